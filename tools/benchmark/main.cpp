// lumenwalk-benchmark: what baking and gathering cost, each speed beside its error against the path tracer.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <thread>

#include "base/error.h"
#include "base/parallel.h"
#include "base/program.h"
#include "document.h"
#include "sections.h"
#include "tools/shared_options.h"

namespace {

const lw::Section sections[] = {
    {"knn", "Figure 6: time of the k nearest photons against photon count, four structures", lw::measure_knn},
    {"table1", "Table 1: global 3D kd-tree against the maps of triangles", lw::measure_table1},
    {"modes", "gather modes: milliseconds, candidates, bytes, errors", lw::measure_modes},
    {"dimming", "frames after a lamp was dimmed beside any other: milliseconds, error", lw::measure_dimming},
    {"convergence", "error against photons", lw::measure_convergence},
    {"scaling", "cost against photons, triangles, lights and pixels", lw::measure_scaling},
    {"equal-time", "the path tracer at equal time and at equal error", lw::measure_equal_time},
    {"features", "what many lamps, glossy materials and textures add", lw::measure_features},
    {"lobes", "a floor of several roughnesses, its lobe from photons or followed", lw::measure_lobes},
    {"gloss", "rooms of gloss, metal and glass", lw::measure_gloss},
    {"work", "what a frame reads, counted; milliseconds at 1 TB/s", lw::measure_work},
    {"bake", "seconds of the bake's phases, photon tracing against raw rays", lw::measure_bake},
    {"cie171", "analytic cases of CIE 171:2006: measured illuminance beside the formula", lw::measure_cie171},
};

struct Options {
    std::string device, rays = "fastest", scenes = "data";
    std::filesystem::path folder = "output/benchmark", document;
    std::vector<std::string> only;
    unsigned threads = 0;
    bool quick = false;
};

std::string list_of_sections() {
    std::string text = "Sections:\n";
    for (const lw::Section& section : sections)
        text += "  " + std::string(section.name) + std::string(12 - std::string(section.name).size(), ' ') +
                section.question + "\n";
    return text;
}

void add_options(CLI::App& app, Options& o) {
    std::vector<std::string> names;
    for (const lw::Section& section : sections) names.push_back(section.name);
    app.add_flag("--quick", o.quick, "fewer photons, pixels and samples: minutes on two cores");
    app.add_option("--only", o.only, "measure this section; may be repeated")->check(CLI::IsMember(names));
    app.add_option("--device", o.device, "part of the name of a Vulkan device; default: the fastest kind");
    app.add_option("--rays", o.rays, lw::rays_help)->check(CLI::IsMember(lw::rays_names))->capture_default_str();
    app.add_option("-o,--output", o.folder, "folder for benchmark.csv, benchmark.json, a CSV per table and references/")
        ->capture_default_str();
    app.add_option("--write", o.document,
                   "Markdown file that takes the tables of each section between its lines <!-- benchmark SECTION --> "
                   "and <!-- end of benchmark -->; docs/accuracy.md has them all");
    app.add_option("--scenes", o.scenes, "folder of cornell.gltf and apartment.glb")->capture_default_str();
    lw::add_threads(app, o.threads);
    app.footer(list_of_sections());
}

std::string processor_name() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
        if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
    return "unknown processor";
}

lw::Row conditions_of(const Options& o, const lw::Device& device) {
    const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
    return {{"processor", processor_name()},
            {"threads", o.threads ? o.threads : cores},
            {"device", device.name() + ", " + device.driver() + (device.ray_queries() ? ", ray queries" : "")},
            {"quick", o.quick}};
}

std::vector<lw::Section> wanted_sections(const Options& o) {
    std::vector<lw::Section> wanted;
    for (const lw::Section& section : sections)
        if (o.only.empty() || std::find(o.only.begin(), o.only.end(), section.name) != o.only.end())
            wanted.push_back(section);
    return wanted;
}

void check_document(const Options& o) {
    if (o.document.empty()) return;
    std::vector<std::string> names;
    for (const lw::Section& section : wanted_sections(o)) names.push_back(section.name);
    lw::check_places(o.document, names);
}

/// The tables of a section as Markdown, with the machine and the time they took.
std::string report_of(const std::vector<lw::Table>& tables, const lw::Row& conditions, double seconds) {
    std::string text = "Measured on " + conditions["processor"].get<std::string>() + ", " +
                       conditions["threads"].dump() + " threads, device " + conditions["device"].get<std::string>() +
                       (conditions["quick"].get<bool>() ? ", --quick" : "") + ", in " +
                       std::to_string(std::lround(seconds)) + " s.\n\n";
    for (const lw::Table& table : tables) text += lw::to_markdown(table) + "\n";
    return text;
}

/// Tables are written after each section, so that an interrupted run leaves what it measured.
void run(const Options& o) {
    check_document(o);
    const lw::ThreadLimit limit(o.threads);
    const lw::Device device({.name = o.device, .rays = lw::rays_named(o.rays)});
    std::filesystem::create_directories(o.folder);
    const lw::Bench bench{device, o.folder, o.scenes, o.quick};
    const lw::Row conditions = conditions_of(o, device);
    std::vector<lw::Table> tables;
    for (const lw::Section& section : wanted_sections(o)) {
        std::vector<lw::Table> measured;
        const lw::Cost cost = lw::cost_of([&] { measured = section.measure(bench); });
        const std::string report = report_of(measured, conditions, cost.seconds);
        std::printf("### %s: %s\n\n%s", section.name, section.question, report.c_str());
        std::fflush(stdout);
        tables.insert(tables.end(), measured.begin(), measured.end());
        lw::write_tables(o.folder, tables, conditions);
        if (!o.document.empty()) lw::replace_section(o.document, section.name, report);
    }
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    CLI::App app("Measures Lumenwalk: every speed beside its error against the reference, as tables, CSV and JSON.",
                 "lumenwalk-benchmark");
    add_options(app, options);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& wrong) {
        return app.exit(wrong) == 0 ? 0 : 2;
    }
    return lw::run_program("lumenwalk-benchmark", [&] { run(options); });
}
