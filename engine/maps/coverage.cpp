#include "maps/coverage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "base/parallel.h"
#include "base/wide_vectors.h"
#include "maps/buried.h"
#include "maps/coverage_samples.h"
#include "maps/kernel_weight.h"
#include "maps/plane_grids.h"
#include "maps/references.h"

namespace lw {
namespace {

/// The samples that belong to one patch, sorted into square cells of half the radius in the frame of its grid.
class GridSamples {
  public:
    GridSamples(const SurfaceGrid& grid, const std::vector<Photon>& samples, const uint* first, const uint* last)
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

    /// The sum over samples of area x kernel at the point `local`, for the kernels of all levels: the coverage.
    CoverageLevels sum_kernels(vec3 local) const {
        CoverageLevels sums{};
        const int x0 = std::max(column(local.x - radius_), 0), x1 = std::min(column(local.x + radius_), columns_ - 1);
        const int y0 = std::max(row(local.y - radius_), 0), y1 = std::min(row(local.y + radius_), rows_ - 1);
        for (int y = y0; y <= y1 && x0 <= x1; ++y) {
            const size_t line = size_t(y) * size_t(columns_);
            const uint last = starts_[line + size_t(x1) + 1];
            for (uint i = starts_[line + size_t(x0)]; i < last; i += run_length)
                add_run(i, std::min(last - i, run_length), local, sums);
        }
        return sums;
    }

  private:
    int column(float u) const { return int(std::floor((u - low_.x) / cell_)); }
    int row(float v) const { return int(std::floor((v - low_.y) / cell_)); }
    size_t cell_of(const vec4& s) const {
        return size_t(std::min(row(s.y), rows_ - 1)) * size_t(columns_) + size_t(std::min(column(s.x), columns_ - 1));
    }

    /// Adds a run of samples, one level after the other, without branches, so that the loops become vector code.
    LW_WIDE_VECTORS void add_run(uint first, uint count, vec3 local, CoverageLevels& sums) const {
        const float radius = radius_;
        std::array<float, run_length> squared{}, areas{};
        const float *u = &u_[first], *v = &v_[first], *h = &h_[first], *area = &area_[first];
        for (uint i = 0; i < count; ++i) {
            const float du = u[i] - local.x, dv = v[i] - local.y, dh = h[i] - local.z;
            squared[i] = du * du + dv * dv + dh * dh;
            areas[i] = area[i] * same_surface_weight(dh, squared[i], radius);
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

uint pack_levels(const CoverageLevels& levels) {
    uint bits = 0;
    for (uint i = 0; i < coverage_levels; ++i)
        bits |= uint(clamp(std::round(levels[i] * coverage_unit), 0.0f, 255.0f)) << (8 * i);
    return bits;
}

/// Counts the coverage of some nodes of each grid, nodes_of_grid[m] from its first, from samples around them.
void sample_coverage(const CoverageInput& input, const std::vector<std::vector<uint>>& nodes_of_grid,
                     const std::vector<Photon>& samples, std::vector<CoverageLevels>& coverage) {
    const PatchGrids& surfaces = input.nodes.surfaces;
    const References references = find_references({input.scene, input.caster, input.partition, samples});
    parallel_for(nodes_of_grid.size(), [&](size_t m) {
        if (nodes_of_grid[m].empty()) return;
        const SurfaceGrid& grid = surfaces.grids[m];
        const SurfaceLattice& lattice = grid.lattice;
        const uint* all = references.photons.data();
        const GridSamples own(grid, samples, all + references.starts[surfaces.patches[m]],
                              all + references.starts[surfaces.patches[m] + 1]);
        for (uint n : nodes_of_grid[m]) {
            const vec2 at = lattice.low + vec2(float(n % lattice.columns), float(n / lattice.columns)) * lattice.step;
            const uint node = lattice.first_node + n;
            coverage[node] = own.sum_kernels(vec3(at, input.nodes.points[node].height));
        }
    });
}

/// Writes the coverage of the nodes of grid m that has a closed form; returns the other nodes, from its first.
std::vector<uint> cover_flat_nodes(const CoverageInput& input, size_t m, std::vector<CoverageLevels>& coverage) {
    const PatchGrids& surfaces = input.nodes.surfaces;
    const SurfaceLattice& lattice = surfaces.grids[m].lattice;
    if (input.partition.shapes[surfaces.patches[m]].outline.empty())
        return find_flat_coverage(input, m, &coverage[lattice.first_node]);
    std::vector<uint> others;  // walls stand around it
    for (uint i = 0; i < lattice.columns * lattice.rows; ++i)
        if (input.nodes.points[lattice.first_node + i].exists()) others.push_back(i);
    return others;
}

/// What samples are wanted for: the neighbourhoods of these nodes of each grid.
WantedSamples samples_for(const CoverageInput& input, const std::vector<std::vector<uint>>& nodes_of_grid) {
    const PatchGrids& surfaces = input.nodes.surfaces;
    WantedSamples wanted{input.partition, std::vector<char>(input.partition.patches.count, 0), {}};
    for (size_t m = 0; m < nodes_of_grid.size(); ++m) {
        wanted.is_wanted[surfaces.patches[m]] = !nodes_of_grid[m].empty();
        const SurfaceLattice& lattice = surfaces.grids[m].lattice;
        for (uint i : nodes_of_grid[m]) {
            const vec2 cells(float(i % lattice.columns), float(i / lattice.columns));
            const float height = input.nodes.points[lattice.first_node + i].height;
            wanted.neighbourhoods.add(point_on_lattice(surfaces.grids[m], cells, height),
                                      1.01f * surfaces.grids[m].radius);
        }
    }
    return wanted;
}

}  // namespace

std::vector<uint> find_coverage(const CoverageInput& input) {
    std::vector<CoverageLevels> coverage(input.nodes.points.size(), CoverageLevels{1, 1, 1, 1});
    std::vector<std::vector<uint>> others(input.nodes.surfaces.grids.size());
    parallel_for(others.size(), [&](size_t m) { others[m] = cover_flat_nodes(input, m, coverage); });
    const std::vector<Photon> samples = sample_surfaces(input.scene, input.caster, samples_for(input, others));
    sample_coverage(input, others, samples, coverage);
    std::vector<uint> packed;
    packed.reserve(coverage.size());
    for (const CoverageLevels& levels : coverage) packed.push_back(pack_levels(levels));
    return packed;
}

}  // namespace lw
