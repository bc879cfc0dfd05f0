#include "maps/outline.h"

#include <algorithm>
#include <tuple>

namespace lw {
namespace {

constexpr float least_edge = 2e-6f;  // of the outline: what is shorter has no direction

}  // namespace

Outline hull_of(Outline points) {
    std::sort(points.begin(), points.end(), [](vec2 p, vec2 q) { return std::tie(p.x, p.y) < std::tie(q.x, q.y); });
    Outline hull;
    for (const bool back : {false, true}) {
        const size_t first = hull.size();
        for (const vec2 p : points) {
            const auto turns_left = [&] {
                const vec2 a = hull[hull.size() - 2], b = hull.back();
                return (b.x - a.x) * (p.y - b.y) - (b.y - a.y) * (p.x - b.x) > 0;
            };
            while (hull.size() >= first + 2 && !turns_left()) hull.pop_back();
            hull.push_back(p);
        }
        hull.pop_back();  // the other half begins with it
        if (!back) std::reverse(points.begin(), points.end());
    }
    return hull;
}

vec2 nearest_in_outline(const Outline& outline, vec2 p) {
    vec2 nearest = p;
    float least = 1e30f;
    bool inside = true;
    for (size_t i = 0; i < outline.size(); ++i) {
        const vec2 a = outline[i], edge = outline[(i + 1) % outline.size()] - a;
        inside = inside && edge.x * (p.y - a.y) - edge.y * (p.x - a.x) >= 0;
        const vec2 on_edge = a + edge * clamp(dot(p - a, edge) / std::max(dot(edge, edge), 1e-30f), 0.0f, 1.0f);
        if (const float d2 = dot(p - on_edge, p - on_edge); d2 < least) least = d2, nearest = on_edge;
    }
    return inside ? p : nearest;
}

vec2 inside_outline(const Outline& outline, vec2 p, float distance) {
    constexpr int passes = 32;  // at a sharp corner each edge sends the point a little out over the other
    bool moved = true;
    for (int pass = 0; pass < passes && moved; ++pass) {
        moved = false;
        for (size_t i = 0; i < outline.size(); ++i) {
            const vec2 a = outline[i], edge = outline[(i + 1) % outline.size()] - a;
            const vec2 inwards = vec2(-edge.y, edge.x) / std::max(length(edge), 1e-20f);
            const float missing = distance - dot(p - a, inwards);
            if (missing > 0) p += inwards * missing;
            moved |= missing > 0.01f * distance;
        }
    }
    return p;
}

Outline part_of(const Outline& outline, vec2 point, vec2 along) {
    const auto height = [&](vec2 p) { return along.x * (p.y - point.y) - along.y * (p.x - point.x); };
    float size = 0;
    for (vec2 p : outline) size = std::max(size, length(p - outline[0]));
    Outline part;
    const auto is_corner = [&](vec2 p, vec2 other) { return length(p - other) > least_edge * size; };
    const auto add = [&](vec2 p) {
        if (part.empty() || is_corner(p, part.back())) part.push_back(p);
    };
    for (size_t i = 0; i < outline.size(); ++i) {
        const vec2 p = outline[i], q = outline[(i + 1) % outline.size()];
        const float hp = height(p), hq = height(q);
        if (hp >= 0) add(p);
        if ((hp > 0 && hq < 0) || (hp < 0 && hq > 0)) add(p + (q - p) * (hp / (hp - hq)));
    }
    while (part.size() > 1 && !is_corner(part.back(), part[0])) part.pop_back();
    return part;
}

float area_of(const Outline& outline) {
    float doubled = 0;
    for (size_t i = 2; i < outline.size(); ++i) {
        const vec2 a = outline[i - 1] - outline[0], b = outline[i] - outline[0];
        doubled += a.x * b.y - a.y * b.x;
    }
    return 0.5f * doubled;
}

}  // namespace lw
