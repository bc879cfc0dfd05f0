#include "measure_options.h"

#include <cstdio>

#include "base/error.h"
#include "measure/task.h"
#include "scene/lamp_factors.h"
#include "shared_options.h"

namespace lw {
namespace {

std::string list_of_tasks() {
    std::string text = "Tasks (EN 12464-1: Em in lx, U0, edition, row or section):\n";
    for (const Task& task : known_tasks()) {
        char line[160];
        std::snprintf(line, sizeof line, "  %-19s %4g  %.1f  %d  %s\n", task.name.c_str(), task.illuminance,
                      task.uniformity, task.edition, task.what.c_str());
        text += line;
    }
    return text;
}

/// What is measured, in which light.
void add_subject(CLI::App& app, MeasureOptions& o) {
    app.add_option("scene", o.scene, "glTF 2.0 file, .gltf or .glb")->required();
    app.add_option("map", o.map, "photon map; default: SCENE.pmap beside the scene");
    app.add_option("--points", o.points,
                   "CSV file of rows name,x,y,z[,nx,ny,nz[,planar|cylindrical]]: places in metres, Y up, and the "
                   "direction they "
                   "face, up unless given; may be repeated")
        ->allow_extra_args(false);
    app.add_option("--grid", o.grids,
                   "\"NAME: X,Y,Z to X,Y,Z [facing=+y] [margin=M] [spacing=M] [kind=cylindrical] [task=TASK]\": a "
                   "rectangle across its direction, in metres; spacing after EN 12464-1 unless given; may be repeated")
        ->allow_extra_args(false);
    app.add_option("--surface", o.surfaces,
                   "\"OBJECT[: [facing=+y] [count=64] [task=TASK]]\": points spread evenly over an object's front "
                   "faces; may be repeated")
        ->allow_extra_args(false);
    app.add_option("--ambiance", o.ambiances,
                   "\"NAME\" of SCENE.ambiances.json, or \"NAME: LAMP=FACTOR, LAMP=FACTOR@KELVIN ...\"; may be "
                   "repeated; default: all lamps at 1")
        ->allow_extra_args(false);
    app.add_option(
           "--power", o.powers,
           "LIGHT=FACTOR, dims (below 1) or brightens a lamp; LIGHT=FACTOR@KELVIN gives it a colour temperature "
           "too, at the "
           "same light output; may be repeated; default: 1 for each lamp")
        ->allow_extra_args(false);
    app.add_option("--maintenance", o.survey.maintenance,
                   "maintenance factor: the part of the light that is left when lamps are old, 0.01 to 1")
        ->capture_default_str()
        ->check(finite_number(0.01, 1));
}

/// How exactly.
void add_effort(CLI::App& app, MeasureOptions& o) {
    app.add_option(
           "--error", o.error_percent,
           "percent: traces rays and bakes until half the 90 % interval of every sensor over 1 lx is below; starts "
           "from MAP if there is one; default: reads MAP once with --rays")
        ->check(finite_number(0.2, 100));
    app.add_option("--photons", o.photons, "bake this many photons in memory instead of reading MAP; default: read MAP")
        ->check(CLI::Range(uint64_t(1000), uint64_t(2'000'000'000)));
    app.add_option("--max-photons", o.survey.max_photons, "photons of the largest bake of --error")
        ->capture_default_str()
        ->check(CLI::Range(uint64_t(1000), uint64_t(2'000'000'000)));
    app.add_option("--save-map", o.saved_map,
                   "photon map to write what --photons or --error baked to; default: not written");
    app.add_option(
           "--reference", o.reference_paths,
           "paths to trace from every sensor in the first ambiance, to say how many intervals hold; default: none")
        ->check(CLI::Range(uint64_t(16), uint64_t(1'000'000'000)));
    app.add_option("--rays", o.survey.meter.rays,
                   "rays per sensor at least; more are traced where rays are most of the error")
        ->capture_default_str()
        ->check(CLI::Range(8u, 1u << 20));
}

void add_reports(CLI::App& app, MeasureOptions& o) {
    app.add_option("--csv", o.csv,
                   "file to write, one row per sensor and ambiance in lux, with the share of each lamp; default: none");
    app.add_option("--fields-csv", o.fields_csv,
                   "file to write, one row per grid or surface and ambiance, in lux; default: none");
    app.add_option("--report", o.report,
                   "HTML file to write: tables, plans with isolux lines, camera views; default: none");
    app.add_option("--camera", o.cameras,
                   "camera to show in the report in false colours; may be repeated; default: none")
        ->allow_extra_args(false);
}

void add_reflections(CLI::App& app, MeasureOptions& o) {
    app.add_option(
        "--reflections", o.reflections,
        "camera, or file of a recorded walk (.json), whose views are searched for bright reflections of lamps; "
        "needs no map; default: none");
    app.add_option("--reflections-step", o.reflections_step, "seconds between the views along a recorded walk")
        ->capture_default_str()
        ->check(finite_number(0.01, 3600));
    app.add_option("--reflections-csv", o.reflections_csv, "file to write, one row per reflection; default: none");
    app.add_option("--min-luminance", o.limits.luminance, "cd/m2: reflections of less luminance are not reported")
        ->capture_default_str()
        ->check(finite_number(0, 1e9));
    app.add_option("--min-ratio", o.limits.ratio,
                   "reflections of a smaller ratio to the luminance of their surroundings are not reported")
        ->capture_default_str()
        ->check(finite_number(0, 1e9));
    app.add_option("--min-solid-angle", o.limits.solid_angle, "sr: smaller reflections are not reported")
        ->capture_default_str()
        ->check(finite_number(0, 12.6));
}

}  // namespace

void add_options(CLI::App& app, MeasureOptions& o) {
    add_subject(app, o);
    add_effort(app, o);
    add_reports(app, o);
    add_reflections(app, o);
    add_seed(app, o.survey.meter.seed);
    add_photometry(app, o.photometry);
    add_threads(app, o.threads);
    app.footer(list_of_tasks());
}

std::string misuse_of(const MeasureOptions& o) {
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

void check_is_new(const char* option, const std::string& name, std::set<std::string>& names) {
    if (!names.insert(name).second) throw Error(std::string(option) + " \"" + name + "\": there are two of this name");
}

std::vector<AmbianceFactors> ambiances_of(const MeasureOptions& o, const Scene& scene) {
    std::vector<AmbianceFactors> ambiances;
    if (o.ambiances.empty() || !o.powers.empty())
        ambiances.push_back({o.powers.empty() ? "all" : "powers", parse_factors(scene, o.powers)});
    std::set<std::string> names;
    for (const std::string& text : o.ambiances) {
        ambiances.push_back(parse_ambiance(text, scene));
        check_is_new("--ambiance", ambiances.back().name, names);
    }
    return ambiances;
}

}  // namespace lw
