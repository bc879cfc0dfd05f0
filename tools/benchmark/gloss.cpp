// Gloss, mirrors, glass and caustics: up to which roughness photons cannot show a lobe, and what the default mode costs
// and errs in the rooms that have them.
#include <algorithm>
#include <cmath>

#include "accuracy.h"
#include "base/error.h"
#include "scene/camera.h"
#include "scene/gltf.h"
#include "sections.h"
#include "shaders/color.h"
#include "trace/caustics.h"

namespace lw {
namespace {

constexpr float roughnesses[] = {0, 0.05f, 0.1f, 0.2f, 0.3f, 0.4f, 0.5f, 0.7f, 0.9f};
constexpr float all_lobes = 1;  // all below it

/// One room with one of its materials at a roughness, and how many paths a pixel the path tracer needs there.
struct Room {
    const char* file;
    const char* material;
    float roughness;
    uint64_t samples;
    uint max_views = 256;  // as the window adds up
};

Scene scene_of(const Bench& bench, const Room& room) {
    Scene scene = load_gltf(bench.scenes / room.file);
    const auto found = std::find(scene.material_names.begin(), scene.material_names.end(), room.material);
    if (found == scene.material_names.end()) throw Error(std::string(room.file) + ": no material " + room.material);
    scene.materials[size_t(found - scene.material_names.begin())].roughness = room.roughness;
    char name[96];
    std::snprintf(name, sizeof name, "%s-%g.gltf", std::filesystem::path(room.file).stem().string().c_str(),
                  double(room.roughness));
    scene.path = name;  // what the references are kept under
    return scene;
}

struct Size {
    uint width, height;
    uint64_t samples;  // of the reference
};

/// A baked room, its reference, and frames of it.
class Measured {
  public:
    Measured(const Bench& bench, const Room& room, const Size& size, uint64_t photons)
        : size_(size),
          baked_(scene_of(bench, room), settings_for(photons), bench.folder),
          device_(bench.device, baked_) {
        const ReferenceView view{baked_.scene.cameras[0], size.width, size.height, size.samples, false};
        reference_ = cached_reference(bench.folder, baked_.scene, *baked_.caster, view);
    }

    /// Pixels that see a material; all but them when `others`.
    std::vector<bool> pixels_of(const char* material) const {
        std::vector<bool> seen;
        for (float triangle : reference_.find("triangle")->values) {
            const uint object = triangle >= 0 ? baked_.scene.triangle_objects[size_t(triangle)] : 0;
            seen.push_back(triangle >= 0 &&
                           baked_.scene.material_names[baked_.scene.objects[object].material] == material);
        }
        return seen;
    }
    TimedFrame render(const GatherSettings& gather, uint frames, uint views = 1) const {
        return device_.render(baked_.scene.cameras[0], {size_.width, size_.height, frames, views}, gather);
    }
    FrameError error(const TimedFrame& frame, const std::vector<bool>& pixels) const {
        return error_of(frame.rendering.image, reference_, Quantity::luminance, {}, pixels);
    }
    std::vector<bool> caustic_pixels(const TimedFrame& frame) const;

  private:
    static BakeSettings settings_for(uint64_t photons) {
        BakeSettings bake;
        bake.photons = photons;
        return bake;
    }
    Size size_;
    BakedCase baked_;
    CaseOnDevice device_;
    Image reference_;
};

/// Where light traced from the lamps as the reference traces it, by way of mirrors, glass and metal smoother than a
/// roughness of 0.35 alone, brings more than half the picture's mean illuminance.
std::vector<bool> Measured::caustic_pixels(const TimedFrame& frame) const {
    const std::vector<float>& lux = frame.rendering.image.find("illuminance")->values;
    std::vector<bool> lit(lux.size(), false);
    if (!has_caustics(baked_.scene, baked_.powers)) return lit;
    double mean = 0;
    for (float e : lux) mean += double(e) / double(lux.size());
    const Caustics caustics(baked_.scene, *baked_.caster, baked_.powers, {2'000'000, 0.004f * baked_.scene.size()});
    const SurfaceReader surfaces(baked_.scene);
    const Camera& camera = baked_.scene.cameras[0];
    for (size_t i = 0; i < lit.size(); ++i) {
        const auto [origin, direction] = camera_ray(camera, float(i % size_.width) + 0.5f,
                                                    float(i / size_.width) + 0.5f, int(size_.width), int(size_.height));
        const auto hit = baked_.caster->nearest(origin, direction);
        if (!hit) continue;
        const Surface s = surfaces.surface_at(hit->triangle, hit->barycentrics);
        if (casts_caustics(s)) continue;  // keeps none
        const vec3 n = s.geometric_normal * (dot(s.geometric_normal, direction) > 0 ? -1.0f : 1.0f);
        lit[i] = double(luminance(caustics.irradiance(s.position, n))) > 0.5 * mean;
    }
    return lit;
}

/// The error where only the floor is looked at, by photons alone and with the lobe followed.
std::vector<Row> measure_threshold(const Bench& bench, float roughness) {
    const Measured room(bench, {"glossy_floor.gltf", "polished", roughness, 0}, {80, 60, bench.pick<uint64_t>(64, 400)},
                        bench.pick<uint64_t>(200'000, 4'000'000));
    const std::vector<bool> floor = room.pixels_of("polished");
    std::vector<Row> rows;
    for (uint mode : {gather_mode_smooth, gather_mode_cached})
        for (float followed : {0.0f, all_lobes}) {
            GatherSettings gather;
            gather.mode = mode;
            gather.paths = followed > 0 ? 16 : 1;
            gather.followed_roughness = followed;
            const TimedFrame frame = room.render(gather, 1);
            const FrameError error = room.error(frame, floor);
            rows.push_back({{"roughness", roughness},
                            {"mode", gather_mode(mode).name},
                            {"lobe", followed > 0 ? "followed, 16 paths" : "photons"},
                            {"rmse_%", 100 * error.rmse_without_noise},
                            {"bias_%", 100 * error.bias},
                            {"reference_error_%", 100 * error.reference_error}});
        }
    return rows;
}

std::vector<Row> measure_room(const Bench& bench, const Room& described) {
    const Measured room(bench, described, {120, 90, bench.pick<uint64_t>(64, described.samples)},
                        bench.pick<uint64_t>(200'000, 4'000'000));
    std::vector<Row> rows;
    for (uint views : {1u, 8u, 64u, 256u, 1024u}) {
        if (views > bench.pick(256u, described.max_views)) break;
        const TimedFrame frame = room.render(GatherSettings{}, views < 32 ? 3 : 1, views);
        Row row{{"room", described.file},
                {"material", described.material},
                {"roughness", described.roughness},
                {"views", views},
                {"visibility_ms", frame.rendering.times.visibility_ms},
                {"gather_ms", frame.rendering.times.gather_ms}};
        const std::vector<bool> caustic = room.caustic_pixels(frame);
        std::vector<bool> other = caustic;
        other.flip();
        add_error(row, room.error(frame, other));
        const auto count = std::count(caustic.begin(), caustic.end(), true);
        row["caustic_pixels"] = count;
        if (count > 0) row["caustic_rmse_%"] = 100 * room.error(frame, caustic).rmse_without_noise;
        rows.push_back(std::move(row));
    }
    return rows;
}

}  // namespace

std::vector<Table> measure_lobes(const Bench& bench) {
    Table table{
        "lobes",
        "threshold",
        "The polished floor of glossy_floor.gltf at several roughnesses: luminance of the floor's pixels against "
        "the path tracer, its specular lobe estimated from photons or followed by rays.",
        {}};
    for (float roughness : roughnesses)
        for (Row& row : measure_threshold(bench, roughness)) table.rows.push_back(std::move(row));
    return {table};
}

std::vector<Table> measure_gloss(const Bench& bench) {
    Table rooms{
        "gloss",
        "rooms",
        "Rooms of gloss, metal and glass in the default mode, luminance against the path tracer; caustic: pixels "
        "that light from lamps by way of mirrors, glass and metal smoother than 0.35 alone brings more than half "
        "the picture's mean illuminance, left out of the rest. "
        "Times of all the views at rest that are added up, through pixel centres; the window adds up 256.",
        {}};
    for (const Room& room :
         {Room{"glossy_floor.gltf", "polished", 0.05f, 1000}, Room{"glossy_floor.gltf", "polished", 0.2f, 1000},
          Room{"glossy_floor.gltf", "polished", 0.5f, 1000}, Room{"metal_sculpture.gltf", "gold", 0.1f, 5000},
          Room{"metal_sculpture.gltf", "gold", 0.3f, 3000}, Room{"metal_sculpture.gltf", "gold", 0.5f, 1000},
          Room{"glass_sphere.gltf", "solid", 0, 2000}, Room{"glass_sphere.gltf", "solid", 0.2f, 8000, 1024},
          Room{"glass_sphere.gltf", "solid", 0.4f, 16000, 1024}})
        for (Row& row : measure_room(bench, room)) rooms.rows.push_back(std::move(row));
    return {rooms};
}

}  // namespace lw
