// lumenwalk-reference: the unbiased path-traced picture that the photon maps are measured against.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>

#include "base/error.h"
#include "base/memory.h"
#include "base/one_line.h"
#include "base/parallel.h"
#include "base/program.h"
#include "base/replaced_file.h"
#include "daylight_options.h"
#include "image/exr.h"
#include "image/light_check.h"
#include "image/picture_size.h"
#include "scene/ambiance.h"
#include "scene/camera.h"
#include "scene/lamp_factors.h"
#include "scene/load_scene.h"
#include "shared_options.h"
#include "trace/reference.h"

namespace {

struct Options {
    std::string scene, output, camera, ambiance, size = "960x540";
    std::vector<std::string> powers, photometry;
    unsigned threads = 0;
    lw::ReferenceSettings settings;
    lw::DaylightOptions daylight;
};

lw::WantedSize size_of(const Options& options) { return lw::parse_picture_size(options.size, 1, 16384); }

/// What is wrong with the command line, or "".
std::string misuse_of(const Options& options) {
    if (std::filesystem::path(options.output).extension() != ".exr") return "--output: must end in .exr";
    if (size_of(options).width == 0) return "--size: must be WxH in pixels, at most 16384 each";
    for (const std::string& power : options.powers)
        if (power.find('=') == std::string::npos) return "--power: must be LIGHT=FACTOR";
    return lw::misuse_of(options.daylight);
}

void render(Options& options) {
    const lw::ThreadLimit limit(options.threads);
    const lw::WantedSize size = size_of(options);
    options.settings.width = int(size.width), options.settings.height = int(size.height);
    if (options.settings.samples == 0)
        options.settings.samples = options.settings.seconds > 0 || options.settings.error > 0 ? 1u << 20 : 256;
    const std::unique_ptr<const lw::Daylight> around = lw::make_daylight(options.daylight);
    options.settings.daylight = around.get();
    lw::Scene scene = lw::load_scene(options.scene, options.photometry, {.needs_lamp = !around});
    if (!options.daylight.weather.empty()) scene.files.push_back(options.daylight.weather);
    for (const std::string& warning : scene.warnings) std::fprintf(stderr, "warning: %s\n", warning.c_str());
    lw::check_can_create(options.output, scene.files);
    lw::check_reference_fits(options.settings, lw::available_memory());
    const lw::RayCaster caster(scene);
    const std::vector<lw::vec3> powers =
        lw::lamp_powers(scene, lw::chosen_factors(scene, options.ambiance, options.powers));
    const lw::Reference reference =
        lw::render_reference(scene, caster, lw::find_camera(scene, options.camera), powers, options.settings);
    lw::check_is_light(reference.image);
    lw::write_exr(options.output, reference.image);
    std::printf("wrote %s: %llu samples per pixel, relative standard error %.4f\n",
                lw::one_line(options.output).c_str(), (unsigned long long)reference.samples, reference.relative_error);
    if (reference.caustic_radius > 0)
        std::printf("caustics are traced from the lamps and blurred over %.2g m\n", double(reference.caustic_radius));
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    options.settings.samples = 0;
    CLI::App app{
        "Renders a glTF building by unbiased path tracing on the CPU: radiance in cd/m2, illuminance in lux, standard "
        "errors."};
    app.add_option("scene", options.scene, "glTF 2.0 file, .gltf or .glb")->required();
    app.add_option("-o,--output", options.output, "EXR picture to write (cd/m2, lux)")->required();
    app.add_option("--camera", options.camera, "name of a camera of the scene; default: the first");
    app.add_option("--size", options.size, "pixels as WxH")->capture_default_str();
    app.add_option("--samples", options.settings.samples,
                   "paths per pixel; default: 256, without limit when --time or --error is given")
        ->check(CLI::Range(1, 1 << 30));
    app.add_option("--time", options.settings.seconds, "stop after this many seconds; default: no limit")
        ->check(lw::finite_number(1e-3, 1e9));
    app.add_option("--error", options.settings.error,
                   "stop at this standard error as a part of the mean of the picture, such as 0.01; default: no limit")
        ->check(lw::finite_number(1e-6, 1e3));
    lw::add_power(app, options.powers);
    app.add_flag("!--no-illuminance", options.settings.illuminance,
                 "leave out the illuminance channel, which takes half the time; default: it is written");
    app.add_option("--caustic-paths", options.settings.caustic_paths,
                   "paths from the lamps per sample, for light of lamps by way of mirrors and glass; 0: none")
        ->capture_default_str()
        ->check(CLI::Range(uint64_t(0), uint64_t(1) << 32));
    app.add_option("--caustic-radius", options.settings.caustic_radius,
                   "metres over which the first sample blurs such light, later ones less; 0: 0.4 % of the diagonal of "
                   "the scene")
        ->capture_default_str()
        ->check(lw::finite_number(0, 1e6));
    lw::add_daylight(app, options.daylight);
    lw::add_ambiance(app, options.ambiance);
    lw::add_seed(app, options.settings.seed);
    lw::add_photometry(app, options.photometry);
    lw::add_threads(app, options.threads);
    try {
        app.parse(argc, argv);
        const std::string misuse = misuse_of(options);
        if (!misuse.empty()) throw CLI::ValidationError(misuse);
    } catch (const CLI::ParseError& e) {
        return app.exit(e) ? 2 : 0;
    }
    return lw::run_program("lumenwalk-reference", [&] { render(options); });
}
