// The gather modes: milliseconds of each pass, candidates, bytes, and errors, at several numbers of neighbours.
#include <algorithm>

#include "accuracy.h"
#include "counting_estimator.h"
#include "rooms.h"
#include "scene/camera.h"
#include "scene/gltf.h"
#include "sections.h"
#include "visible_points.h"

namespace lw {
namespace {

/// Photons tested at a point. The exact search reads each accepted photon once more when it is added.
double candidates(const CountingEstimator& estimator, const VisiblePoint& p, bool exact) {
    const uint64_t before = estimator.counted.of(Record::photon);
    const Gathered sum = estimator.gather_photons(estimator.place_on_grid(p.grid, p.surface.position), p.surface,
                                                  p.geometric_normal, p.shading_normal, p.to_view);
    return double(estimator.counted.of(Record::photon) - before) - (exact ? double(sum.photons) : 0.0);
}

double mean_candidates(const BakedCase& baked, const std::vector<VisiblePoint>& points, const GatherSettings& gather) {
    const CountingEstimator estimator(baked.scene, baked.map, baked.weights, gather);
    double sum = 0;
    size_t count = 0;
    for (size_t i = 0; i < points.size(); i += 17, ++count)
        sum += candidates(estimator, points[i], gather.mode == gather_mode_exact);
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

std::vector<uint> neighbours_of(const MeasuredMode& mode, bool quick) {
    const std::vector<uint> wanted = quick ? std::vector<uint>{50, 500} : std::vector<uint>{50, 200, 500};
    std::vector<uint> allowed;
    for (uint k : wanted)
        if (k <= mode.max_neighbours && !(quick && mode.mode == gather_mode_exact && k > 50)) allowed.push_back(k);
    return allowed;
}

Row mode_row(const View& view, const BakedCase& baked, const MeasuredMode& mode, uint k, const TimedFrame& frame) {
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
    for (const MeasuredMode& mode : measured_modes()) {
        if (view.cached_only && mode.mode != gather_mode_cached) continue;
        for (uint k : neighbours_of(mode, bench.quick)) {
            const GatherSettings gather{mode.mode, k, mode.shadow_rays};
            const uint frames = mode.mode == gather_mode_cached ? 15 : 3;  // milliseconds, or up to seconds
            const TimedFrame frame = on_device.render(seen.camera, {view.width, view.height, frames}, gather);
            rows.push_back(mode_row(view, baked, mode, k, frame));
            if (mode.mode != gather_mode_cached)
                rows.back()["candidates_per_pixel"] = mean_candidates(baked, points, gather);
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
    for (View& view : views_of(bench)) {
        for (Row& row : measure_view(bench, std::move(view))) modes.rows.push_back(std::move(row));
    }
    return {modes};
}

}  // namespace lw
