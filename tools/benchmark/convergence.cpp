// Error against photons, with the neighbours that make an estimate converge, and with the default gather.
#include <cmath>

#include "accuracy.h"
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
    uint mode;
    double neighbours;  // at the most photons
    double exponent;    // of the photons in the neighbours
};

constexpr Series series[] = {
    {"smooth, k as N^(2/3), photons hold all light", true, gather_mode_smooth, 2000, 2.0 / 3},
    {"smooth, k = 500, photons hold all light", true, gather_mode_smooth, 500, 0},
    {"cached, the default", false, gather_mode_cached, 300, 0},
};

std::vector<Row> measure_series(const Bench& bench, const Subject& subject, const Series& wanted) {
    const uint64_t most = bench.pick<uint64_t>(500'000, 4'000'000);
    std::vector<Row> rows;
    for (uint64_t photons = most / 64; photons <= most; photons *= 4) {
        BakeSettings bake;
        bake.photons = photons;
        bake.direct_in_photons = wanted.direct_in_photons;
        const BakedCase baked(subject.scene, bake, bench.folder);
        const ReferenceView view{baked.scene.cameras[0], subject.side, subject.side, subject.samples};
        const Image reference = cached_reference(bench.folder, baked.scene, *baked.caster, view);
        GatherSettings gather = default_gather();
        gather.mode = wanted.mode;
        gather.neighbours =
            uint(std::lround(wanted.neighbours * std::pow(double(photons) / double(most), wanted.exponent)));
        const TimedFrame frame =
            CaseOnDevice(bench.device, baked).render(view.camera, {view.width, view.height, 3}, gather);
        rows.push_back({{"scene", subject.name},
                        {"series", wanted.name},
                        {"photons", baked.photons.records.size()},
                        {"k", gather.neighbours},
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
        "Error of illuminance against photons. An estimate from k of N photons converges as N^(-1/3) when k follows "
        "N^(2/3), in the limit of many photons: noise falls as k^(-1/2), the blur of borders and shadows as the "
        "radius squared or, at edges of shadows, as its root.",
        {}};
    for (const Subject& subject : subjects)
        for (const Series& wanted : series)
            for (Row& row : measure_series(bench, subject, wanted)) table.rows.push_back(std::move(row));
    return {table};
}

}  // namespace lw
