// Calculation grids of the walkthrough: rectangles in the air or on a surface (measure/grid.h) whose sensors are read
// once from a map; the light of each lamp is kept apart, so that the values follow the dimmers.
#pragma once
#include <optional>

#include "measure/grid.h"
#include "measure/survey.h"

namespace lw {

struct Field {
    uint id = 0;  // unique, counted from 1
    GridRequest request;
    SensorSet set;
    std::vector<Reading> readings;  // one per sensor, or empty before they are read
    bool is_current = false;        // read from the map that is shown
    std::vector<Value> values;      // per sensor, at the present factors of the lamps
    Statistics statistics;
};

struct Fields {
    std::vector<Field> fields;
    bool chooses = false;        // the next clicks choose corners
    std::optional<vec3> corner;  // the first corner, once chosen
    float height = 0.75f;        // m, of the grid over the clicked surface; 0.75 is the height of a desk
    std::string text;            // the text in the input line of the panel
    uint next_id = 1;
};

constexpr size_t max_sensors = 2000;  // most sensors of a grid in the window, so that nobody waits long

/// Adds a grid that is still to be read. Throws Error for one with too many sensors.
void add_field(Fields& fields, const GridRequest& request, const Scene& scene);

/// The request for a horizontal grid between two clicked points, fields.height above the first. Its name is made from
/// the number of grids. Throws Error when it is narrower than 10 cm.
GridRequest request_between(const Fields& fields, vec3 first, vec3 second, const Scene& scene);

/// The grid as a text that --grid of lumenwalk-measure takes.
std::string text_of(const GridRequest& request);

/// Fills values and statistics of all fields at these factors, RGB per lamp.
void value_fields(Fields& fields, const std::vector<vec3>& factors);

/// A line such as "312 lx +- 3, Emin 190, U0 0.61", or that the field is still being read.
std::string summary_of(const Field& field);

/// The fields as a survey with one ambiance called `name`, for the tables that lumenwalk-measure writes.
Survey survey_of(const Fields& fields, const std::vector<vec3>& factors, const std::string& name);

}  // namespace lw
