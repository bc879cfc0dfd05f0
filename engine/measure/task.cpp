#include "measure/task.h"

#include "base/error.h"

namespace lw {

const std::vector<Task>& known_tasks() {
    static const std::vector<Task> tasks = {
        {"office", 500, 0.6, "writing, typing, reading, data processing (table 5.26.2)"},
        {"filing", 300, 0.4, "filing and copying in offices (5.26.1)"},
        {"drawing", 750, 0.7, "technical drawing (5.26.3)"},
        {"conference", 500, 0.6, "conference and meeting rooms (5.26.5)"},
        {"reception", 300, 0.6, "reception desk (5.26.6)"},
        {"archive", 200, 0.4, "archives (5.26.7)"},
        {"circulation", 100, 0.4, "circulation areas and corridors (5.1.1)"},
        {"stairs", 100, 0.4, "stairs, escalators (5.1.2)"},
        {"canteen", 200, 0.4, "canteens, pantries (5.2.1)"},
        {"restroom", 100, 0.4, "rest rooms (5.2.2)"},
        {"kitchen", 500, 0.6, "kitchens (5.29.2)"},
        {"sales", 300, 0.4, "sales areas (5.27.1)"},
        {"classroom", 300, 0.6, "classrooms, tutorial rooms (5.36.1)"},
        {"lecture", 500, 0.6, "lecture halls (5.36.3)"},
        {"wall", 50, 0.1, "walls (4.2.2)"},
        {"bright-wall", 75, 0.1, "walls of offices, schools, hospitals (4.2.2)"},
        {"ceiling", 30, 0.1, "ceilings (4.2.2)"},
        {"bright-ceiling", 50, 0.1, "ceilings of offices, schools, hospitals (4.2.2)"},
        {"faces", 50, 0.1, "mean cylindrical illuminance where people are (4.6.2)"},
        {"visual-contact", 150, 0.1, "mean cylindrical illuminance where people talk (4.6.2)"},
    };
    return tasks;
}

const Task& find_task(const std::string& name) {
    std::string names;
    for (const Task& task : known_tasks()) {
        if (task.name == name) return task;
        names += (names.empty() ? "" : ", ") + task.name;
    }
    throw Error("task " + name + ": not known; there are: " + names);
}

}  // namespace lw
