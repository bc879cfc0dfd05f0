// The gather modes: milliseconds of each pass, candidates, bytes, and errors, at several numbers of neighbours.
#include <algorithm>

#include "accuracy.h"
#include "base/parallel.h"
#include "rooms.h"
#include "scene/camera.h"
#include "scene/gltf.h"
#include "sections.h"
#include "visible_points.h"

namespace lw {
namespace {

/// The estimator's text once more, over a photon_place that counts how often it is read.
class CountingEstimator : public PhotonEstimator {
  public:
    using PhotonEstimator::PhotonEstimator;

    PhotonPlace photon_place(uint i) const {
        ++reads_;
        return PhotonEstimator::photon_place(i);
    }
#include "shaders/gather.glsl"

    /// Photons tested at a point. The exact search reads each accepted photon once more when it is added.
    double candidates(const VisiblePoint& p) {
        reads_ = 0;
        const Gathered sum = gather_photons(place_on(p.map, p.surface.position), p.surface, p.geometric_normal,
                                            p.shading_normal, p.to_view);
        return double(reads_) - (gather_mode == gather_mode_exact ? double(sum.photons) : 0.0);
    }

  private:
    mutable uint64_t reads_ = 0;
};

double mean_candidates(const BakedCase& baked, const std::vector<VisiblePoint>& points, const GatherSettings& gather) {
    CountingEstimator estimator(baked.scene, baked.map, baked.weights, gather);
    double sum = 0;
    size_t count = 0;
    for (size_t i = 0; i < points.size(); i += 17, ++count) sum += estimator.candidates(points[i]);
    return count ? sum / double(count) : 0;
}

struct View {
    std::string scene_name, camera;
    Scene scene;
    uint width, height;
    uint64_t photons;
    uint64_t samples;
    bool cached_only = false;  // exact direct light and the modes that read the lattice
};

std::vector<uint> neighbours_of(const GatherMode& mode, bool quick) {
    const std::vector<uint> wanted = quick ? std::vector<uint>{50, 500} : std::vector<uint>{50, 200, 500};
    std::vector<uint> allowed;
    for (uint k : wanted)
        if (k <= mode.most && !(quick && mode.mode == 0 && k > 50)) allowed.push_back(k);
    return allowed;
}

Row mode_row(const View& view, const BakedCase& baked, const GatherMode& mode, uint k, const TimedFrame& frame) {
    const PassTimes& times = frame.rendering.times;
    return {{"scene", view.scene_name},
            {"pixels", std::to_string(view.width) + "x" + std::to_string(view.height)},
            {"photons", baked.photons.records.size()},
            {"direct", baked.map.settings.direct_in_photons ? "photons" : "exact"},
            {"mode", mode.name},
            {"k", k},
            {"visibility_ms", times.visibility_ms},
            {"gather_ms", times.gather_ms},
            {"tonemap_ms", times.tonemap_ms},
            {"total_ms", frame.total_ms()},
            {"bytes_per_photon", bytes_per_photon(baked.map)}};
}

std::vector<Row> measure_case(const Bench& bench, const View& view, const BakedCase& baked) {
    const ReferenceView seen{find_camera(baked.scene, view.camera), view.width, view.height, view.samples};
    const Image reference = cached_reference(bench.folder, baked.scene, *baked.caster, seen);
    const std::vector<bool> border = border_pixels(baked.scene, *baked.caster, seen);
    const std::vector<bool> gathered = gathered_pixels(baked.scene, *baked.caster, seen);
    const auto points = visible_points(baked.scene, *baked.caster, baked.map, seen.camera, view.width, view.height);
    const CaseOnDevice on_device(bench.device, baked);
    std::vector<Row> rows;
    for (const GatherMode& mode : gather_modes()) {
        if (view.cached_only && mode.mode != gather_mode_cached) continue;
        for (uint k : neighbours_of(mode, bench.quick)) {
            const GatherSettings gather{mode.mode, k, mode.shadow_rays};
            const uint frames = mode.mode == gather_mode_cached ? 15 : 3;  // milliseconds, or up to seconds
            const TimedFrame frame = on_device.render(seen.camera, {view.width, view.height, frames}, gather);
            rows.push_back(mode_row(view, baked, mode, k, frame));
            if (mode.on_cpu) rows.back()["candidates_per_pixel"] = mean_candidates(baked, points, gather);
            add_error(rows.back(), error_of(frame.rendering.image, reference, Quantity::illuminance, border, gathered));
        }
    }
    return rows;
}

/// The scene baked with exact direct light, and the paper's way with all light in the photons.
std::vector<Row> measure_view(const Bench& bench, View view) {
    std::vector<Row> rows;
    for (bool direct_in_photons : {false, true}) {
        if (direct_in_photons && view.cached_only) continue;
        BakeSettings bake;
        bake.photons = view.photons;
        bake.direct_in_photons = direct_in_photons;
        const BakedCase baked(view.scene, bake, bench.folder);
        for (Row& row : measure_case(bench, view, baked)) rows.push_back(std::move(row));
    }
    return rows;
}

/// Error against photons at the default gather: the N^(-1/3) of a bandwidth that follows the density.
std::vector<Row> measure_convergence(const Bench& bench, const View& view) {
    std::vector<Row> rows;
    for (uint64_t photons = view.photons / 64; photons <= view.photons; photons *= 4) {
        BakeSettings bake;
        bake.photons = photons;
        const BakedCase baked(view.scene, bake, bench.folder);
        const ReferenceView seen{find_camera(baked.scene, view.camera), view.width, view.height, view.samples};
        const Image reference = cached_reference(bench.folder, baked.scene, *baked.caster, seen);
        const CaseOnDevice on_device(bench.device, baked);
        for (uint k : {50u, 200u, 500u}) {
            const TimedFrame frame =
                on_device.render(seen.camera, {view.width, view.height, 1}, {gather_mode_smooth, k});
            rows.push_back({{"scene", view.scene_name},
                            {"photons", baked.photons.records.size()},
                            {"k", k},
                            {"total_ms", frame.total_ms()}});
            add_error(rows.back(), error_of(frame.rendering.image, reference, Quantity::illuminance));
        }
    }
    return rows;
}

std::vector<View> views_of(const Bench& bench) {
    const auto photons = bench.pick<uint64_t>(500'000, 4'000'000);
    const auto samples = bench.pick<uint64_t>(64, 128);
    const uint side = bench.pick(128u, 500u);
    RoomSettings eight;
    eight.lights = 8;
    std::vector<View> views;
    views.push_back({"cornell.gltf", "", load_gltf(bench.scenes / "cornell.gltf"), bench.pick(128u, 256u),
                     bench.pick(128u, 256u), photons, 4 * samples});
    views.push_back({"room", "", make_room({}), side, side, photons, bench.pick<uint64_t>(64, 512)});
    views.push_back({"room, 8 lamps", "", make_room(eight), side, side, photons, samples, true});
    views.push_back({"room", "", make_room({}), bench.pick(160u, 1280u), bench.pick(90u, 720u), photons, 64, true});
    views.push_back({"apartment.glb", "living", load_gltf(bench.scenes / "apartment.glb"), bench.pick(160u, 320u),
                     bench.pick(90u, 180u), photons, bench.pick<uint64_t>(64, 1024)});
    return views;
}

}  // namespace

std::vector<Table> measure_modes(const Bench& bench) {
    const std::string errors =
        " Errors are of illuminance against the path tracer; rmse is without the reference's own noise, which was "
        "subtracted in quadrature. A border pixel sees a point within 10 cm of an edge or a contact of its surface. "
        "Mirrors and glass are left out: "
        "they keep no photons.";
    Table modes{"modes", "times", "Gather modes, medians of the device's timestamps." + errors, {}};
    Table convergence{"modes", "convergence", "Smooth gather, error against photons." + errors, {}};
    for (View& view : views_of(bench)) {
        if (!view.cached_only && view.scene_name != "apartment.glb")
            for (Row& row : measure_convergence(bench, view)) convergence.rows.push_back(std::move(row));
        for (Row& row : measure_view(bench, std::move(view))) modes.rows.push_back(std::move(row));
    }
    return {modes, convergence};
}

}  // namespace lw
