#include "app/walkthrough.h"

#include <cstdio>

#include "app/baking.h"
#include "app/measuring/field_reader.h"
#include "app/picture/viewer.h"
#include "app/session/actions.h"
#include "app/session/saving.h"
#include "base/error.h"
#include "gpu/commands.h"
#include "scene/camera.h"
#include "scene/lamp_factors.h"

namespace lw {
namespace {

constexpr double min_seconds_between_losses = 60;

void refuse_validation_messages(const Device& device) {
    const std::vector<std::string> messages = device.validation_messages();
    if (!messages.empty())
        throw Error("Vulkan validation: " + std::to_string(messages.size()) + " messages, first: " + messages[0]);
}

/// Takes a finished map from the bake, if there is one, and shows its errors to the user.
void follow_baking(Baking& baking, Session& session, SharedMap& map, Viewer& viewer) {
    if (std::optional<PhotonMap> ready = baking.take()) {
        map = std::make_shared<const PhotonMap>(std::move(*ready));
        viewer.set_map(map);
        tell(session, std::to_string(map->stored_photons) + " photons", 3);
    }
    const std::string message = baking.take_message();
    if (!message.empty()) tell(session, message, 10);
}

/// Lets the reader go on with calculation grids, and shows its errors to the user.
void follow_fields(FieldReader& reader, Session& session, const SharedMap& map) {
    try {
        if (!reader.follow(session.fields, map)) return;
        value_fields(session.fields, factors_now(session.lighting));
        tell(session, "calculation grids: " + std::to_string(session.fields.fields.size()) + " read", 2);
    } catch (const Error& failure) {
        tell(session, failure.what(), 10);
    }
}

/// The map, and the threads that bake it and read grids from it while the window is open.
struct Work {
    SharedMap map;
    std::unique_ptr<Baking> baking;
    FieldReader fields;

    BakingState progress() const {
        const BakingState bakes = baking ? baking->progress() : std::nullopt;
        return bakes ? bakes : fields.progress();
    }
};

/// Shows frames on one device until the window closes or the scene must be loaded again.
void run(Window& window, const WalkthroughSettings& settings, Session& session, Work& work) {
    Viewer viewer(window, session, settings.device, settings.vsync);
    if (work.map) viewer.set_map(work.map);
    while (!window.closes() && !session.reload) {
        if (work.baking) follow_baking(*work.baking, session, work.map, viewer);
        follow_fields(work.fields, session, work.map);
        viewer.frame(work.progress());
    }
    refuse_validation_messages(viewer.device());
}

/// Shows frames until the window closes or the scene must be loaded again. Starts a new device when one is lost.
void run_on_devices(Window& window, const WalkthroughSettings& settings, Session& session, Work& work) {
    double lost = -1e9;
    while (!window.closes() && !session.reload) {
        try {
            run(window, settings, session, work);
            continue;
        } catch (const vk::DeviceLostError&) {
        } catch (const DeviceLost&) {
        } catch (const vk::SystemError& failure) {
            throw Error(std::string("Vulkan: ") + failure.what());
        }
        if (Window::now() - lost < min_seconds_between_losses)
            throw Error("Vulkan: the graphics device was lost twice within a minute");
        lost = Window::now();
        tell(session, "the graphics device was lost: starting it again", 8);
    }
}

void set_start(const WalkthroughSettings& settings, Session& session) {
    const Camera& camera = find_camera(session.world.scene, settings.camera);
    session.walker = walker_at(camera, session.body, session.world.collision);
    session.yfov = camera.yfov;
    if (settings.ambiance.empty()) return;
    chosen_factors(session.world.scene, settings.ambiance, {});  // refuses unknown ones
    std::vector<std::string> missing;
    session.lighting.lamps =
        with_ambiance(session.world.scene, session.lighting.presets.ambiances.at(settings.ambiance), missing);
    session.lighting.current = settings.ambiance;
}

LampPresets presets_beside(const std::filesystem::path& scene) {
    try {
        return load_lamp_presets(default_ambiances_path(scene));
    } catch (const Error&) {
        return {};  // the session tells why
    }
}

/// Loads the scene with the photometric files of its presets. When one of them is wrong, the user is told and the scene
/// is loaded without them.
std::unique_ptr<World> load_world(const WalkthroughSettings& settings, const LampPresets& presets) {
    try {
        return std::make_unique<World>(settings.scene, presets, settings.photometry);
    } catch (const Error& failure) {
        if (presets.photometry.empty()) throw;
        auto world = std::make_unique<World>(settings.scene, LampPresets(), settings.photometry);
        std::fprintf(stderr, "warning: %s: going on without the files of the lamps\n", failure.what());
        return world;
    }
}

/// Loads the map beside the scene, or starts to bake one.
void find_map(const WalkthroughSettings& settings, Session& session, Work& work) {
    const World& world = session.world;
    std::string reason;
    work.map = try_load_map(settings.map, world.scene, reason);
    if (work.map) return;
    tell(session, reason.empty() ? "no map beside the scene yet: baking one" : reason + ": baking a new one", 8);
    work.baking =
        std::make_unique<Baking>(world.scene, world.caster, Baking::Settings{100'000, settings.photons, settings.map});
}

/// Walks in one loaded scene until the window closes or the scene must be loaded again.
void walk_in_world(Window& window, const WalkthroughSettings& settings, Session& session) {
    Work work{nullptr, nullptr, {session.world.scene, session.world.caster}};
    find_map(settings, session, work);
    run_on_devices(window, settings, session, work);
}

}  // namespace

void walk_in_window(const WalkthroughSettings& settings) {
    std::unique_ptr<World> world = load_world(settings, presets_beside(settings.scene));
    auto session = std::make_unique<Session>(open_session(*world, settings.output));
    set_start(settings, *session);
    if (device_names().empty())
        throw Error("Vulkan: no device found (mesa-vulkan-drivers has one that runs on the CPU)");
    Window window("Lumenwalk - " + settings.scene.filename().string(), settings.size);
    for (;;) {
        walk_in_world(window, settings, *session);
        if (window.closes()) return;
        std::unique_ptr<World> next = load_world(settings, session->lighting.presets);
        session = std::make_unique<Session>(*next, *session);
        world = std::move(next);
    }
}

}  // namespace lw
