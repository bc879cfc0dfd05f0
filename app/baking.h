// Bakes a map while the user already walks: a preview with few photons first, then the full map, which is saved beside
// the scene. Runs on a thread of its own; results are taken when they are ready.
#pragma once
#include <thread>

#include "base/progress.h"
#include "maps/photon_map.h"
#include "trace/ray_caster.h"

namespace lw {

class Baking {
  public:
    struct Settings {
        uint64_t preview_photons = 100'000;  // 0: no preview
        uint64_t photons = 1'000'000;
        std::filesystem::path output;  // where the full map is saved
    };

    /// Scene and caster must outlive it.
    Baking(const Scene& scene, const RayCaster& caster, Settings settings);
    /// Cancels what is still running and waits for it.
    ~Baking();
    Baking(const Baking&) = delete;
    Baking& operator=(const Baking&) = delete;

    /// A finished map, once each: the preview, then the full one.
    std::optional<PhotonMap> take();
    /// What runs at the moment, with 0 to 1 of the whole; none when all is done.
    std::optional<ProgressBoard::State> progress() const;
    /// What went wrong since the last call ("" if nothing): a bake that failed, or a map that could not be saved.
    std::string take_message();

  private:
    void run();
    void bake(uint64_t photons, bool is_full);

    const Scene& scene_;
    const RayCaster& caster_;
    Settings settings_;
    ProgressBoard board_;
    mutable std::mutex mutex_;
    std::optional<PhotonMap> ready_;
    std::string message_;
    std::string renderer_;
    bool done_ = false;
    std::thread thread_;
};

}  // namespace lw
