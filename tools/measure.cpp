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
#include "maps/bake_memory.h"
#include "maps/build.h"
#include "measure/grid.h"
#include "measure/reflections.h"
#include "measure/report.h"
#include "measure/survey.h"
#include "measure/table.h"
#include "number_option.h"
#include "photometry/photometry.h"
#include "photons/shoot.h"
#include "scene/camera.h"
#include "scene/lamp_factors.h"
#include "scene/load_scene.h"
#include "scene/recorded_path.h"

namespace {

constexpr uint64_t photons_to_start_with = 200'000;

struct Options {
    std::string scene, map, saved_map, csv, fields_csv, report, reflections, reflections_csv;
    std::vector<std::string> points, grids, surfaces, photometry, powers, ambiances, cameras;
    double error_percent = 0, reflections_step = 1;
    uint64_t photons = 0, reference_paths = 0;
    unsigned threads = 0;
    lw::SurveySettings survey;
    lw::ReflectionLimits limits;
    bool has_sensors() const { return !points.empty() || !grids.empty() || !surfaces.empty(); }
};

std::string misuse_of(const Options& o) {
    if (!o.has_sensors() && o.reflections.empty())
        return "say what to measure: --points, --grid, --surface or --reflections";
    if (!o.reflections_csv.empty() && o.reflections.empty()) return "--reflections-csv: needs --reflections CAMERA";
    if (!o.reflections.empty() && o.ambiances.size() > 1) return "--reflections: takes one --ambiance";
    if (o.photons > 0 && !o.map.empty()) return "--photons bakes, so it takes no MAP; --save-map FILE keeps the bake";
    if (!o.saved_map.empty() && o.photons == 0 && o.error_percent == 0)
        return "--save-map: needs --photons or --error, which bake";
    if (!o.has_sensors() && (o.error_percent > 0 || !o.csv.empty() || !o.report.empty()))
        return "--error, --csv and --report: say what to measure: --points, --grid or --surface";
    for (const std::string& power : o.powers)
        if (power.find('=') == std::string::npos) return "--power: must be LIGHT=FACTOR";
    return "";
}

/// The map to read: the file, or a bake in memory. --error may start without either: it bakes until it is reached.
lw::PhotonMap map_of(const Options& o, const lw::Scene& scene, const lw::RayCaster& caster) {
    const std::filesystem::path path = o.map.empty() ? lw::default_map_path(o.scene) : std::filesystem::path(o.map);
    const bool starts_anew = o.error_percent > 0 && o.map.empty() && !std::filesystem::exists(path);
    if (o.photons == 0 && !starts_anew) return lw::load_photon_map(path, scene);
    lw::BakeSettings settings;
    settings.photons = o.photons > 0 ? o.photons : photons_to_start_with;
    lw::check_bake_fits(scene, settings, lw::available_memory());
    return lw::build_photon_map(scene, caster, lw::shoot_photons(scene, caster, {settings.photons, settings.seed}),
                                settings);
}

/// Refuses a second set of results that could not be told from the first.
void check_is_new(const char* option, const std::string& name, std::set<std::string>& names) {
    if (!names.insert(name).second)
        throw lw::Error(std::string(option) + " \"" + name + "\": there are two of this name");
}

std::vector<lw::SensorSet> sets_of(const Options& o, const lw::Scene& scene) {
    std::vector<lw::SensorSet> sets;
    std::set<std::string> names;
    for (const std::string& path : o.points) sets.push_back(lw::read_points(path, scene));
    for (const std::string& text : o.grids) {
        sets.push_back(lw::make_grid(lw::parse_grid(text), scene));
        check_is_new("--grid", sets.back().name, names);
    }
    for (const std::string& text : o.surfaces) sets.push_back(lw::make_surface(text, scene));
    return sets;
}

std::vector<lw::PowerSetting> ambiances_of(const Options& o, const lw::Scene& scene) {
    std::vector<lw::PowerSetting> ambiances;
    if (o.ambiances.empty() || !o.powers.empty())
        ambiances.push_back({o.powers.empty() ? "all" : "powers", lw::parse_powers(scene, o.powers)});
    std::set<std::string> names;
    for (const std::string& text : o.ambiances) {
        ambiances.push_back(lw::parse_ambiance(text, scene));
        check_is_new("--ambiance", ambiances.back().name, names);
    }
    return ambiances;
}

void write_text(const std::string& path, const std::string& text) {
    if (path.empty()) return;
    lw::ReplacedFile file(path);
    file.stream() << text;
    file.commit();
}

/// Refuses outputs that would take the place of an input or of each other. A map may be replaced by a better one.
void check_outputs(const Options& o, const lw::Scene& scene) {
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
void write_files(const Options& o, const lw::Survey& survey, const lw::Scene& scene, const lw::RayCaster& caster) {
    if (!o.saved_map.empty()) lw::save_photon_map(o.saved_map, survey.map);
    write_text(o.csv, lw::sensors_as_csv(survey, scene));
    write_text(o.fields_csv, lw::fields_as_csv(survey));
    if (!o.report.empty()) write_text(o.report, lw::report_as_html(survey, scene, caster, o.cameras));
}

/// Says how many photons were read, and what became of a bake that was made.
void tell_photons(const Options& o, const lw::Survey& survey) {
    const bool baked = survey.bakes > 0 || o.photons > 0;
    std::printf("%.4g million photons%s\n", 1e-6 * double(survey.map.stored_photons),
                survey.bakes > 0 ? ", baked for the error asked for"
                : baked          ? ", baked in memory"
                                 : "");
    if (o.saved_map.empty() && survey.bakes > 0) std::printf("this bake is not kept; --save-map FILE writes it\n");
}

void print_fields(const Options& o, const lw::Survey& survey) {
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

/// The cameras in which reflections are looked for: one of the scene, or those along a recorded walk.
std::vector<lw::Camera> reflection_views(const Options& o, const lw::Scene& scene) {
    if (std::filesystem::path(o.reflections).extension() != ".json") return {lw::find_camera(scene, o.reflections)};
    const lw::Path path = lw::load_path(o.reflections);
    std::vector<lw::Camera> views;
    for (int i = 0; i * o.reflections_step <= path.seconds() + 1e-9; ++i) {
        views.push_back(lw::camera_on(path, i * o.reflections_step, scene));
        char name[32];
        std::snprintf(name, sizeof name, "%g s", i * o.reflections_step);
        views.back().name = name;
    }
    return views;
}

void print_reflections(const Options& o, const lw::Scene& scene, const std::string& view, const std::string& powers,
                       const lw::ReflectionReport& report) {
    std::printf("camera %s, %s: %zu reflections over %g cd/m2, %g times their surroundings and %g sr\n", view.c_str(),
                powers.c_str(), report.found.size(), o.limits.luminance, o.limits.ratio, o.limits.solid_angle);
    for (const lw::Reflection& found : report.found)
        std::printf("  %s; %.2g sr, position index %.1f, at pixel %.0f, %.0f of %dx%d\n",
                    lw::describe(scene, found).c_str(), found.solid_angle, found.position_index, double(found.x),
                    double(found.y), report.width, report.height);
    std::printf("UGR %s, of the lamps alone %s; background %.3g cd/m2\n", lw::rating_text(report.ugr).c_str(),
                lw::rating_text(report.ugr_lamps).c_str(), report.background);
}

/// Bright reflections of lamps in one view or along a walk, traced without photons.
void report_reflections(const Options& o, const lw::Scene& scene, const lw::RayCaster& caster) {
    const lw::PowerSetting powers = ambiances_of(o, scene).back();
    const std::vector<lw::vec3> weights = lw::light_powers(scene, powers.factors);
    lw::ReflectionSettings settings;
    settings.limits = o.limits;
    settings.seed = o.survey.meter.seed;
    std::vector<lw::ViewedReflections> views;
    for (const lw::Camera& camera : reflection_views(o, scene)) {
        views.push_back({camera.name, lw::find_reflections(scene, caster, camera, weights, settings)});
        print_reflections(o, scene, camera.name, powers.name, views.back().report);
    }
    if (o.reflections_csv.empty()) return;
    if (views.size() == 1)
        lw::write_reflections(o.reflections_csv, scene, views[0].report);
    else
        lw::write_reflections(o.reflections_csv, scene, views);
    std::printf("wrote %s\n", lw::one_line(o.reflections_csv).c_str());
}

void measure(Options& o) {
    const lw::ThreadLimit limit(o.threads);
    o.survey.error = o.error_percent / 100;
    const lw::Scene scene = lw::load_scene(o.scene, o.photometry);
    for (const std::string& warning : scene.warnings) std::fprintf(stderr, "warning: %s\n", warning.c_str());
    std::vector<lw::SensorSet> sets = sets_of(o, scene);
    std::vector<lw::PowerSetting> ambiances = ambiances_of(o, scene);
    check_outputs(o, scene);
    for (const std::string& camera : o.cameras) lw::find_camera(scene, camera);
    const lw::RayCaster caster(scene);
    if (!o.reflections.empty()) report_reflections(o, scene, caster);
    if (!o.has_sensors()) return;
    lw::Survey survey =
        lw::make_survey(scene, caster, map_of(o, scene, caster), std::move(sets), std::move(ambiances), o.survey);
    lw::add_pins(scene, caster, survey);
    if (o.reference_paths > 0) lw::trace_survey(scene, caster, o.reference_paths, o.survey.meter.seed, survey);
    for (const std::string& warning : survey.warnings) std::fprintf(stderr, "warning: %s\n", warning.c_str());
    write_files(o, survey, scene, caster);
    print_fields(o, survey);
}

std::string list_of_tasks() {
    std::string text = "Tasks (EN 12464-1: Em in lx, U0, edition, row or section):\n";
    for (const lw::Task& task : lw::known_tasks()) {
        char line[160];
        std::snprintf(line, sizeof line, "  %-19s %4g  %.1f  %d  %s\n", task.name.c_str(), task.illuminance,
                      task.uniformity, task.edition, task.what.c_str());
        text += line;
    }
    return text;
}

/// What is measured, in which light.
void add_subject(CLI::App& app, Options& o) {
    app.add_option("scene", o.scene, "glTF 2.0 file, .gltf or .glb")->required();
    app.add_option("map", o.map, "photon map (default: beside the scene, .pmap)");
    app.add_option("--points", o.points, "CSV file of rows name,x,y,z[,nx,ny,nz[,planar|cylindrical]] in metres, Y up")
        ->allow_extra_args(false);
    app.add_option("--grid", o.grids,
                   "\"NAME: X,Y,Z to X,Y,Z [facing=+y] [margin=M] [spacing=M] [kind=cylindrical] [task=TASK]\": a "
                   "rectangle across its direction; spacing after EN 12464-1 unless given; metres")
        ->allow_extra_args(false);
    app.add_option(
           "--surface", o.surfaces,
           "\"OBJECT[: [facing=+y] [count=64] [task=TASK]]\": points spread evenly over an object's front faces")
        ->allow_extra_args(false);
    app.add_option(
           "--ambiance", o.ambiances,
           "\"NAME\" of SCENE.ambiances.json, or \"NAME: LAMP=FACTOR, LAMP=FACTOR@KELVIN ...\"; may be repeated")
        ->allow_extra_args(false);
    app.add_option(
           "--power", o.powers,
           "LIGHT=FACTOR, dims (< 1) or brightens a lamp; LIGHT=FACTOR@KELVIN gives it a colour temperature too, "
           "at the same light output; may be repeated")
        ->allow_extra_args(false);
    app.add_option("--maintenance", o.survey.maintenance, "maintenance factor: part of the light that is left")
        ->capture_default_str()
        ->check(lw::finite_number(0.01, 1));
}

/// How exactly.
void add_effort(CLI::App& app, Options& o) {
    app.add_option(
           "--error", o.error_percent,
           "percent: traces rays and bakes until half the 90 % interval of every sensor over 1 lx is below; starts "
           "from MAP if there is one")
        ->check(lw::finite_number(0.2, 100));
    app.add_option("--photons", o.photons, "bake this many photons in memory instead of reading MAP")
        ->check(CLI::Range(uint64_t(1000), uint64_t(2'000'000'000)));
    app.add_option("--most-photons", o.survey.max_photons, "largest bake of --error")
        ->capture_default_str()
        ->check(CLI::Range(uint64_t(1000), uint64_t(2'000'000'000)));
    app.add_option("--save-map", o.saved_map, "photon map to write what --photons or --error baked to (SCENE.pmap)");
    app.add_option("--reference", o.reference_paths,
                   "path trace every sensor with so many paths in the first ambiance, and say how many intervals hold")
        ->check(CLI::Range(uint64_t(16), uint64_t(1'000'000'000)));
    app.add_option("--rays", o.survey.meter.rays, "least rays per sensor; more are traced where they are the error")
        ->capture_default_str()
        ->check(CLI::Range(8u, 1u << 20));
}

void add_reports(CLI::App& app, Options& o) {
    app.add_option("--csv", o.csv, "file of one row per sensor and ambiance, with the share of each lamp");
    app.add_option("--fields-csv", o.fields_csv, "file of one row per grid or surface and ambiance");
    app.add_option("--report", o.report, "self-contained HTML report: tables, plans with isolux lines, camera views");
    app.add_option("--camera", o.cameras, "camera to show in the report in false colours; may be repeated")
        ->allow_extra_args(false);
}

void add_reflections(CLI::App& app, Options& o) {
    app.add_option(
        "--reflections", o.reflections,
        "camera, or file of a recorded walk (.json), whose views are searched for bright reflections of lamps; "
        "needs no map");
    app.add_option("--reflections-step", o.reflections_step, "seconds between the views along a recorded walk")
        ->capture_default_str()
        ->check(lw::finite_number(0.01, 3600));
    app.add_option("--reflections-csv", o.reflections_csv, "file of one row per reflection");
    app.add_option("--least-luminance", o.limits.luminance, "cd/m2 of the mirrored lamp, below which none is reported")
        ->capture_default_str()
        ->check(lw::finite_number(0, 1e9));
    app.add_option("--least-ratio", o.limits.ratio, "luminance of the reflection over that of its surroundings")
        ->capture_default_str()
        ->check(lw::finite_number(0, 1e9));
    app.add_option("--least-solid-angle", o.limits.solid_angle, "sr of a reflection")
        ->capture_default_str()
        ->check(lw::finite_number(0, 12.6));
}

void add_options(CLI::App& app, Options& o) {
    add_subject(app, o);
    add_effort(app, o);
    add_reports(app, o);
    add_reflections(app, o);
    app.add_option("--seed", o.survey.meter.seed, "seed of the random numbers")
        ->check(lw::whole_number())
        ->capture_default_str();
    app.add_option("--ies", o.photometry,
                   "LAMP=FILE, gives a point or spot lamp the distribution of an IES LM-63 or EULUMDAT (.ldt) file; "
                   "the same for bake and all "
                   "programs that read the map; may be repeated")
        ->allow_extra_args(false);
    app.add_option("--threads", o.threads, "worker threads (0: all cores)")
        ->capture_default_str()
        ->check(CLI::Range(0u, 4096u));
    app.footer(list_of_tasks());
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    CLI::App app{"Measures illuminance in lux at points, on grids and on objects of a baked glTF building."};
    add_options(app, options);
    try {
        app.parse(argc, argv);
        const std::string misuse = misuse_of(options);
        if (!misuse.empty()) throw CLI::ValidationError(misuse);
    } catch (const CLI::ParseError& e) {
        return app.exit(e) ? 2 : 0;
    }
    return lw::run_program("lumenwalk-measure", [&] { measure(options); });
}
