// lumenwalk-measure: illuminance at points, on calculation grids and on objects, with 90 % intervals.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <set>

#include "base/error.h"
#include "base/memory.h"
#include "base/one_line.h"
#include "base/parallel.h"
#include "base/program.h"
#include "base/progress.h"
#include "base/replaced_file.h"
#include "file/map_file.h"
#include "maps/bake.h"
#include "maps/bake_memory.h"
#include "measure/grid.h"
#include "measure/report.h"
#include "measure/survey.h"
#include "measure/table.h"
#include "measure_options.h"
#include "photometry/photometry.h"
#include "scene/camera.h"
#include "scene/load_scene.h"

namespace {

constexpr uint64_t photons_to_start_with = 200'000;

/// The map to read: the file, or a bake in memory. --error may start without either: it bakes until it is reached.
lw::PhotonMap map_of(const lw::MeasureOptions& o, const lw::Scene& scene, const lw::RayCaster& caster) {
    const std::filesystem::path path = o.map.empty() ? lw::default_map_path(o.scene) : std::filesystem::path(o.map);
    const bool starts_anew = o.error_percent > 0 && o.map.empty() && !std::filesystem::exists(path);
    if (o.photons == 0 && !starts_anew) return lw::load_photon_map(path, scene);
    lw::BakeSettings settings;
    settings.photons = o.photons > 0 ? o.photons : photons_to_start_with;
    lw::check_bake_fits(scene, caster, settings, lw::available_memory());
    return lw::bake(scene, caster, settings);
}

std::vector<lw::SensorSet> sets_of(const lw::MeasureOptions& o, const lw::Scene& scene) {
    std::vector<lw::SensorSet> sets;
    std::set<std::string> names;
    for (const std::string& path : o.points) sets.push_back(lw::read_points(path, scene));
    for (const std::string& text : o.grids) {
        sets.push_back(lw::make_grid(lw::parse_grid(text), scene));
        lw::check_is_new("--grid", sets.back().name, names);
    }
    for (const std::string& text : o.surfaces) sets.push_back(lw::make_surface(text, scene));
    return sets;
}

void write_text(const std::string& path, const std::string& text) {
    if (path.empty()) return;
    lw::ReplacedFile file(path);
    file.stream() << text;
    file.commit();
}

/// Refuses outputs that would take the place of an input or of each other. A map may be replaced by a better one.
void check_outputs(const lw::MeasureOptions& o, const lw::Scene& scene) {
    std::vector<std::filesystem::path> inputs = scene.files;
    inputs.insert(inputs.end(), o.points.begin(), o.points.end());
    if (!o.reflections.empty()) inputs.emplace_back(o.reflections);  // or the name of a camera
    if (!o.saved_map.empty()) lw::check_can_create(o.saved_map, inputs);
    inputs.push_back(o.map.empty() ? lw::default_map_path(o.scene) : std::filesystem::path(o.map));
    const std::filesystem::path tables[] = {o.csv, o.fields_csv, o.report, o.reflections_csv};
    for (const std::filesystem::path& table : tables)
        if (!table.empty()) lw::check_can_create(table, inputs);
    const std::filesystem::path all[] = {o.csv, o.fields_csv, o.report, o.reflections_csv, o.saved_map};
    lw::check_different(all);
}

/// Before anything is printed, which whoever reads it may end (| head).
void write_files(const lw::MeasureOptions& o, const lw::Survey& survey, const lw::Scene& scene,
                 const lw::RayCaster& caster) {
    if (!o.saved_map.empty()) lw::save_photon_map(o.saved_map, survey.map);
    write_text(o.csv, lw::sensors_as_csv(survey, scene));
    write_text(o.fields_csv, lw::fields_as_csv(survey));
    if (!o.report.empty()) write_text(o.report, lw::report_as_html(survey, scene, caster, o.cameras));
}

/// Says how many photons were read, and what became of a bake that was made.
void tell_photons(const lw::MeasureOptions& o, const lw::Survey& survey) {
    const bool baked = survey.bakes > 0 || o.photons > 0;
    std::printf("%.4g million photons%s\n", 1e-6 * double(survey.map.stored_photons),
                survey.bakes > 0 ? ", baked for the error asked for"
                : baked          ? ", baked in memory"
                                 : "");
    if (o.saved_map.empty() && survey.bakes > 0) std::printf("this bake is not kept; --save-map FILE writes it\n");
}

void print_fields(const lw::MeasureOptions& o, const lw::Survey& survey) {
    for (const std::string& text : o.photometry)
        std::printf("%s: %s\n", lw::one_line(text).c_str(),
                    lw::summary_of(lw::read_photometry(text.substr(text.find('=') + 1))).c_str());
    std::printf("%s", lw::fields_as_text(survey).c_str());
    std::printf("+- half the 90 %% interval; maintenance factor %g\n", double(survey.maintenance));
    if (o.reference_paths > 0) std::printf("%s", lw::agreement_as_text(survey).c_str());
    tell_photons(o, survey);
    for (const std::string& path : {o.saved_map, o.csv, o.fields_csv, o.report})
        if (!path.empty()) std::printf("wrote %s\n", lw::one_line(path).c_str());
}

void measure(lw::MeasureOptions& o) {
    const lw::ThreadLimit limit(o.threads);
    o.survey.error = o.error_percent / 100;
    const lw::Scene scene = lw::load_scene(o.scene, o.photometry);
    for (const std::string& warning : scene.warnings) std::fprintf(stderr, "warning: %s\n", warning.c_str());
    std::vector<lw::SensorSet> sets = sets_of(o, scene);
    std::vector<lw::AmbianceFactors> ambiances = lw::ambiances_of(o, scene);
    check_outputs(o, scene);
    for (const std::string& camera : o.cameras) lw::find_camera(scene, camera);
    const lw::RayCaster caster(scene);
    if (!o.reflections.empty()) lw::report_reflections(o, scene, caster);
    if (!o.has_sensors()) return;
    lw::Survey survey =
        lw::make_survey(scene, caster, map_of(o, scene, caster), std::move(sets), std::move(ambiances), o.survey);
    lw::add_pins(scene, caster, survey);
    if (o.reference_paths > 0) lw::trace_survey(scene, caster, o.reference_paths, o.survey.meter.seed, survey);
    for (const std::string& warning : survey.warnings) std::fprintf(stderr, "warning: %s\n", warning.c_str());
    write_files(o, survey, scene, caster);
    print_fields(o, survey);
}

}  // namespace

int main(int argc, char** argv) {
    lw::MeasureOptions options;
    CLI::App app{"Measures illuminance in lux at points, on grids and on objects of a baked glTF building."};
    lw::add_options(app, options);
    try {
        app.parse(argc, argv);
        const std::string misuse = lw::misuse_of(options);
        if (!misuse.empty()) throw CLI::ValidationError(misuse);
    } catch (const CLI::ParseError& e) {
        return app.exit(e) ? 2 : 0;
    }
    return lw::run_program("lumenwalk-measure", [&] { measure(options); });
}
