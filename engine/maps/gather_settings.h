// Settings of the gather, which shaders and CPU estimate share, and the table of its modes.
#pragma once
#include <compare>
#include <string>
#include <vector>

#include "shaders/photon_map.h"

namespace lw {

struct GatherSettings {
    uint mode = gather_mode_cached;
    uint neighbours = 300;  // photons per estimate
    // Per emissive mesh; 0: none where the map has a lattice, shadows as sharp as that, of lobes mirrors alone
    // followed.
    uint shadow_rays = 4;
    uint paths = 1;                                     // per pixel along lobes that are followed
    float followed_roughness = max_followed_roughness;  // lobes of surfaces smoother than this, at most 1, are followed

    /// Equal settings make the same picture. The order only serves as that of keys.
    auto operator<=>(const GatherSettings&) const = default;
};

/// Most neighbours of the exact mode. Its heap is an array of this size in registers or local memory.
inline constexpr uint max_exact_neighbours = 1024;

/// A mode of the gather that makes a picture; gather_mode_inspect makes none.
struct GatherMode {
    uint mode;         // gather_mode_...
    const char* name;  // of the option, and in tables
    const char* description;
    const char* title;  // in a report
};

/// The table of all such modes, in the order in which they are offered.
inline constexpr GatherMode gather_modes[] = {
    {gather_mode_exact, "exact", "k nearest photons", "exact photons"},
    {gather_mode_smooth, "smooth", "photons, one pass", "smooth photons"},
    {gather_mode_cached, "cached", "irradiance of the bake", "cached irradiance"},
};

/// The table's entry of a mode.
const GatherMode& gather_mode(uint mode);
/// The mode of a name. Throws Error naming it when there is none.
uint gather_mode_named(const std::string& name);
/// The names of all modes, for the check of an option, and a text that explains them, for its help.
std::vector<std::string> gather_mode_names();
std::string gather_mode_help();

/// The glTF roughness, at most 1, below which specular lobes are followed by rays; without shadow rays only mirrors
/// are.
float followed_roughness(const GatherSettings& settings);

/// True when shadow rays are traced: when the settings say so, or when the map does not know which lamps its nodes see,
/// as a map without photons.
bool has_shadow_rays(const GatherSettings& settings, bool has_visible_lamps);

/// The settings with all members reset that pipelines are not compiled for. When the results are equal, pipelines can
/// be shared.
GatherSettings pipeline_settings(const GatherSettings& settings);

}  // namespace lw
