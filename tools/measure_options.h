// The options of lumenwalk-measure, and the values that more than one part of it makes of them.
#pragma once
#include <CLI/CLI.hpp>
#include <set>

#include "measure/reflections.h"
#include "measure/survey.h"

namespace lw {

struct MeasureOptions {
    std::string scene, map, saved_map, csv, fields_csv, report, reflections, reflections_csv;
    std::vector<std::string> points, grids, surfaces, photometry, powers, ambiances, cameras;
    double error_percent = 0, reflections_step = 1;
    uint64_t photons = 0, reference_paths = 0;
    unsigned threads = 0;
    SurveySettings survey;
    ReflectionLimits limits;
    bool has_sensors() const { return !points.empty() || !grids.empty() || !surfaces.empty(); }
};

void add_options(CLI::App& app, MeasureOptions& options);

/// What is wrong with options that parse, or "".
std::string misuse_of(const MeasureOptions& options);

/// Refuses a second set of results that could not be told from the first.
void check_is_new(const char* option, const std::string& name, std::set<std::string>& names);

/// Those of --ambiance and --power; the lamps as in the file without either.
std::vector<AmbianceFactors> ambiances_of(const MeasureOptions& options, const Scene& scene);

/// Bright reflections of lamps in one view or along a walk (--reflections), traced without photons.
void report_reflections(const MeasureOptions& options, const Scene& scene, const RayCaster& caster);

}  // namespace lw
