#include "app/play.h"

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "app/picture/exposure.h"
#include "base/error.h"
#include "base/progress.h"
#include "base/replaced_file.h"
#include "file/map_file.h"
#include "image/light_check.h"
#include "image/png.h"
#include "scene/lamp_factors.h"

namespace lw {
namespace {

using Clock = std::chrono::steady_clock;

struct FrameTimes {
    double seconds;        // time in the path
    RendererTimes passes;  // of all samples
    RendererTimes first;   // of the first
    double all_ms;         // from the first command recorded to the last one done
};

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

Rgb8Image read_screen(const Device& device, const ProgressiveRenderer& renderer, vk::Extent2D size) {
    Rgb8Image image{int(size.width), int(size.height), {}};
    for (uint32_t code : read_back<uint32_t>(device, renderer.screen(), image.pixel_count()))
        for (int shift : {0, 8, 16}) image.rgb.push_back(uint8_t(code >> shift & 0xffu));
    return image;
}

/// Makes one frame with all its samples and waits for it.
FrameTimes make_frame_of(const Device& device, ProgressiveRenderer& renderer, const FrameRequest& request,
                         const DisplaySettings& display) {
    FrameTimes times{};
    renderer.forget();
    const Clock::time_point start = Clock::now();
    for (uint i = 0; i < request.max_samples; ++i) {
        submit_and_wait(device, [&](vk::CommandBuffer commands) { renderer.record(commands, request, display, 0); });
        const RendererTimes pass = renderer.times(0);
        times.passes.visibility_ms += pass.visibility_ms;
        times.passes.gather_ms += pass.gather_ms;
        times.passes.view_ms += pass.view_ms;
        times.passes.divisor = pass.divisor;  // of the last sample, whose picture is shown
        if (i == 0) times.first = pass;
    }
    times.all_ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
    return times;
}

void write_timings(const std::filesystem::path& path, const std::vector<FrameTimes>& frames) {
    ReplacedFile file(path);
    file.stream() << "frame,path seconds,visibility ms,gather ms,view ms,frame ms\n";
    for (size_t i = 0; i < frames.size(); ++i) {
        const FrameTimes& f = frames[i];
        file.stream() << i + 1 << "," << f.seconds << "," << f.passes.visibility_ms << "," << f.passes.gather_ms << ","
                      << f.passes.view_ms << "," << f.all_ms << "\n";
    }
    file.commit();
}

double median_of(const std::vector<FrameTimes>& frames, double (*value)(const FrameTimes&)) {
    std::vector<double> values;
    for (const FrameTimes& f : frames) values.push_back(value(f));
    return median(std::move(values));
}

std::string settings_text(const GatherSettings& gather, uint samples) {
    std::string text = gather_mode(gather.mode).title;
    if (gather.mode != gather_mode_cached) text += ", " + std::to_string(gather.neighbours) + " photons per estimate";
    text += ", " + std::to_string(gather.shadow_rays) + " shadow rays per emissive mesh, ";
    return text + std::to_string(samples) + (samples == 1 ? " view per pixel" : " views per pixel");
}

void print_rate(const std::vector<FrameTimes>& frames, const PlaySettings& settings) {
    double sum = 0, slowest = 0;
    for (const FrameTimes& f : frames) sum += f.all_ms, slowest = std::max(slowest, f.all_ms);
    const uint divisor = frames.back().passes.divisor;
    std::printf("%s, %ux%u", settings_text(settings.gather, settings.samples).c_str(), settings.size.width,
                settings.size.height);
    std::printf(divisor > 1 ? ", light at %ux%u\n" : "\n", settings.size.width / divisor,
                settings.size.height / divisor);
    std::printf("median of passes: visibility %.1f ms, gather %.1f ms, view %.1f ms\n",
                median_of(frames, [](const FrameTimes& f) { return f.passes.visibility_ms; }),
                median_of(frames, [](const FrameTimes& f) { return f.passes.gather_ms; }),
                median_of(frames, [](const FrameTimes& f) { return f.passes.view_ms; }));
    std::printf("%zu frames, median %.1f ms, slowest %.1f ms, %.1f frames/s\n", frames.size(),
                median_of(frames, [](const FrameTimes& f) { return f.all_ms; }), slowest,
                1000 * double(frames.size()) / sum);
}

void prepare_folder(const std::filesystem::path& folder) {
    std::error_code failure;
    std::filesystem::create_directories(folder, failure);
    if (failure) throw Error(folder.string() + ": cannot be created: " + failure.message());
    check_can_create(folder / "frame-0001.png");
}

std::filesystem::path frame_name(const std::filesystem::path& folder, size_t i) {
    char name[32];
    std::snprintf(name, sizeof name, "frame-%04zu.png", i + 1);
    return folder / name;
}

}  // namespace

void play(const PlaySettings& settings) {
    const LampPresets presets = load_lamp_presets(default_ambiances_path(settings.scene));
    const World world(settings.scene, presets, settings.photometry);
    const Path path = load_path(settings.path);
    const std::vector<vec3> factors = chosen_factors(world.scene, settings.ambiance, {});
    const auto map = std::make_shared<const PhotonMap>(load_photon_map(settings.map, world.scene));
    if (!settings.frames.empty()) prepare_folder(settings.frames);
    if (!settings.timings.empty()) {
        std::vector<std::filesystem::path> inputs = world.scene.files;
        inputs.insert(inputs.end(), {settings.map, settings.path});
        check_can_create(settings.timings, inputs);
    }
    const Device device(settings.device);
    ProgressiveRenderer renderer(device, world.scene, map, world.bvh);
    renderer.resize(settings.size);
    Viewing viewing;
    viewing.auto_exposure = !settings.exposure_ev;
    viewing.exposure_ev = settings.exposure_ev.value_or(0);
    const auto count = size_t(path.seconds() * path.frames_per_second + 1.5);
    std::vector<FrameTimes> frames;
    uint divisor = std::max(1u, settings.divisor);
    const auto make = [&](size_t i) {
        FrameRequest request;
        request.camera = camera_on(path, double(i) / path.frames_per_second, world.scene);
        request.factors_a = factors;
        request.gather = settings.gather;
        request.max_samples = settings.samples;
        request.divisor = divisor;
        request.sharpens = false;
        FrameTimes times = make_frame_of(device, renderer, request, {{}, viewing.exposure_ev});
        times.seconds = double(i) / path.frames_per_second;
        return times;
    };
    make(0);  // pipelines are made and the exposure is found before the clock runs
    DynamicResolution resolution;
    if (settings.divisor == 0) divisor = resolution.next(0, make(0).first, true);
    for (size_t i = 0; i < count; ++i) {
        adapt_to(viewing, renderer.readback(0, view_shaded), i == 0 ? 10.0f : float(1 / path.frames_per_second));
        frames.push_back(make(i));
        if (settings.divisor == 0) divisor = resolution.next(0, frames.back().first, false);
        if (settings.frames.empty()) continue;
        check_is_light(renderer.read_values());
        write_png(frame_name(settings.frames, i), read_screen(device, renderer, settings.size));
    }
    if (!settings.timings.empty()) write_timings(settings.timings, frames);
    print_rate(frames, settings);
    const std::vector<std::string> messages = device.validation_messages();
    if (!messages.empty()) throw Error("Vulkan validation: first message: " + messages[0]);
}

}  // namespace lw
