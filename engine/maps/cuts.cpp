#include "maps/cuts.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "maps/outline.h"
#include "maps/wall_lines.h"

namespace lw {
namespace {

constexpr float min_piece = 0.1f;  // in scales, least width of a piece: a wall along the border cuts nothing off
constexpr size_t max_cuts = 255;
constexpr int max_cut = max_cuts_deep;

/// The outlines of the wanted patches, in their frames.
std::unordered_map<uint, Outline> outlines_of(const Scene& scene, const ScaledPatches& scaled,
                                              const std::vector<WalledPatch>& walled) {
    const Patches& patches = scaled.patches;
    std::unordered_map<uint, Outline> outlines;
    for (const WalledPatch& w : walled) outlines[w.patch];
    for (size_t side = 0; side < patches.of_side.size(); ++side)
        if (const auto found = outlines.find(patches.of_side[side]); found != outlines.end())
            for (int c = 0; c < 3; ++c)
                found->second.emplace_back(
                    scaled.shapes[found->first].to_local(scene.positions[scene.triangles[side / 2][c]]));
    for (auto& [patch, outline] : outlines) {
        const Outline& known = scaled.shapes[patch].outline;
        outline = known.empty() ? hull_of(std::move(outline)) : known;
    }
    return outlines;
}

/// The length of the walls of a line that stand inside the outline, m; 0 when the line would cut off only a narrow
/// strip.
float length_inside(const Outline& outline, const WallLine& line, float scale) {
    float low = 0, high = 0, first = 1e30f, last = -1e30f;
    for (size_t i = 0; i < outline.size(); ++i) {
        const vec2 p = outline[i], q = outline[(i + 1) % outline.size()];
        const float hp = line.height(p), hq = line.height(q);
        low = std::min(low, hp), high = std::max(high, hp);
        if ((hp < 0) == (hq < 0)) continue;
        const float s = dot(p + (q - p) * (hp / (hp - hq)) - line.point, line.along);
        first = std::min(first, s), last = std::max(last, s);
    }
    if (std::min(-low, high) < (line.is_chord ? width_of_chords(scale) : min_piece * scale)) return 0;
    float inside = 0;
    for (vec2 s : line.stretches) inside += std::max(0.0f, std::min(s.y, last) - std::max(s.x, first));
    return inside;
}

/// Cuts patches, one after the other, and appends the pieces.
class Cutter {
  public:
    explicit Cutter(ScaledPatches& scaled)
        : scaled_(scaled), depths_(depths_of(scaled)), roots_(scaled.shapes.size(), no_grid) {}

    void cut(uint patch, const Outline& outline, const std::vector<WallLine>& lines) {
        whole_ = scaled_.shapes[patch];
        scale_ = scaled_.scales[patch];
        lines_ = &lines;
        left_ = max_cuts;
        free_ = patch;
        first_depth_ = depths_[patch];
        const uint root = divide(outline, first_depth_);
        if (is_cut(root)) roots_[patch] = root;
    }

    /// Has what referred to the patches that were cut refer to their first cuts.
    void finish() {
        Patches& patches = scaled_.patches;
        patches.count = uint(scaled_.shapes.size());
        const auto turn = [&](uint& id) {
            if (!is_cut(id) && id < roots_.size() && roots_[id] != no_grid) id = roots_[id];
        };
        for (uint& side : patches.of_side) turn(side);
        for (size_t c = 0; c < cuts_before_; ++c) turn(patches.cuts[c].front), turn(patches.cuts[c].back);
    }

  private:
    /// How many cuts lead to each patch.
    static std::vector<int> depths_of(const ScaledPatches& scaled) {
        std::vector<int> patches(scaled.shapes.size(), 0), cuts(scaled.patches.cuts.size(), 0);
        for (size_t c = 0; c < cuts.size(); ++c)
            for (const uint id : {scaled.patches.cuts[c].front, scaled.patches.cuts[c].back})
                (is_cut(id) ? cuts[id & ~cut_bit] : patches[id]) = cuts[c] + 1;
        return patches;
    }

    uint divide(const Outline& outline, int depth) {
        const WallLine* best = nullptr;
        float most = 0.02f * scale_;
        for (const WallLine& line : *lines_) {
            if (line.is_chord && best) break;  // chords come last, and must cut in their order
            if (const float inside = length_inside(outline, line, scale_); inside > most) best = &line, most = inside;
        }
        if (!best || left_ == 0 || depth == max_cut) return add_piece(outline, depth > first_depth_);
        --left_;
        std::vector<Cut>& cuts = scaled_.patches.cuts;
        const auto index = uint(cuts.size());
        const vec3 up = whole_.v_axis * best->along.x - whole_.u_axis * best->along.y;
        const vec3 point = whole_.anchor + whole_.u_axis * best->point.x + whole_.v_axis * best->point.y;
        cuts.push_back({point, no_grid, up, no_grid});
        const uint front = divide(part_of(outline, best->point, best->along), depth + 1);
        const uint back = divide(part_of(outline, best->point, -best->along), depth + 1);
        cuts[index].front = front, cuts[index].back = back;
        return index | cut_bit;
    }

    /// Adds a piece and returns its number. The first piece takes the number of the whole patch.
    uint add_piece(const Outline& outline, bool is_part) {
        if (!is_part) return free_;
        const uint id = free_ != no_grid ? free_ : uint(scaled_.shapes.size());
        if (free_ == no_grid) scaled_.shapes.emplace_back(), scaled_.scales.push_back(scale_);
        free_ = no_grid;
        scaled_.shapes[id] = piece_of(whole_, outline);
        return id;
    }

    ScaledPatches& scaled_;
    const std::vector<int> depths_;
    std::vector<uint> roots_;
    const size_t cuts_before_ = scaled_.patches.cuts.size();
    PatchShape whole_;
    float scale_ = 0;
    const std::vector<WallLine>* lines_ = nullptr;
    size_t left_ = 0;
    uint free_ = no_grid;
    int first_depth_ = 0;
};

}  // namespace

PatchShape piece_of(const PatchShape& whole, const std::vector<vec2>& outline) {
    PatchShape piece = whole;
    piece.outline = outline;
    piece.box_low = vec3(1e30f), piece.box_high = vec3(-1e30f);
    vec2 low(1e30f), high(-1e30f);
    for (vec2 p : outline) {
        low = min(low, p), high = max(high, p);
        for (float h : {whole.low.z, whole.high.z}) {
            const vec3 at = whole.to_scene(vec3(p, h));
            piece.box_low = min(piece.box_low, at), piece.box_high = max(piece.box_high, at);
        }
    }
    piece.low = vec3(low, whole.low.z), piece.high = vec3(high, whole.high.z);
    return piece;
}

void cut_patches(const Scene& scene, ScaledPatches& scaled) {
    const std::vector<WalledPatch> walled = find_walls(scene, scaled.scales, scaled.shapes);
    if (walled.empty()) return;
    const std::unordered_map<uint, Outline> outlines = outlines_of(scene, scaled, walled);
    Cutter cutter(scaled);
    for (const auto& [patch, lines] : walled)
        if (outlines.at(patch).size() > 2) cutter.cut(patch, outlines.at(patch), lines);
    cutter.finish();
}

}  // namespace lw
