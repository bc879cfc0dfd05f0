#include "maps/bake_memory.h"

#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/memory.h"
#include "maps/build.h"

namespace lw {
namespace {

constexpr double max_references_per_photon = 2.5;  // small patches get smaller radii for this
constexpr double max_indices = 4.29e9;             // 32 bits

/// The numbers that the memory of a bake depends on.
struct Counts {
    double photons, samples, nodes, lamps, triangles;
};

Counts counts_of(const Scene& scene, const BakeSettings& settings) {
    const double r = double(settings.radius > 0 ? std::min(settings.radius, scene.size())
                                                : automatic_radius(scene, settings.photons));
    const double sides = 2 * area_of(scene) / std::max(r * r, 1e-30);
    constexpr double sampled = 0.85;  // part of all sides: inner sides of closed bodies need no samples
    return {double(settings.photons), sampled * sides / 0.03, sides / 0.25, double(scene.lights.size()),
            double(scene.triangles.size())};
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

uint64_t predict_bake_bytes(const Scene& scene, const BakeSettings& settings) {
    return uint64_t(bytes_of(counts_of(scene, settings)));
}

void check_bake_fits(const Scene& scene, const BakeSettings& settings, uint64_t budget) {
    const auto fits = [&](uint64_t photons) {
        BakeSettings fewer = settings;
        fewer.photons = photons;
        const Counts counts = counts_of(scene, fewer);
        return can_be_counted(counts) && bytes_of(counts) <= double(budget);
    };
    if (fits(settings.photons)) return;
    const bool countable = can_be_counted(counts_of(scene, settings));
    const uint64_t most = max_photons(settings.photons, fits);
    throw Error(scene.path.filename().string() + ": " + std::to_string(settings.photons) + " photons " +
                (countable ? "take about " + bytes_text(predict_bake_bytes(scene, settings)) + " of memory, " +
                                 bytes_text(budget) + " may be used (--memory)"
                           : std::string("need more than 2^32 references or lattice nodes")) +
                (most ? "; " + std::to_string(most) + " would fit" : "; a larger --radius would need less"));
}

}  // namespace lw
