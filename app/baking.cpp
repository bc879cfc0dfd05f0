#include "app/baking.h"

#include "base/error.h"
#include "file/map_file.h"
#include "maps/bake.h"

namespace lw {

Baking::Baking(const Scene& scene, const RayCaster& caster, Settings settings)
    : scene_(scene), caster_(caster), settings_(std::move(settings)), thread_([this] { run(); }) {}

Baking::~Baking() {
    board_.cancel();
    thread_.join();
}

void Baking::run() {
    const ProgressScope scope(board_);
    try {
        if (settings_.preview_photons > 0 && settings_.preview_photons < settings_.photons)
            bake(settings_.preview_photons, false);
        bake(settings_.photons, true);
    } catch (const std::exception& failure) {
        const std::lock_guard lock(mutex_);
        if (!board_.is_cancelled()) message_ = failure.what();
    }
    const std::lock_guard lock(mutex_);
    done_ = true;
}

void Baking::bake(uint64_t photons, bool is_full) {
    {
        const std::lock_guard lock(mutex_);
        renderer_ = is_full ? "" : "preview: ";
    }
    PhotonMap map = lw::bake(scene_, caster_, {.photons = photons});
    if (board_.is_cancelled()) throw Error("cancelled");
    std::string trouble;
    if (is_full && !settings_.output.empty()) {
        board_.set("saving", 0);
        try {
            save_photon_map(settings_.output, map);
        } catch (const Error& failure) {
            trouble = std::string(failure.what()) + "; the map is used, but not kept";
        }
    }
    const std::lock_guard lock(mutex_);
    ready_ = std::move(map);
    if (!trouble.empty()) message_ = trouble;
}

std::optional<PhotonMap> Baking::take() {
    const std::lock_guard lock(mutex_);
    std::optional<PhotonMap> map;
    std::swap(map, ready_);
    return map;
}

std::optional<ProgressBoard::State> Baking::progress() const {
    const std::lock_guard lock(mutex_);
    if (done_) return std::nullopt;
    ProgressBoard::State state = board_.state();
    state.what = renderer_ + state.what;
    return state;
}

std::string Baking::take_message() {
    const std::lock_guard lock(mutex_);
    std::string message;
    std::swap(message, message_);
    return message;
}

}  // namespace lw
