#include "maps/cuts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <tuple>
#include <unordered_map>

#include "base/parallel.h"
#include "maps/photon_map.h"
#include "trace/box_search.h"

namespace lw {
namespace {

constexpr float least_wall = 1;           // radius: shorter things (legs, boards of furniture) cut nothing
constexpr float tolerance = 0.002f;       // of the radius: segments as close to a line lie on it
constexpr float least_piece = 0.1f;       // of the radius: a wall along the border of a patch cuts nothing off
constexpr float round_tolerance = 0.02f;  // of the radius: how far a chord may be from a round wall
constexpr float least_chord = 0.5f;       // radius
constexpr float least_round_wall = 1;     // radius, along the wall
constexpr float steep = 0.7f;             // largest cosine between the normals of a wall and of what it stands on
constexpr size_t most_cuts = 255, most_tried = 512;
constexpr int deepest_cut = most_cuts_deep;

using Outline = std::vector<vec2>;  // convex, counter-clockwise

struct Segment {
    uint patch;
    uint triangle;
    vec2 a, b;  // in the frame of the patch
};

/// A line with the stretches of it where walls stand, in metres from `point` along `along`.
struct WallLine {
    vec2 point, along;
    std::vector<vec2> stretches;
    float length = 0;       // of the longest stretch
    bool is_chord = false;  // of a round wall

    float height(vec2 p) const { return along.x * (p.y - point.y) - along.y * (p.x - point.x); }
};

/// Whether walls may stand on a patch: it is plane, and no small piece of furniture.
bool may_be_cut(const PatchShape& shape, float radius) {
    const vec3 size = shape.high - shape.low;
    return shape.cos_spread > 0.999f && size.z <= height_of_cuts(radius) &&
           std::max(size.x, size.y) > least_wall * radius;
}

/// Where a triangle that crosses the plane a little above the patch meets the patch, clipped to it and its
/// surroundings.
bool crossing(const PatchShape& shape, const std::array<vec3, 3>& corners, float radius, Segment& segment) {
    std::array<vec3, 3> local;
    const float plane = shape.high.z + height_of_cuts(radius);
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
        const float low = shape.low[axis] - radius - ends[0][axis], high = shape.high[axis] + radius - ends[0][axis];
        if (d[axis] == 0) {
            if (low > 0 || high < 0) return false;
            continue;
        }
        first = std::max(first, std::min(low / d[axis], high / d[axis]));
        last = std::min(last, std::max(low / d[axis], high / d[axis]));
    }
    if (!(first < last)) return false;
    const vec3 n = cross(local[1] - local[0], local[2] - local[0]);  // of the wall: it may lean
    const vec2 foot = vec2(n) * (n.z * height_of_cuts(radius) / std::max(n.x * n.x + n.y * n.y, 1e-30f));
    segment.a = ends[0] + d * first + foot, segment.b = ends[0] + d * last + foot;
    return true;
}

/// The segments along which triangles stand on patches, sorted by patch, the longest first.
std::vector<Segment> find_segments(const Scene& scene, float radius, const std::vector<PatchShape>& shapes) {
    std::vector<Box> slabs;
    for (const PatchShape& s : shapes) {
        const bool wanted = may_be_cut(s, radius);
        const vec3 reach = (abs(s.u_axis) + abs(s.v_axis)) * radius + abs(s.normal) * (2 * height_of_cuts(radius));
        slabs.push_back(wanted ? Box{s.box_low - reach, s.box_high + reach} : Box{vec3(1e30f), vec3(-1e30f)});
    }
    const BoxSearch search(std::move(slabs));
    constexpr size_t chunk = 4096;
    std::vector<std::vector<Segment>> parts((scene.triangles.size() + chunk - 1) / chunk);
    parallel_for(parts.size(), [&](size_t k) {
        for (size_t t = k * chunk; t < std::min(scene.triangles.size(), (k + 1) * chunk); ++t) {
            std::array<vec3, 3> p;
            for (int c = 0; c < 3; ++c) p[size_t(c)] = scene.positions[scene.triangles[t][c]];
            const vec3 product = cross(p[1] - p[0], p[2] - p[0]);
            const float size = length(product);
            search.overlapping({min(p[0], min(p[1], p[2])), max(p[0], max(p[1], p[2]))}, [&](uint patch) {
                Segment segment{patch, uint(t), {}, {}};
                if (std::abs(dot(product, shapes[patch].normal)) < steep * size &&
                    crossing(shapes[patch], p, radius, segment))
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

/// Which lines of like direction and place lie a segment's: cells of 2 degrees and a twentieth of the radius.
glm::ivec2 bin_of(const Segment& s, float radius) {
    vec2 along = s.b - s.a;
    if (along.x < 0 || (along.x == 0 && along.y < 0)) along = -along;
    const float angle = std::atan2(along.y, along.x), size = std::max(length(along), 1e-20f);
    const float offset = (along.x * s.a.y - along.y * s.a.x) / size;
    return {int(std::round(angle * 28.6f)), int(std::round(clamp(offset / radius * 20, -1e6f, 1e6f)))};
}

/// Joins overlapping and touching stretches and keeps those of at least `least` m.
void join_stretches(WallLine& line, float radius, float least) {
    std::sort(line.stretches.begin(), line.stretches.end(), [](vec2 x, vec2 y) { return x.x < y.x; });
    std::vector<vec2> joined;
    for (vec2 s : line.stretches)
        if (!joined.empty() && s.x <= joined.back().y + 0.02f * radius)
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

/// The chord of a round wall around the middle of a segment, halfway between the wall's points nearest and farthest.
WallLine chord_of(std::span<const Segment> segments, const Segment& seed, float radius) {
    WallLine line{0.5f * (seed.a + seed.b), normalize(seed.b - seed.a), {}};
    line.is_chord = true;
    std::vector<std::pair<vec2, vec2>> places;  // along the line and from it
    for (const Segment& s : segments) {
        const vec2 heights(line.height(s.a), line.height(s.b));
        if (std::max(std::abs(heights.x), std::abs(heights.y)) > 2 * round_tolerance * radius) continue;
        const float a = dot(s.a - line.point, line.along), b = dot(s.b - line.point, line.along);
        line.stretches.emplace_back(std::min(a, b), std::max(a, b));
        places.emplace_back(line.stretches.back(), heights);
    }
    join_stretches(line, radius, least_chord * radius);
    std::erase_if(line.stretches, [](vec2 s) { return s.x > 0 || s.y < 0; });
    line.length = line.stretches.empty() ? 0 : line.stretches[0].y - line.stretches[0].x;
    float low = 0, high = 0;
    for (const auto& [at, heights] : places)
        if (line.length > 0 && at.x >= line.stretches[0].x && at.y <= line.stretches[0].y)
            low = std::min({low, heights.x, heights.y}), high = std::max({high, heights.x, heights.y});
    line.point += vec2(-line.along.y, line.along.x) * (0.5f * (low + high));
    return line;
}

/// Whether a chord's wall goes on at one of its ends, bent by less than 45 degrees, in another chord.
bool goes_on(const WallLine& x, const WallLine& y, float radius) {
    if (std::abs(dot(x.along, y.along)) < 0.7f) return false;
    const auto distance_to = [&](vec2 p) {
        const float at = clamp(dot(p - y.point, y.along), y.stretches[0].x, y.stretches[0].y);
        return length(p - y.point - y.along * at);
    };
    return std::min(distance_to(x.point + x.along * x.stretches[0].x),
                    distance_to(x.point + x.along * x.stretches[0].y)) < 4 * round_tolerance * radius;
}

/// Adds chords for the segments that no straight line took, where they make up a long enough wall, each beside the
/// one before: then what one chord cuts off lies beside what the next does.
void add_chords(std::span<const Segment> segments, std::vector<char>& taken, float radius,
                std::vector<WallLine>& lines) {
    std::vector<WallLine> chords;
    size_t tried = 0;
    for (size_t i = 0; i < segments.size() && tried < most_tried && lines.size() + chords.size() < most_cuts; ++i) {
        if (taken[i] || !(length(segments[i].b - segments[i].a) > 0)) continue;
        ++tried;
        WallLine line = chord_of(segments, segments[i], radius);
        if (!(line.length > 0)) continue;
        const vec2 stretch = line.stretches[0];
        for (size_t j = i; j < segments.size(); ++j) {
            const vec2 to_middle = 0.5f * (segments[j].a + segments[j].b) - line.point;
            const float at = dot(to_middle, line.along);
            taken[j] |= std::abs(line.height(segments[j].a)) <= round_tolerance * radius &&
                        std::abs(line.height(segments[j].b)) <= round_tolerance * radius && at >= stretch.x &&
                        at <= stretch.y;
        }
        chords.push_back(std::move(line));
    }
    std::vector<float> walls;
    for (WallLine& chord : chords) {
        walls.push_back(0);
        for (const WallLine& other : chords)  // itself too
            walls.back() += goes_on(chord, other, radius) ? other.length : 0;
    }
    for (size_t i = chords.size(); i-- > 0;)
        if (walls[i] < least_round_wall * radius) chords.erase(chords.begin() + ptrdiff_t(i));
    for (size_t i = 0; i < chords.size(); ++i) {
        const vec2 end = i ? chords[i - 1].point : chords[0].point;
        std::iter_swap(chords.begin() + ptrdiff_t(i),
                       std::min_element(chords.begin() + ptrdiff_t(i), chords.end(), [&](const auto& x, const auto& y) {
                           return length(x.point - end) < length(y.point - end);
                       }));
    }
    lines.insert(lines.end(), chords.begin(), chords.end());
}

/// The lines on which long enough walls stand, from the segments of one patch.
std::vector<WallLine> find_lines(std::span<const Segment> segments, float radius) {
    std::unordered_map<uint64_t, float> lengths;
    const auto key = [](glm::ivec2 bin) { return uint64_t(uint(bin.x)) << 32 | uint(bin.y); };
    std::vector<glm::ivec2> bins;
    for (const Segment& s : segments) {
        bins.push_back(bin_of(s, radius));
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
    for (size_t i = 0; i < segments.size() && tried < most_tried && lines.size() < most_cuts; ++i) {
        const vec2 along = segments[i].b - segments[i].a;
        const float size = length(along);
        if (taken[i] || !(size > 0) || length_around(bins[i]) < least_wall * radius) continue;
        ++tried;
        WallLine line{segments[i].a, along / size, {}};
        members.clear();
        for (size_t j = i; j < segments.size(); ++j) {
            if (taken[j] || std::abs(line.height(segments[j].a)) > tolerance * radius ||
                std::abs(line.height(segments[j].b)) > tolerance * radius)
                continue;
            taken[j] = 1;
            members.push_back(j);
            const float a = dot(segments[j].a - line.point, line.along),
                        b = dot(segments[j].b - line.point, line.along);
            line.stretches.emplace_back(std::min(a, b), std::max(a, b));
        }
        join_stretches(line, radius, least_wall * radius);
        if (!(line.length > 0)) continue;
        for (size_t j : members) straight[j] = 1;
        lines.push_back(std::move(line));
    }
    add_chords(segments, straight, radius, lines);
    return lines;
}

/// The convex hull of points (monotone chain, Andrew 1979).
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

/// The outlines of the wanted patches, in their frames.
std::unordered_map<uint, Outline> outlines_of(const Scene& scene, const Patches& patches,
                                              const std::vector<PatchShape>& shapes, const std::vector<uint>& wanted) {
    std::unordered_map<uint, Outline> outlines;
    for (uint patch : wanted) outlines[patch];
    for (size_t side = 0; side < patches.of_side.size(); ++side)
        if (const auto found = outlines.find(patches.of_side[side]); found != outlines.end())
            for (int c = 0; c < 3; ++c)
                found->second.emplace_back(
                    shapes[found->first].to_local(scene.positions[scene.triangles[side / 2][c]]));
    for (auto& [patch, outline] : outlines) outline = hull_of(std::move(outline));
    return outlines;
}

/// The part of an outline where `sign` x the height over the line is positive.
Outline part_of(const Outline& outline, const WallLine& line, float sign) {
    Outline part;
    for (size_t i = 0; i < outline.size(); ++i) {
        const vec2 p = outline[i], q = outline[(i + 1) % outline.size()];
        const float hp = sign * line.height(p), hq = sign * line.height(q);
        if (hp >= 0) part.push_back(p);
        if ((hp > 0 && hq < 0) || (hp < 0 && hq > 0)) part.push_back(p + (q - p) * (hp / (hp - hq)));
    }
    return part;
}

/// How much of the walls of a line stands inside the outline, m; 0 when the line cuts off next to nothing.
float length_inside(const Outline& outline, const WallLine& line, float radius) {
    float low = 0, high = 0, first = 1e30f, last = -1e30f;
    for (size_t i = 0; i < outline.size(); ++i) {
        const vec2 p = outline[i], q = outline[(i + 1) % outline.size()];
        const float hp = line.height(p), hq = line.height(q);
        low = std::min(low, hp), high = std::max(high, hp);
        if ((hp < 0) == (hq < 0)) continue;
        const float s = dot(p + (q - p) * (hp / (hp - hq)) - line.point, line.along);
        first = std::min(first, s), last = std::max(last, s);
    }
    if (std::min(-low, high) < (line.is_chord ? round_tolerance : least_piece) * radius) return 0;
    float inside = 0;
    for (vec2 s : line.stretches) inside += std::max(0.0f, std::min(s.y, last) - std::max(s.x, first));
    return inside;
}

/// Cuts one patch after another.
class Cutter {
  public:
    Cutter(float radius, Patches& patches, std::vector<PatchShape>& shapes)
        : radius_(radius), patches_(patches), shapes_(shapes), roots_(shapes.size(), no_map) {}

    void cut(uint patch, const Outline& outline, const std::vector<WallLine>& lines) {
        whole_ = shapes_[patch];
        lines_ = &lines;
        left_ = most_cuts;
        free_ = patch;
        const uint root = divide(outline, 0);
        if (root & is_cut) roots_[patch] = root;
    }

    /// Numbers the cuts behind all patches.
    void finish() {
        patches_.count = uint(shapes_.size());
        const auto number = [&](uint id) { return id & is_cut ? patches_.count + (id & ~is_cut) : id; };
        for (PatchCut& c : patches_.cuts) c.front = number(c.front), c.back = number(c.back);
        for (uint& side : patches_.of_side)
            if (roots_[side] != no_map) side = number(roots_[side]);
    }

  private:
    static constexpr uint is_cut = 1u << 31;

    uint divide(const Outline& outline, int depth) {
        const WallLine* best = nullptr;
        float most = 0.02f * radius_;
        for (const WallLine& line : *lines_) {
            if (line.is_chord && best) break;  // chords are the last, in the order in which they cut
            if (const float inside = length_inside(outline, line, radius_); inside > most) best = &line, most = inside;
        }
        if (!best || left_ == 0 || depth == deepest_cut) return add_piece(outline, depth > 0);
        --left_;
        const auto index = uint(patches_.cuts.size());
        const vec3 up = whole_.v_axis * best->along.x - whole_.u_axis * best->along.y;
        const vec3 point = whole_.anchor + whole_.u_axis * best->point.x + whole_.v_axis * best->point.y;
        patches_.cuts.push_back({point, up, 0, 0});
        const uint front = divide(part_of(outline, *best, 1), depth + 1);
        const uint back = divide(part_of(outline, *best, -1), depth + 1);
        patches_.cuts[index].front = front, patches_.cuts[index].back = back;
        return index | is_cut;
    }

    /// The first piece takes the place of the whole.
    uint add_piece(const Outline& outline, bool is_part) {
        if (!is_part) return free_;
        PatchShape piece = whole_;
        piece.outline = outline;
        piece.box_low = vec3(1e30f), piece.box_high = vec3(-1e30f);
        vec2 low(1e30f), high(-1e30f);
        for (vec2 p : outline) {
            low = min(low, p), high = max(high, p);
            for (float h : {whole_.low.z, whole_.high.z}) {
                const vec3 at = whole_.anchor + whole_.u_axis * p.x + whole_.v_axis * p.y + whole_.normal * h;
                piece.box_low = min(piece.box_low, at), piece.box_high = max(piece.box_high, at);
            }
        }
        piece.low = vec3(low, whole_.low.z), piece.high = vec3(high, whole_.high.z);
        const uint id = free_ != no_map ? free_ : uint(shapes_.size());
        if (free_ == no_map) shapes_.emplace_back();
        free_ = no_map;
        shapes_[id] = std::move(piece);
        return id;
    }

    float radius_;
    Patches& patches_;
    std::vector<PatchShape>& shapes_;
    std::vector<uint> roots_;
    PatchShape whole_;
    const std::vector<WallLine>* lines_ = nullptr;
    size_t left_ = 0;
    uint free_ = no_map;
};

}  // namespace

void cut_patches(const Scene& scene, float radius, Patches& patches, std::vector<PatchShape>& shapes) {
    const std::vector<Segment> segments = find_segments(scene, radius, shapes);
    std::vector<size_t> starts{0};
    for (size_t i = 1; i <= segments.size(); ++i)
        if (i == segments.size() || segments[i].patch != segments[i - 1].patch) starts.push_back(i);
    if (segments.empty()) return;
    std::vector<std::vector<WallLine>> lines(starts.size() - 1);
    parallel_for(lines.size(), [&](size_t i) {
        lines[i] = find_lines(std::span(segments).subspan(starts[i], starts[i + 1] - starts[i]), radius);
    });
    std::vector<uint> wanted;
    for (size_t i = 0; i < lines.size(); ++i)
        if (!lines[i].empty()) wanted.push_back(segments[starts[i]].patch);
    const std::unordered_map<uint, Outline> outlines = outlines_of(scene, patches, shapes, wanted);
    Cutter cutter(radius, patches, shapes);
    for (size_t i = 0; i < lines.size(); ++i) {
        const uint patch = segments[starts[i]].patch;
        if (!lines[i].empty() && outlines.at(patch).size() > 2) cutter.cut(patch, outlines.at(patch), lines[i]);
    }
    cutter.finish();
}

vec2 nearest_in_outline(const std::vector<vec2>& outline, vec2 p) {
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

}  // namespace lw
