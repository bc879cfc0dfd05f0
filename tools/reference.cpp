// lumenwalk-reference: the unbiased path-traced picture, or illuminance at points, that the photon maps are measured
// against.
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
#include "measure/grid.h"
#include "measure/table.h"
#include "measure/traced.h"
#include "scene/ambiance.h"
#include "scene/camera.h"
#include "scene/lamp_factors.h"
#include "scene/load_scene.h"
#include "shared_options.h"
#include "trace/reference.h"

namespace {

struct Options {
    std::string scene, output, camera, ambiance, size = "960x540", csv;
    std::vector<std::string> powers, photometry, points;
    uint64_t paths = 100'000;  // per point
    unsigned threads = 0;
    lw::ReferenceSettings settings;
    lw::DaylightOptions daylight;
};

lw::WantedSize size_of(const Options& options) { return lw::parse_picture_size(options.size, 1, 16384); }

/// What is wrong with the command line, or "".
std::string misuse_of(const Options& options) {
    if (options.output.empty() && options.points.empty()) return "--output: is needed, or --points";
    if (!options.output.empty() && std::filesystem::path(options.output).extension() != ".exr")
        return "--output: must end in .exr";
    if (!options.csv.empty() && options.points.empty()) return "--csv: needs --points";
    if (size_of(options).width == 0) return "--size: must be WxH in pixels, at most 16384 each";
    for (const std::string& power : options.powers)
        if (power.find('=') == std::string::npos) return "--power: must be LIGHT=FACTOR";
    return lw::misuse_of(options.daylight);
}

/// What is lit, and by what.
struct Subject {
    const lw::Scene& scene;
    const lw::RayCaster& caster;
    std::vector<lw::vec3> powers;
    const lw::Daylight* daylight;
};

void measure(const Options& options, const Subject& subject, const std::vector<lw::SensorSet>& sets) {
    std::string csv;
    for (const lw::SensorSet& set : sets) {
        const std::vector<lw::Traced> traced =
            lw::trace_sensors(subject.scene, subject.caster, subject.powers, set.sensors,
                              {options.paths, options.settings.seed, subject.daylight});
        csv += lw::traced_as_csv(set, traced, subject.scene);
        for (size_t i = 0; i < traced.size(); ++i)
            std::printf("%s %s: %.5g lx, standard error %.2g\n", lw::one_line(set.name).c_str(),
                        lw::one_line(lw::name_of_sensor(set, i)).c_str(), traced[i].lux, traced[i].standard_error);
    }
    if (options.csv.empty()) return;
    lw::ReplacedFile file(options.csv);
    file.stream() << lw::traced_heading() << csv;
    file.commit();
    std::printf("wrote %s\n", lw::one_line(options.csv).c_str());
}

void render(const Options& options, const Subject& subject) {
    lw::ReferenceSettings settings = options.settings;
    settings.daylight = subject.daylight;
    const lw::Reference reference = lw::render_reference(
        subject.scene, subject.caster, lw::find_camera(subject.scene, options.camera), subject.powers, settings);
    lw::check_is_light(reference.image);
    lw::write_exr(options.output, reference.image);
    std::printf("wrote %s: %llu samples per pixel, relative standard error %.4f\n",
                lw::one_line(options.output).c_str(), (unsigned long long)reference.samples, reference.relative_error);
    if (reference.caustic_radius > 0)
        std::printf("caustics are traced from the lamps and blurred over %.2g m\n", double(reference.caustic_radius));
}

/// Sets the size and the number of samples.
void complete(Options& options) {
    const lw::WantedSize size = size_of(options);
    options.settings.width = int(size.width), options.settings.height = int(size.height);
    if (options.settings.samples == 0)
        options.settings.samples = options.settings.seconds > 0 || options.settings.error > 0 ? 1u << 20 : 256;
}

/// Refuses outputs that cannot be written or would take the place of an input or of each other.
void check_outputs(const Options& options, const lw::Scene& scene) {
    std::vector<std::filesystem::path> inputs = scene.files;
    inputs.insert(inputs.end(), options.points.begin(), options.points.end());
    if (!options.daylight.weather.empty()) inputs.emplace_back(options.daylight.weather);
    const std::filesystem::path outputs[] = {options.output, options.csv};
    for (const std::filesystem::path& output : outputs)
        if (!output.empty()) lw::check_can_create(output, inputs);
    lw::check_different(outputs);
}

void trace(Options& options) {
    const lw::ThreadLimit limit(options.threads);
    complete(options);
    const std::unique_ptr<const lw::Daylight> around = lw::make_daylight(options.daylight);
    const lw::Scene scene = lw::load_scene(options.scene, options.photometry, {.needs_lamp = !around});
    for (const std::string& warning : scene.warnings) std::fprintf(stderr, "warning: %s\n", warning.c_str());
    check_outputs(options, scene);
    std::vector<lw::SensorSet> sets;
    for (const std::string& points : options.points) sets.push_back(lw::read_points(points, scene));
    if (!options.output.empty()) lw::check_reference_fits(options.settings, lw::available_memory());
    const lw::RayCaster caster(scene);
    const Subject subject{scene, caster,
                          lw::lamp_powers(scene, lw::chosen_factors(scene, options.ambiance, options.powers)),
                          around.get()};
    if (!sets.empty()) measure(options, subject, sets);
    if (!options.output.empty()) render(options, subject);
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    options.settings.samples = 0;
    CLI::App app{
        "Renders a glTF building, or measures it at points, by unbiased path tracing on the CPU: radiance in cd/m2, "
        "illuminance in lux, standard errors."};
    app.add_option("scene", options.scene, "glTF 2.0 file, .gltf or .glb")->required();
    app.add_option("-o,--output", options.output, "EXR picture to write (cd/m2, lux)");
    app.add_option("--points", options.points,
                   "CSV file of points at which to trace illuminance, as lumenwalk-measure reads them; may be repeated")
        ->allow_extra_args(false);
    app.add_option("--csv", options.csv, "CSV file to write the illuminance at --points to; default: not written");
    app.add_option("--paths", options.paths, "paths per point")
        ->capture_default_str()
        ->check(CLI::Range(uint64_t(16), uint64_t(1) << 40));
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
    return lw::run_program("lumenwalk-reference", [&] { trace(options); });
}
