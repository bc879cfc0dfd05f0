#include "trace/reference.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "base/memory.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "scene/camera.h"
#include "shaders/color.h"

namespace lw {
namespace {

/// Running mean and squared deviation of RGB and illuminance (Welford 1962), in double.
struct PixelSum {
    std::array<double, 4> mean{}, deviation{};

    void add(const std::array<double, 4>& sample, uint64_t n) {
        for (size_t c = 0; c < 4; ++c) {
            const double delta = sample[c] - mean[c];
            mean[c] += delta / double(n);
            deviation[c] += delta * (sample[c] - mean[c]);
        }
    }
    double error(size_t c, uint64_t n) const { return n > 1 ? std::sqrt(deviation[c] / double(n - 1) / double(n)) : 0; }
};

/// The first surface on the ray through the centre of a pixel. All samples of the pixel share it, so it is found once.
struct FirstHit {
    CameraRay ray;
    std::optional<Hit> hit;
    Surface surface;
    vec3 normal;  // geometric, unit, on the side of the viewer
};

double relative_error(const std::vector<PixelSum>& pixels, uint64_t n) {
    double mean = 0, error2 = 0;
    for (const PixelSum& p : pixels)
        for (size_t c = 0; c < 3; ++c) {
            mean += p.mean[c];
            error2 += p.error(c, n) * p.error(c, n);
        }
    const double count = 3 * double(pixels.size());
    return mean > 0 ? std::sqrt(error2 / count) / (mean / count) : 0;
}

void write_first_hits(const std::vector<FirstHit>& first, const Camera& camera, Image& image) {
    auto& depth = image.add("depth");
    auto& triangle = image.add("triangle", -1);
    for (size_t i = 0; i < first.size(); ++i) {
        if (!first[i].hit) continue;
        depth[i] = camera.near - dot(first[i].ray.direction, camera.rotation[2]) * first[i].hit->distance;
        triangle[i] = float(first[i].hit->triangle);
    }
    for (int axis = 0; axis < 3; ++axis) {
        auto& normal = image.add(std::string("normal.") + "XYZ"[axis]);
        for (size_t i = 0; i < first.size(); ++i)
            if (first[i].hit)
                normal[i] =
                    first[i].surface.normal[axis] * (dot(first[i].surface.normal, first[i].normal) < 0 ? -1.0f : 1.0f);
    }
}

Image to_image(const std::vector<PixelSum>& pixels, uint64_t n, const ReferenceSettings& settings) {
    Image image{settings.width, settings.height, {}};
    const char* names[] = {"R", "G", "B", "illuminance"};
    for (size_t c = 0; c < (settings.illuminance ? 4u : 3u); ++c) {
        auto& mean = image.add(names[c]);
        for (size_t i = 0; i < pixels.size(); ++i) mean[i] = float(pixels[i].mean[c]);
        auto& error = image.add(std::string("error.") + names[c]);
        for (size_t i = 0; i < pixels.size(); ++i) error[i] = float(pixels[i].error(c, n));
    }
    return image;
}

/// The kernel radii of the caustics, one per sample. They fall so that blur and noise vanish together (Knaus & Zwicker
/// 2011).
class CausticRadii {
  public:
    explicit CausticRadii(float first) : r2_(double(first) * double(first)) {}
    float next() {
        const double r2 = r2_;
        ++samples_, sum_ += r2;
        r2_ *= (double(samples_) + 2.0 / 3) / (double(samples_) + 1);
        return float(std::sqrt(r2));
    }
    float mean() const { return samples_ ? float(std::sqrt(sum_ / double(samples_))) : 0; }

  private:
    double r2_, sum_ = 0;
    uint64_t samples_ = 0;
};

}  // namespace

void check_reference_fits(const ReferenceSettings& settings, uint64_t available) {
    constexpr uint64_t channels = 13;  // of the image, and as many once more while it is written
    check_picture_fits(uint64_t(settings.width), uint64_t(settings.height),
                       sizeof(PixelSum) + sizeof(FirstHit) + 2 * channels * sizeof(float), available);
}

Reference render_reference(const Scene& scene, const RayCaster& caster, const Camera& camera,
                           const std::vector<vec3>& powers, const ReferenceSettings& settings) {
    const std::optional<SkySampler> around = sky_around(scene, settings.daylight);
    const SkySampler* sky = around ? &*around : nullptr;
    const PathTracer tracer(scene, caster, powers, sky);
    const SurfaceReader surfaces(scene);
    const size_t count = size_t(settings.width) * size_t(settings.height);
    std::vector<PixelSum> pixels(count);
    std::vector<FirstHit> first(count);
    parallel_for(
        count,
        [&](size_t i) {
            const auto x = float(i % size_t(settings.width)) + 0.5f, y = float(i / size_t(settings.width)) + 0.5f;
            first[i].ray = camera_ray(camera, x, y, settings.width, settings.height);
            first[i].hit = caster.nearest(first[i].ray.origin, first[i].ray.direction);
            if (!first[i].hit) return;
            first[i].surface = surfaces.surface_at(first[i].hit->triangle, first[i].hit->barycentrics);
            const vec3 ng = first[i].surface.geometric_normal;
            first[i].normal = dot(ng, first[i].ray.direction) > 0 ? -ng : ng;
        },
        64);

    const auto start = std::chrono::steady_clock::now();
    Progress progress("reference", settings.samples * count);
    Reference result;
    const bool with_caustics = settings.caustic_paths > 0 && has_caustics(scene, powers, sky);
    CausticRadii radii(settings.caustic_radius > 0 ? settings.caustic_radius : 0.004f * scene.size());
    std::optional<Caustics> caustics;
    while (result.samples < settings.samples) {
        const uint64_t most = with_caustics ? 1 : std::max<uint64_t>(1, std::min<uint64_t>(result.samples, 16));
        const uint64_t pass = std::min<uint64_t>(settings.samples - result.samples, most);
        if (with_caustics)
            caustics.emplace(scene, caster, powers,
                             CausticSettings{settings.caustic_paths, radii.next(), settings.seed, result.samples, sky});
        const Caustics* light = caustics ? &*caustics : nullptr;
        parallel_for(size_t(settings.height), [&](size_t row) {
            for (size_t i = row * size_t(settings.width); i < (row + 1) * size_t(settings.width); ++i)
                for (uint64_t n = result.samples; n < result.samples + pass; ++n) {
                    Rng rng(settings.seed, i, n);
                    const vec3 radiance = tracer.radiance(first[i].ray.origin, first[i].ray.direction, rng, light);
                    double lux = 0;
                    if (settings.illuminance && first[i].hit)
                        lux = precise_luminance(
                            tracer.irradiance(first[i].surface.position, first[i].normal, rng, light));
                    pixels[i].add({double(radiance.x), double(radiance.y), double(radiance.z), lux}, n + 1);
                }
            progress.step(pass * uint64_t(settings.width));
        });
        result.samples += pass;
        result.relative_error = relative_error(pixels, result.samples);
        const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        if (settings.seconds > 0 && seconds >= settings.seconds) break;
        if (settings.error > 0 && result.samples >= 16 && result.relative_error <= settings.error) break;
    }
    result.caustic_radius = radii.mean();
    result.image = to_image(pixels, result.samples, settings);
    write_first_hits(first, camera, result.image);
    return result;
}

}  // namespace lw
