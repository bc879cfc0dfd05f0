// The hard ways to write the plain room down.
#pragma once
#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <string>

#include "robustness/room.h"

namespace lw::test {

/// The name of a disguise as words.
inline std::string words_of(std::string name) {
    std::replace(name.begin(), name.end(), '_', ' ');
    return name;
}

struct Disguise {
    const char* name;
    Room (*room)();
    double scale = 1;  // of the illuminance
};

inline void PrintTo(const Disguise& disguise, std::ostream* out) { *out << disguise.name; }

inline Room with_node(const glm::dmat4& node) {
    Room room = plain_room();
    room.node = node;
    return room;
}

inline Room with_soup(Soup (*change)(const Soup&)) {
    Room room = plain_room();
    for (Soup* soup : {&room.walls, &room.block}) *soup = change(*soup);
    return room;
}

inline Room far_in_vertices() {
    const glm::dvec3 far(10240, 0, -10240);
    Room room = plain_room();
    for (Soup* soup : {&room.walls, &room.block, &room.panel})
        *soup = moved(*soup, [=](glm::dvec3 p) { return p + far; });
    room.lamp += far, room.eye += far;
    return room;
}

/// Made smaller or larger in its vertices, under a node that undoes it or under none.
inline Room scaled_in_vertices(double scale, bool undone_by_node) {
    Room room = plain_room();
    for (Soup* soup : {&room.walls, &room.block, &room.panel})
        *soup = moved(*soup, [=](glm::dvec3 p) { return p * scale; });
    room.lamp *= scale, room.eye *= scale;
    room.unit = scale;
    if (undone_by_node)
        room.node = glm::scale(glm::dmat4(1), glm::dvec3(1 / scale));
    else
        room.candela *= scale * scale;
    return room;
}

/// Each quad of two triangles as strips whose sides are 1 : 10,000.
inline Soup needles(const Soup& soup) {
    Soup strips;
    for (size_t i = 0; i < soup.size(); i += 2) {
        const auto& [a, b, c] = soup[i];
        const glm::dvec3 u = b - a, v = c - b;
        strips = joined(strips, quad(a, u, v, 1, int(std::round(glm::length(v) / glm::length(u) * 10'000))));
    }
    return strips;
}

inline Soup flipped(const Soup& soup) {
    Soup other = soup;
    for (Corners& t : other) std::swap(t[1], t[2]);
    return other;
}

inline const Disguise disguises[] = {
    {"1000_km_away_by_its_node", [] { return with_node(glm::translate(glm::dmat4(1), glm::dvec3(1e6, -1e6, 1e6))); }},
    {"10_km_away_in_its_vertices", far_in_vertices},
    {"a_millimetre_wide_by_its_node",
     [] {
         Room room = with_node(glm::scale(glm::dmat4(1), glm::dvec3(0.25e-3)));
         room.candela *= 0.25e-3 * 0.25e-3;
         return room;
     }},
    {"a_kilometre_wide_by_its_node",
     [] {
         Room room = with_node(glm::scale(glm::dmat4(1), glm::dvec3(250)));
         room.candela *= 250.0 * 250.0;
         return room;
     }},
    {"a_millimetre_wide_in_its_vertices", [] { return scaled_in_vertices(0.25e-3, false); }},
    {"a_kilometre_wide_in_its_vertices", [] { return scaled_in_vertices(250, false); }},
    {"turned", [] { return with_node(glm::rotate(glm::dmat4(1), 0.7, glm::dvec3(1, 2, 3) / std::sqrt(14.0))); }},
    {"mirrored", [] { return with_node(glm::scale(glm::dmat4(1), glm::dvec3(-1, 1, 1))); }},
    {"a_million_triangles", [] { return with_soup([](const Soup& s) { return divided(s, 204); }); }},
    {"needles_of_1_to_10000", [] { return with_soup(needles); }},
    {"T_junctions",
     [] {
         return with_soup([](const Soup& s) {
             Soup mixed;
             for (size_t i = 0; i < s.size(); ++i) mixed = joined(mixed, divided({s[i]}, i % 2 ? 7 : 1 + int(i % 5)));
             return mixed;
         });
     }},
    {"every_triangle_twice", [] { return with_soup([](const Soup& s) { return joined(s, s); }); }},
    {"every_small_triangle_twice",
     [] { return with_soup([](const Soup& s) { return joined(divided(s, 30), divided(s, 30)); }); }},
    {"coplanar_overlapping",
     [] {
         Room room = plain_room();
         room.walls = joined(room.walls, quad({1, 0, 1}, {0, 0, 3}, {2.5, 0, 0}));
         return room;
     }},
    {"with_triangles_without_area",
     [] {
         return with_soup([](const Soup& s) {
             Soup more = s;
             for (const auto& [a, b, c] : s) {
                 more.push_back({a, a, b});
                 more.push_back({a, a, a});
                 more.push_back({a, (a + b) * 0.5, b});
             }
             return more;
         });
     }},
    {"denormal_coordinates",
     [] {
         return with_soup(
             [](const Soup& s) { return moved(s, [](glm::dvec3 p) { return glm::max(p, glm::dvec3(1e-41)); }); });
     }},
    {"of_denormal_coordinates_alone", [] { return scaled_in_vertices(1e-39, true); }},
    {"inside_out", [] { return with_soup(flipped); }},
    {"mixed_winding",
     [] {
         return with_soup([](const Soup& s) {
             Soup mixed = divided(s, 10);
             for (size_t i = 0; i < mixed.size(); i += 3) std::swap(mixed[i][1], mixed[i][2]);
             return mixed;
         });
     }},
    {"double_sided",
     [] {
         Room room = plain_room();
         room.double_sided = true;
         return room;
     }},
    {"lit_1e9_times",
     [] {
         Room room = plain_room();
         room.candela *= 1e9, room.panel_luminance *= 1e9;
         return room;
     },
     1e9},
    {"lit_1e_6_times",
     [] {
         Room room = plain_room();
         room.candela *= 1e-6, room.panel_luminance *= 1e-6;
         return room;
     },
     1e-6},
};

}  // namespace lw::test
