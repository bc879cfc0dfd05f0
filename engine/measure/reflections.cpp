#include "measure/reflections.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/parallel.h"
#include "base/replaced_file.h"
#include "measure/guth.h"
#include "measure/mirrored_light.h"
#include "scene/camera.h"
#include "shaders/color.h"

namespace lw {
namespace {

constexpr uint max_surroundings = 96;   // pixels path traced around a patch
constexpr uint surrounding_paths = 32;  // per pixel

/// The pixels of a view and their rays.
struct View {
    const Camera& camera;
    int width, height;

    size_t size() const { return size_t(width) * size_t(height); }
    vec3 direction(size_t pixel, float dx, float dy) const {
        return camera_direction(camera, float(pixel % size_t(width)) + dx, float(pixel / size_t(width)) + dy, width,
                                height);
    }
    /// Solid angle of a pixel of the plane at distance 1: its area times the cube of the cosine.
    double solid_angle(size_t pixel) const {
        const double cosine = -double(dot(direction(pixel, 0.5f, 0.5f), camera.rotation[2]));
        const double side = 2 * std::tan(double(camera.yfov) / 2) / height;
        return side * side * cosine * cosine * cosine;
    }
    /// The neighbours of a pixel, eight or fewer.
    template <class Visit>
    void around(uint pixel, const Visit& visit) const {
        const int x = int(pixel) % width, y = int(pixel) / width;
        for (int ny = std::max(y - 1, 0); ny <= std::min(y + 1, height - 1); ++ny)
            for (int nx = std::max(x - 1, 0); nx <= std::min(x + 1, width - 1); ++nx)
                if (nx != x || ny != y) visit(uint(ny * width + nx));
    }
};

std::vector<MirroredLight> mirrored_light(const Scene& scene, const RayCaster& caster, std::span<const vec3> powers,
                                          const View& view, const ReflectionSettings& settings) {
    const MirrorTracer tracer(scene, caster, powers);
    std::vector<MirroredLight> light(view.size());
    parallel_for(
        view.size(),
        [&](size_t pixel) {
            for (uint i = 0; i < settings.samples; ++i) {
                Rng rng(settings.seed, pixel, i);
                const float dx = rng.next(), dy = rng.next();
                tracer.add(view.camera.position, view.direction(pixel, dx, dy), 1.0 / settings.samples, rng,
                           light[pixel]);
            }
        },
        64);
    return light;
}

/// Finds the patches: connected pixels (by edge or corner) in which one object shows one lamp with more than `limit`
/// cd/m2. `light`: the mirrored light of each pixel.
std::vector<Reflection> grow_patches(const std::vector<MirroredLight>& light, const View& view, double limit) {
    std::vector<Reflection> patches;
    std::map<std::pair<uint, uint>, std::vector<char>> bright;
    for (uint pixel = 0; pixel < light.size(); ++pixel)
        for (const auto& [cause, value] : light[pixel])
            if (value >= limit) bright.try_emplace(cause, view.size(), char(0)).first->second[pixel] = 1;
    for (auto& [cause, mask] : bright) {
        std::vector<char>& left = mask;
        for (uint seed = 0; seed < left.size(); ++seed) {
            if (!left[seed]) continue;
            Reflection patch;
            patch.lamp = cause.first, patch.object = cause.second;
            patch.pixels.push_back(seed), left[seed] = 0;
            for (size_t i = 0; i < patch.pixels.size(); ++i)
                view.around(patch.pixels[i], [&](uint other) {
                    if (left[other]) patch.pixels.push_back(other), left[other] = 0;
                });
            std::sort(patch.pixels.begin(), patch.pixels.end());
            patches.push_back(std::move(patch));
        }
    }
    return patches;
}

/// The pixels around a patch, up to about its own width away, that show neither a lamp nor a patch.
std::vector<uint> surroundings_of(const Reflection& patch, const std::vector<char>& taken, const View& view) {
    std::vector<char> reached(view.size(), 0);
    std::vector<uint> front = patch.pixels, found;
    for (uint pixel : front) reached[pixel] = 1;
    const int steps = 2 + int(std::sqrt(double(patch.pixels.size())) / 2);
    for (int step = 0; step < steps; ++step) {
        std::vector<uint> next;
        for (uint pixel : front)
            view.around(pixel, [&](uint other) {
                if (!reached[other]) next.push_back(other), reached[other] = 1;
            });
        for (uint pixel : next)
            if (step > 0 && !taken[pixel])
                found.push_back(pixel);  // the first ring of pixels is left out: they are partly patch
        front = std::move(next);
    }
    return found;
}

/// For each pixel: 1 when it shows a lamp itself or a reflection above the limit.
std::vector<char> taken_pixels(const Scene& scene, const RayCaster& caster, const View& view,
                               const std::vector<Reflection>& patches) {
    std::vector<char> taken(view.size(), 0);
    for (size_t pixel = 0; pixel < view.size(); ++pixel) {
        const auto hit = caster.nearest(view.camera.position, view.direction(pixel, 0.5f, 0.5f));
        taken[pixel] = hit && scene.objects[scene.triangle_objects[hit->triangle]].light >= 0;
    }
    for (const Reflection& patch : patches)
        for (uint pixel : patch.pixels) taken[pixel] = 1;
    return taken;
}

double mean_luminance(const PathTracer& tracer, const View& view, const std::vector<uint>& pixels, uint64_t seed) {
    const size_t step = std::max<size_t>(1, pixels.size() / max_surroundings);
    double sum = 0;
    size_t count = 0;
    for (size_t i = 0; i < pixels.size(); i += step)
        for (uint n = 0; n < surrounding_paths; ++n, ++count) {
            Rng rng(seed ^ 0x5eed, pixels[i], n);
            sum += precise_luminance(tracer.radiance(view.camera.position, view.direction(pixels[i], 0.5f, 0.5f), rng));
        }
    return count ? sum / double(count) : 0;
}

/// Fills in the patch's size, place and luminance. `light`: the mirrored light of each pixel.
void measure(Reflection& patch, const std::vector<MirroredLight>& light, const View& view) {
    const vec3 forward = -view.camera.rotation[2], up = view.camera.rotation[1];
    double mean = 0;
    vec3 middle(0);
    for (uint pixel : patch.pixels) {
        const double value = light[pixel].at({patch.lamp, patch.object}), size = view.solid_angle(pixel);
        mean += value * size;
        patch.peak = std::max(patch.peak, value);
        patch.solid_angle += size;
        patch.x += (float(pixel % uint(view.width)) + 0.5f) / float(patch.pixels.size());
        patch.y += (float(pixel / uint(view.width)) + 0.5f) / float(patch.pixels.size());
        middle += view.direction(pixel, 0.5f, 0.5f) * float(size);
    }
    patch.luminance = mean / patch.solid_angle + patch.surroundings;
    patch.peak += patch.surroundings;
    const GlareSource source{patch.lamp, patch.luminance, patch.solid_angle, normalize(middle)};
    patch.position_index = position_index(source.direction, forward, up);
    patch.glare = glare_of(source, forward, up);
}

}  // namespace

ReflectionReport find_reflections(const Scene& scene, const RayCaster& caster, const Camera& camera,
                                  std::span<const vec3> powers, const ReflectionSettings& settings) {
    const View view{camera, settings.width, settings.height};
    const std::vector<MirroredLight> light = mirrored_light(scene, caster, powers, view, settings);
    std::vector<Reflection> patches = grow_patches(light, view, settings.limits.luminance);
    const std::vector<char> taken = taken_pixels(scene, caster, view, patches);
    const PathTracer tracer(scene, caster, {powers.begin(), powers.end()});
    parallel_for(patches.size(), [&](size_t i) {
        patches[i].surroundings = mean_luminance(tracer, view, surroundings_of(patches[i], taken, view), settings.seed);
        measure(patches[i], light, view);
    });
    std::erase_if(patches, [&](const Reflection& p) {
        return p.ratio() < settings.limits.ratio || p.solid_angle < settings.limits.solid_angle;
    });
    std::stable_sort(patches.begin(), patches.end(),
                     [](const Reflection& a, const Reflection& b) { return a.glare > b.glare; });

    ReflectionReport report{settings.width, settings.height, std::move(patches), 0, 0, 0};
    report.background = background_luminance(scene, caster, camera, powers);
    double glare = 0;
    for (const GlareSource& lamp : find_visible_lamps(scene, caster, camera, powers))
        glare += glare_of(lamp, -camera.rotation[2], camera.rotation[1]);
    report.ugr_lamps = unified_glare_rating(glare, report.background);
    for (const Reflection& r : report.found) glare += r.glare;
    report.ugr = unified_glare_rating(glare, report.background);
    return report;
}

std::string describe(const Scene& scene, const Reflection& reflection) {
    char numbers[96];
    std::snprintf(numbers, sizeof numbers, ": %.0f cd/m2, %.3gx its surroundings", reflection.luminance,
                  reflection.ratio());
    return scene.object_names[reflection.object] + " mirrors " + scene.light_names[reflection.lamp] + numbers;
}

namespace {

constexpr const char* columns =
    "object,lamp,luminance_cd_m2,peak_cd_m2,surroundings_cd_m2,ratio,solid_angle_sr,position_index,glare,ugr_alone,x_"
    "px,"
    "y_px,pixels\n";

std::string quoted(const std::string& name) {
    std::string text = "\"";
    for (char c : name) text += c == '"' ? "\"\"" : std::string(1, c);
    return text + '"';
}

std::string row_of(const Scene& scene, const ReflectionReport& report, const Reflection& r) {
    char line[320];
    std::snprintf(line, sizeof line, ",%.6g,%.6g,%.6g,%.6g,%.6g,%.4f,%.6g,%.2f,%.1f,%.1f,%zu\n", r.luminance, r.peak,
                  r.surroundings, r.ratio(), r.solid_angle, r.position_index, r.glare,
                  unified_glare_rating(r.glare, report.background), double(r.x), double(r.y), r.pixels.size());
    return quoted(scene.object_names[r.object]) + ',' + quoted(scene.light_names[r.lamp]) + line;
}

}  // namespace

void write_reflections(const std::filesystem::path& path, const Scene& scene, const ReflectionReport& report) {
    ReplacedFile file(path);
    file.stream() << columns;
    for (const Reflection& r : report.found) file.stream() << row_of(scene, report, r);
    file.commit();
}

void write_reflections(const std::filesystem::path& path, const Scene& scene,
                       const std::vector<ViewedReflections>& views) {
    ReplacedFile file(path);
    file.stream() << "view," << columns;
    for (const ViewedReflections& v : views)
        for (const Reflection& r : v.report.found) file.stream() << quoted(v.view) << ',' << row_of(scene, v.report, r);
    file.commit();
}

std::vector<OutlineEdge> outline_of(const Reflection& reflection, int width) {
    const auto columns_wide = uint(width);
    const auto inside = [&](uint x, uint y) {  // x may be -1, as the largest uint
        return x < columns_wide &&
               std::binary_search(reflection.pixels.begin(), reflection.pixels.end(), y * columns_wide + x);
    };
    std::vector<OutlineEdge> edges;
    for (uint pixel : reflection.pixels) {
        const uint x = pixel % columns_wide, y = pixel / columns_wide;
        if (!inside(x - 1, y)) edges.push_back({x, y, x, y + 1});
        if (!inside(x + 1, y)) edges.push_back({x + 1, y, x + 1, y + 1});
        if (y == 0 || !inside(x, y - 1)) edges.push_back({x, y, x + 1, y});
        if (!inside(x, y + 1)) edges.push_back({x, y + 1, x + 1, y + 1});
    }
    return edges;
}

}  // namespace lw
