// lumenwalk: walk through a baked building, dim its lamps, measure and compare.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>

#include "app/play.h"
#include "app/walkthrough.h"
#include "base/program.h"
#include "file/map_file.h"
#include "image/picture_size.h"

namespace {

struct Options {
    lw::WalkthroughSettings walk;
    std::string scene, map, output, size, gather = "cached", rays = "fastest";
    double device_memory_gb = 0;
    lw::PlaySettings play;
};

void add_options(CLI::App& app, Options& o) {
    app.add_option("scene", o.scene, "glTF 2.0 scene, .glb or .gltf")->required();
    app.add_option("map", o.map, "photon map; default: SCENE.pmap beside the scene, baked when missing or stale");
    app.add_option("--photons", o.walk.photons, "photons of a map that must be baked")
        ->check(CLI::Range(uint64_t(1000), uint64_t(2'000'000'000)))
        ->capture_default_str();
    app.add_option("--camera", o.walk.camera, "name of the camera to start at; default: the first");
    app.add_option("--ambiance", o.walk.ambiance,
                   "name of a set of lamp factors in SCENE.ambiances.json to start with; default: all lamps at 1");
    app.add_option(
           "--ies", o.walk.photometry,
           "LAMP=FILE, gives a point or spot lamp the distribution of an IES LM-63 or EULUMDAT (.ldt) file; may be "
           "repeated; default: none")
        ->allow_extra_args(false);
    app.add_option("--size", o.size, "pixels of the window as WxH; default: 1280x720, of --play 960x540");
    app.add_option("-o,--output", o.output,
                   "folder of screenshots, probe tables and recorded walks; default: that of the scene");
    app.add_option("--device", o.walk.device.name, "part of the name of a Vulkan device; default: the fastest kind");
    app.add_option("--device-memory", o.device_memory_gb,
                   "GB of the device that scene and photons may take; default: what it has to give");
    app.add_option("--rays", o.rays, lw::rays_help)->check(CLI::IsMember(lw::rays_names))->capture_default_str();
    app.add_option("--play", o.play.path, "recorded walk (.json) to replay without a window; default: a window");
    app.add_option("--frames", o.play.frames,
                   "with --play: folder for a PNG of every frame; default: none are written");
    app.add_option("--timings", o.play.timings,
                   "with --play: CSV file to write, milliseconds of every frame and pass; default: none");
    app.add_option("--gather", o.gather, "with --play: " + lw::gather_mode_help())
        ->check(CLI::IsMember(lw::gather_mode_names()))
        ->capture_default_str();
    app.add_option(
           "--neighbours", o.play.gather.neighbours,
           "with --play: photons that the light at a point is estimated from, where it is estimated from photons")
        ->check(CLI::Range(1, 1000000))
        ->capture_default_str();
    app.add_option("--shadow-rays", o.play.gather.shadow_rays,
                   "with --play: shadow rays per pixel and glowing object; 0: none at all")
        ->check(CLI::Range(0, 1024))
        ->capture_default_str();
    app.add_option("--samples", o.play.samples, "with --play: views averaged per pixel")
        ->check(CLI::Range(1, 4096))
        ->capture_default_str();
    app.add_option("--divisor", o.play.divisor,
                   "with --play: light is computed at the width and height divided by this (1 to 4) and drawn at full "
                   "size; 0: as few pixels as keep a frame near 66 ms, as the window does in motion")
        ->check(CLI::Range(0, 4))
        ->capture_default_str();
    app.add_option("--exposure", o.play.exposure_ev, "with --play: EV100; default: follows the picture");
    app.add_flag("!--no-vsync", o.walk.vsync, "do not wait for the display between frames; default: wait");
    app.add_flag("--validation", o.walk.device.validation,
                 "run with the Vulkan validation layer; any message is an error");
}

void run(Options& o) {
    lw::WalkthroughSettings& walk = o.walk;
    walk.scene = o.scene;
    walk.device.memory_bytes = vk::DeviceSize(o.device_memory_gb * 1e9);
    walk.map = o.map.empty() ? lw::default_map_path(o.scene) : std::filesystem::path(o.map);
    walk.output = o.output.empty() ? walk.scene.parent_path() : std::filesystem::path(o.output);
    if (o.play.path.empty()) return lw::walk_in_window(walk);
    lw::PlaySettings& play = o.play;
    play.scene = walk.scene;
    play.map = walk.map;
    play.device = walk.device;
    play.ambiance = walk.ambiance;
    play.photometry = walk.photometry;
    if (!o.size.empty()) play.size = walk.size;
    play.gather.mode = lw::gather_mode_named(o.gather);
    lw::play(play);
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    CLI::App app("Walks through a glTF building in the light of its photon map: dim lamps, measure, compare.",
                 "lumenwalk");
    add_options(app, options);
    try {
        app.parse(argc, argv);
        options.walk.device.rays = lw::rays_named(options.rays);
        if (!options.size.empty()) {
            const lw::WantedSize size = lw::parse_picture_size(options.size, 16, 16384);
            if (size.width == 0) throw CLI::ValidationError("--size: must be WxH in pixels, from 16x16 to 16384x16384");
            options.walk.size = vk::Extent2D(size.width, size.height);
        }
        if (app.count("--device-memory") > 0 && !(options.device_memory_gb >= 0.001 && options.device_memory_gb <= 1e6))
            throw CLI::ValidationError("--device-memory: give a number from 0.001 to 1e6");
        if (options.play.exposure_ev && !(std::abs(*options.play.exposure_ev) <= 100))
            throw CLI::ValidationError("--exposure: give a number from -100 to 100");
        if (options.play.path.empty() && !(options.play.frames.empty() && options.play.timings.empty()))
            throw CLI::ValidationError("--frames and --timings: only with --play");
    } catch (const CLI::ParseError& wrong) {
        return app.exit(wrong) == 0 ? 0 : 2;
    }
    return lw::run_program("lumenwalk", [&] { run(options); });
}
