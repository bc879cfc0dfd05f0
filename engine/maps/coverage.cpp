#include "maps/coverage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "base/parallel.h"
#include "base/wide_vectors.h"
#include "maps/kernel_weight.h"
#include "scene/surface.h"
#include "scene/triangle.h"
#include "trace/sampling.h"

namespace lw {
namespace {

constexpr int rays_around = 4;
constexpr double samples_of_patch = 64;

/// The samples that belong to one map, sorted into square cells of half the radius in the frame of its grid.
class MapSamples {
  public:
    MapSamples(const SurfaceGrid& grid, const std::vector<Photon>& samples, const uint* first, const uint* last)
        : cell_(grid.radius * 0.5f), radius_(grid.radius) {
        const CoverageLevels radii = radii_of_levels(grid);
        for (uint level = 0; level < coverage_levels; ++level) {
            inverse_radii2_[level] = 1 / (radii[level] * radii[level]);
            // kernel_peak() but for the order of its factors, on which the last bit hangs.
            peaks_[level] = kernel_height / lw_pi * inverse_radii2_[level];
        }
        vec2 high(-1e30f);
        low_ = vec2(1e30f);
        std::vector<vec4> unsorted;
        for (const uint* i = first; i != last; ++i) {
            const vec3 local = position_in_grid(grid, samples[*i].position);
            unsorted.emplace_back(local, samples[*i].flux.x);
            low_ = min(low_, vec2(local.x, local.y)), high = max(high, vec2(local.x, local.y));
        }
        if (unsorted.empty()) return;
        columns_ = int((high.x - low_.x) / cell_) + 1;
        rows_ = int((high.y - low_.y) / cell_) + 1;
        starts_.assign(size_t(columns_) * size_t(rows_) + 1, 0);
        for (const vec4& s : unsorted) ++starts_[cell_of(s) + 1];
        for (size_t c = 1; c < starts_.size(); ++c) starts_[c] += starts_[c - 1];
        std::vector<uint> next(starts_.begin(), starts_.end() - 1);
        for (std::vector<float>* values : {&u_, &v_, &h_, &area_}) values->resize(unsorted.size());
        for (const vec4& s : unsorted) {
            const uint i = next[cell_of(s)]++;
            u_[i] = s.x, v_[i] = s.y, h_[i] = s.z, area_[i] = s.w;
        }
    }

    /// Sum of area x kernel at `local`, for the kernels of all levels.
    CoverageLevels sum_kernels(vec3 local, float max_radius) const {
        CoverageLevels sums{};
        const int x0 = std::max(column(local.x - radius_), 0), x1 = std::min(column(local.x + radius_), columns_ - 1);
        const int y0 = std::max(row(local.y - radius_), 0), y1 = std::min(row(local.y + radius_), rows_ - 1);
        for (int y = y0; y <= y1 && x0 <= x1; ++y) {
            const size_t line = size_t(y) * size_t(columns_);
            const uint last = starts_[line + size_t(x1) + 1];
            for (uint i = starts_[line + size_t(x0)]; i < last; i += run_length)
                add_run(i, std::min(last - i, run_length), local, max_radius, sums);
        }
        return sums;
    }

  private:
    int column(float u) const { return int(std::floor((u - low_.x) / cell_)); }
    int row(float v) const { return int(std::floor((v - low_.y) / cell_)); }
    size_t cell_of(const vec4& s) const {
        return size_t(std::min(row(s.y), rows_ - 1)) * size_t(columns_) + size_t(std::min(column(s.x), columns_ - 1));
    }

    /// Without branches, in vectors: a run of samples, then one level after the other.
    LW_WIDE_VECTORS void add_run(uint first, uint count, vec3 local, float max_radius, CoverageLevels& sums) const {
        std::array<float, run_length> squared{}, areas{};
        const float *u = &u_[first], *v = &v_[first], *h = &h_[first], *area = &area_[first];
        for (uint i = 0; i < count; ++i) {
            const float du = u[i] - local.x, dv = v[i] - local.y, dh = h[i] - local.z;
            squared[i] = du * du + dv * dv + dh * dh;
            areas[i] = area[i] * same_surface_weight(dh, squared[i], max_radius);
        }
        for (uint level = 0; level < coverage_levels; ++level) {
            std::array<float, lanes> parts{};
            for (uint i = 0; i < count; i += lanes)
                for (uint lane = 0; lane < lanes; ++lane)
                    parts[lane] += areas[i + lane] * kernel_weight(squared[i + lane] * inverse_radii2_[level]);
            sums[level] += peaks_[level] * std::accumulate(parts.begin(), parts.end(), 0.0f);
        }
    }

    static constexpr uint run_length = 64, lanes = 8;
    float cell_, radius_;
    CoverageLevels inverse_radii2_{}, peaks_{};  // 1/m2 of each kernel, and its value at the centre
    vec2 low_{0};
    int columns_ = 0, rows_ = 0;
    std::vector<uint> starts_;
    std::vector<float> u_, v_, h_, area_;  // in the order of the cells
};

/// The area a sample of each triangle stands for: at most `area`, and a patch has at least samples_of_patch.
std::vector<float> areas_of_samples(const Scene& scene, const Patches& patches, float area) {
    std::vector<double> patch_areas(patches.count, 0),
        cut_areas(patches.cuts.size(), 0);  // of the whole when it is cut
    const auto area_of_side = [&](size_t side) -> double& {
        const uint id = patches.of_side[side];
        return is_cut(id) ? cut_areas[id & ~cut_bit] : patch_areas[id];
    };
    for (size_t t = 0; t < scene.triangles.size(); ++t)
        for (size_t side = 2 * t; side < 2 * t + 2; ++side) area_of_side(side) += triangle_area(scene, t);
    std::vector<float> areas(scene.triangles.size());
    for (size_t t = 0; t < areas.size(); ++t) {
        const double smaller = std::min(area_of_side(2 * t), area_of_side(2 * t + 1));
        areas[t] = std::max(1e-20f, std::min(area, float(smaller / samples_of_patch)));
    }
    return areas;
}

/// True when another triangle lies in the same place and is the one that rays meet there: it holds the photons, and
/// only its samples count. Without this, duplicate or overlapping triangles would be dark: more area, not more photons.
bool is_overlaid(const RayCaster& caster, vec3 point, vec3 normal, uint triangle) {
    const std::optional<Hit> hit = caster.nearest(caster.offset(point, normal), -normal, 2 * caster.epsilon());
    return hit && hit->triangle != triangle;
}

uint pack_levels(const CoverageLevels& levels) {
    uint bits = 0;
    for (uint i = 0; i < coverage_levels; ++i)
        bits |= uint(clamp(std::round(levels[i] * coverage_unit), 0.0f, 255.0f)) << (8 * i);
    return bits;
}

}  // namespace

bool is_buried(const RayCaster& caster, vec3 point, vec3 normal, float clearance, Rng& rng) {
    const mat3 frame = frame_around(normal);
    const vec3 origin = caster.offset(point, normal);
    for (int i = 0; i < rays_around; ++i) {
        const float u = (float(i) + rng.next()) / rays_around;
        const vec3 direction = sample_cosine(u, rng.next());
        if (!caster.nearest(origin, frame * direction, clearance / std::max(direction.z, 0.2f))) return false;
    }
    return true;
}

uint64_t Neighbourhoods::bit_of(vec3 cell) const {
    const uint64_t x = uint64_t(uint32_t(int(cell.x))), y = uint64_t(uint32_t(int(cell.y))), z = uint64_t(int(cell.z));
    return mix64((x << 32 | y) ^ z * 0x9e3779b97f4a7c15ull) % bit_count;
}

void Neighbourhoods::add(vec3 point) {
    const vec3 low = floor(point / radius_) - 1.0f,
               high = floor(point / radius_) + 1.0f;  // cells as wide as the radius
    for (float z = low.z; z <= high.z; ++z)
        for (float y = low.y; y <= high.y; ++y)
            for (float x = low.x; x <= high.x; ++x) {
                const uint64_t bit = bit_of({x, y, z});
                bits_[bit / 64] |= 1ull << bit % 64;
            }
}

bool Neighbourhoods::contain(vec3 point) const {
    const uint64_t bit = bit_of(floor(point / radius_));
    return bits_[bit / 64] >> bit % 64 & 1;
}

bool WantedSamples::contain(size_t side, vec3 position) const {
    const uint own = patches.at(side, position);
    const auto near = neighbours.near(own, position);
    return is_wanted[own] || std::any_of(near.begin(), near.end(), [&](uint patch) { return is_wanted[patch]; });
}

std::vector<char> WantedSamples::sides() const {
    std::vector<char> near(patches.count), wanted;
    for (uint patch = 0; patch < patches.count; ++patch) {
        const auto all = neighbours.of(patch);
        near[patch] = is_wanted[patch] || std::any_of(all.begin(), all.end(), [&](uint p) { return is_wanted[p]; });
    }
    for (uint patch : patches.of_side) wanted.push_back(is_cut(patch) || near[patch]);  // a cut: its pieces
    return wanted;
}

std::vector<Photon> sample_surfaces(const Scene& scene, const RayCaster& caster, const WantedSamples& wanted,
                                    float area, float clearance) {
    constexpr size_t chunk = 1024;
    const std::vector<float> shares = areas_of_samples(scene, wanted.patches, area);
    const std::vector<char> sides = wanted.sides();
    std::vector<uint> counts(scene.triangles.size());
    double waiting = 0.5;
    for (size_t t = 0; t < counts.size(); ++t) {
        waiting += triangle_area(scene, t) / double(shares[t]);
        counts[t] = uint(waiting);
        waiting -= counts[t];
    }
    std::vector<std::vector<Photon>> chunks((counts.size() + chunk - 1) / chunk);
    parallel_for(chunks.size(), [&](size_t k) {
        for (size_t t = k * chunk; t < std::min(counts.size(), (k + 1) * chunk); ++t) {
            if (!sides[2 * t] && !sides[2 * t + 1]) continue;
            const auto scramble = uint32_t(mix64(t));
            const auto [p0, p1, p2] = triangle_corners(scene, t);
            const vec3 product = edge_product(p0, p1, p2);
            for (uint i = 0; i < counts[t]; ++i) {
                const vec2 place = sample_triangle(sobol_owen(i, 0, scramble), sobol_owen(i, 1, scramble));
                const vec3 position = (1 - place.x - place.y) * p0 + place.x * p1 + place.y * p2;
                if (!wanted.neighbourhoods.contain(position)) continue;
                const bool wanted_sides[] = {wanted.contain(2 * t, position), wanted.contain(2 * t + 1, position)};
                if (!wanted_sides[0] && !wanted_sides[1]) continue;
                if (is_overlaid(caster, position, normalize(product), uint(t))) continue;
                for (uint side = 0; side < 2; ++side) {
                    if (!wanted_sides[side]) continue;
                    const vec3 n = product / (side ? -length(product) : length(product));
                    Rng rng(1, 2 * t + side, i);
                    if (is_buried(caster, position, n, clearance, rng)) continue;
                    chunks[k].push_back({position, vec3(shares[t]), n, uint(t), pack_origin(0, path_direct, side)});
                }
            }
        }
    });
    std::vector<Photon> samples;
    samples.reserve(std::accumulate(chunks.begin(), chunks.end(), size_t(0),
                                    [](size_t sum, const std::vector<Photon>& part) { return sum + part.size(); }));
    for (const auto& part : chunks) samples.insert(samples.end(), part.begin(), part.end());
    return samples;
}

void sample_coverage(const PhotonMap& map, const std::vector<NodePoint>& nodes, const std::vector<Photon>& samples,
                     const References& references, const std::vector<uint>& patch_of_map,
                     const std::vector<std::vector<uint>>& nodes_of_map, std::vector<CoverageLevels>& coverage) {
    parallel_for(nodes_of_map.size(), [&](size_t m) {
        if (nodes_of_map[m].empty()) return;
        const SurfaceGrid& grid = map.grids[m];
        const SurfaceLattice& lattice = grid.lattice;
        const uint* all = references.photons.data();
        const MapSamples own(grid, samples, all + references.starts[patch_of_map[m]],
                             all + references.starts[patch_of_map[m] + 1]);
        for (uint n : nodes_of_map[m]) {
            const vec2 at = lattice.low + vec2(float(n % lattice.columns), float(n / lattice.columns)) * lattice.step;
            const uint node = lattice.first_node + n;
            coverage[node] = own.sum_kernels(vec3(at, nodes[node].height), map.settings.radius);
        }
    });
}

std::vector<uint> pack_coverage(const std::vector<CoverageLevels>& coverage) {
    std::vector<uint> packed;
    packed.reserve(coverage.size());
    for (const CoverageLevels& levels : coverage) packed.push_back(pack_levels(levels));
    return packed;
}

}  // namespace lw
