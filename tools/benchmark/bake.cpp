// Seconds of the bake's phases, and photon tracing beside the raw rate of incoherent rays in the same scene.
#include <algorithm>

#include "base/parallel.h"
#include "rooms.h"
#include "scene/gltf.h"
#include "sections.h"
#include "trace/sampling.h"

namespace lw {
namespace {

/// Rays that photon tracing followed: one per stored photon, and one per path whose direct photon is not stored. A
/// lower bound: mirrors, escapes after a bounce and pilots are not counted.
double traced_rays(const BakedCase& baked) {
    double rays = double(baked.photons.records.size());
    if (baked.map.settings.direct_in_photons) return rays;
    for (const LightBalance& lamp : baked.photons.lights) rays += double(lamp.emitted);
    return rays;
}

struct Ray {
    vec3 origin, direction;
};

/// Cosine-distributed rays from photons in random order: as incoherent as photons after a bounce.
std::vector<Ray> bounced_rays(const BakedCase& baked, size_t count) {
    const std::vector<Photon>& photons = baked.photons.records;
    const SurfaceReader surfaces(baked.scene);
    std::vector<Ray> rays(count);
    for (size_t i = 0; i < count; ++i) {
        Rng rng(7, 0, i);
        const Photon& photon = photons[size_t(rng.next() * float(photons.size() - 1))];
        const vec3 front = surfaces.surface_at(photon.triangle, vec2(1.0f / 3)).geometric_normal;
        const vec3 normal = photon.side() ? -front : front;
        rays[i] = {baked.caster->offset(photon.position, normal),
                   frame_around(normal) * sample_cosine(rng.next(), rng.next())};
    }
    return rays;
}

/// Millions of nearest hits a second, all threads, nothing but the caster.
double raw_rays_per_second(const BakedCase& baked, size_t count) {
    const std::vector<Ray> rays = bounced_rays(baked, count);
    std::vector<float> reached(count);
    const double ms = median_ms(3, [&] {
        parallel_for(
            count,
            [&](size_t i) {
                const auto hit = baked.caster->nearest(rays[i].origin, rays[i].direction);
                reached[i] = hit ? hit->distance : 0;
            },
            1024);
    });
    return double(count) / (1e3 * ms);
}

/// The last of `runs` bakes, with the cost of the run of median CPU time.
std::unique_ptr<BakedCase> bake_repeatedly(const Bench& bench, const Scene& scene, const BakeSettings& settings) {
    std::vector<BakeCost> costs;
    std::unique_ptr<BakedCase> baked;
    for (unsigned run = 0; run < bench.pick(1u, 5u); ++run) {
        baked.reset();
        baked = std::make_unique<BakedCase>(scene, settings, bench.folder);
        costs.push_back(baked->cost);
    }
    const auto cpu = [](const BakeCost& c) { return c.trace.cpu_seconds + c.maps.cpu_seconds + c.write.cpu_seconds; };
    std::sort(costs.begin(), costs.end(), [&](const auto& a, const auto& b) { return cpu(a) < cpu(b); });
    baked->cost = costs[costs.size() / 2];
    return baked;
}

void add_phase(Row& row, const std::string& name, const Cost& cost) {
    row[name + "_s"] = cost.seconds;
    row[name + "_cpu_s"] = cost.cpu_seconds;
}

Row row_of(const BakedCase& baked, const std::string& name, size_t raw_rays) {
    Row row{{"scene", name}, {"triangles", baked.scene.triangles.size()}, {"photons", baked.photons.records.size()}};
    add_phase(row, "hierarchy", baked.cost.hierarchy);
    add_phase(row, "trace", baked.cost.trace);
    add_phase(row, "maps", baked.cost.maps);
    add_phase(row, "write", baked.cost.write);
    row["trace_maps_write_cpu_s"] =
        baked.cost.trace.cpu_seconds + baked.cost.maps.cpu_seconds + baked.cost.write.cpu_seconds;
    row["load_s"] = baked.cost.load.seconds;
    row["disk_bytes_per_photon"] = double(baked.cost.file_bytes) / double(baked.photons.records.size());
    row["bytes_per_photon"] = bytes_per_photon(baked.map);
    row["references_per_photon"] = references_per_photon(baked.map);
    row["peak_memory_mb"] = baked.cost.peak_memory_mb;
    row["added_memory_mb"] = baked.cost.added_memory_mb;
    const double raw = raw_rays_per_second(baked, raw_rays);
    const double photon_rays = traced_rays(baked) / baked.cost.trace.seconds / 1e6;
    row["photon_Mrays_per_s"] = photon_rays;
    row["raw_Mrays_per_s"] = raw;
    row["tracing_share_of_raw_%"] = 100 * photon_rays / raw;
    return row;
}

}  // namespace

std::vector<Table> measure_bake(const Bench& bench) {
    BakeSettings settings;
    settings.photons = bench.pick<uint64_t>(500'000, 4'000'000);
    const size_t raw_rays = bench.pick<size_t>(1'000'000, 4'000'000);
    Table table{"bake",
                "phases",
                "Seconds (wall, and CPU of all threads) of the bake; raw rays are incoherent cosine-distributed "
                "nearest-hit queries through the same caster from the photons' places. A photon ray is a stored photon "
                "or an unstored direct one; the pilots of the emission are in the seconds, not in the rays.",
                {}};
    for (const Tessellation kind : {Tessellation::mixed, Tessellation::uniform}) {
        RoomSettings room;
        room.tessellation = kind;
        const auto baked = bake_repeatedly(bench, make_room(room), settings);
        table.rows.push_back(row_of(*baked, std::string("room, ") + name_of(kind), raw_rays));
    }
    const auto apartment = bake_repeatedly(bench, load_gltf(bench.scenes / "apartment.glb"), settings);
    table.rows.push_back(row_of(*apartment, "apartment.glb", raw_rays));
    return {table};
}

}  // namespace lw
