// Dimming: what a frame costs in which one lamp, or all lamps, have another power, beside a frame in which nothing
// changes; and how far light that was added lamp by lamp is from a whole sum.
#include <algorithm>
#include <cmath>

#include "gather/frame_renderer.h"
#include "gather/renderer.h"
#include "gpu/commands.h"
#include "scene/camera.h"
#include "scene/gltf.h"
#include "sections.h"
#include "trace/build_bvh.h"

namespace lw {
namespace {

constexpr vk::Extent2D pixels{960, 540};

/// The apartment with as many lamps: point lamps of 100 cd are added in rows under the ceiling of the living room.
Scene with_lamps(Scene scene, size_t lamps) {
    const vec3 first = find_camera(scene, "living").position + vec3(-1.5f, 0.6f, -1.5f);
    for (size_t i = 0; scene.lights.size() < lamps; ++i) {
        Light light{};
        light.type = light_point;
        light.intensity = vec3(100);
        light.position = first + vec3(0.35f * float(i % 8), 0, 0.35f * float(i / 8));
        light.direction = vec3(0, -1, 0);
        scene.lights.push_back(light);
        scene.light_names.push_back("added_" + std::to_string(i));
        scene.light_groups.emplace_back();
    }
    return scene;
}

/// Frames in motion of one baked scene, without a window.
class Frames {
  public:
    Frames(const Device& device, const BakedCase& baked)
        : device_(device),
          bvh_(build_bvh(baked.scene)),
          resident_(device, baked.scene, baked.map, bvh_),
          live_(device, resident_, pixels),
          camera_(find_camera(baked.scene, "living")),
          factors_(baked.scene.lights.size(), vec3(1)) {}

    /// Milliseconds from the first command to the end of the last one; `change` alters the factors before.
    template <class Change>
    double frame_ms(const Change& change) {
        change(factors_);
        return 1000 * cost_of([&] {
                          submit_and_wait(device_, [&](vk::CommandBuffer commands) {
                              resident_.record_lamp_factors(commands, factors_, 0, false);
                              Frame frame = make_frame(camera_, pixels, 0, 1);
                              live_.record_visibility(commands, frame);
                              GatherSettings without_rays;
                              without_rays.shadow_rays = 0;
                              live_.record_light(commands, frame, without_rays, FrameRenderer::Side::a);
                              live_.record_view(commands, {}, {}, 0);
                          });
                      }).seconds;
    }
    template <class Change>
    double median_frame_ms(const Change& change) {
        std::vector<double> times;
        for (int i = 0; i < 11; ++i) times.push_back(frame_ms(change));
        return median(times);
    }

    /// RMS difference of the picture from that with all lamps summed anew, in parts of its mean.
    double error_of_added() {
        const std::vector<float> added = lux();
        submit_and_wait(
            device_, [&](vk::CommandBuffer commands) { resident_.record_lamp_factors(commands, factors_, 0, true); });
        frame_ms([](auto&) {});
        const std::vector<float> whole = lux();
        double difference = 0, sum = 0;
        for (size_t i = 0; i < whole.size(); ++i) {
            difference += std::pow(double(added[i]) - double(whole[i]), 2);
            sum += double(whole[i]);
        }
        return std::sqrt(difference / double(whole.size())) / (sum / double(whole.size()));
    }
    uint64_t bytes() const { return resident_.bytes(); }

  private:
    std::vector<float> lux() const { return live_.read_values(camera_, pixels, 1).find("illuminance")->values; }

    const Device& device_;
    Bvh bvh_;
    Resident resident_;
    FrameRenderer live_;
    Camera camera_;
    std::vector<vec3> factors_;
};

Row measure_lamps(const Bench& bench, size_t lamps, uint64_t photons) {
    const Scene scene = with_lamps(load_gltf(bench.scenes / "apartment.glb"), lamps);
    const BakedCase baked(scene, {.photons = photons}, bench.folder);
    Frames frames(bench.device, baked);
    frames.frame_ms([](auto& factors) { factors[0] *= 0.9f; });  // memory of a first change
    const double still = frames.median_frame_ms([](auto&) {});
    size_t turn = 0;
    const double one = frames.median_frame_ms([&](auto& factors) {
        factors[turn % factors.size()] *= turn % 2 ? 1.25f : 0.8f;
        ++turn;
    });
    const double error = frames.error_of_added();
    const double all = frames.median_frame_ms([&](auto& factors) {
        for (vec3& factor : factors) factor *= turn % 2 ? 1.25f : 0.8f;
        ++turn;
    });
    return {{"lamps", lamps},
            {"photons", baked.photons.records.size()},
            {"nodes", baked.map.coverage.size()},
            {"still_ms", still},
            {"one_lamp_ms", one},
            {"one_lamp_over_still", one / still},
            {"all_lamps_ms", all},
            {"added_error_percent", 100 * error},
            {"device_mb", double(frames.bytes()) / 1e6}};
}

}  // namespace

std::vector<Table> measure_dimming(const Bench& bench) {
    Table table{
        "dimming",
        "frames",
        "Frames of the apartment (camera living) at 960x540 without shadow rays, from recording to the end on the "
        "device, "
        "medians of 11: while nothing changes, with another power of one lamp in each frame, and of all "
        "lamps. Lamps beyond the nine of the file are points of 100 cd. The error is the RMS difference in "
        "illuminance of the picture after 11 single changes from that with all lamps summed anew, in percent of "
        "the mean.",
        {}};
    const auto photons = bench.pick<uint64_t>(100'000, 4'000'000);
    for (size_t lamps : {9, 64}) table.rows.push_back(measure_lamps(bench, lamps, photons));
    return {table};
}

}  // namespace lw
