#include "maps/bake_memory.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "base/memory.h"
#include "base/parallel.h"
#include "maps/build.h"
#include "maps/lattice.h"
#include "maps/surroundings.h"
#include "scene/triangle.h"
#include "trace/sampling.h"

namespace lw {
namespace {

constexpr double max_references_per_photon = 2.5;  // small patches get smaller radii for this
constexpr double max_indices = 4.29e9;             // 32 bits

/// The numbers that the memory of a bake depends on.
struct Counts {
    double photons, samples, nodes, lamps, triangles;
};

/// How many nodes lie over both sides of all surfaces where scales follow the surroundings: from rays of some points.
double nodes_by_surroundings(const Scene& scene, const RayCaster& caster) {
    constexpr uint points = 4096, rays = 16;
    std::vector<double> sums{0};
    for (size_t t = 0; t < scene.triangles.size(); ++t) sums.push_back(sums.back() + triangle_area(scene, t));
    const ScaleRule rule(scene);
    std::vector<double> densities(points, 0);  // nodes per m2
    parallel_for(points, [&](size_t i) {
        const double place = (double(i) + 0.5) / points * sums.back();
        const auto t = size_t(std::upper_bound(sums.begin() + 1, sums.end() - 1, place) - sums.begin()) - 1;
        const std::array<vec3, 3> p = triangle_corners(scene, t);
        const vec3 product = edge_product(p[0], p[1], p[2]) * (i % 2 ? -1.0f : 1.0f);
        const vec2 at = sample_triangle(sobol_owen(uint32_t(i), 0, 1), sobol_owen(uint32_t(i), 1, 1));
        const LookOut point{(1 - at.x - at.y) * p[0] + at.x * p[1] + at.y * p[2], normalize(product), lift_above(p)};
        const double step = double(nodes_apart * rule.scale_of(look_around(caster, {&point, 1}, rays, i).distance));
        densities[i] = 1 / (step * step);
    });
    return 2 * sums.back() * std::accumulate(densities.begin(), densities.end(), 0.0) / points;
}

Counts counts_of(const Scene& scene, const RayCaster& caster, const BakeSettings& settings) {
    const double photons = double(settings.photons), lamps = double(scene.lights.size()),
                 triangles = double(scene.triangles.size());
    if (!(settings.radius > 0)) {
        constexpr double samples_of_node = 7;
        constexpr double of_small_patches = 5;  // their lattices have more nodes than their area says
        const double nodes = of_small_patches * nodes_by_surroundings(scene, caster);
        return {photons, samples_of_node * nodes, nodes, lamps, triangles};
    }
    const double r = double(std::min(settings.radius, scene.size()));
    const double sides = 2 * area_of(scene) / std::max(r * r, 1e-30);
    constexpr double sampled = 0.85;  // part of all sides: inner sides of closed bodies need no samples
    return {photons, sampled * sides / 0.03, sides / 0.25, lamps, triangles};
}

double bytes_of(const Counts& c) {
    constexpr double program = 2e7, per_triangle = 650;
    constexpr double tracing = 102;  // bytes of a photon in the vector of its task and in that of all
    constexpr double building = 100, per_sample = 70, per_node = 101, per_node_and_lamp = 20;
    const double maps =
        building * c.photons + per_sample * c.samples + (per_node + per_node_and_lamp * c.lamps) * c.nodes;
    return program + per_triangle * c.triangles + std::max(tracing * c.photons, maps);
}

bool can_be_counted(const Counts& c) {
    const double columns = std::ceil(c.lamps / lamps_per_visibility_column);
    return c.photons * max_references_per_photon < max_indices && c.samples * max_references_per_photon < max_indices &&
           c.nodes * std::max(columns, 1.0) < max_indices;
}

/// The largest number of photons below `wanted`, of one significant digit, for which `fits` is true; 0 when there is
/// none.
template <class Fits>
uint64_t max_photons(uint64_t wanted, const Fits& fits) {
    for (uint64_t digit = 1'000'000'000; digit > 0; digit /= 10)
        for (uint64_t n = 9; n > 0; --n)
            if (n * digit < wanted && fits(n * digit)) return n * digit;
    return 0;
}

}  // namespace

uint64_t predict_bake_bytes(const Scene& scene, const RayCaster& caster, const BakeSettings& settings) {
    return uint64_t(bytes_of(counts_of(scene, caster, settings)));
}

void check_bake_fits(const Scene& scene, const RayCaster& caster, const BakeSettings& settings, uint64_t budget) {
    const Counts wanted = counts_of(scene, caster, settings);
    const auto fits = [&](uint64_t photons) {
        Counts counts = wanted;
        counts.photons = double(photons);
        return can_be_counted(counts) && bytes_of(counts) <= double(budget);
    };
    if (fits(settings.photons)) return;
    const bool countable = can_be_counted(wanted);
    const uint64_t most = max_photons(settings.photons, fits);
    throw Error(scene.path.filename().string() + ": " + std::to_string(settings.photons) + " photons " +
                (countable ? "take about " + bytes_text(uint64_t(bytes_of(wanted))) + " of memory, " +
                                 bytes_text(budget) + " may be used (--memory)"
                           : std::string("need more than 2^32 references or lattice nodes")) +
                (most ? "; " + std::to_string(most) + " would fit" : "; a larger --radius would need less"));
}

}  // namespace lw
