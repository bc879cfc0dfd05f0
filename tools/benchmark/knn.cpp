// Figure 6 of the paper (Graglia, Sequeira, Mavromatis: Real-Time Walkthrough Rendering, 2012): time of the k nearest
// photons against photon count, four structures, one thread.
#include <cmath>

#include "base/error.h"
#include "rooms.h"
#include "scene/triangle.h"
#include "sections.h"
#include "visible_points.h"

namespace lw {
namespace {

constexpr uint wanted = 50;  // k
constexpr uint side = 500;   // pixels of the view whose points are queries

/// Every `stride`-th visible point on walls and boxes, in image order.
std::vector<Query> flat_queries(const BakedCase& baked, size_t stride) {
    std::vector<Query> queries;
    size_t seen = 0;
    for (const VisiblePoint& p :
         visible_points(baked.scene, *baked.caster, baked.map, baked.scene.cameras[0], side, side)) {
        const std::string& object = baked.scene.object_names[baked.scene.triangle_objects[p.triangle]];
        const bool flat = object == "walls" || object == "furniture";
        if (flat && p.grid != no_grid && seen++ % stride == 0) queries.push_back(p.query());
    }
    return queries;
}

struct Agreement {
    size_t checked = 0, same_distances = 0, same_sets = 0;
    double largest_difference = 0;  // of r_k, m
};

std::vector<NearestPhotons::Entry> sorted_entries(const NearestPhotons& nearest) {
    std::vector<NearestPhotons::Entry> entries = nearest.entries();
    std::sort(entries.begin(), entries.end());
    return entries;
}

/// Positions in a grid are steps of its quantum: everything is compared within two steps' diagonal.
float tolerance_of(const PhotonMap& map, const Query& query) { return 2 * length(map.grids[query.grid].quantum); }

/// Whether each photon of `a` has one of `b` at its place; photons as far as the k-th may have changed places.
template <class A, class B>
bool same_set(const Query& query, const A& a, const std::vector<NearestPhotons::Entry>& found_a, const B& b,
              const std::vector<NearestPhotons::Entry>& found_b, float tolerance) {
    if (found_a.size() != found_b.size()) return false;
    if (found_a.empty()) return true;
    const float farthest = std::sqrt(found_a.back().distance_squared) - tolerance;
    for (const auto& entry : found_a) {
        if (std::sqrt(entry.distance_squared) >= farthest) break;
        const vec3 position = a.position(query, entry.index);
        const bool found = std::any_of(found_b.begin(), found_b.end(), [&](const auto& other) {
            return length(b.position(query, other.index) - position) <= tolerance;
        });
        if (!found) return false;
    }
    return true;
}

/// Compares `structure` with the grid of the maps at every `stride`-th query.
template <class Structure>
Agreement agreement_of(const BakedCase& baked, const std::vector<Query>& queries, const Structure& structure,
                       size_t stride) {
    const GridSearch grid(baked.map);
    NearestPhotons ours, theirs;
    Agreement agreement;
    for (size_t i = 0; i < queries.size(); i += stride) {
        const float radius = baked.map.grids[queries[i].grid].radius;
        ours.start(wanted, radius * radius), theirs.start(wanted, radius * radius);
        grid.find(queries[i], ours), structure.find(queries[i], theirs);
        const auto a = sorted_entries(ours), b = sorted_entries(theirs);
        const float tolerance = tolerance_of(baked.map, queries[i]);
        bool distances = a.size() == b.size();
        for (size_t n = 0; distances && n < a.size(); ++n)
            distances = std::fabs(std::sqrt(a[n].distance_squared) - std::sqrt(b[n].distance_squared)) <= tolerance;
        ++agreement.checked;
        agreement.same_distances += distances;
        agreement.same_sets += same_set(queries[i], grid, a, structure, b, tolerance);
        if (ours.full() && theirs.full())
            agreement.largest_difference = std::max(
                agreement.largest_difference, std::fabs(double(std::sqrt(ours.bound()) - std::sqrt(theirs.bound()))));
    }
    return agreement;
}

template <class Structure>
double search_ms(const BakedCase& baked, const std::vector<Query>& queries, const Structure& structure, unsigned runs) {
    NearestPhotons nearest;
    return median_ms(runs, [&] {
        for (const Query& query : queries) {
            const float radius = baked.map.grids[query.grid].radius;
            nearest.start(wanted, radius * radius);
            structure.find(query, nearest);
        }
    });
}

/// Builds and measures one structure; `make()` returns a pointer to it.
template <class Make>
Row measure_structure(const Bench& bench, const BakedCase& baked, const std::vector<Query>& queries, const char* name,
                      const Make& make) {
    decltype(make()) structure;
    const Cost build = cost_of([&] { structure = make(); });
    const double ms = search_ms(baked, queries, *structure, bench.pick(3u, 5u));
    const Agreement agreement = agreement_of(baked, queries, *structure, bench.pick<size_t>(10, 50));
    const auto share = [&](size_t n) { return 100 * double(n) / double(std::max<size_t>(1, agreement.checked)); };
    return {{"photons", baked.photons.records.size()},
            {"structure", name},
            {"build_s", build.seconds},
            {"queries", queries.size()},
            {"knn_ms", ms},
            {"us_per_query", 1e3 * ms / double(queries.size())},
            {"same_distances_%", share(agreement.same_distances)},
            {"same_sets_%", share(agreement.same_sets)},
            {"largest_difference_of_r_k_mm", 1e3 * agreement.largest_difference}};
}

/// Radius that holds k photons at the mean density of the scene, m.
float mean_radius(const Scene& scene, size_t photons) {
    double area = 0;
    for (size_t t = 0; t < scene.triangles.size(); ++t) area += triangle_area(scene, t);
    return float(std::sqrt(wanted * area / (double(lw_pi) * double(photons))));
}

std::vector<Row> measure_count(const Bench& bench, uint64_t photons) {
    BakeSettings bake;
    bake.photons = photons;
    bake.direct_in_photons = true;
    const BakedCase baked(make_room({}), bake, bench.folder);
    const std::vector<Query> queries = flat_queries(baked, bench.pick<size_t>(12, 1));
    const PhotonCloud cloud(baked.scene, baked.photons.records);
    const float cell = mean_radius(baked.scene, cloud.positions.size());
    std::vector<Row> rows;
    rows.push_back(measure_structure(bench, baked, queries, "2D grid of the maps",
                                     [&] { return std::make_unique<GridSearch>(baked.map); }));
    rows.back()["build_s"] = baked.cost.maps.seconds;
    rows.push_back(measure_structure(bench, baked, queries, "2D kd-tree per map",
                                     [&] { return std::make_unique<GridTreeSearch>(baked.map); }));
    rows.push_back(measure_structure(bench, baked, queries, "3D kd-tree",
                                     [&] { return std::make_unique<GlobalTreeSearch>(cloud, baked.map); }));
    rows.push_back(measure_structure(bench, baked, queries, "3D hash grid",
                                     [&] { return std::make_unique<HashGridSearch>(cloud, baked.map, cell); }));
    for (Row& row : rows) row["times_the_grid"] = row["knn_ms"].get<double>() / rows[0]["knn_ms"].get<double>();
    return rows;
}

}  // namespace

std::vector<Table> measure_knn(const Bench& bench) {
    Table table{
        "knn",
        "figure6",
        "Figure 6: k = 50 nearest photons, one thread, queries at what the pixels of a 500x500 view see of "
        "walls and boxes; furnished room of 100,000 triangles, all light in photons. The same photons, queries "
        "and rules for all; trees and hash grid keep a heap, the 2D grid selects once. Agreement with the 2D grid "
        "within "
        "two steps of its 16-bit coordinates. The "
        "grid's build is the whole of the maps. Cells of the 3D hash grid are as wide as r_50 at mean density. With "
        "few photons the radius reaches the sculptures, about which a map decides once and a 3D search at each query: "
        "those queries differ."
        " Speeds of searches without error: the error of the gather is in the other sections.",
        {}};
    const std::vector<uint64_t> counts = bench.quick ? std::vector<uint64_t>{100'000, 300'000, 1'000'000}
                                                     : std::vector<uint64_t>{250'000, 1'000'000, 4'000'000, 16'000'000};
    for (uint64_t photons : counts)
        for (Row& row : measure_count(bench, photons)) table.rows.push_back(std::move(row));
    return {table};
}

}  // namespace lw
