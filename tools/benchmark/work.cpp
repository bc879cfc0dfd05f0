// What a frame reads and tests, counted: what bounds it on a device that is not there to be measured.
#include "accuracy.h"
#include "counting_estimator.h"
#include "rooms.h"
#include "scene/camera.h"
#include "scene/gltf.h"
#include "sections.h"
#include "trace/build_bvh.h"
#include "visible_points.h"

namespace lw {
namespace {

/// Visibility (16 bytes written and read), light (16 written and read), screen (4 written).
constexpr double bytes_of_passes = 16 + 16 + 16 + 16 + 4;
constexpr double device_bytes_per_ms = 1e9;  // 1 TB/s

struct Counted {
    std::string scene, camera;
    bool direct_in_photons;
    GatherSettings gather;
};

double per_pixel(uint64_t reads, size_t pixels) { return double(reads) / double(pixels); }

Row count_of(const Counted& counted, const BakedCase& baked, const Bvh& bvh, uint side, size_t step) {
    const CountingEstimator estimator(baked.scene, baked.map, baked.powers, counted.gather, bvh);
    const Camera camera = find_camera(baked.scene, counted.camera);
    const auto points = visible_points(baked.scene, *baked.caster, baked.map, camera, side, side);
    size_t pixels = 0;
    for (size_t i = 0; i < points.size(); i += step, ++pixels)
        estimator.shade(points[i].triangle, points[i].barycentrics, camera.position, uint(i),
                        uvec2(points[i].pixel % side, points[i].pixel / side));
    const Reads& reads = estimator.counted;
    const double bytes = bytes_of_passes + reads.bytes() / double(pixels);
    Row row{{"scene", counted.scene},
            {"direct", counted.direct_in_photons ? "photons" : "exact"},
            {"mode", gather_mode(counted.gather.mode).name},
            {"k", counted.gather.neighbours},
            {"shadow_rays", counted.gather.shadow_rays},
            {"surfaces", per_pixel(reads.of(Record::surface), pixels)},
            {"cells", per_pixel(reads.of(Record::cell), pixels)},
            {"photons_tested", per_pixel(reads.of(Record::photon), pixels)},
            {"boxes_tested", per_pixel(reads.of(Record::box), pixels)},
            {"triangles_tested", per_pixel(reads.of(Record::triangle), pixels)},
            {"bytes_per_pixel", bytes}};
    for (const auto& [name, count] : {std::pair("500x500", 500.0 * 500), std::pair("1920x1080", 1920.0 * 1080),
                                      std::pair("3840x2160", 3840.0 * 2160)})
        row[std::string(name) + "_ms"] = bytes * count / device_bytes_per_ms;
    return row;
}

}  // namespace

std::vector<Table> measure_work(const Bench& bench) {
    const GatherSettings paper{gather_mode_exact, 50}, smooth{gather_mode_smooth, 50},
        moving{gather_mode_cached, 300, 0};
    Table table{
        "work",
        "pixels",
        "Records that the text of the gather reads at every 17th pixel of 500x500, counted on the CPU, and the "
        "milliseconds that a frame takes where each read goes to a memory of 1 TB/s: none is served by a cache. The "
        "rasterizer's own work is not in it. Measured instead of counted where there is a GPU: "
        "lumenwalk-benchmark --only table1 --only modes.",
        {}};
    for (const std::string scene : {"room", "apartment.glb"})
        for (const bool direct_in_photons : {false, true}) {
            BakeSettings bake;
            bake.photons = bench.pick<uint64_t>(500'000, 4'000'000);
            bake.direct_in_photons = direct_in_photons;
            const bool is_room = scene == "room";
            const BakedCase baked(is_room ? make_room({}) : load_gltf(bench.scenes / scene), bake, bench.folder);
            const Bvh bvh = direct_in_photons ? Bvh{} : build_bvh(baked.scene);
            for (const GatherSettings& gather : {GatherSettings{}, moving, smooth, paper})
                table.rows.push_back(count_of({scene, is_room ? "" : "living", direct_in_photons, gather}, baked, bvh,
                                              500, bench.pick<size_t>(170, 17)));
        }
    return {table};
}

}  // namespace lw
