#include "accuracy.h"

#include <cmath>
#include <cstdio>
#include <limits>

#include "base/error.h"
#include "base/parallel.h"
#include "image/compare.h"
#include "image/exr.h"
#include "scene/camera.h"
#include "trace/reference.h"
#include "trace/sampling.h"

namespace lw {
namespace {

constexpr uint64_t reference_seed = 1;
constexpr int border_directions = 16;
constexpr float lift = 0.01f;     // m above the surface
constexpr float drop = 0.04f;     // m below the lifted point
constexpr float cos_edge = 0.5f;  // 60 degrees

std::filesystem::path reference_file(const std::filesystem::path& folder, const Scene& scene,
                                     const ReferenceView& view) {
    char name[160];
    std::snprintf(name, sizeof name, "%s-%s-%ux%u-%llu-%llu-%016llx.exr", scene.path.stem().string().c_str(),
                  view.camera.name.c_str(), view.width, view.height, (unsigned long long)view.samples,
                  (unsigned long long)reference_seed, (unsigned long long)scene.content_hash);
    return folder / "references" / name;
}

struct SurfacePoint {
    vec3 position, normal;  // geometric, to the viewer
};

std::optional<Hit> visible_hit(const RayCaster& caster, const ReferenceView& view, size_t pixel) {
    const float x = float(pixel % view.width) + 0.5f, y = float(pixel / view.width) + 0.5f;
    const CameraRay ray = camera_ray(view.camera, x, y, int(view.width), int(view.height));
    return caster.nearest(ray.origin, ray.direction);
}

std::optional<SurfacePoint> visible_point(const Scene& scene, const RayCaster& caster, const ReferenceView& view,
                                          size_t pixel) {
    const std::optional<Hit> hit = visible_hit(caster, view, pixel);
    if (!hit) return std::nullopt;
    const Surface s = SurfaceReader(scene).surface_at(hit->triangle, hit->barycentrics);
    const bool back = dot(s.geometric_normal, s.position - view.camera.position) > 0;
    return SurfacePoint{s.position, back ? -s.geometric_normal : s.geometric_normal};
}

bool is_border(const Scene& scene, const RayCaster& caster, const SurfacePoint& point, float reach) {
    const mat3 frame = frame_around(point.normal);
    const vec3 start = point.position + lift * point.normal;
    for (int i = 0; i < border_directions; ++i) {
        const float phi = 2 * lw_pi * (float(i) + 0.5f) / border_directions;
        const vec3 along = frame * vec3(std::cos(phi), std::sin(phi), 0);
        if (caster.nearest(start, along, reach)) return true;
        const std::optional<Hit> below = caster.nearest(start + reach * along, -point.normal, drop);
        if (!below) return true;
        const Surface s = SurfaceReader(scene).surface_at(below->triangle, below->barycentrics);
        if (std::fabs(dot(s.geometric_normal, point.normal)) < cos_edge) return true;
    }
    return false;
}

/// One number per pixel of what is compared; `error` reads the standard errors instead. The errors of the colour
/// channels come from the same paths and are taken as fully correlated.
std::vector<double> plane_of(const Image& image, Quantity quantity, bool error) {
    const std::string prefix = error ? "error." : "";
    const auto channel = [&](const std::string& name) {
        const Channel* found = image.find(prefix + name);
        if (!found) throw Error("picture: channel " + prefix + name + " is missing");
        return found;
    };
    std::vector<double> plane(image.pixel_count());
    if (quantity == Quantity::illuminance) {
        const Channel* lux = channel("illuminance");
        for (size_t i = 0; i < plane.size(); ++i) plane[i] = double(lux->values[i]);
        return plane;
    }
    const Channel *r = channel("R"), *g = channel("G"), *b = channel("B");
    for (size_t i = 0; i < plane.size(); ++i)
        plane[i] = 0.2126 * double(r->values[i]) + 0.7152 * double(g->values[i]) + 0.0722 * double(b->values[i]);
    return plane;
}

void add_border_error(const std::vector<double>& picture, const std::vector<double>& truth,
                      const std::vector<bool>& border, const std::vector<bool>& measured, FrameError& error) {
    double sum = 0, true_sum = 0, count = 0;
    for (size_t i = 0; i < border.size(); ++i)
        if (border[i] && (measured.empty() || measured[i])) sum += picture[i], true_sum += truth[i], count += 1;
    error.border_share = border.empty() ? 0 : count / double(border.size());
    error.border_bias = true_sum > 0 ? sum / true_sum - 1 : std::numeric_limits<double>::quiet_NaN();
}

Row percent(double fraction) { return std::isfinite(fraction) ? Row(100 * fraction) : Row(); }

}  // namespace

Image cached_reference(const std::filesystem::path& folder, const Scene& scene, const RayCaster& caster,
                       const ReferenceView& view) {
    const std::filesystem::path file = reference_file(folder, scene, view);
    if (std::filesystem::exists(file)) return read_exr(file);
    ReferenceSettings settings;
    settings.width = int(view.width), settings.height = int(view.height);
    settings.samples = view.samples;
    settings.illuminance = view.illuminance;
    // A set is traced for each sample: a few paths for each pixel are enough.
    settings.caustic_paths = std::min<uint64_t>(settings.caustic_paths, 4 * uint64_t(view.width) * view.height);
    settings.seed = reference_seed;
    const Image image = render_reference(scene, caster, view.camera, lamp_powers(scene, {}), settings).image;
    std::filesystem::create_directories(file.parent_path());
    write_exr(file, image);
    return image;
}

std::vector<bool> border_pixels(const Scene& scene, const RayCaster& caster, const ReferenceView& view, float reach) {
    std::vector<char> found(size_t(view.width) * view.height, 0);
    parallel_for(
        found.size(),
        [&](size_t i) {
            const std::optional<SurfacePoint> point = visible_point(scene, caster, view, i);
            found[i] = point && is_border(scene, caster, *point, reach);
        },
        256);
    return {found.begin(), found.end()};
}

std::vector<bool> gathered_pixels(const Scene& scene, const RayCaster& caster, const ReferenceView& view) {
    const SurfaceReader surfaces(scene);
    std::vector<char> gathered(size_t(view.width) * view.height, 0);
    parallel_for(
        gathered.size(),
        [&](size_t i) {
            const std::optional<Hit> hit = visible_hit(caster, view, i);
            if (!hit) return;
            const Surface s = surfaces.surface_at(hit->triangle, hit->barycentrics);
            gathered[i] = !surfaces.is_purely_specular(s) && s.transmission <= 0.5f;
        },
        256);
    return {gathered.begin(), gathered.end()};
}

FrameError error_of(const Image& picture, const Image& reference, Quantity quantity, const std::vector<bool>& border,
                    const std::vector<bool>& measured) {
    const std::vector<double> a = plane_of(picture, quantity, false), r = plane_of(reference, quantity, false);
    const std::vector<double> noise = plane_of(reference, quantity, true);
    double sum = 0, mean = 0, squared = 0, noise_squared = 0, count = 0;
    for (size_t i = 0; i < r.size(); ++i) {
        if (!measured.empty() && !measured[i]) continue;
        count += 1;
        sum += a[i], mean += r[i];
        squared += (a[i] - r[i]) * (a[i] - r[i]);
        noise_squared += noise[i] * noise[i];
    }
    FrameError error;
    error.bias = sum / mean - 1;
    mean /= count;
    error.rmse = std::sqrt(squared / count) / mean;
    error.reference_error = std::sqrt(noise_squared / count) / mean;
    error.rmse_without_noise = std::sqrt(std::max(0.0, squared - noise_squared) / count) / mean;
    error.flip = picture.find("R") ? compare(picture, reference).flip : std::numeric_limits<double>::quiet_NaN();
    add_border_error(a, r, border, measured, error);
    return error;
}

void add_error(Row& row, const FrameError& error) {
    row["rmse_%"] = percent(error.rmse_without_noise);
    row["rmse_as_measured_%"] = percent(error.rmse);
    row["reference_error_%"] = percent(error.reference_error);
    row["bias_%"] = percent(error.bias);
    if (error.border_share > 0) row["border_bias_%"] = percent(error.border_bias);
    row["flip"] = std::isfinite(error.flip) ? Row(error.flip) : Row();
}

}  // namespace lw
