// lumenwalk-screenshot: a picture of a baked scene, gathered on the GPU.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <iostream>

#include "base/error.h"
#include "base/one_line.h"
#include "base/program.h"
#include "base/replaced_file.h"
#include "file/map_file.h"
#include "gather/renderer.h"
#include "image/exr.h"
#include "image/light_check.h"
#include "image/picture_size.h"
#include "image/png.h"
#include "scene/ambiance.h"
#include "scene/camera.h"
#include "scene/lamp_factors.h"
#include "scene/load_scene.h"
#include "shared_options.h"
#include "trace/build_bvh.h"

namespace {

struct Options {
    std::string scene, map, output, camera, size, gather = "cached", device, ambiance, rays = "fastest";
    std::vector<std::string> powers, photometry;
    unsigned neighbours = lw::GatherSettings{}.neighbours, samples = 0, timings = 0,
             shadow_rays = lw::GatherSettings{}.shadow_rays, paths = lw::GatherSettings{}.paths;
    float followed_roughness = lw::GatherSettings{}.followed_roughness;
    std::optional<float> exposure, error_percent;
    double device_memory_gb = 0;
    bool list_cameras = false, list_lights = false, list_devices = false, validation = false;
    bool lists() const { return list_cameras || list_lights || list_devices; }
};

void add_options(CLI::App& app, Options& o) {
    app.add_option("scene", o.scene, "glTF 2.0 scene, .glb or .gltf");
    app.add_option("map", o.map, "photon map of lumenwalk-bake; default: SCENE.pmap beside the scene");
    app.add_option("-o,--output", o.output,
                   "picture to write, required: .exr (cd/m2, lux, m) or .png (exposed, 8 bits)");
    app.add_option("--camera", o.camera, "name of a camera of the scene; default: the first");
    app.add_option("--size", o.size, "pixels as WxH; default: 1280 wide with the aspect of the camera");
    lw::add_photometry(app, o.photometry);
    lw::add_power(app, o.powers);
    lw::add_ambiance(app, o.ambiance);
    app.add_option("--neighbours", o.neighbours,
                   "photons that the light at a point is estimated from, where it is estimated from photons")
        ->check(CLI::Range(1, 1000000))
        ->capture_default_str();
    app.add_option("--gather", o.gather, lw::gather_mode_help())
        ->check(CLI::IsMember(lw::gather_mode_names()))
        ->capture_default_str();
    app.add_option(
           "--shadow-rays", o.shadow_rays,
           "shadow rays per pixel and glowing object; 0: none at all, shadows as sharp as the lattice of the bake")
        ->check(CLI::Range(0, 1024))
        ->capture_default_str();
    app.add_option("--paths", o.paths,
                   "paths followed per pixel along narrow lobes and through glass, where there are any")
        ->check(CLI::Range(1u, lw::max_paths))
        ->capture_default_str();
    app.add_option("--followed-roughness", o.followed_roughness,
                   "glTF roughness, 0 to 1: rays bring what smoother surfaces reflect, photons what others do")
        ->check(lw::finite_number(0, 1))
        ->capture_default_str();
    app.add_option("--exposure", o.exposure, "EV100, the exposure of a .png; default: from the picture")
        ->check(lw::finite_number(-100, 100));
    app.add_option("--samples", o.samples, "views averaged per pixel; default: 64, at most 4096 with --error")
        ->check(CLI::Range(1, 4096));
    app.add_option("--error", o.error_percent,
                   "ends once the standard error of the picture, in percent of its mean luminance, is estimated below "
                   "this; 0.5 is smooth to the eye")
        ->check(lw::finite_number(0.01, 100));
    app.add_option("--device", o.device, "part of the name of a Vulkan device; default: the fastest kind");
    app.add_option("--device-memory", o.device_memory_gb,
                   "GB of the device that scene and photons may take; default: what it has to give")
        ->check(lw::finite_number(0.001, 1e6));
    app.add_option("--timings", o.timings, "draws the picture this often and prints the median times of its passes")
        ->check(CLI::Range(1, 10000));
    app.add_option("--rays", o.rays, lw::rays_help)->check(CLI::IsMember(lw::rays_names))->capture_default_str();
    app.add_flag("--validation", o.validation, "run with the Vulkan validation layer; any message is an error");
    app.add_flag("--list-cameras", o.list_cameras, "print the cameras of the scene");
    app.add_flag("--list-lights", o.list_lights, "print the lamps of the scene");
    app.add_flag("--list-devices", o.list_devices, "print the Vulkan devices");
}

/// What is wrong with the command line, or "".
std::string misuse_of(const Options& o) {
    const std::string extension = std::filesystem::path(o.output).extension().string();
    if (o.scene.empty() && (!o.lists() || o.list_cameras || o.list_lights)) return "a scene is required";
    if (!o.lists() && extension != ".exr" && extension != ".png") return "--output: must end in .exr or .png";
    if (!o.size.empty() && lw::parse_picture_size(o.size, 1, 65536).width == 0)
        return "--size: must be WxH in pixels, as 1280x720";
    for (const std::string& power : o.powers)
        if (power.find('=') == std::string::npos) return "--power: must be LIGHT=FACTOR";
    return "";
}

void print_lists(const Options& o) {
    if (o.list_devices)
        for (const std::string& name : lw::device_names()) std::cout << name << "\n";
    if (!o.list_cameras && !o.list_lights) return;
    const lw::Scene scene = lw::load_scene(o.scene, o.photometry);
    if (o.list_cameras)
        for (const lw::Camera& camera : scene.cameras) std::cout << camera.name << "\n";
    if (o.list_lights)
        for (const std::string& name : scene.light_names) std::cout << name << "\n";
}

vk::Extent2D picture_size(const Options& o, const lw::Camera& camera) {
    lw::WantedSize size{1280, 720};
    if (!o.size.empty())
        size = lw::parse_picture_size(o.size, 1, 65536);
    else if (camera.aspect > 0)
        size.height = std::max(1u, unsigned(float(size.width) / camera.aspect + 0.5f));
    return {size.width, size.height};
}

void write_picture(const std::filesystem::path& path, const lw::Rendering& picture) {
    if (path.extension() == ".exr")
        lw::write_exr(path, picture.image);
    else
        lw::write_png(path, picture.screen);
}

void refuse_validation_messages(const lw::Device& device) {
    const std::vector<std::string> messages = device.validation_messages();
    if (!messages.empty())
        throw lw::Error("Vulkan validation: " + std::to_string(messages.size()) + " messages, first: " + messages[0]);
}

void take_screenshot(const Options& o) {
    const lw::Scene scene = lw::load_scene(o.scene, o.photometry);
    for (const std::string& warning : scene.warnings) std::cerr << "warning: " << warning << "\n";
    const lw::Camera& camera = lw::find_camera(scene, o.camera);
    const std::vector<lw::vec3> factors = lw::chosen_factors(scene, o.ambiance, o.powers);
    const std::filesystem::path map_path = o.map.empty() ? lw::default_map_path(o.scene) : std::filesystem::path(o.map);
    const lw::PhotonMap map = lw::load_photon_map(map_path, scene);
    std::vector<std::filesystem::path> inputs = scene.files;
    inputs.push_back(map_path);
    lw::check_can_create(o.output, inputs);
    const lw::Device device({.name = o.device,
                             .validation = o.validation,
                             .memory_bytes = vk::DeviceSize(o.device_memory_gb * 1e9),
                             .rays = lw::rays_named(o.rays)});
    const lw::Bvh bvh = lw::build_bvh(scene);
    lw::Resident resident(device, scene, map, bvh);
    resident.set_lamp_factors(factors);
    const vk::Extent2D size = picture_size(o, camera);
    lw::Renderer renderer(device, resident, size.width, size.height);
    const lw::GatherSettings gather{lw::gather_mode_named(o.gather), o.neighbours, o.shadow_rays, o.paths,
                                    o.followed_roughness};
    const lw::Rendering picture = renderer.render(camera, {.gather = gather,
                                                           .exposure_ev = o.exposure,
                                                           .samples = o.samples > 0     ? o.samples
                                                                      : o.error_percent ? 4096u
                                                                                        : 64u,
                                                           .frames = std::max(o.timings, 1u),
                                                           .error = o.error_percent.value_or(0) / 100,
                                                           .shows_progress = o.timings <= 1});
    refuse_validation_messages(device);
    lw::check_is_light(picture.image);
    write_picture(o.output, picture);
    std::printf("%s: %ux%u on %s, %.0f MiB on the device, EV %.2f\n", lw::one_line(o.output).c_str(), size.width,
                size.height, device.name().c_str(), double(resident.bytes()) / 1048576.0, double(picture.exposure_ev));
    if (picture.error)
        std::printf("%u views, estimated standard error %.2g %%\n", picture.samples, 100 * double(*picture.error));
    if (o.timings > 0)
        std::printf("visibility %.2f ms, gather %.2f ms, tone mapping %.2f ms (median of %u)\n",
                    picture.times.visibility_ms, picture.times.gather_ms, picture.times.tonemap_ms, o.timings);
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    CLI::App app("Renders a baked scene on the GPU.", "lumenwalk-screenshot");
    add_options(app, options);
    try {
        app.parse(argc, argv);
        const std::string misuse = misuse_of(options);
        if (!misuse.empty()) throw CLI::ValidationError(misuse);
    } catch (const CLI::ParseError& wrong) {
        return app.exit(wrong) == 0 ? 0 : 2;
    }
    return lw::run_program("lumenwalk-screenshot",
                           [&] { options.lists() ? print_lists(options) : take_screenshot(options); });
}
