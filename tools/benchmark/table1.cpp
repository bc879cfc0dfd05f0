// Table 1 of the paper (Graglia, Sequeira, Mavromatis: Real-Time Walkthrough Rendering, 2012): 100,000 triangles,
// 4,000,000 photons, 500x500; global 3D kd-tree against the maps of triangles.
#include "accuracy.h"
#include "base/parallel.h"
#include "maps/estimate.h"
#include "rooms.h"
#include "sections.h"
#include "shaders/color.h"
#include "visible_points.h"

namespace lw {
namespace {

constexpr uint wanted = 50;  // k of the exact searches

/// What a search leaves for the integration: k places per point.
struct Found {
    std::vector<uint> indices;
    std::vector<uint> counts;
    std::vector<float> radius_squared;
    explicit Found(size_t points) : indices(points * wanted), counts(points), radius_squared(points) {}
};

template <class Structure>
void find_all(const PhotonMap& map, const std::vector<VisiblePoint>& points, const Structure& structure, Found& found) {
    parallel_for(
        points.size(),
        [&](size_t i) {
            thread_local NearestPhotons nearest;
            found.counts[i] = 0;
            if (points[i].grid == no_grid) return;
            const float radius = map.grids[points[i].grid].radius;
            nearest.start(wanted, radius * radius);
            structure.find(points[i].query(), nearest);
            found.radius_squared[i] = std::max(nearest.bound(), 1e-12f * radius * radius);
            const size_t first = nearest.full() ? 1 : 0;  // the k-th bounds the disc and is not counted
            for (size_t n = first; n < nearest.entries().size(); ++n)
                found.indices[i * wanted + found.counts[i]++] = nearest.entries()[n].index;
        },
        256);
}

/// Sums flux x BRDF over what was found; `add(index, kernel, point, sum)` adds one photon. Returns lux per pixel.
template <class AddPhoton>
void integrate_all(const std::vector<VisiblePoint>& points, const Found& found, const AddPhoton& add, Image& image) {
    std::vector<float>& lux = image.channels[0].values;
    parallel_for(
        points.size(),
        [&](size_t i) {
            Gathered sum{vec3(0), vec3(0), 0, 0};
            const float kernel = 1.0f / (lw_pi * found.radius_squared[i]);
            for (uint n = 0; n < found.counts[i]; ++n) add(found.indices[i * wanted + n], kernel, points[i], sum);
            lux[points[i].pixel] = luminance(sum.irradiance);
        },
        256);
}

struct Subject {
    const Bench& bench;
    const BakedCase& baked;
    ReferenceView view;
    Image reference;
    std::vector<VisiblePoint> points;
};

Row method_row(const char* method, const std::string& where) {
    return {
        {"method", method}, {"where", where}, {"knn_ms", nullptr}, {"integration_ms", nullptr}, {"gather_ms", nullptr}};
}

template <class Structure, class AddPhoton>
Row measure_on_cpu(const Subject& subject, const char* method, const Structure& structure, const AddPhoton& add) {
    const unsigned runs = subject.bench.pick(3u, 5u);
    Found found(subject.points.size());
    Image image{int(subject.view.width), int(subject.view.height), {}};
    image.add("illuminance");
    Row row = method_row(method, "CPU, all threads");
    row["knn_ms"] = median_ms(runs, [&] { find_all(subject.baked.map, subject.points, structure, found); });
    row["integration_ms"] = median_ms(runs, [&] { integrate_all(subject.points, found, add, image); });
    row["total_ms"] = row["knn_ms"].get<double>() + row["integration_ms"].get<double>();
    row["k"] = wanted;
    add_error(row, error_of(image, subject.reference, Quantity::illuminance));
    return row;
}

Row measure_tree(const Subject& subject, const PhotonEstimator& estimator) {
    const PhotonCloud cloud(subject.baked.scene, subject.baked.photons.records);
    const GlobalTreeSearch tree(cloud, subject.baked.map);
    const std::vector<Photon>& photons = subject.baked.photons.records;
    return measure_on_cpu(subject, "global 3D kd-tree, photons hold all light", tree,
                          [&](uint i, float kernel, const VisiblePoint& p, Gathered& sum) {
                              const vec3 flux = photons[i].flux * subject.baked.weights[photons[i].light()] * kernel;
                              sum.irradiance += flux;
                              sum.radiance += flux * estimator.eval_brdf(p.surface, p.shading_normal, p.to_view,
                                                                         p.shading_normal, true);
                          });
}

Row measure_maps(const Subject& subject, const PhotonEstimator& estimator) {
    const GridSearch grids(subject.baked.map);
    return measure_on_cpu(subject, "triangle maps, photons hold all light", grids,
                          [&](uint i, float kernel, const VisiblePoint& p, Gathered& sum) {
                              estimator.add_photon(i, estimator.photon_place(i), kernel / subject.baked.map.flux_scale,
                                                   p.surface, p.geometric_normal, p.shading_normal, p.to_view, sum);
                          });
}

/// Search and integration are one pass on the device.
Row measure_on_device(const Subject& subject, const BakedCase& baked, const char* method, GatherSettings gather) {
    const CaseOnDevice on_device(subject.bench.device, baked);
    const TimedFrame frame = on_device.render(
        subject.view.camera, {subject.view.width, subject.view.height, subject.bench.pick(3u, 7u)}, gather);
    Row row = method_row(method, subject.bench.device.name());
    row["gather_ms"] = frame.rendering.times.gather_ms;
    row["total_ms"] = frame.total_ms();
    row["k"] = gather.neighbours;
    add_error(row, error_of(frame.rendering.image, subject.reference, Quantity::illuminance));
    return row;
}

Row paper_row(const char* method, double knn_ms, double integration_ms, double total_ms) {
    Row row = method_row(method, "paper, its GPU");
    row["knn_ms"] = knn_ms, row["integration_ms"] = integration_ms, row["total_ms"] = total_ms;
    return row;
}

std::vector<Row> paper_rows() {
    return {paper_row("global 3D kd-tree, total as printed", 150, 140, 230),
            paper_row("global 3D kd-tree, sum of its rows", 150, 140, 290), paper_row("triangle maps", 14, 140, 154)};
}

}  // namespace

std::vector<Table> measure_table1(const Bench& bench) {
    BakeSettings bake;
    bake.photons = bench.pick<uint64_t>(1'000'000, 4'000'000);
    bake.direct_in_photons = true;
    const uint side = bench.pick(250u, 500u);
    const BakedCase baked(make_room({}), bake, bench.folder);
    Subject subject{bench, baked, {baked.scene.cameras[0], side, side, bench.pick<uint64_t>(32, 512)}, {}, {}};
    subject.reference = cached_reference(bench.folder, baked.scene, *baked.caster, subject.view);
    subject.points = visible_points(baked.scene, *baked.caster, baked.map, subject.view.camera, side, side);
    const PhotonEstimator estimator(baked.scene, baked.map, baked.weights, {gather_mode_exact, wanted});

    std::vector<Row> rows = paper_rows();
    rows.push_back(measure_tree(subject, estimator));
    rows.push_back(measure_maps(subject, estimator));
    for (const MeasuredMode& mode : measured_modes())
        rows.push_back(
            measure_on_device(subject, baked, (mode.name + ", photons hold all light").c_str(), {mode.mode, wanted}));
    bake.direct_in_photons = false;
    const BakedCase exact_direct(make_room({}), bake, bench.folder);
    const GatherSettings fast;
    rows.push_back(measure_on_device(subject, exact_direct,
                                     (std::string(gather_mode(fast.mode).name) + ", the default").c_str(), fast));
    Table table{"table1", "times",
                "Table 1: furnished room of " + std::to_string(baked.scene.triangles.size()) + " triangles, " +
                    std::to_string(baked.photons.records.size()) + " photons, " + std::to_string(side) + "x" +
                    std::to_string(side) +
                    " pixels; errors of illuminance. On a device search and integration are one "
                    "pass; the total has visibility and tone mapping too.",
                std::move(rows)};
    return {table};
}

}  // namespace lw
