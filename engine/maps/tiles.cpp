#include "maps/tiles.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "maps/cuts.h"
#include "maps/outline.h"
#include "maps/surroundings.h"
#include "scene/triangle.h"
#include "trace/sampling.h"

namespace lw {
namespace {

constexpr float most_distances = 6;     // across a tile
constexpr float most_spread = 5;        // of the distances in a tile
constexpr float least_under_sky = 4;    // m, of a tile from which most rays meet nothing
constexpr int deepest = 28;             // cuts one after the other; the rest is left to walls
constexpr size_t most_triangles = 256;  // that are looked at around a tile
constexpr uint points_of_tile = 16, rays_of_point = 8;

/// The tiles of one patch. Cuts and tiles are numbered from 0; ids as in Patches.
struct Tiles {
    std::vector<Cut> cuts;
    std::vector<PatchShape> shapes;
    std::vector<float> scales;
};

class Tiler {
  public:
    Tiler(const Scene& scene, const RayCaster& caster, const ScaledPatches& scaled, uint patch)
        : scene_(scene), caster_(caster), whole_(scaled.shapes[patch]) {
        const std::array<vec3, 3> corners = triangle_corners(scene, whole_.triangle);
        lift_ = lift_above(corners);
        Outline outline;
        for (const vec3& corner : corners) outline.emplace_back(whole_.to_local(corner));
        outline_ = hull_of(std::move(outline));
    }

    /// None where the patch stays whole.
    Tiles cut() {
        if (outline_.size() == 3) divide(outline_, 0);
        return std::move(tiles_);
    }

  private:
    uint divide(const Outline& outline, int depth) {
        const PatchShape tile = piece_of(whole_, outline);
        const vec3 size = tile.high - tile.low;
        const int longer = size.x >= size.y ? 0 : 1;
        const float width = size[longer];
        const bool near = is_near_others(tile);
        const Surroundings around = look_from(outline, depth);
        const bool uneven = around.spread > most_spread && width > most_distances * around.distance;
        const bool open = around.missed > 0.5f && width > least_under_sky;
        if (!near || !(uneven || open) || depth == deepest) {
            if (depth == 0) return no_grid;
            tiles_.shapes.push_back(tile);
            tiles_.scales.push_back(rule_.scale_of(around.distance));
            return uint(tiles_.shapes.size() - 1);
        }
        const auto index = uint(tiles_.cuts.size());
        vec2 point = 0.5f * (vec2(tile.low) + vec2(tile.high)), along(0);
        along[1 - longer] = longer == 0 ? 1.0f : -1.0f;
        const vec3 up = whole_.v_axis * along.x - whole_.u_axis * along.y;
        tiles_.cuts.push_back(
            {whole_.anchor + whole_.u_axis * point.x + whole_.v_axis * point.y, no_grid, up, no_grid});
        const uint front = divide(part_of(outline, point, along), depth + 1);
        const uint back = divide(part_of(outline, point, -along), depth + 1);
        tiles_.cuts[index].front = front, tiles_.cuts[index].back = back;
        return index | cut_bit;
    }

    /// True when other surfaces rise above the plane of a tile within half its diagonal of its middle.
    bool is_near_others(const PatchShape& tile) {
        const vec3 middle = tile.to_scene(0.5f * (tile.low + tile.high));
        const float reach = 0.5f * length(tile.high - tile.low);
        if (!caster_.triangles_around(middle, reach, most_triangles, found_)) return true;
        const float least = std::max(0.25f * rule_.least(), 4 * lift_);
        return std::any_of(found_.begin(), found_.end(), [&](uint triangle) {
            const auto corners = triangle_corners(scene_, triangle);
            return std::any_of(corners.begin(), corners.end(),
                               [&](vec3 corner) { return whole_.to_local(corner).z > least; });
        });
    }

    Surroundings look_from(const Outline& outline, int depth) const {
        std::vector<float> areas{0};  // of the triangles of a fan, summed
        const auto product = [](vec2 a, vec2 b) { return a.x * b.y - a.y * b.x; };
        for (size_t i = 2; i < outline.size(); ++i)
            areas.push_back(areas.back() + product(outline[i - 1] - outline[0], outline[i] - outline[0]));
        const vec3 first = whole_.to_scene(vec3(outline[0], 0));
        const uint64_t seed = seed_of(scene_.origin, std::array{first, first + whole_.normal}) + uint64_t(depth);
        std::vector<LookOut> points;
        for (uint p = 0; p < points_of_tile; ++p) {
            float u = sobol_owen(p, 0, uint32_t(seed)) * areas.back();
            size_t i = 1;
            while (i + 1 < areas.size() && areas[i] <= u) ++i;
            u = clamp((u - areas[i - 1]) / std::max(areas[i] - areas[i - 1], 1e-30f), 0.0f, 0.999999f);
            const vec2 at = sample_triangle(u, sobol_owen(p, 1, uint32_t(seed)));
            const vec2 place = outline[0] * (1 - at.x - at.y) + outline[i] * at.x + outline[i + 1] * at.y;
            points.push_back({whole_.to_scene(vec3(place, 0)), whole_.normal, lift_});
        }
        return look_around(caster_, points, rays_of_point, seed);
    }

    const Scene& scene_;
    const RayCaster& caster_;
    const PatchShape& whole_;
    const ScaleRule rule_{scene_};
    float lift_ = 0;
    Outline outline_;
    Tiles tiles_;
    std::vector<uint> found_;
};

/// Puts the tiles of a patch in its place: the first takes its number, the others are appended. Returns what the sides
/// of the patch refer to.
uint place_tiles(Tiles tiles, uint patch, ScaledPatches& scaled) {
    const auto first_cut = uint(scaled.patches.cuts.size()), first = uint(scaled.shapes.size());
    const auto renumbered = [&](uint id) { return is_cut(id) ? id + first_cut : id == 0 ? patch : first + id - 1; };
    for (Cut cut : tiles.cuts) {
        cut.front = renumbered(cut.front), cut.back = renumbered(cut.back);
        scaled.patches.cuts.push_back(cut);
    }
    scaled.shapes[patch] = std::move(tiles.shapes[0]);
    scaled.scales[patch] = tiles.scales[0];
    for (size_t i = 1; i < tiles.shapes.size(); ++i) {
        scaled.shapes.push_back(std::move(tiles.shapes[i]));
        scaled.scales.push_back(tiles.scales[i]);
    }
    return first_cut | cut_bit;
}

}  // namespace

void cut_into_tiles(const Scene& scene, const RayCaster& caster, ScaledPatches& scaled) {
    std::vector<uint> large;
    const float least_width = std::min(least_under_sky, 20 * ScaleRule(scene).least());
    for (uint p = 0; p < scaled.patches.count; ++p) {
        const vec3 size = scaled.shapes[p].high - scaled.shapes[p].low;
        const float width = std::max(size.x, size.y);
        if (scaled.shapes[p].triangles == 1 && width > least_width) large.push_back(p);
    }
    std::vector<Tiles> tiles(large.size());
    parallel_for(large.size(), [&](size_t i) { tiles[i] = Tiler(scene, caster, scaled, large[i]).cut(); });
    std::vector<uint> roots(scaled.patches.count, no_grid);
    for (size_t i = 0; i < large.size(); ++i)
        if (!tiles[i].cuts.empty()) roots[large[i]] = place_tiles(std::move(tiles[i]), large[i], scaled);
    scaled.patches.count = uint(scaled.shapes.size());
    for (uint& side : scaled.patches.of_side)
        if (roots[side] != no_grid) side = roots[side];
}

}  // namespace lw
