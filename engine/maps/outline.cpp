#include "maps/outline.h"

#include <algorithm>
#include <tuple>

namespace lw {

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
    for (size_t i = 0; i < outline.size(); ++i) {
        const vec2 a = outline[i], edge = outline[(i + 1) % outline.size()] - a;
        const vec2 inwards = vec2(-edge.y, edge.x) / std::max(length(edge), 1e-20f);
        p += inwards * std::max(0.0f, distance - dot(p - a, inwards));
    }
    return p;
}

}  // namespace lw
