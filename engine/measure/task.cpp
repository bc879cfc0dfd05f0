#include "measure/task.h"

#include "base/error.h"

namespace lw {

const std::vector<Task>& known_tasks() {
    static const std::vector<Task> tasks = {
        {"office", 500, 0.6, 2021, "writing, typing, reading, data processing (34.2)"},
        {"filing", 300, 0.4, 2021, "filing, copying (34.1)"},
        {"drawing", 750, 0.7, 2021, "technical drawing (34.3)"},
        {"cad", 500, 0.6, 2021, "CAD workstations (34.4)"},
        {"conference", 500, 0.6, 2021, "conference and meeting rooms (34.5)"},
        {"reception", 300, 0.6, 2021, "reception desk (34.6)"},
        {"archive", 200, 0.4, 2021, "archives (34.7)"},
        {"office-wall", 150, 0.1, 2021, "walls of office work places (34.2)"},
        {"office-ceiling", 100, 0.1, 2021, "ceilings of office work places (34.2)"},
        {"office-faces", 150, 0.1, 2021, "mean cylindrical illuminance at office work places (34.2)"},
        {"circulation", 100, 0.4, 2021, "corridors and circulation areas (9.1)"},
        {"stairs", 100, 0.4, 2021, "stairs, escalators (9.2)"},
        {"circulation-wall", 50, 0.1, 2021, "walls of circulation areas (9.1)"},
        {"circulation-ceiling", 30, 0.1, 2021, "ceilings of circulation areas (9.1)"},
        {"circulation-faces", 50, 0.1, 2021, "mean cylindrical illuminance in circulation areas (9.1)"},
        {"classroom", 500, 0.6, 2021, "classrooms, general activities (44.1)"},
        {"lecture", 500, 0.6, 2021, "auditoriums, lecture halls (44.2)"},
        {"school-stairs", 150, 0.4, 2021, "stairs of schools (44)"},
        {"classroom-2011", 300, 0.6, 2011, "classrooms, tutorial rooms (5.36.1)"},
        {"canteen", 200, 0.4, 2011, "canteens, pantries (5.2.1)"},
        {"restroom", 100, 0.4, 2011, "rest rooms (5.2.2)"},
        {"kitchen", 500, 0.6, 2011, "kitchens (5.29.2)"},
        {"sales", 300, 0.4, 2011, "sales areas (5.27.1)"},
        {"till", 500, 0.6, 2011, "till areas (5.27.2)"},
        {"wall", 50, 0.1, 2011, "walls (4.2.2)"},
        {"bright-wall", 75, 0.1, 2011, "walls of offices, schools, hospitals (4.2.2)"},
        {"ceiling", 30, 0.1, 2011, "ceilings (4.2.2)"},
        {"bright-ceiling", 50, 0.1, 2011, "ceilings of offices, schools, hospitals (4.2.2)"},
        {"faces", 50, 0.1, 2011, "mean cylindrical illuminance where people are (4.6.2)"},
        {"visual-contact", 150, 0.1, 2011, "mean cylindrical illuminance where people talk (4.6.2)"},
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
