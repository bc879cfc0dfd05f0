// A survey as text for other programs: CSV, one row per sensor and ambiance, and one per field and ambiance.
#pragma once
#include <string>

#include "measure/survey.h"

namespace lw {

/// field,kind,sensor,x,y,z,nx,ny,nz,response,ambiance,lux,low,high,ray_error,photon_error,photons,doubt,pin_lux,
/// pin_half_width,traced_lux,traced_error,agrees, then the lux of each lamp in that ambiance. low and high bound the
/// 90 % interval; the pin's columns are empty off surfaces (add_pins()), those of the path tracer unless it was asked
/// (trace_survey(), first ambiance).
std::string sensors_as_csv(const Survey& survey, const Scene& scene);

/// field,task,ambiance,count,blocked,doubtful, then Emin, Eavg, Emax, U0, Ud each with its half width, required,
/// verdict.
std::string fields_as_csv(const Survey& survey);

/// The same as lines for a terminal.
std::string fields_as_text(const Survey& survey);

/// Field by field how many 90 % intervals hold what trace_survey() found, as lines for a terminal.
std::string agreement_as_text(const Survey& survey);

/// The name of sensor `i` of a set: its own, "row,column" of a grid from 1, or its number from 1.
std::string name_of_sensor(const SensorSet& set, size_t i);

}  // namespace lw
