#include "measure/report.h"

#include <algorithm>
#include <cmath>

#include "measure/html.h"
#include "measure/isolux.h"
#include "measure/table.h"
#include "measure/view.h"
#include "scene/camera.h"

namespace lw {
namespace {

constexpr float plan_band = 0.5f;  // m around a grid
constexpr int plan_width = 720, picture_width = 720, picture_height = 405;

constexpr const char* style = R"(<style>
body{font:14px/1.45 system-ui,sans-serif;max-width:78em;margin:2em auto;padding:0 1em;color:#1c1c22}
h1{font-size:1.6em}h2{margin-top:2em;border-bottom:1px solid #ccc}
table{border-collapse:collapse;margin:.8em 0}td,th{white-space:nowrap;padding:.25em .7em;border-bottom:1px solid #ddd;text-align:right}
td:first-child,th:first-child{text-align:left}.pass{color:#08702c;font-weight:600}.fail{color:#b00020;font-weight:600}
.undecided{color:#8a5a00;font-weight:600}.note{color:#555}.warning{background:#fff3d6;padding:.5em .8em;border-left:4px solid #e0a100}
svg.plan,img.view{display:block;width:100%;max-width:720px;background:#fff}
svg text{text-anchor:middle;dominant-baseline:central;fill:#111;paint-order:stroke;stroke:#ffffffa0;stroke-width:.22em}text.doubtful{fill:#b00020;font-style:italic}text.blocked{fill:#888;text-decoration:line-through}
.iso{fill:none;stroke:#000}.level{font-weight:700;paint-order:stroke;stroke:#fff;stroke-width:.3em;fill:#000}
.field{fill:none;stroke:#000;stroke-dasharray:.06 .06}
.legend{position:relative;height:2.6em;max-width:720px;margin:.4em 0}.bar{position:absolute;left:0;right:0;top:0;height:1em}
.tick{position:absolute;top:1.1em;transform:translateX(-50%);font-size:12px;white-space:nowrap}.unit{position:absolute;right:0;top:1.1em;font-size:12px}
</style>)";

std::string cell(const std::string& text) { return "<td>" + text + "</td>"; }

std::string lux_cell(Estimate e) {
    return cell(printed("%.4g <span class=note>&plusmn; %.2g</span>", e.value, e.half_width));
}

std::string verdict_cells(const MeasuredSet& measured, const Statistics& s) {
    if (measured.set.task.empty()) return cell("") + cell("") + cell("");
    const Task& task = find_task(measured.set.task);
    const std::string verdict = name_of(judge(s, task).both());
    return cell(escaped(task.name)) +
           cell(printed("%g lx, U0 %.2g (%d)", task.illuminance, task.uniformity, task.edition)) +
           cell("<span class=" + verdict + ">" + verdict + "</span>");
}

std::string table_of_fields(const Survey& survey, const AmbianceFactors& ambiance) {
    std::string text =
        "<table><tr><th>field<th>points<th>E<sub>avg</sub> lx<th>E<sub>min</sub><th>E<sub>max</sub><th>U<sub>0</sub>"
        "<th>U<sub>d</sub><th>doubtful<th>task<th>EN 12464-1<th>result</tr>\n";
    for (const MeasuredSet& measured : survey.sets) {
        const Statistics s = statistics_of(measured, ambiance, survey.maintenance);
        text += "<tr>" + cell(escaped(measured.set.name)) + cell(printed("%zu", s.count)) + lux_cell(s.average) +
                lux_cell(s.minimum) + lux_cell(s.maximum) +
                cell(printed("%.2f <span class=note>&plusmn; %.1g</span>", s.u0.value, s.u0.half_width)) +
                cell(printed("%.2f", s.ud.value)) + cell(printed("%zu", s.doubtful)) + verdict_cells(measured, s) +
                "</tr>\n";
    }
    return text + "</table>\n";
}

/// A lamp's factor as text: "0.5", or "0.9 0.5 0.2" when the channels differ.
std::string power_text(vec3 factor) {
    if (factor.x == factor.y && factor.y == factor.z) return printed("%.3g", double(factor.x));
    return printed("R %.2f G %.2f B %.2f", double(factor.x), double(factor.y), double(factor.z));
}

/// A table of the mean lux that each lamp brings to each field.
std::string table_of_lamps(const Survey& survey, const Scene& scene, const AmbianceFactors& ambiance) {
    std::string text = "<table><tr><th>lamp<th>power";
    for (const MeasuredSet& measured : survey.sets) text += "<th>" + escaped(measured.set.name) + " lx";
    text += "</tr>\n";
    for (size_t lamp = 0; lamp < scene.lights.size(); ++lamp) {
        const vec3 factor = ambiance.factors[lamp];
        text += "<tr>" + cell(escaped(scene.light_names[lamp])) + cell(power_text(factor));
        for (const MeasuredSet& measured : survey.sets) {
            double sum = 0, count = 0;
            for (const Reading& reading : measured.readings)
                if (!reading.blocked) sum += lux_of_lamp(reading, lamp, factor), count += 1;
            text += cell(printed("%.4g", count > 0 ? sum / count * double(survey.maintenance) : 0.0));
        }
        text += "</tr>\n";
    }
    return text + "</table>\n";
}

std::string table_of_points(const MeasuredSet& measured, const std::vector<Value>& values, const Scene& scene) {
    std::string text = "<table><tr><th>" + escaped(measured.set.name) + "<th>x<th>y<th>z<th>lx<th>remark</tr>\n";
    for (size_t i = 0; i < values.size(); ++i) {
        const glm::dvec3 at = glm::dvec3(measured.set.sensors[i].position) + scene.origin;
        text += "<tr>" + cell(escaped(name_of_sensor(measured.set, i))) + cell(printed("%.3f", at.x)) +
                cell(printed("%.3f", at.y)) + cell(printed("%.3f", at.z)) +
                lux_cell({values[i].lux, values[i].half_width}) + cell(escaped(values[i].doubt)) + "</tr>\n";
    }
    return text + "</table>\n";
}

/// The lowest and highest lux of the colour scale of a field, common to all ambiances.
std::pair<double, double> range_of(const MeasuredSet& measured, const Survey& survey) {
    double low = 1e30, high = 0;
    for (const AmbianceFactors& ambiance : survey.ambiances)
        for (const Value& value : values_of(measured, ambiance, survey.maintenance))
            low = std::min(low, value.lux), high = std::max(high, value.lux);
    high = std::max(high, 1e-6);
    return {std::clamp(low, high * 1e-2, high * 0.8), high};
}

/// A line on the place of a grid: number of points, the corner drawn at the top left, directions of columns and rows.
std::string note_of(const SensorSet& set, const Scene& scene) {
    const auto axis = [](vec3 v) { return v.x != 0 ? "x" : v.y != 0 ? "y" : "z"; };
    const GridShape& grid = set.grid;
    const glm::dvec3 corner = glm::dvec3(grid.corner) + scene.origin;
    return printed(
        "<p class=note>%u &times; %u points every %.3g &times; %.3g m%s; top left %.2f, %.2f, %.2f m, "
        "to the right +%s, down +%s</p>\n",
        grid.columns, grid.rows, double(length(grid.across)), double(length(grid.along)),
        set.sensors[0].response == Response::cylindrical ? ", cylindrical" : "", corner.x, corner.y, corner.z,
        axis(grid.across), axis(grid.along));
}

/// A table of the values that should not be trusted, with the reason.
std::string table_of_doubts(const Survey& survey, const AmbianceFactors& ambiance) {
    constexpr size_t most = 20;
    std::string rows;
    size_t count = 0;
    for (const MeasuredSet& measured : survey.sets) {
        const std::vector<Value> values = values_of(measured, ambiance, survey.maintenance);
        for (size_t i = 0; i < values.size(); ++i) {
            if (values[i].doubt.empty() || measured.readings[i].blocked || ++count > most) continue;
            rows += "<tr>" + cell(escaped(measured.set.name)) + cell(escaped(name_of_sensor(measured.set, i))) +
                    lux_cell({values[i].lux, values[i].half_width}) + cell(escaped(values[i].doubt)) + "</tr>\n";
        }
    }
    if (count == 0) return "";
    if (count > most) rows += printed("<tr><td>and %zu more, in the CSV</tr>\n", count - most);
    return "<h3>Values that should not be trusted</h3>\n<table><tr><th>field<th>sensor<th>lx<th>why</tr>\n" + rows +
           "</table>\n";
}

/// A table of how many intervals hold the path-traced value.
std::string table_of_agreement(const Survey& survey) {
    if (survey.sets.empty() || survey.sets[0].traced.empty()) return "";
    const AmbianceFactors& ambiance = survey.ambiances[0];
    std::string text =
        "<h3>Compared with path tracing</h3>\n<table><tr><th>field<th>sensors<th>intervals that hold"
        "<th>mean difference</tr>\n";
    for (const MeasuredSet& measured : survey.sets) {
        const Agreement a = agreement_of(measured, ambiance, survey.maintenance);
        text += "<tr>" + cell(escaped(measured.set.name)) + cell(printed("%zu", a.compared)) +
                cell(printed("%zu", a.inside)) + cell(printed("%+.2f %%", 100 * a.difference)) + "</tr>\n";
    }
    return text + "</table>\n";
}

std::string fields_of(const Survey& survey, const Scene& scene, const RayCaster& caster,
                      const AmbianceFactors& ambiance) {
    std::string text;
    for (const MeasuredSet& measured : survey.sets) {
        const std::vector<Value> values = values_of(measured, ambiance, survey.maintenance);
        if (measured.set.kind == SensorSet::Kind::points) text += table_of_points(measured, values, scene);
        if (measured.set.kind != SensorSet::Kind::grid) continue;
        const auto [low, high] = range_of(measured, survey);
        text += "<h3>" + escaped(measured.set.name) + "</h3>\n" + note_of(measured.set, scene);
        text += grid_drawing(measured, values, plan_view(scene, caster, measured.set, plan_band, plan_width), plan_band,
                             low, high) +
                legend(low, high);
    }
    return text;
}

std::string pictures_of(const Survey& survey, const Scene& scene, const RayCaster& caster,
                        const AmbianceFactors& ambiance, const std::vector<std::string>& cameras) {
    std::string text;
    for (const std::string& name : cameras) {
        std::vector<double> lux = seen_illuminance(scene, caster, survey.map, find_camera(scene, name), ambiance,
                                                   picture_width, picture_height);
        for (double& value : lux) value *= double(survey.maintenance);
        const auto [low, high] = range_of_picture(lux);
        Rgb8Image image{picture_width, picture_height, {}};
        for (const double value : lux)
            for (const uint8_t code : value > 0 ? false_color(log_share(value, low, high)) : std::array<uint8_t, 3>{})
                image.rgb.push_back(code);
        text += "<h3>Camera " + escaped(name) +
                "</h3>\n<img class=view alt=\"illuminance of what the camera sees\" src=\"" + data_address(image) +
                "\">\n" + legend(low, high);
    }
    return text;
}

}  // namespace

std::string report_as_html(const Survey& survey, const Scene& scene, const RayCaster& caster,
                           const std::vector<std::string>& cameras) {
    const std::string name = escaped(scene.path.filename().string());
    std::string text =
        "<!DOCTYPE html>\n<html lang=en><meta charset=utf-8><meta name=viewport content=\"width=device-width\">"
        "<title>Illuminance of " +
        name + "</title>\n" + std::string(style) + "\n<h1>Illuminance of " + name + "</h1>\n";
    text += printed(
        "<p>%.3g million photons, maintenance factor %.3g. &plusmn; is half the 90&nbsp;%% interval of a value. "
        "Numbers in red italics should not be trusted, for the reasons given; points inside objects are crossed out "
        "and not counted. Plans show the model below the grid; metres, Y up.</p>\n",
        1e-6 * double(survey.map.stored_photons), double(survey.maintenance));
    for (const std::string& warning : survey.warnings) text += "<p class=warning>" + escaped(warning) + "</p>\n";
    for (const AmbianceFactors& ambiance : survey.ambiances) {
        text += "<h2>Ambiance " + escaped(ambiance.name) + "</h2>\n" + table_of_fields(survey, ambiance);
        text += fields_of(survey, scene, caster, ambiance);
        text += pictures_of(survey, scene, caster, ambiance, cameras);
        text += "<h3>Share of each lamp, mean of the field</h3>\n" + table_of_lamps(survey, scene, ambiance);
        text += table_of_doubts(survey, ambiance);
        if (&ambiance == &survey.ambiances[0]) text += table_of_agreement(survey);
    }
    return text + "</html>\n";
}

}  // namespace lw
