// The hemisphere of the sky in 145 patches of nearly equal solid angle (Tregenza 1987): seven rings, each 12 degrees
// high, of 30, 30, 24, 24, 18, 12 and 6 patches, and a cap of 6 degrees around the zenith.
#pragma once
#include <array>

namespace lw {

/// A patch between two altitudes and two azimuths, degrees from north and clockwise. The first patch of a ring has its
/// middle in the north; the last of all is the cap around the zenith.
struct SkyPatch {
    double low, high;          // altitudes
    double altitude, azimuth;  // of the middle
    double width;              // in azimuth
    double solid_angle;        // sr
};

constexpr int sky_patch_count = 145;

/// The patches, from the horizon up; their solid angles add up to 2 pi.
std::array<SkyPatch, sky_patch_count> tregenza_patches();

/// The index of the patch that holds a direction; an altitude below 0 is in the lowest ring.
int patch_at(double altitude, double azimuth);

}  // namespace lw
