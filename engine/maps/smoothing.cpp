#include "maps/smoothing.h"

#include <algorithm>
#include <cmath>

#include "base/wide_vectors.h"
#include "maps/kernel_weight.h"
#include "shaders/color.h"

namespace lw {
namespace {

constexpr float spread2 = 2.5f;    // variance of the weights over distance, nodes squared
constexpr float darkest = 1e-30f;  // avoids 0 / 0

/// Approximates exp(-x) by (1 - x / 16)^16, which reaches 0 and needs no library call.
float ending_exponential(float x) {
    const float t = positive(1 - x / 16), t2 = t * t, t4 = t2 * t2, t8 = t4 * t4;
    return t8 * t8;
}

/// What the weight of another node depends on, besides its brightness.
struct WeightOfNode {
    float distance;  // the weight that its distance has
    float noise;     // relative, of both
};

/// For each node of a row, its weight by distance times the filter weight of the node in another row that lies dx to
/// the right.
LW_WIDE_VECTORS void weigh(const float* own, const float* other, const float* exists, WeightOfNode by,
                           std::vector<float>& weights) {
    float* w = weights.data();
    const size_t count = weights.size();
    for (size_t x = 0; x < count; ++x) {
        const float change = (own[x] - other[x]) / (0.5f * by.noise * (own[x] + other[x]) + darkest);
        w[x] = by.distance * exists[x] * ending_exponential(0.5f * change * change);
    }
}

LW_WIDE_VECTORS void add_weighted(const float* values, const std::vector<float>& weights, float* sums) {
    for (size_t x = 0; x < weights.size(); ++x) sums[x] += values[x] * weights[x];
}

void divide(const std::vector<float>& totals, float* sums) {
    for (size_t x = 0; x < totals.size(); ++x) sums[x] = totals[x] > 0 ? sums[x] / totals[x] : 0.0f;
}

}  // namespace

LatticePlanes smooth(const LatticePlanes& light, const LatticePlanes& brightness, const LatticePlanes& existence,
                     float noise) {
    constexpr int reach = LatticePlanes::border;
    LatticePlanes smoothed(light.columns, light.rows, light.planes);
    std::vector<float> weights(light.columns), totals(light.columns);
    for (int y = 0; y < int(light.rows); ++y) {
        std::fill(totals.begin(), totals.end(), 0.0f);
        for (int dy = -reach; dy <= reach; ++dy)
            for (int dx = -reach; dx <= reach; ++dx) {
                const float weight = std::exp(-0.5f * float(dx * dx + dy * dy) / spread2);
                weigh(brightness.row(0, y), brightness.row(0, y + dy) + dx, existence.row(0, y + dy) + dx,
                      {weight, noise}, weights);
                for (size_t x = 0; x < totals.size(); ++x) totals[x] += weights[x];
                for (uint p = 0; p < light.planes; ++p)
                    add_weighted(light.row(p, y + dy) + dx, weights, smoothed.row(p, y));
            }
        for (uint p = 0; p < light.planes; ++p) divide(totals, smoothed.row(p, y));
    }
    return smoothed;
}

void smooth_nodes(const Lattice& all, uint m, NodeSmoothing settings, std::span<vec3> light) {
    const SurfaceLattice& lattice = all.surfaces.grids[m].lattice;
    LatticePlanes planes(lattice.columns, lattice.rows, 3), brightness(lattice.columns, lattice.rows, 1),
        existence(lattice.columns, lattice.rows, 1);
    for (uint y = 0; y < lattice.rows; ++y)
        for (uint x = 0; x < lattice.columns; ++x) {
            const uint node = lattice.first_node + y * lattice.columns + x;
            if (!all.nodes[node].exists() || (settings.leaves_buried && all.buried[node])) continue;
            for (uint c = 0; c < 3; ++c) planes.row(c, int(y))[x] = light[node][int(c)];
            brightness.row(0, int(y))[x] = luminance(light[node]);
            existence.row(0, int(y))[x] = 1;
        }
    const LatticePlanes smoothed = smooth(planes, brightness, existence, settings.noise);
    for (uint y = 0; y < lattice.rows; ++y)
        for (uint x = 0; x < lattice.columns; ++x)
            for (uint c = 0; c < 3; ++c)
                light[lattice.first_node + y * lattice.columns + x][int(c)] =
                    existence.row(0, int(y))[x] * smoothed.row(c, int(y))[x];
}

}  // namespace lw
