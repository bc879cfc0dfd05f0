// Calculation grids of the walkthrough: rectangles in the air or on a surface (measure/grid.h) whose sensors are read
// once from a map; what each lamp brings is kept, so that their values follow the dimmers.
#pragma once
#include <optional>

#include "measure/grid.h"
#include "measure/survey.h"

namespace lw {

struct Field {
    uint id = 0;  // counts up
    GridRequest request;
    SensorSet set;
    std::vector<Reading> readings;  // one per sensor once they are read, else none
    bool is_current = false;        // read from the map that is shown
    std::vector<Value> values;      // at the lamps' present powers
    Statistics statistics;
};

struct Fields {
    std::vector<Field> fields;
    bool chooses = false;        // the next clicks are corners
    std::optional<vec3> corner;  // the first
    float height = 0.75f;        // m of a plane over the surface that is clicked: a desk
    std::string text;            // of the panel's line
    uint next_id = 1;
};

constexpr size_t max_sensors = 2000;  // of a grid in the window, where someone waits for it

/// Adds a grid that is still to be read. Throws Error for one with too many sensors.
void add_field(Fields& fields, const GridRequest& request, const Scene& scene);

/// The level rectangle between two clicked points, `height` over the first; its name counts the grids. Throws Error
/// when it is thinner than 10 cm.
GridRequest request_between(const Fields& fields, vec3 first, vec3 second, const Scene& scene);

/// The grid as a text that --grid of lumenwalk-measure takes.
std::string text_of(const GridRequest& request);

/// Values and sums at the lamps' present powers (factors per lamp and channel).
void value_fields(Fields& fields, const std::vector<vec3>& factors);

/// "312 lx +- 3, Emin 190, U0 0.61": one line of what is known, or that it is still being read.
std::string summary_of(const Field& field);

/// What lumenwalk-measure writes of the same grids: a table of sensors and one of fields, the ambiance being `name`.
Survey survey_of(const Fields& fields, const std::vector<vec3>& factors, const std::string& name);

}  // namespace lw
