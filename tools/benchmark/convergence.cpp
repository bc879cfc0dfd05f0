// Error against photons, with the neighbours that make an estimate converge, and with the default gather.
#include <cmath>

#include "accuracy.h"
#include "maps/build.h"
#include "rooms.h"
#include "scene/gltf.h"
#include "sections.h"

namespace lw {
namespace {

struct Subject {
    std::string name;
    Scene scene;
    uint side;
    uint64_t samples;  // of the reference
};

/// What is gathered from a number of photons.
struct Series {
    const char* name;
    bool direct_in_photons;
    uint mode, neighbours;
    bool widens;  // the search radius follows N^(-1/6), so that an estimate has N^(2/3) photons; else N^(-1/2)
};

constexpr Series series[] = {
    {"smooth, radius as N^(-1/6), photons hold all light", true, gather_mode_smooth, 1'000'000, true},
    {"smooth, k = 200, photons hold all light", true, gather_mode_smooth, 200, false},
    {"cached, the default", false, gather_mode_cached, 300, false},
};

/// The radius of a disc that holds 250 photons at their mean density, m.
float mean_radius(const Scene& scene, uint64_t photons) {
    return float(std::sqrt(250 * area_of(scene) / (double(lw_pi) * double(photons))));
}

std::vector<Row> measure_series(const Bench& bench, const Subject& subject, const Series& wanted) {
    const uint64_t most = bench.pick<uint64_t>(500'000, 4'000'000), least = most / 64;
    std::vector<Row> rows;
    for (uint64_t photons = least; photons <= most; photons *= 4) {
        BakeSettings bake;
        bake.photons = photons;
        bake.direct_in_photons = wanted.direct_in_photons;
        if (wanted.widens)
            bake.radius = mean_radius(subject.scene, least) * std::pow(float(photons) / float(least), -1.0f / 6);
        const BakedCase baked(subject.scene, bake, bench.folder);
        const ReferenceView view{baked.scene.cameras[0], subject.side, subject.side, subject.samples};
        const Image reference = cached_reference(bench.folder, baked.scene, *baked.caster, view);
        GatherSettings gather;
        gather.mode = wanted.mode;
        gather.neighbours = wanted.neighbours;
        const TimedFrame frame =
            CaseOnDevice(bench.device, baked).render(view.camera, {view.width, view.height, 3}, gather);
        rows.push_back({{"scene", subject.name},
                        {"series", wanted.name},
                        {"photons", baked.photons.records.size()},
                        {"radius_m", baked.map.settings.radius},
                        {"total_ms", frame.total_ms()}});
        add_error(rows.back(), error_of(frame.rendering.image, reference, Quantity::illuminance));
    }
    return rows;
}

}  // namespace

std::vector<Table> measure_convergence(const Bench& bench) {
    const std::vector<Subject> subjects{{"cornell.gltf", load_gltf(bench.scenes / "cornell.gltf"),
                                         bench.pick(128u, 256u), bench.pick<uint64_t>(256, 512)},
                                        {"room", make_room({}), bench.pick(128u, 500u), bench.pick<uint64_t>(64, 512)}};
    Table table{
        "convergence",
        "photons",
        "Error of illuminance against photons. The search radius of a bake follows N^(-1/2), so that frames cost the "
        "same and shadows sharpen with N; the noise of an estimate stays. With a radius as N^(-1/6) an estimate has "
        "N^(2/3) photons: its noise falls as N^(-1/3), as does the blur of smooth light; "
        "edges blur over a width as N^(-1/6), and their RMSE falls as the root of it.",
        {}};
    for (const Subject& subject : subjects)
        for (const Series& wanted : series)
            for (Row& row : measure_series(bench, subject, wanted)) table.rows.push_back(std::move(row));
    return {table};
}

}  // namespace lw
