// Requirements on the light for a task in a room: maintained illuminance and uniformity by EN 12464-1, edition of 2021
// or, where stated, of 2011.
#pragma once
#include <string>
#include <vector>

namespace lw {

struct Task {
    std::string name;
    double illuminance;  // lx, maintained, mean of the field
    double uniformity;   // least U0 = minimum / mean
    int edition;         // year of EN 12464-1
    std::string what;    // description, with the row or section of the standard
};

const std::vector<Task>& known_tasks();

/// The preset of this name. Throws Error listing the names.
const Task& find_task(const std::string& name);

}  // namespace lw
