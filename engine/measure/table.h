// A survey as text for other programs: CSV, one row per sensor and ambiance, and one per field and ambiance.
#pragma once
#include <string>

#include "measure/survey.h"

namespace lw {

/// CSV, one row per sensor and ambiance, with the columns
///   field,kind,sensor,x,y,z,nx,ny,nz,response,ambiance,lux,low,high,ray_error,photon_error,photons,doubt,
///   pin_lux,pin_half_width,traced_lux,traced_error,agrees
/// and then the lux of each lamp. low and high are the ends of the 90 % interval. The pin's columns are empty for
/// sensors that lie on no surface (add_pins()), those of the path tracer unless trace_survey() was called.
std::string sensors_as_csv(const Survey& survey, const Scene& scene);

/// CSV, one row per field and ambiance, with the columns field,task,ambiance,count,blocked,doubtful, then Emin, Eavg,
/// Emax, U0, Ud, each with its half width, then required and verdict.
std::string fields_as_csv(const Survey& survey);

/// CSV of a set of sensors that the path tracer read (measure/traced.h), one row per sensor, with the columns
/// field,sensor,x,y,z,nx,ny,nz,response,lux,standard_error. Without the row of their names, traced_heading().
std::string traced_as_csv(const SensorSet& set, const std::vector<Traced>& traced, const Scene& scene);
std::string traced_heading();

/// The same as lines of text for a terminal.
std::string fields_as_text(const Survey& survey);

/// For each field, how many 90 % intervals hold the value of trace_survey(), as lines of text for a terminal.
std::string agreement_as_text(const Survey& survey);

/// The name of sensor `i` of a set: its own name; in a grid "row,column", counted from 1; else its number, from 1.
std::string name_of_sensor(const SensorSet& set, size_t i);

}  // namespace lw
