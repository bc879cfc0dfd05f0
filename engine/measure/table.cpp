#include "measure/table.h"

#include <cstdio>

namespace lw {
namespace {

std::string format(const char* pattern, auto... values) {
    char text[512];
    std::snprintf(text, sizeof text, pattern, values...);
    return text;
}

/// A cell, quoted when it needs to be (RFC 4180).
std::string quoted(const std::string& text) {
    if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
    std::string result = "\"";
    for (const char c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c);
    return result + "\"";
}

const char* name_of(SensorSet::Kind kind) {
    return kind == SensorSet::Kind::points ? "point" : kind == SensorSet::Kind::grid ? "grid" : "surface";
}

const char* name_of(Response response) { return response == Response::planar ? "planar" : "cylindrical"; }

std::string verdict_of(const MeasuredSet& measured, const Statistics& statistics) {
    if (measured.set.task.empty()) return "";
    return name_of(judge(statistics, find_task(measured.set.task)).both());
}

/// The place of a sensor in the world, its direction and its kind.
std::string place_of(const Sensor& sensor, const Scene& scene) {
    const glm::dvec3 at = glm::dvec3(sensor.position) + scene.origin;
    return format("%.6g,%.6g,%.6g,%.4g,%.4g,%.4g,", at.x, at.y, at.z, double(sensor.normal.x), double(sensor.normal.y),
                  double(sensor.normal.z)) +
           name_of(sensor.response);
}

std::string row_of(const MeasuredSet& measured, size_t i, size_t a, const Survey& survey, const Scene& scene) {
    const AmbianceFactors& ambiance = survey.ambiances[a];
    const Reading& reading = measured.readings[i];
    const Value value = value_of(reading, ambiance.factors, survey.maintenance);
    std::string row = quoted(measured.set.name) + "," + name_of(measured.set.kind) + "," +
                      quoted(name_of_sensor(measured.set, i)) + "," + place_of(measured.set.sensors[i], scene) + "," +
                      quoted(ambiance.name) +
                      format(",%.5g,%.5g,%.5g,%.3g,%.3g,", value.lux, std::max(value.lux - value.half_width, 0.0),
                             value.lux + value.half_width, value.ray_error, value.photon_error);
    row += format("%.0f,", value.photons) + quoted(value.doubt);
    const bool has_pin = a < measured.pins.size() && measured.pins[a][i];
    row += has_pin ? format(",%.5g,%.3g", measured.pins[a][i]->value, measured.pins[a][i]->half_width) : ",,";
    const bool is_traced = a == 0 && i < measured.traced.size();
    row += is_traced ? format(",%.5g,%.3g,%s", measured.traced[i].lux * double(survey.maintenance),
                              measured.traced[i].standard_error * double(survey.maintenance),
                              agrees(value, measured.traced[i], survey.maintenance) ? "yes" : "no")
                     : ",,,";
    for (size_t lamp = 0; lamp < scene.lights.size(); ++lamp)
        row += format(",%.5g", lux_of_lamp(reading, lamp, ambiance.factors[lamp]) * double(survey.maintenance));
    return row + "\n";
}

}  // namespace

std::string name_of_sensor(const SensorSet& set, size_t i) {
    if (i < set.sensor_names.size()) return set.sensor_names[i];
    if (set.kind != SensorSet::Kind::grid) return std::to_string(i + 1);
    return std::to_string(i / set.grid.columns + 1) + "," + std::to_string(i % set.grid.columns + 1);
}

std::string traced_heading() { return "field,sensor,x,y,z,nx,ny,nz,response,lux,standard_error\n"; }

std::string traced_as_csv(const SensorSet& set, const std::vector<Traced>& traced, const Scene& scene) {
    std::string text;
    for (size_t i = 0; i < traced.size(); ++i)
        text += quoted(set.name) + "," + quoted(name_of_sensor(set, i)) + "," + place_of(set.sensors[i], scene) +
                format(",%.5g,%.3g\n", traced[i].lux, traced[i].standard_error);
    return text;
}

std::string sensors_as_csv(const Survey& survey, const Scene& scene) {
    std::string text =
        "field,kind,sensor,x,y,z,nx,ny,nz,response,ambiance,lux,low,high,ray_error,photon_error,photons,doubt,"
        "pin_lux,pin_half_width,traced_lux,traced_error,agrees";
    for (const std::string& name : scene.light_names) text += "," + quoted("lux of " + name);
    text += "\n";
    for (const MeasuredSet& measured : survey.sets)
        for (size_t a = 0; a < survey.ambiances.size(); ++a)
            for (size_t i = 0; i < measured.readings.size(); ++i) text += row_of(measured, i, a, survey, scene);
    return text;
}

std::string fields_as_csv(const Survey& survey) {
    std::string text =
        "field,task,ambiance,count,blocked,doubtful,Emin,Emin_half_width,Eavg,Eavg_half_width,Emax,Emax_half_width,U0,"
        "U0_half_width,Ud,Ud_half_width,required_lux,required_U0,verdict\n";
    for (const MeasuredSet& measured : survey.sets)
        for (const AmbianceFactors& ambiance : survey.ambiances) {
            const Statistics s = statistics_of(measured, ambiance, survey.maintenance);
            text += quoted(measured.set.name) + "," + measured.set.task + "," + quoted(ambiance.name) +
                    format(",%zu,%zu,%zu", s.count, s.blocked, s.doubtful);
            for (const Estimate& e : {s.minimum, s.average, s.maximum, s.u0, s.ud})
                text += format(",%.5g,%.3g", e.value, e.half_width);
            const Task task = measured.set.task.empty() ? Task{} : find_task(measured.set.task);
            text += measured.set.task.empty()
                        ? ",,,\n"
                        : format(",%g,%g,%s\n", task.illuminance, task.uniformity, verdict_of(measured, s).c_str());
        }
    return text;
}

std::string agreement_as_text(const Survey& survey) {
    std::string text;
    const AmbianceFactors& ambiance = survey.ambiances[0];
    for (const MeasuredSet& measured : survey.sets) {
        const Agreement a = agreement_of(measured, ambiance, survey.maintenance);
        text += format("%-16s %-12s path traced: %zu of %zu intervals hold, mean difference %+.2f %%\n",
                       measured.set.name.c_str(), ambiance.name.c_str(), a.inside, a.compared, 100 * a.difference);
    }
    return text;
}

std::string fields_as_text(const Survey& survey) {
    std::string text = format("%-16s %-12s %6s %16s %16s %16s %14s %6s  %s\n", "field", "ambiance", "points", "Eavg lx",
                              "Emin lx", "Emax lx", "U0", "Ud", "task");
    const auto lux = [](Estimate e) { return format("%.4g +- %.2g", e.value, e.half_width); };
    for (const MeasuredSet& measured : survey.sets)
        for (const AmbianceFactors& ambiance : survey.ambiances) {
            const Statistics s = statistics_of(measured, ambiance, survey.maintenance);
            text += format("%-16s %-12s %6zu %16s %16s %16s %14s %6.2f  %s %s", measured.set.name.c_str(),
                           ambiance.name.c_str(), s.count, lux(s.average).c_str(), lux(s.minimum).c_str(),
                           lux(s.maximum).c_str(), format("%.2f +- %.2f", s.u0.value, s.u0.half_width).c_str(),
                           s.ud.value, measured.set.task.c_str(), verdict_of(measured, s).c_str());
            if (s.blocked > 0) text += format("  (%zu points inside objects left out)", s.blocked);
            if (s.doubtful > 0) text += format("  (%zu doubtful)", s.doubtful);
            text += "\n";
        }
    return text;
}

}  // namespace lw
