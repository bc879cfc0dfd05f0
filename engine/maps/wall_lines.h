// Finds where walls stand on plane patches, as straight lines, and as chords of round walls.
#pragma once
#include "maps/patches.h"

namespace lw {

/// A line in the frame of a patch, and its stretches on which walls stand: each from x to y, in m from `point` along
/// the unit vector `along`.
struct WallLine {
    vec2 point, along;
    std::vector<vec2> stretches;
    float length = 0;       // of the longest stretch, m
    bool is_chord = false;  // a chord of a round wall, which has one stretch

    float height(vec2 p) const { return along.x * (p.y - point.y) - along.y * (p.x - point.x); }
};

struct WalledPatch {
    uint patch;
    std::vector<WallLine> lines;  // the straight ones first, then chords, each beginning where the one before ends
};

/// How far above a surface the walls that stand on it are looked for, m; thinner things lie on it. Light may pass
/// below.
inline float height_of_cuts(float scale) { return 0.03f * scale; }

/// How far a chord may be from the round wall it stands for, m.
inline float width_of_chords(float scale) { return 0.02f * scale; }

/// The patches wider than their scale (m, one for each) on which surfaces stand along straight lines of at least that
/// length, or along round walls as long, at any angle steeper than 45 degrees; at most 255 lines for one.
std::vector<WalledPatch> find_walls(const Scene& scene, const std::vector<float>& scales,
                                    const std::vector<PatchShape>& shapes);

}  // namespace lw
