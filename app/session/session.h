// All that the user can change: place, lamps, what is shown and measured. Panels and keys write it, the frame reads it.
#pragma once
#include <optional>

#include "app/measuring/fields.h"
#include "app/picture/progressive_renderer.h"
#include "app/session/lamp_board.h"
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
    LampBoard board;
    std::optional<Fade> fade;  // from the factors before to those of the board
    float fade_seconds = 1;
    int selected = -1;     // lamp
    int scrolled_to = -1;  // lamp that the panel has last scrolled into view, or -1
    std::string search;
    LampBook book;
    std::string book_trouble;  // why the file beside the scene could not be read and must not be overwritten, or ""
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
    double until = 0;  // s, Window::now()
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
    std::string bookmarks_trouble;  // why the file of bookmarks must not be overwritten, or ""
    std::optional<Path> recording;
    double recorded_seconds = 0;
    Lighting lighting;
    Comparison comparison;
    Viewing viewing;
    Metering metering;
    Fields fields;
    bool panels = true, keys = false, full_screen = false;
    PictureRequest picture_request = PictureRequest::none;
    bool reload = false;  // lamps have other photometric files now: the scene must be loaded and baked again
    Notice notice;
    FrameStatistics statistics;
};

/// Shows a message for some seconds.
void tell(Session& session, const std::string& text, double seconds = 5);

/// The RGB factors of the lamps at this moment of a crossfade.
std::vector<vec3> factors_now(const Lighting& lighting);

/// Makes `board` the current one, with a crossfade from the factors of this moment.
void fade_to(Lighting& lighting, const LampBoard& board);

/// Writes ambiances, groups and photometric files to the file beside the scene. Tells the user that `what` is saved, or
/// why it is not.
void save_book(Session& session, const std::string& what);

/// Puts a photometric file (relative to the scene's folder) on a point or spot lamp, or takes it off (""); keeps that
/// beside the scene and asks for the scene to be loaded anew. Tells what is wrong with a file.
void attach_file(Session& session, size_t lamp, const std::string& file);

/// Flies to place `index`, counted over the cameras of the scene, then the bookmarks. Returns false when there is none.
bool fly_to(Session& session, size_t index);

/// Adds the current view to the bookmarks and saves them beside the scene.
void add_bookmark(Session& session);

/// Starts recording the walk, or ends and saves it.
void toggle_recording(Session& session);

/// Advances the session by `seconds`: transition or walk, crossfade, recording.
void advance(Session& session, const WalkInput& input, float seconds);

/// The request and the display settings of the next frame.
FrameRequest frame_request_of(const Session& session, uint divisor);
DisplaySettings display_settings_of(const Session& session, bool bgr);

/// A file in the output folder that does not exist yet: SCENE-001.EXT, SCENE-002.EXT, ...
std::filesystem::path free_name(const Session& session, const std::string& extension);

}  // namespace lw
