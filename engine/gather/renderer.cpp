#include "gather/renderer.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/progress.h"
#include "gather/device_fit.h"
#include "gpu/commands.h"
#include "image/tonemap.h"
#include "scene/surface.h"
#include "shaders/color.h"

namespace lw {
namespace {

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

/// The offset of a sample from the pixel's centre, in pixels: from the R3 sequence (Roberts 2018), so that it is not
/// correlated with the R2 sequences of lobes and lamps.
vec2 pixel_offset(uint index, uint count) {
    if (count == 1) return vec2(0);
    const double x = 0.5 + double(index) * 0.8191725133961645;
    const double y = 0.5 + double(index) * 0.6710436067037893;
    return vec2(float(x - std::floor(x) - 0.5), float(y - std::floor(y) - 0.5));
}

PassTimes median_times(const std::vector<PassTimes>& frames) {
    std::vector<double> visibility, gather;
    for (const PassTimes& t : frames) {
        visibility.push_back(t.visibility_ms);
        gather.push_back(t.gather_ms);
    }
    return {median(visibility), median(gather), 0};
}

/// The shading normal, turned to the camera, and in w the depth along the camera's axis, m.
vec4 normal_and_depth(const Surface& s, const Camera& camera) {
    const vec3 to_camera = camera.position - s.position;
    const bool front = dot(s.geometric_normal, to_camera) >= 0;
    return vec4(front ? s.normal : -s.normal, dot(to_camera, camera.rotation[2]));
}

constexpr uint first_compared = 8;  // samples

/// The standard error of the mean of 2n samples, RMS over the pixels in parts of the mean: it and the mean of the first
/// n differ by half of the difference of two halves. Lamps and their images are counted at eight times the mean.
float error_of_samples(const std::vector<float>& all, const std::vector<float>& first_half) {
    double mean = 0, squares = 0;
    for (float l : all) mean += double(l) / double(all.size());
    const auto limited = [&](float l) { return std::min(double(l), 8 * mean); };
    for (size_t i = 0; i < all.size(); ++i) {
        const double change = limited(all[i]) - limited(first_half[i]);
        squares += change * change / double(all.size());
    }
    return mean > 0 ? float(std::sqrt(squares) / mean) : 0.0f;
}

bool is_light(const Channel& channel) {
    return channel.name == "R" || channel.name == "G" || channel.name == "B" || channel.name == "illuminance";
}

}  // namespace

Frame make_frame(const Camera& camera, vk::Extent2D size, uint index, uint count) {
    Frame frame{};
    frame.camera_position = camera.position;
    frame.camera_right = camera.rotation[0];
    frame.camera_up = camera.rotation[1];
    frame.camera_back = camera.rotation[2];
    const float vertical = 1.0f / std::tan(0.5f * camera.yfov);
    frame.projection = vec2(vertical * float(size.height) / float(size.width), vertical);
    frame.jitter = pixel_offset(index, count) * 2.0f / vec2(float(size.width), float(size.height));
    frame.near = camera.near;
    frame.width = size.width;
    frame.height = size.height;
    frame.sample_index = index;
    frame.sample_weight = 1.0f / float(count);
    return frame;
}

Renderer::Renderer(const Device& device, const Resident& resident, uint width, uint height)
    : device_(&device),
      resident_(&resident),
      width_(width),
      height_(height),
      visibility_(device, resident, fit_pictures(device, resident, {width, height}, 1)),
      picture_(device, visibility_.texture(), resident),
      tonemap_(device, resident, picture_) {}

void Renderer::choose_gather(GatherSettings settings) {
    if (!gather_ || pipeline_settings(settings) != pipeline_settings(gather_settings_))
        gather_ = std::make_unique<GatherPass>(*device_, *resident_, picture_, settings);
    gather_settings_ = settings;
}

Rendering Renderer::render(const Camera& camera, const RenderSettings& settings) {
    choose_gather(settings.gather);
    std::vector<PassTimes> frames;
    Rendering result;
    for (uint i = 0; i < std::max(1u, settings.frames); ++i) frames.push_back(render_frame(camera, settings, result));
    result.times = median_times(frames);
    result.image =
        read_picture(*device_, resident_->scene(), camera, picture_, {width_, height_}, visibility_.read_samples());
    const float unfinished = float(result.samples) / float(std::max(1u, settings.samples));  // part of the weights
    for (Channel& channel : result.image.channels)
        if (is_light(channel) && unfinished < 1)
            for (float& value : channel.values) value /= unfinished;
    result.exposure_ev = settings.exposure_ev ? *settings.exposure_ev : auto_exposure_ev(result.image);
    std::vector<double> tonemap_ms;
    for (size_t i = 0; i < frames.size(); ++i)
        tonemap_ms.push_back(render_screen(result.exposure_ev + std::log2(unfinished)));
    result.times.tonemap_ms = median(tonemap_ms);
    result.screen = read_screen();
    return result;
}

std::vector<float> Renderer::read_luminance(float scale) const {
    std::vector<float> luminances;
    luminances.reserve(size_t(width_) * height_);
    for (const vec4& light : read_back<vec4>(*device_, picture_.radiance(), size_t(width_) * height_))
        luminances.push_back(luminance(vec3(light)) * scale);
    return luminances;
}

/// Renders the samples, each in a submission of its own, so that none lasts long enough for a driver's watchdog. Each
/// time their number has doubled, compares the picture with what it was before.
PassTimes Renderer::render_frame(const Camera& camera, const RenderSettings& settings, Rendering& result) const {
    const uint samples = std::max(1u, settings.samples);
    const Timestamps times(*device_, 3);
    PassTimes sum;
    std::vector<float> half;
    std::optional<Progress> progress;
    if (settings.shows_progress && samples > 1) progress.emplace("views", samples);
    for (uint i = 0; i < samples; ++i) {
        Frame frame = with_gather(make_frame(camera, {width_, height_}, i, samples), *resident_, settings.gather);
        if (settings.centred) frame.jitter = vec2(0);
        submit_and_wait(*device_, [&](vk::CommandBuffer commands) {
            using Stage = vk::PipelineStageFlagBits2;
            times.reset(commands);
            times.write(commands, 0);
            stage_barrier(commands, Stage::eAllCommands, Stage::eAllCommands);
            visibility_.record(commands, frame);
            times.write(commands, 1);
            gather_->record(commands, frame);
            times.write(commands, 2);
        });
        const std::vector<double> ms = times.intervals_ms();
        sum.visibility_ms += ms[0];
        sum.gather_ms += ms[1];
        if (progress) progress->step();
        result.samples = i + 1;
        if (!std::has_single_bit(i + 1) || i + 1 < first_compared) continue;
        std::vector<float> all = read_luminance(float(samples) / float(i + 1));
        if (!half.empty()) result.error = error_of_samples(all, half);
        half = std::move(all);
        if (result.error && *result.error < settings.error) break;
    }
    return sum;
}

double Renderer::render_screen(float exposure_ev) const {
    const Timestamps times(*device_, 2);
    submit_and_wait(*device_, [&](vk::CommandBuffer commands) {
        using Stage = vk::PipelineStageFlagBits2;
        times.reset(commands);
        stage_barrier(commands, Stage::eAllCommands, Stage::eComputeShader);
        times.write(commands, 0);
        tonemap_.record(commands, {width_, height_, exposure_ev});
        times.write(commands, 1);
    });
    return times.intervals_ms()[0];
}

Image read_picture(const Device& device, const Scene& scene, const Camera& camera, const Picture& picture,
                   vk::Extent2D size, const std::vector<VisibleSample>& visible) {
    Image image{int(size.width), int(size.height), {}};
    const size_t count = image.pixel_count();
    const auto light = read_back<vec4>(device, picture.radiance(), count);
    std::vector<vec4> geometry(count, vec4(0));
    const SurfaceReader surfaces(scene);
    for (size_t i = 0; i < count; ++i)
        if (visible[i].triangle != no_triangle)
            geometry[i] = normal_and_depth(surfaces.surface_at(visible[i].triangle, visible[i].barycentrics), camera);
    const auto add_plane = [&](const char* name, const auto& value) {
        std::vector<float>& plane = image.add(name);
        for (size_t i = 0; i < count; ++i) plane[i] = value(i);
    };
    add_plane("R", [&](size_t i) { return light[i].x; });
    add_plane("G", [&](size_t i) { return light[i].y; });
    add_plane("B", [&](size_t i) { return light[i].z; });
    add_plane("illuminance", [&](size_t i) { return light[i].w; });
    add_plane("depth", [&](size_t i) { return geometry[i].w; });
    add_plane("normal.X", [&](size_t i) { return geometry[i].x; });
    add_plane("normal.Y", [&](size_t i) { return geometry[i].y; });
    add_plane("normal.Z", [&](size_t i) { return geometry[i].z; });
    add_plane("triangle",
              [&](size_t i) { return visible[i].triangle == no_triangle ? -1.0f : float(visible[i].triangle); });
    return image;
}

Rgb8Image Renderer::read_screen() const {
    Rgb8Image screen{int(width_), int(height_), {}};
    const auto codes = read_back<uint32_t>(*device_, picture_.screen(), screen.pixel_count());
    screen.rgb.reserve(3 * codes.size());
    for (uint32_t code : codes)
        for (int shift : {0, 8, 16}) screen.rgb.push_back(uint8_t(code >> shift & 0xffu));
    return screen;
}

}  // namespace lw
