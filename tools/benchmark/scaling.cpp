// Cost and memory of bake, file, load and frame against photons, triangles, lights and pixels, and fitted exponents.
#include <cmath>

#include "accuracy.h"
#include "base/error.h"
#include "rooms.h"
#include "sections.h"

namespace lw {
namespace {

struct Point {
    std::string axis;  // "photons", "triangles, mixed", ...
    double value;
    RoomSettings room;
    uint64_t photons;
};

RoomSettings base_room() { return {}; }

uint64_t base_photons(const Bench& bench) { return bench.pick<uint64_t>(250'000, 4'000'000); }
uint base_side(const Bench& bench) { return bench.pick(128u, 256u); }

std::vector<Point> photon_points(const Bench& bench) {
    std::vector<Point> points;
    const auto last = bench.pick<uint64_t>(1'000'000, 32'000'000);
    for (uint64_t n = bench.pick<uint64_t>(62'500, 250'000); n <= last; n *= bench.quick ? 4 : 2)
        points.push_back({"photons", double(n), base_room(), n});
    return points;
}

std::vector<Point> triangle_points(const Bench& bench) {
    std::vector<Point> points;
    const size_t last = bench.pick<size_t>(100'000, 1'000'000);
    for (Tessellation kind : {Tessellation::uniform, Tessellation::mixed})
        for (size_t n = 100; n <= last; n *= bench.quick && n > 100 ? 100 : 10) {
            RoomSettings room = base_room();
            room.triangles = n;
            room.tessellation = kind;
            points.push_back({std::string("triangles, ") + name_of(kind), double(n), room, base_photons(bench)});
        }
    return points;
}

std::vector<Point> light_points(const Bench& bench) {
    std::vector<Point> points;
    for (Lamps lamps : {Lamps::panels, Lamps::points})
        for (unsigned n = 1; n <= 64; n *= bench.quick ? 8 : 2) {
            RoomSettings room = base_room();
            room.lights = n;
            room.lamps = lamps;
            points.push_back(
                {lamps == Lamps::panels ? "lights, panels" : "lights, points", double(n), room, base_photons(bench)});
        }
    return points;
}

void add_bake(Row& row, const BakedCase& baked) {
    row["triangles"] = baked.scene.triangles.size();
    row["photons"] = baked.photons.records.size();
    row["lights"] = baked.scene.lights.size();
    row["trace_s"] = baked.cost.trace.seconds;
    row["maps_s"] = baked.cost.maps.seconds;
    row["write_s"] = baked.cost.write.seconds;
    row["bake_s"] = baked.cost.trace.seconds + baked.cost.maps.seconds + baked.cost.write.seconds;
    row["bake_peak_mb"] = baked.cost.peak_memory_mb;
    row["bake_added_mb"] = baked.cost.added_memory_mb;
    row["file_mb"] = double(baked.cost.file_bytes) / 1e6;
    row["load_s"] = baked.cost.load.seconds;
    row["references_per_photon"] = references_per_photon(baked.map);
    row["bytes_per_photon"] = bytes_per_photon(baked.map);
}

void add_frame(Row& row, const TimedFrame& frame) {
    row["device_mb"] = double(frame.device_bytes) / 1e6;
    row["visibility_ms"] = frame.rendering.times.visibility_ms;
    row["gather_ms"] = frame.rendering.times.gather_ms;
    row["frame_ms"] = frame.total_ms();
}

FrameError error_at_base_size(const Bench& bench, const BakedCase& baked, const TimedFrame& frame) {
    const uint side = base_side(bench);
    const Image reference = cached_reference(bench.folder, baked.scene, *baked.caster,
                                             {baked.scene.cameras[0], side, side, bench.pick<uint64_t>(16, 32)});
    return error_of(frame.rendering.image, reference, Quantity::illuminance);
}

/// What a device cannot hold is a result too: the row says why.
Row measure_point(const Bench& bench, const Point& point) {
    Row row{{"axis", point.axis}, {"value", point.value}};
    try {
        BakeSettings bake;
        bake.photons = point.photons;
        const BakedCase baked(make_room(point.room), bake, bench.folder);
        add_bake(row, baked);
        const uint side = base_side(bench);
        const TimedFrame frame =
            CaseOnDevice(bench.device, baked).render(baked.scene.cameras[0], {side, side, 3}, GatherSettings{});
        add_frame(row, frame);
        add_error(row, error_at_base_size(bench, baked, frame));
    } catch (const Error& refusal) {
        row["refused"] = refusal.what();
    }
    return row;
}

/// One bake at growing sizes; the error is the map's, measured at the base size.
std::vector<Row> measure_pixels(const Bench& bench) {
    BakeSettings bake;
    bake.photons = base_photons(bench);
    const BakedCase baked(make_room(base_room()), bake, bench.folder);
    const CaseOnDevice on_device(bench.device, baked);
    const uint side = base_side(bench);
    const FrameError error =
        error_at_base_size(bench, baked, on_device.render(baked.scene.cameras[0], {side, side, 1}, GatherSettings{}));
    std::vector<uvec2> sizes{{128, 128}, {256, 256}};
    if (!bench.quick) sizes.insert(sizes.end(), {{512, 512}, {1280, 720}, {1920, 1080}});
    std::vector<Row> rows;
    for (uvec2 size : sizes) {
        Row row{{"axis", "pixels"}, {"value", size.x * size.y}};
        add_bake(row, baked);
        add_frame(row, on_device.render(baked.scene.cameras[0], {size.x, size.y, 3}, GatherSettings{}));
        add_error(row, error);
        rows.push_back(std::move(row));
    }
    return rows;
}

std::vector<double> column(const std::vector<Row>& rows, const std::string& name) {
    std::vector<double> values;
    for (const Row& row : rows)
        values.push_back(row.contains(name) && row[name].is_number() ? row[name].get<double>() : std::nan(""));
    return values;
}

/// One row per axis: the exponent of each cost.
std::vector<Row> fit_axes(const std::vector<Row>& rows) {
    std::vector<Row> fits;
    std::vector<std::string> axes;
    for (const Row& row : rows)
        if (std::find(axes.begin(), axes.end(), row["axis"]) == axes.end()) axes.push_back(row["axis"]);
    for (const std::string& axis : axes) {
        std::vector<Row> points;
        std::copy_if(rows.begin(), rows.end(), std::back_inserter(points),
                     [&](const Row& r) { return r["axis"] == axis; });
        Row fit{{"axis", axis}, {"points", points.size()}};
        for (const char* cost : {"trace_s", "maps_s", "write_s", "bake_added_mb", "file_mb", "load_s", "device_mb",
                                 "gather_ms", "frame_ms", "rmse_%"}) {
            const double exponent = fitted_exponent(column(points, "value"), column(points, cost));
            fit[cost] = std::isfinite(exponent) ? Row(exponent) : Row();
        }
        fits.push_back(std::move(fit));
    }
    return fits;
}

}  // namespace

std::vector<Table> measure_scaling(const Bench& bench) {
    const std::string settings = "Furnished room, otherwise " + std::to_string(base_photons(bench)) +
                                 " photons, 100,000 "
                                 "triangles (mixed), 2 lights, " +
                                 std::to_string(base_side(bench)) + "x" + std::to_string(base_side(bench)) +
                                 " pixels, default gather.";
    Table table{"scaling",
                "points",
                settings + " Errors are of illuminance; along pixels the error is that of the base size.",
                {}};
    for (const auto& points : {photon_points(bench), triangle_points(bench), light_points(bench)})
        for (const Point& point : points) table.rows.push_back(measure_point(bench, point));
    for (Row& row : measure_pixels(bench)) table.rows.push_back(std::move(row));
    Table fits{"scaling", "exponents", settings + " Exponents b of cost = a value^b, least squares in logarithms.",
               fit_axes(table.rows)};
    return {table, fits};
}

}  // namespace lw
