// What a room needs for its task: maintained illuminance and uniformity after EN 12464-1:2011, sections 4 and 5.
#pragma once
#include <string>
#include <vector>

namespace lw {

struct Task {
    std::string name;
    double illuminance;  // lx, maintained, mean of the field
    double uniformity;   // least U0 = minimum / mean
    std::string what;
};

const std::vector<Task>& known_tasks();

/// The preset of this name. Throws Error listing the names.
const Task& find_task(const std::string& name);

}  // namespace lw
