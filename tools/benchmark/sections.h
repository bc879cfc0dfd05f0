// The sections of the benchmark: each measures one question and returns tables. One file per section.
#pragma once
#include <filesystem>
#include <functional>
#include <vector>

#include "bake_case.h"
#include "table.h"

namespace lw {

/// What every section is given.
struct Bench {
    const Device& device;
    std::filesystem::path folder;  // of the output; references are kept in it
    std::filesystem::path scenes;  // cornell.gltf and apartment.glb
    bool quick = false;

    /// The quick or the full value of a setting.
    template <class T>
    T pick(T quick_value, T full_value) const {
        return quick ? quick_value : full_value;
    }
};

std::vector<Table> measure_knn(const Bench& bench);
std::vector<Table> measure_table1(const Bench& bench);
std::vector<Table> measure_modes(const Bench& bench);
std::vector<Table> measure_dimming(const Bench& bench);
std::vector<Table> measure_convergence(const Bench& bench);
std::vector<Table> measure_scaling(const Bench& bench);
std::vector<Table> measure_equal_time(const Bench& bench);
std::vector<Table> measure_features(const Bench& bench);
std::vector<Table> measure_lobes(const Bench& bench);
std::vector<Table> measure_gloss(const Bench& bench);
std::vector<Table> measure_work(const Bench& bench);
std::vector<Table> measure_bake(const Bench& bench);
std::vector<Table> measure_cie171(const Bench& bench);

struct Section {
    const char* name;
    const char* question;
    std::vector<Table> (*measure)(const Bench&);
};

}  // namespace lw
