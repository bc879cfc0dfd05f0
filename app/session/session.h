// All that the user can change, as plain values: where they stand, the lamps, what is shown. Panels and keys write it,
// the frame reads it.
#pragma once
#include <chrono>
#include <optional>

#include "app/measuring/fields.h"
#include "app/picture/progressive_renderer.h"
#include "app/session/lamp_states.h"
#include "app/session/world.h"
#include "app/walk/places.h"
#include "maps/probe.h"

namespace lw {

/// A crossfade between two sets of lamp factors.
struct Fade {
    std::vector<vec3> from;
    float seconds = 0, passed = 0;
};

struct Lighting {
    LampStates lamps;
    std::optional<Fade> fade;  // from what was lit before to `lamps`
    float fade_seconds = 1;
    int selected = -1;     // lamp
    int scrolled_to = -1;  // lamp that the panel has scrolled into view
    std::string search;
    LampPresets presets;
    std::string presets_error;  // why the file beside the scene must not be overwritten, or ""
    std::string current;        // ambiance chosen last
};

struct Comparison {
    bool on = false;
    LampStates lamps;  // B
    std::string name = "as in the file";
    float split = 0.5f;
};

struct Viewing {
    uint view = view_shaded;
    uint curve = curve_neutral;
    bool auto_exposure = true;
    float exposure_ev = 7;
    bool auto_range = true, logarithmic = false, lines = false;
    float low = 0, high = 500;
    GatherSettings gather;
    uint max_samples = 256;
    uint divisor = 0;          // of the resolution while moving; 0: by the time a frame takes
    bool wants_error = false;  // to be told the estimated error while the view is still
    bool reflections = false;  // outlines of bright reflections of lamps
};

/// A measured place that is kept.
struct Pin {
    Hit hit;
    vec3 viewer;
    Measurement value;
};

struct Metering {
    bool on = false;
    std::optional<Pin> live;  // under the crosshair
    std::vector<Pin> pins;
};

/// What is to be done with the next picture.
enum class PictureRequest { none, save, copy };

/// A line told to the user for a few seconds.
struct Notice {
    std::string text;
    std::chrono::steady_clock::time_point until{};
};

struct FrameStatistics {
    RendererTimes times;
    double frame_ms = 0;   // from one image to the next, averaged
    uint64_t photons = 0;  // stored in the map
    uint64_t device_bytes = 0;
    uint samples = 0;
    std::optional<vec2> error;  // %, estimated standard error of the picture: median, 95th percentile
};

struct Session {
    /// At the first camera, all lamps as in the scene; open_session() adds what is kept beside the scene.
    Session(const World& world, std::filesystem::path output);
    /// The same session in the same building with other lamps.
    Session(const World& world, const Session& before);

    const World& world;
    std::filesystem::path output;  // folder of screenshots, probes and recorded paths
    Body body;
    Walker walker;
    float yfov, near;
    std::optional<ViewTransition> transition;
    int place = 0;  // jumped to last
    std::vector<Bookmark> bookmarks;
    std::string bookmarks_error;  // as presets_error
    std::optional<Path> recording;
    double recorded_seconds = 0;
    Lighting lighting;
    Comparison comparison;
    Viewing viewing;
    Metering metering;
    Fields fields;
    bool panels = true, keys = false;  // shown
    PictureRequest picture_request = PictureRequest::none;
    bool reload = false;  // lamps have got other photometric files: the scene is loaded and baked anew
    Notice notice;
    FrameStatistics statistics;
};

/// What the lamps are multiplied by now, crossfade included.
std::vector<vec3> factors_now(const Lighting& lighting);

/// What the next frame is to viewer.
FrameRequest frame_request_of(const Session& session, uint divisor);
DisplaySettings display_settings_of(const Session& session, bool bgr);

}  // namespace lw
