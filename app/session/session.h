// All that the user can change: place, lamps, what is shown and measured. Panels and keys write it, the frame reads it.
#pragma once
#include <chrono>
#include <optional>

#include "app/measuring/fields.h"
#include "app/picture/progressive_renderer.h"
#include "app/session/lamp_states.h"
#include "app/session/world.h"
#include "app/walk/places.h"
#include "measure/probe.h"

namespace lw {

/// A crossfade between two sets of lamp factors.
struct Fade {
    std::vector<vec3> from;
    float seconds = 0, passed = 0;
};

struct Lighting {
    LampStates lamps;
    std::optional<Fade> fade;  // from the factors before to those of `lamps`
    float fade_seconds = 1;
    int selected = -1;     // lamp
    int scrolled_to = -1;  // lamp that the panel has last scrolled into view, or -1
    std::string search;
    LampPresets presets;
    std::string presets_error;  // why the file beside the scene could not be read and must not be overwritten, or ""
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
    uint divisor = 0;          // of width and height in motion; 0: chosen from the frame time
    bool wants_error = false;  // estimate the error of the picture when the view is still
    bool reflections = false;  // outline bright reflections of lamps
};

/// A point that was measured and is kept.
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

/// What to do with the next picture.
enum class PictureRequest { none, save, copy };

/// A message that the user sees for a few seconds.
struct Notice {
    std::string text;
    std::chrono::steady_clock::time_point until{};
};

struct FrameStatistics {
    RendererTimes times;
    double frame_ms = 0;   // time between images, averaged
    uint64_t photons = 0;  // stored in the map
    uint64_t device_bytes = 0;
    uint samples = 0;
    std::optional<vec2> error;  // %, estimated standard error of the picture: median, 95th percentile
};

struct Session {
    /// At the first camera, all lamps as in the scene; open_session() adds what is kept beside the scene.
    Session(const World& world, std::filesystem::path output);
    /// Continues a session in the same building after it was loaded again with other lamps.
    Session(const World& world, const Session& before);

    const World& world;
    std::filesystem::path output;  // folder of screenshots, probes and recorded paths
    Body body;
    Walker walker;
    float yfov, near;
    std::optional<ViewTransition> transition;
    int place = 0;  // index of the place flown to last
    std::vector<Bookmark> bookmarks;
    std::string bookmarks_error;  // why the file of bookmarks must not be overwritten, or ""
    std::optional<Path> recording;
    double recorded_seconds = 0;
    Lighting lighting;
    Comparison comparison;
    Viewing viewing;
    Metering metering;
    Fields fields;
    bool panels = true, keys = false;  // shown
    PictureRequest picture_request = PictureRequest::none;
    bool reload = false;  // lamps have other photometric files now: the scene must be loaded and baked again
    Notice notice;
    FrameStatistics statistics;
};

/// The RGB factors of the lamps at this moment of a crossfade.
std::vector<vec3> factors_now(const Lighting& lighting);

/// The request and the display settings of the next frame.
FrameRequest frame_request_of(const Session& session, uint divisor);
DisplaySettings display_settings_of(const Session& session, bool bgr);

}  // namespace lw
