#include "maps/wall_lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <tuple>
#include <unordered_map>

#include "base/parallel.h"
#include "scene/triangle.h"
#include "trace/box_search.h"

namespace lw {
namespace {

constexpr float min_wall = 1;        // in scales: shorter things (legs and boards of furniture) cut nothing
constexpr float tolerance = 0.002f;  // in scales: segments this close to a line lie on it
constexpr float min_chord = 0.3f;    // scale
constexpr float max_chord = 8;       // scales
constexpr float min_round_wall = 1;  // in scales, along the wall
constexpr float steep = 0.7f;        // largest cosine between the normals of a wall and of the surface it stands on
constexpr size_t max_lines = 255, max_tried = 512;

struct Segment {
    uint patch;
    uint triangle;
    vec2 a, b;  // in the frame of the patch
};

/// True when a patch may be cut: it is plane and not small.
bool may_be_cut(const PatchShape& shape, float scale) {
    const vec3 size = shape.high - shape.low;
    return shape.cos_spread > 0.999f && size.z <= height_of_cuts(scale) && std::max(size.x, size.y) > min_wall * scale;
}

/// Sets `segment` to the line where a triangle stands on a patch: its intersection with a plane a little above the
/// patch, clipped to the patch and its surroundings. Returns false when there is none.
bool crossing(const PatchShape& shape, const std::array<vec3, 3>& corners, float scale, Segment& segment) {
    std::array<vec3, 3> local;
    const float plane = shape.high.z + height_of_cuts(scale);
    for (size_t c = 0; c < 3; ++c) local[c] = shape.to_local(corners[c]) - vec3(0, 0, plane);
    std::array<vec2, 3> ends;
    size_t found = 0;
    for (size_t c = 0; c < 3; ++c) {
        const vec3 p = local[c], q = local[(c + 1) % 3];
        if ((p.z < 0) != (q.z < 0)) ends[found++] = vec2(p) + (vec2(q) - vec2(p)) * (p.z / (p.z - q.z));
    }
    if (found != 2) return false;
    float first = 0, last = 1;
    const vec2 d = ends[1] - ends[0];
    for (int axis = 0; axis < 2; ++axis) {
        const float low = shape.low[axis] - scale - ends[0][axis], high = shape.high[axis] + scale - ends[0][axis];
        if (d[axis] == 0) {
            if (low > 0 || high < 0) return false;
            continue;
        }
        first = std::max(first, std::min(low / d[axis], high / d[axis]));
        last = std::min(last, std::max(low / d[axis], high / d[axis]));
    }
    if (!(first < last)) return false;
    const vec3 n = edge_product(local[0], local[1], local[2]);  // normal of the wall, which may lean
    const vec2 foot = vec2(n) * (n.z * height_of_cuts(scale) / std::max(n.x * n.x + n.y * n.y, 1e-30f));
    segment.a = ends[0] + d * first + foot, segment.b = ends[0] + d * last + foot;
    return true;
}

/// All segments along which triangles stand on patches, sorted by patch, the longest first.
std::vector<Segment> find_segments(const Scene& scene, const std::vector<float>& scales,
                                   const std::vector<PatchShape>& shapes) {
    std::vector<Box> slabs;
    for (size_t p = 0; p < shapes.size(); ++p) {
        const PatchShape& s = shapes[p];
        const float scale = scales[p];
        const bool wanted = may_be_cut(s, scale);
        const vec3 reach = (abs(s.u_axis) + abs(s.v_axis)) * scale + abs(s.normal) * (2 * height_of_cuts(scale));
        slabs.push_back(wanted ? Box{s.box_low - reach, s.box_high + reach} : Box{vec3(1e30f), vec3(-1e30f)});
    }
    const BoxSearch search(std::move(slabs));
    constexpr size_t chunk = 4096;
    std::vector<std::vector<Segment>> parts((scene.triangles.size() + chunk - 1) / chunk);
    parallel_for(parts.size(), [&](size_t k) {
        for (size_t t = k * chunk; t < std::min(scene.triangles.size(), (k + 1) * chunk); ++t) {
            const std::array<vec3, 3> p = triangle_corners(scene, t);
            const vec3 product = edge_product(p[0], p[1], p[2]);
            const float size = length(product);
            search.overlapping({min(p[0], min(p[1], p[2])), max(p[0], max(p[1], p[2]))}, [&](uint patch) {
                Segment segment{patch, uint(t), {}, {}};
                if (std::abs(dot(product, shapes[patch].normal)) < steep * size &&
                    crossing(shapes[patch], p, scales[patch], segment))
                    parts[k].push_back(segment);
            });
        }
    });
    std::vector<Segment> segments;
    for (const auto& part : parts) segments.insert(segments.end(), part.begin(), part.end());
    parallel_sort(segments.begin(), segments.end(), [](const Segment& x, const Segment& y) {
        const float length_x = dot(x.b - x.a, x.b - x.a), length_y = dot(y.b - y.a, y.b - y.a);
        return std::tuple(x.patch, -length_x, x.triangle) < std::tuple(y.patch, -length_y, y.triangle);
    });
    return segments;
}

/// The bin of a segment's line, by direction and distance from the origin: 2 degrees and a twentieth of the scale
/// wide.
glm::ivec2 bin_of(const Segment& s, float scale) {
    vec2 along = s.b - s.a;
    if (along.x < 0 || (along.x == 0 && along.y < 0)) along = -along;
    const float angle = std::atan2(along.y, along.x), size = std::max(length(along), 1e-20f);
    const float offset = (along.x * s.a.y - along.y * s.a.x) / size;
    return {int(std::round(angle * 28.6f)), int(std::round(clamp(offset / scale * 20, -1e6f, 1e6f)))};
}

/// Joins overlapping and touching stretches and keeps those of at least `least` m.
void join_stretches(WallLine& line, float scale, float least) {
    std::sort(line.stretches.begin(), line.stretches.end(), [](vec2 x, vec2 y) { return x.x < y.x; });
    std::vector<vec2> joined;
    for (vec2 s : line.stretches)
        if (!joined.empty() && s.x <= joined.back().y + 0.02f * scale)
            joined.back().y = std::max(joined.back().y, s.y);
        else
            joined.push_back(s);
    line.stretches.clear();
    for (vec2 s : joined)
        if (s.y - s.x >= least) {
            line.stretches.push_back(s);
            line.length = std::max(line.length, s.y - s.x);
        }
}

/// The longest chord from `start` to which the wall that begins there along `ahead` stays close. Found with the cone of
/// directions that pass all points of the wall (Williams 1978); the chord lies halfway between the points of the wall
/// on either side.
WallLine chord_from(std::span<const Segment> segments, const std::vector<uint>& open, vec2 start, vec2 ahead,
                    float scale) {
    struct Wall {
        float distance2;
        std::array<vec2, 2> ends;  // the one closer to `start` first
    };
    std::vector<Wall> walls;
    const float farthest2 = max_chord * scale * max_chord * scale;
    for (uint i : open) {
        const vec2 a = segments[i].a - start, b = segments[i].b - start;
        const float a2 = dot(a, a), b2 = dot(b, b);
        if (std::min(a2, b2) >= farthest2 || dot(a2 > b2 ? a : b, ahead) <= 0) continue;
        walls.push_back(a2 > b2 ? Wall{b2, {b, a}} : Wall{a2, {a, b}});
    }
    std::sort(walls.begin(), walls.end(), [](const Wall& x, const Wall& y) { return x.distance2 < y.distance2; });
    const float width = 2 * width_of_chords(scale);
    float right = -0.5f * lw_pi, left = -right, reached = 0;
    WallLine chord{start, ahead, {}, 0, true};
    std::vector<vec2> passed;
    for (const auto& [distance2, wall] : walls) {
        if (std::sqrt(distance2) > reached + 0.1f * width) break;
        const auto angle_of = [&](vec2 p) { return std::atan2(ahead.x * p.y - ahead.y * p.x, dot(ahead, p)); };
        const auto half_angle = [&](vec2 p) { return std::asin(std::min(width / std::max(length(p), width), 1.0f)); };
        const float angle = angle_of(wall[1]);
        if (angle < right || angle > left) continue;
        for (vec2 p : wall)
            if (p != vec2(0))
                right = std::max(right, angle_of(p) - half_angle(p)),
                left = std::min(left, angle_of(p) + half_angle(p));
        passed.insert(passed.end(), wall.begin(), wall.end());
        if (length(wall[1]) > reached) reached = length(wall[1]), chord.along = wall[1] / reached;
    }
    float low = 0, high = 0;
    for (vec2 p : passed) low = std::min(low, chord.height(start + p)), high = std::max(high, chord.height(start + p));
    chord.point += vec2(-chord.along.y, chord.along.x) * (0.5f * (low + high));
    chord.length = reached;
    return chord;
}

/// True when the wall of chord x goes on in chord y: they meet at an end, bent by less than 45 degrees.
bool goes_on(const WallLine& x, const WallLine& y, float scale) {
    if (std::abs(dot(x.along, y.along)) < 0.7f) return false;
    const auto distance_to = [&](vec2 p) {
        const float at = clamp(dot(p - y.point, y.along), y.stretches[0].x, y.stretches[0].y);
        return length(p - y.point - y.along * at);
    };
    return std::min(distance_to(x.point + x.along * x.stretches[0].x),
                    distance_to(x.point + x.along * x.stretches[0].y)) < 4 * width_of_chords(scale);
}

/// Adds chords for the segments that no straight line covers, where they form a long enough wall. Each chord begins
/// where the one before ends, so that the pieces they cut off lie side by side.
void add_chords(std::span<const Segment> segments, const std::vector<char>& taken, float scale,
                std::vector<WallLine>& lines) {
    std::vector<WallLine> chords;
    std::vector<uint> open;  // the segments that no line covers
    for (uint i = 0; i < segments.size(); ++i)
        if (!taken[i] && segments[i].a != segments[i].b) open.push_back(i);
    const auto squared = [](vec2 v) { return dot(v, v); };
    vec2 end = segments[0].a;
    for (size_t tried = 0; tried < max_tried && lines.size() + chords.size() < max_lines && !open.empty(); ++tried) {
        uint first = open[0];
        float least = 1e30f;
        for (uint i : open)
            if (const float d = std::min(squared(segments[i].a - end), squared(segments[i].b - end)); d < least)
                least = d, first = i;
        const Segment* seed = &segments[first];
        const bool is_turned = squared(seed->b - end) < squared(seed->a - end);
        const vec2 from = is_turned ? seed->b : seed->a, to = is_turned ? seed->a : seed->b;
        const WallLine chord = chord_from(segments, open, from, normalize(to - from), scale);
        std::erase_if(open, [&](uint i) {
            const Segment& s = segments[i];
            const float at = dot(0.5f * (s.a + s.b) - chord.point, chord.along);
            return i == first ||
                   (std::max(std::abs(chord.height(s.a)), std::abs(chord.height(s.b))) <= 2 * width_of_chords(scale) &&
                    at >= 0 && at <= chord.length);
        });
        end = from + chord.along * chord.length;
        if (chord.length < min_chord * scale) continue;
        chords.push_back(chord);
        chords.back().stretches.emplace_back(0.0f, chord.length);
    }
    for (const WallLine& chord : chords) {
        float wall = 0;
        for (const WallLine& other : chords)  // itself too
            wall += goes_on(chord, other, scale) ? other.length : 0;
        if (wall >= min_round_wall * scale) lines.push_back(chord);
    }
}

/// Finds the lines on which long enough walls stand, from the segments of one patch.
std::vector<WallLine> find_lines(std::span<const Segment> segments, float scale) {
    std::unordered_map<uint64_t, float> lengths;
    const auto key = [](glm::ivec2 bin) { return uint64_t(uint(bin.x)) << 32 | uint(bin.y); };
    std::vector<glm::ivec2> bins;
    for (const Segment& s : segments) {
        bins.push_back(bin_of(s, scale));
        lengths[key(bins.back())] += length(s.b - s.a);
    }
    const auto length_around = [&](glm::ivec2 bin) {
        float sum = 0;
        for (int x = -1; x <= 1; ++x)
            for (int y = -1; y <= 1; ++y)
                if (const auto found = lengths.find(key(bin + glm::ivec2(x, y))); found != lengths.end())
                    sum += found->second;
        return sum;
    };
    std::vector<WallLine> lines;
    std::vector<char> taken(segments.size(), 0), straight = taken;
    std::vector<size_t> members;
    size_t tried = 0;
    for (size_t i = 0; i < segments.size() && tried < max_tried && lines.size() < max_lines; ++i) {
        const vec2 along = segments[i].b - segments[i].a;
        const float size = length(along);
        if (taken[i] || !(size > 0) || length_around(bins[i]) < min_wall * scale) continue;
        ++tried;
        WallLine line{segments[i].a, along / size, {}};
        members.clear();
        for (size_t j = i; j < segments.size(); ++j) {
            if (taken[j] || std::abs(line.height(segments[j].a)) > tolerance * scale ||
                std::abs(line.height(segments[j].b)) > tolerance * scale)
                continue;
            taken[j] = 1;
            members.push_back(j);
            const float a = dot(segments[j].a - line.point, line.along),
                        b = dot(segments[j].b - line.point, line.along);
            line.stretches.emplace_back(std::min(a, b), std::max(a, b));
        }
        join_stretches(line, scale, min_wall * scale);
        if (!(line.length > 0)) continue;
        for (size_t j : members) straight[j] = 1;
        lines.push_back(std::move(line));
    }
    add_chords(segments, straight, scale, lines);
    return lines;
}

}  // namespace

std::vector<WalledPatch> find_walls(const Scene& scene, const std::vector<float>& scales,
                                    const std::vector<PatchShape>& shapes) {
    const std::vector<Segment> segments = find_segments(scene, scales, shapes);
    std::vector<size_t> starts;
    for (size_t i = 0; i < segments.size(); ++i)
        if (i == 0 || segments[i].patch != segments[i - 1].patch) starts.push_back(i);
    std::vector<WalledPatch> walled(starts.size());
    parallel_for(starts.size(), [&](size_t i) {
        const size_t end = i + 1 < starts.size() ? starts[i + 1] : segments.size();
        walled[i] = {segments[starts[i]].patch, find_lines(std::span(segments).subspan(starts[i], end - starts[i]),
                                                           scales[segments[starts[i]].patch])};
    });
    std::erase_if(walled, [](const WalledPatch& w) { return w.lines.empty(); });
    return walled;
}

}  // namespace lw
