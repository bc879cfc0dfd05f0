// All that the user can change, as plain values: where they stand, the lamps, what is shown. Panels and keys write it,
// the frame reads it.
#pragma once
#include <optional>

#include "app/lamp_board.h"
#include "app/places.h"
#include "app/stage.h"
#include "app/world.h"
#include "maps/probe.h"

namespace lw {

/// A crossfade between two sets of lamp factors.
struct Fade {
    std::vector<vec3> from;
    float seconds = 0, passed = 0;
};

struct Lighting {
    LampBoard board;
    std::optional<Fade> fade;  // from what was lit before to the board
    float fade_seconds = 1;
    int selected = -1;  // lamp
    std::string search;
    LampBook book;
    std::string book_trouble;  // why the file beside the scene must not be overwritten, or ""
    std::string current;       // ambiance chosen last
};

struct Comparison {
    bool on = false;
    LampBoard board;  // B
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
    uint most_samples = 32;
    uint divisor = 0;  // of the resolution while moving; 0: by the time a frame takes
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

/// A line told to the user for a few seconds.
struct Notice {
    std::string text;
    double until = 0;  // s, Window::now()
};

struct Statistics {
    StageTimes times;
    double frame_ms = 0;  // from one image to the next, averaged
    uint64_t device_bytes = 0;
    uint samples = 0;
};

struct Session {
    Session(const World& world, std::filesystem::path output);

    const World& world;
    std::filesystem::path output;  // folder of screenshots, probes and recorded paths
    Body body;
    Walker walker;
    float yfov, near;
    std::optional<Flight> flight;
    std::vector<Bookmark> bookmarks;
    std::string bookmarks_trouble;  // as book_trouble
    std::optional<Path> recording;
    double recorded_seconds = 0;
    Lighting lighting;
    Comparison comparison;
    Viewing viewing;
    Metering metering;
    bool panels = true, keys = false, full_screen = false;
    bool screenshot = false;  // wanted with the next frame
    Notice notice;
    Statistics statistics;
};

/// Shows a line for a while.
void tell(Session& session, const std::string& text, double seconds = 5);

/// What the lamps are multiplied by now, crossfade included.
std::vector<vec3> factors_now(const Lighting& lighting);

/// Lights the board, fading from what is lit now.
void fade_to(Lighting& lighting, const LampBoard& board);

/// Flies to place `index`: the cameras of the scene, then the bookmarks. False when there is none.
bool fly_to(Session& session, size_t index);

/// Keeps the view as a bookmark beside the scene.
void add_bookmark(Session& session);

/// Starts recording the walk, or ends and saves it.
void toggle_recording(Session& session);

/// Moves on by `seconds`: flight or walk, crossfade, recording.
void advance(Session& session, const WalkInput& input, float seconds);

/// What the frame shows.
Shot shot_of(const Session& session, uint divisor);
Look look_of(const Session& session, bool bgr);

/// Measures again what lies under the crosshair and, when `all`, the pins.
void measure_again(Session& session, const PhotonMap& map, bool all);

/// Measures and pins what the picture shows at a pixel.
void pin_at(Session& session, const PhotonMap& map, vec2 pixel, vec2 size);

/// The pins as a table beside the other outputs; tells how it went.
void save_pins(Session& session);

/// A file in the output folder that does not exist yet: SCENE-001.EXT, SCENE-002.EXT, ...
std::filesystem::path free_name(const Session& session, const std::string& extension);

}  // namespace lw
