#include "daylight/tregenza.h"

#include <algorithm>
#include <cmath>

namespace lw {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr std::array<int, 8> patches_of_ring{30, 30, 24, 24, 18, 12, 6, 1};
constexpr double ring_height = 12;  // degrees

}  // namespace

std::array<SkyPatch, sky_patch_count> tregenza_patches() {
    std::array<SkyPatch, sky_patch_count> patches{};
    size_t next = 0;
    for (size_t ring = 0; ring < patches_of_ring.size(); ++ring) {
        const double low = ring_height * double(ring), high = std::min(low + ring_height, 90.0);
        const double width = 360.0 / patches_of_ring[ring];
        const double solid_angle = (std::sin(high * pi / 180) - std::sin(low * pi / 180)) * width * pi / 180;
        const double middle = high < 90 ? 0.5 * (low + high) : 90;
        for (int i = 0; i < patches_of_ring[ring]; ++i)
            patches[next++] = {low, high, middle, width * i, width, solid_angle};
    }
    return patches;
}

int patch_at(double altitude, double azimuth) {
    const int ring = std::clamp(int(altitude / ring_height), 0, 7);
    int first = 0;
    for (int i = 0; i < ring; ++i) first += patches_of_ring[size_t(i)];
    const int count = patches_of_ring[size_t(ring)];
    const double turns = azimuth / 360 - std::floor(azimuth / 360);
    return first + int(std::floor(turns * count + 0.5)) % count;
}

}  // namespace lw
