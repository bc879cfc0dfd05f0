#include "maps/photon_sums.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/wide_vectors.h"
#include "maps/kernel_weight.h"

namespace lw {
namespace {

constexpr size_t run_length = 128;  // photons weighed at once
constexpr size_t summed_at_once = 1024;

int cell_at(float metres, float cell_size, uint count) {
    return int(clamp(std::floor(metres / cell_size), -1.0f, float(count)));
}

}  // namespace

PhotonSums::PhotonSums(const PhotonRecords& records, const SurfaceGrid& grid)
    : grid_(grid), starts_(records.cell_starts.data() + grid.first_cell), first_(starts_[0]) {
    const size_t count = starts_[grid.columns * grid.rows] - first_;
    for (std::vector<float>* places : {&u_, &v_, &h_}) places->resize(count);
    fluxes_.resize(count);
    lamps_.resize(count);
    for (size_t i = 0; i < count; ++i) {
        const PhotonPlace place = records.places[first_ + i];
        const vec3 local = place_in_grid(place, grid);
        u_[i] = local.x, v_[i] = local.y, h_[i] = local.z;
        fluxes_[i] = vec4(unpack_rgb9e5(records.fluxes[first_ + i]), 0);
        lamps_[i] = light_of(place);
    }
}

void PhotonSums::add(vec3 local, float radius, std::span<vec4> sums) const {
    const float r2 = radius * radius, size = grid_.cell_size;
    const int y0 = std::max(cell_at(local.y - radius, size, grid_.rows), 0);
    const int y1 = std::min(cell_at(local.y + radius, size, grid_.rows), int(grid_.rows) - 1);
    for (int y = y0; y <= y1; ++y) {
        const float below = float(y) * size - local.y, dy = std::max({below, -below - size, 0.0f});
        const float half_width = std::sqrt(std::max(r2 - dy * dy, 0.0f));
        const int x0 = std::max(cell_at(local.x - half_width, size, grid_.columns), 0);
        const int x1 = std::min(cell_at(local.x + half_width, size, grid_.columns), int(grid_.columns) - 1);
        if (x0 > x1) continue;
        const uint* row = starts_ + size_t(y) * grid_.columns;
        add_row(row[x0] - first_, row[x1 + 1] - first_, local, 1 / r2, sums);
    }
}

/// Sums runs of photons separately, so that rounding errors of millions of photons stay small.
void PhotonSums::add_row(size_t first, size_t last, vec3 local, float inverse_radius2, std::span<vec4> sums) const {
    if (last - first <= summed_at_once) return add_run(first, last, local, inverse_radius2, sums);
    std::vector<vec4> apart(sums.size());
    for (; first < last; first += std::min(last - first, summed_at_once)) {
        std::fill(apart.begin(), apart.end(), vec4(0));
        add_run(first, first + std::min(last - first, summed_at_once), local, inverse_radius2, apart);
        for (size_t i = 0; i < sums.size(); ++i) sums[i] += apart[i];
    }
}

/// The weights of `count` photons, 0 of those outside the kernel or not on the same surface.
LW_WIDE_VECTORS void PhotonSums::weigh(size_t first, size_t count, vec3 local, float inverse_radius2,
                                       float* weights) const {
    const float *u = &u_[first], *v = &v_[first], *h = &h_[first], search_radius = grid_.radius;
    for (size_t i = 0; i < count; ++i) {
        const float du = u[i] - local.x, dv = v[i] - local.y, dh = h[i] - local.z;
        const float d2 = du * du + dv * dv + dh * dh;
        weights[i] = kernel_weight(d2 * inverse_radius2) * same_surface_weight(dh, d2, search_radius);
    }
}

void PhotonSums::add_run(size_t first, size_t last, vec3 local, float inverse_radius2, std::span<vec4> sums) const {
    std::array<float, run_length> weights;
    for (; first < last; first += run_length) {
        const size_t count = std::min(last - first, run_length);
        weigh(first, count, local, inverse_radius2, weights.data());
        for (size_t i = 0; i < count; ++i)
            sums[sums_per_lamp * lamps_[first + i] + i % sums_per_lamp] += fluxes_[first + i] * weights[i];
    }
}

}  // namespace lw
