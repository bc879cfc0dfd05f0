// What a scene does not need costs nothing: the same room as Lambert with one lamp, with many, glossy, textured.
#include "accuracy.h"
#include "rooms.h"
#include "sections.h"

namespace lw {
namespace {

struct Variant {
    const char* name;
    unsigned lights;
    Lamps lamps;
    Finish finish;
};

constexpr Variant variants[] = {{"Lambert, one panel", 1, Lamps::panels, Finish::lambert},
                                {"Lambert, one point", 1, Lamps::points, Finish::lambert},
                                {"Lambert, 30 panels", 30, Lamps::panels, Finish::lambert},
                                {"Lambert, 30 points", 30, Lamps::points, Finish::lambert},
                                {"glossy, one panel", 1, Lamps::panels, Finish::glossy},
                                {"textured, one panel", 1, Lamps::panels, Finish::textured},
                                {"sculptures of glass, one panel", 1, Lamps::panels, Finish::glass}};

struct Constant {
    bool FrameConstants::*member;
    const char* name;
};

/// Specialization constants of what a scene may need.
constexpr Constant constants[] = {
    {&FrameConstants::has_uv0, "texture coordinates"},   {&FrameConstants::has_textures, "textures"},
    {&FrameConstants::has_directions, "directions"},     {&FrameConstants::has_transmission, "glass"},
    {&FrameConstants::has_caustics, "caustics"},         {&FrameConstants::has_followed, "followed lobes"},
    {&FrameConstants::has_mesh_lamps, "glowing meshes"}, {&FrameConstants::has_visible_lamps, "visible lamps"},
    {&FrameConstants::has_shadow_masks, "shadow masks"}, {&FrameConstants::has_shadow_rays, "shadow rays"}};

/// What the shader of a scene is compiled with.
std::string variant_of(const CaseOnDevice& on_device) {
    const FrameConstants values = on_device.constants(GatherSettings{});
    std::string names;
    for (const Constant& c : constants)
        if (values.*c.member) names += (names.empty() ? "" : ", ") + std::string(c.name);
    return names;
}

template <class T>
size_t bytes_of_array(const std::vector<T>& values) {
    return values.size() * sizeof(T);
}

/// Bytes of the arrays that only a feature needs.
void add_feature_bytes(Row& row, const BakedCase& baked, const CaseOnDevice& on_device) {
    row["direction_bytes"] = bytes_of_array(baked.map.directions);
    row["shadow_ray_bytes"] = on_device.ray_bytes();
    row["texture_bytes"] = bytes_of_array(baked.scene.texels) + bytes_of_array(baked.scene.textures) +
                           bytes_of_array(baked.scene.uv0) + bytes_of_array(baked.scene.uv1);
    row["caustic_bytes"] = bytes_of_array(baked.map.smooth_caustics) + baked.map.caustic_sides.bytes();
    row["lamp_bytes"] = bytes_of_array(baked.scene.lights) + baked.scene.lights.size() * sizeof(LampPower);
}

Row measure_variant(const Bench& bench, const Variant& variant) {
    BakeSettings bake;
    bake.photons = bench.pick<uint64_t>(250'000, 4'000'000);
    RoomSettings room;
    room.triangles = bench.pick<size_t>(20'000, 100'000);
    room.lights = variant.lights;
    room.lamps = variant.lamps;
    room.finish = variant.finish;
    const BakedCase baked(make_room(room), bake, bench.folder);
    const CaseOnDevice on_device(bench.device, baked);
    const uint side = bench.pick(128u, 250u);
    const TimedFrame frame = on_device.render(baked.scene.cameras[0], {side, side, 3}, GatherSettings{});
    const Image reference = cached_reference(bench.folder, baked.scene, *baked.caster,
                                             {baked.scene.cameras[0], side, side, bench.pick<uint64_t>(32, 256)});
    Row row{{"room", variant.name},
            {"shader", variant_of(on_device)},
            {"disk_bytes", baked.cost.file_bytes},
            {"device_bytes", frame.device_bytes},
            {"gather_ms", frame.rendering.times.gather_ms},
            {"frame_ms", frame.total_ms()}};
    add_feature_bytes(row, baked, on_device);
    add_error(row, error_of(frame.rendering.image, reference, Quantity::luminance));
    return row;
}

/// Differences to the first row, beside the values.
void add_differences(std::vector<Row>& rows) {
    for (Row& row : rows)
        for (const char* column : {"disk_bytes", "device_bytes", "gather_ms"})
            row[std::string("added_") + column] = row[column].get<double>() - rows[0][column].get<double>();
}

}  // namespace

std::vector<Table> measure_features(const Bench& bench) {
    Table table{"features",
                "rooms",
                "The same room with what it may need or not: " + std::to_string(bench.pick(250'000, 4'000'000)) +
                    " photons, default gather, " + (bench.quick ? "128x128" : "250x250") +
                    "; *added* is the difference to the first row. Errors are of luminance.",
                {}};
    for (const Variant& variant : variants) table.rows.push_back(measure_variant(bench, variant));
    add_differences(table.rows);
    return {table};
}

}  // namespace lw
