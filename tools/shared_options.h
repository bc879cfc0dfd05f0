// Options that several programs have, with the same words and the same checks.
#pragma once
#include <string>
#include <vector>

#include "number_option.h"

namespace lw {

inline void add_seed(CLI::App& app, uint64_t& seed) {
    app.add_option("--seed", seed, "whole number that chooses the random numbers: the same gives the same result")
        ->check(whole_number())
        ->capture_default_str();
}

inline void add_photometry(CLI::App& app, std::vector<std::string>& files) {
    app.add_option("--ies", files,
                   "LAMP=FILE, gives a point or spot lamp the distribution of an IES LM-63 or EULUMDAT (.ldt) file; "
                   "the same for bake and all programs that read the map; may be repeated; default: none")
        ->allow_extra_args(false);
}

inline void add_power(CLI::App& app, std::vector<std::string>& powers) {
    app.add_option("--power", powers,
                   "LIGHT=FACTOR, dims (below 1) or brightens a lamp; may be repeated; default: 1 for each lamp")
        ->allow_extra_args(false);
}

inline void add_ambiance(CLI::App& app, std::string& ambiance) {
    app.add_option("--ambiance", ambiance,
                   "name of a set of lamp factors in SCENE.ambiances.json, which --power multiplies; default: none");
}

inline void add_threads(CLI::App& app, unsigned& threads) {
    app.add_option("--threads", threads, "worker threads; 0: one for each core")
        ->capture_default_str()
        ->check(CLI::Range(0u, 4096u));
}

}  // namespace lw
