#pragma once
#include "benchmark/lab_scene.h"

namespace lw::test {

/// A room of two chambers with a wall without thickness between them; a lamp in the west one, none in the east one.
inline Scene two_chambers() {
    LabScene lab;
    lab.add_room({0, 0, 0}, {4, 2, 2}, 0.6f);
    lab.add_rectangle("wall", {2, 0, 0}, {0, 2, 0}, {0, 0, 2}, 0.6f);
    lab.add_point({1, 1, 1}, 100);
    lab.add_rectangle("panel", {0.5f, 1.9f, 0.5f}, {0.3f, 0, 0}, {0, 0, 0.3f}, 0, 2000);
    return lab.finish();
}

}  // namespace lw::test
