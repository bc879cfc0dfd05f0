#include "maps/cuts.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "maps/outline.h"
#include "maps/wall_lines.h"

namespace lw {
namespace {

constexpr float min_piece = 0.1f;  // in radii, least width of a piece: a wall along the border cuts nothing off
constexpr size_t max_cuts = 255;
constexpr int max_cut = max_cuts_deep;

/// The outlines of the wanted patches, in their frames.
std::unordered_map<uint, Outline> outlines_of(const Scene& scene, const Patches& patches,
                                              const std::vector<PatchShape>& shapes,
                                              const std::vector<WalledPatch>& walled) {
    std::unordered_map<uint, Outline> outlines;
    for (const WalledPatch& w : walled) outlines[w.patch];
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

/// The length of the walls of a line that stand inside the outline, m; 0 when the line would cut off only a narrow
/// strip.
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
    if (std::min(-low, high) < (line.is_chord ? width_of_chords(radius) : min_piece * radius)) return 0;
    float inside = 0;
    for (vec2 s : line.stretches) inside += std::max(0.0f, std::min(s.y, last) - std::max(s.x, first));
    return inside;
}

/// Cuts patches, one after the other, and appends the pieces.
class Cutter {
  public:
    Cutter(float radius, Patches& patches, std::vector<PatchShape>& shapes)
        : radius_(radius), patches_(patches), shapes_(shapes), roots_(shapes.size(), no_grid) {}

    void cut(uint patch, const Outline& outline, const std::vector<WallLine>& lines) {
        whole_ = shapes_[patch];
        lines_ = &lines;
        left_ = max_cuts;
        free_ = patch;
        const uint root = divide(outline, 0);
        if (is_cut(root)) roots_[patch] = root;
    }

    /// Has the sides of the patches that were cut refer to their first cuts.
    void finish() {
        patches_.count = uint(shapes_.size());
        for (uint& side : patches_.of_side)
            if (roots_[side] != no_grid) side = roots_[side];
    }

  private:
    uint divide(const Outline& outline, int depth) {
        const WallLine* best = nullptr;
        float most = 0.02f * radius_;
        for (const WallLine& line : *lines_) {
            if (line.is_chord && best) break;  // chords come last, and must cut in their order
            if (const float inside = length_inside(outline, line, radius_); inside > most) best = &line, most = inside;
        }
        if (!best || left_ == 0 || depth == max_cut) return add_piece(outline, depth > 0);
        --left_;
        const auto index = uint(patches_.cuts.size());
        const vec3 up = whole_.v_axis * best->along.x - whole_.u_axis * best->along.y;
        const vec3 point = whole_.anchor + whole_.u_axis * best->point.x + whole_.v_axis * best->point.y;
        patches_.cuts.push_back({point, no_grid, up, no_grid});
        const uint front = divide(part_of(outline, *best, 1), depth + 1);
        const uint back = divide(part_of(outline, *best, -1), depth + 1);
        patches_.cuts[index].front = front, patches_.cuts[index].back = back;
        return index | cut_bit;
    }

    /// Adds a piece and returns its number. The first piece takes the number of the whole patch.
    uint add_piece(const Outline& outline, bool is_part) {
        if (!is_part) return free_;
        PatchShape piece = whole_;
        piece.outline = outline;
        piece.box_low = vec3(1e30f), piece.box_high = vec3(-1e30f);
        vec2 low(1e30f), high(-1e30f);
        for (vec2 p : outline) {
            low = min(low, p), high = max(high, p);
            for (float h : {whole_.low.z, whole_.high.z}) {
                const vec3 at = whole_.to_scene(vec3(p, h));
                piece.box_low = min(piece.box_low, at), piece.box_high = max(piece.box_high, at);
            }
        }
        piece.low = vec3(low, whole_.low.z), piece.high = vec3(high, whole_.high.z);
        const uint id = free_ != no_grid ? free_ : uint(shapes_.size());
        if (free_ == no_grid) shapes_.emplace_back();
        free_ = no_grid;
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
    uint free_ = no_grid;
};

}  // namespace

void cut_patches(const Scene& scene, float radius, Patches& patches, std::vector<PatchShape>& shapes) {
    const std::vector<WalledPatch> walled = find_walls(scene, radius, shapes);
    if (walled.empty()) return;
    const std::unordered_map<uint, Outline> outlines = outlines_of(scene, patches, shapes, walled);
    Cutter cutter(radius, patches, shapes);
    for (const auto& [patch, lines] : walled)
        if (outlines.at(patch).size() > 2) cutter.cut(patch, outlines.at(patch), lines);
    cutter.finish();
}

}  // namespace lw
