// Inappropriate reflections: bright patches of a view in which a mirroring or glossy surface shows a lamp. In: scene,
// rays, camera, RGB power of each lamp. Out: each patch with its lamp, its object and its glare, by decreasing glare.
#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "measure/glare.h"

namespace lw {

/// A patch is reported when it exceeds all of these.
struct ReflectionLimits {
    double luminance = 500;     // cd/m2 of the mirrored lamp
    double ratio = 3;           // luminance of the patch over that of its surroundings
    double solid_angle = 2e-5;  // sr: a square of a quarter of a degree
};

struct ReflectionSettings {
    int width = 320, height = 180;  // pixels of the view in which reflections are looked for
    uint samples = 16;              // rays per pixel
    uint64_t seed = 1;
    ReflectionLimits limits;
};

/// A connected region of pixels in which one object shows one lamp.
struct Reflection {
    uint lamp = 0;
    uint object = 0;            // the first surface that reflects it, an index into scene.objects
    double luminance = 0;       // cd/m2, mean over the patch: the mirrored light plus the luminance of the surroundings
    double peak = 0;            // cd/m2 of the brightest pixel
    double surroundings = 0;    // cd/m2, mean around the patch
    double solid_angle = 0;     // sr
    double position_index = 1;  // Guth
    double glare = 0;           // L2 omega / p2
    float x = 0, y = 0;         // middle, pixels from the top left corner
    std::vector<uint> pixels;   // row * width + column
    double ratio() const { return surroundings > 0 ? luminance / surroundings : 1e9; }
};

struct ReflectionReport {
    int width = 0, height = 0;
    std::vector<Reflection> found;
    double background = 0;  // cd/m2
    double ugr_lamps = 0;   // of the lamps in view alone
    double ugr = 0;         // with the reflections that were found
};

/// Looks for reflections of emissive lamps, and of point and spot lamps in rough gloss, by way of up to four surfaces,
/// through thin glass too. Mirror images of point lamps have no size and are not found. Deterministic.
ReflectionReport find_reflections(const Scene& scene, const RayCaster& caster, const Camera& camera,
                                  std::span<const vec3> powers, const ReflectionSettings& settings);

/// "window mirrors desk_2: 8400 cd/m2, 14x its surroundings".
std::string describe(const Scene& scene, const Reflection& reflection);

/// Writes a CSV file with a header and one line per reflection. Throws Error when the file cannot be written.
void write_reflections(const std::filesystem::path& path, const Scene& scene, const ReflectionReport& report);

/// The report of a view that has a name, such as one along a walk.
struct ViewedReflections {
    std::string view;
    ReflectionReport report;
};
/// The same for several views, with the name of the view as first column.
void write_reflections(const std::filesystem::path& path, const Scene& scene,
                       const std::vector<ViewedReflections>& views);

/// An edge between a pixel of a patch and one outside: from (x0, y0) to (x1, y1), in pixels from the top left corner.
struct OutlineEdge {
    uint x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};
/// The outline of a patch in a picture `width` pixels wide.
std::vector<OutlineEdge> outline_of(const Reflection& reflection, int width);

}  // namespace lw
