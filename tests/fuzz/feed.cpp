#include "fuzz/feed.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "base/error.h"
#include "file/checksum.h"
#include "file/map_file.h"
#include "maps/estimate.h"
#include "scene/gltf.h"
#include "trace/build_bvh.h"
#include "trace/emitter.h"

namespace lw::test {
namespace {

constexpr size_t map_header_bytes = 200, map_checksum_at = 16, map_scene_at = 24, map_sizes_at = 80;

void require(bool holds, const char* what) {
    if (!holds) throw std::logic_error(what);
}

bool is_finite(vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }
bool is_light(vec3 v) { return is_finite(v) && v.x >= 0 && v.y >= 0 && v.z >= 0; }

/// A file of this process, in memory where there is such a folder.
std::filesystem::path write(Bytes bytes, const char* name) {
    static const std::filesystem::path folder = [] {
        const std::filesystem::path memory = "/dev/shm";
        const auto root = std::filesystem::is_directory(memory) ? memory : std::filesystem::temp_directory_path();
        const auto own = root / ("lumenwalk_fuzz_" + std::to_string(getpid()));
        std::filesystem::create_directories(own);
        return own;
    }();
    std::ofstream(folder / name, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
    return folder / name;
}

struct Remover {
    std::filesystem::path path;
    ~Remover() {
        std::error_code ignored;
        std::filesystem::remove(path, ignored);
        std::filesystem::remove(path.parent_path(), ignored);  // when it is empty
        std::filesystem::create_directories(path.parent_path(), ignored);
    }
};

void check_arrays(const Scene& s) {
    require(!s.triangles.empty() && s.triangles.size() == s.triangle_objects.size(), "triangles and objects disagree");
    require(s.normals.size() == s.positions.size(), "normals and positions disagree");
    const auto fits = [&](const auto& v) { return v.empty() || v.size() == s.positions.size(); };
    require(fits(s.uv0) && fits(s.uv1) && fits(s.colors) && fits(s.tangents), "an attribute has another length");
    for (const vec3& p : s.positions) require(is_finite(p), "a position is not finite");
    for (const vec3& n : s.normals) require(std::abs(length(n) - 1) < 1e-3f, "a normal is not of unit length");
    for (uvec3 t : s.triangles) require(std::max({t.x, t.y, t.z}) < s.positions.size(), "an index is out of range");
    for (uint o : s.triangle_objects) require(o < s.objects.size(), "an object is out of range");
    for (const Object& o : s.objects) {
        require(o.material < s.materials.size(), "a material is out of range");
        require(o.light < int(s.lights.size()), "a light is out of range");
    }
}

void check_lamps_and_cameras(const Scene& s) {
    require(!s.lights.empty() && s.lights.size() == s.light_names.size(), "lamps and names disagree");
    for (const Light& l : s.lights) {
        require(is_light(l.intensity), "an intensity is no light");
        require(is_finite(l.position) && std::abs(length(l.direction) - 1) < 1e-3f, "a lamp stands nowhere");
        require(uint64_t(l.first_emitter) + l.emitter_count <= s.emitters.size(), "an emitter is out of range");
    }
    require(!s.cameras.empty(), "no camera");
    for (const Camera& c : s.cameras)
        for (int axis = 0; axis < 3; ++axis)
            require(is_finite(c.position) && std::abs(length(c.rotation[axis]) - 1) < 1e-3f, "a camera is not finite");
}

/// Reads textures and attributes of some triangles, and light of all lamps there.
void look_around(const Scene& s) {
    const SurfaceReader surfaces(s);
    const Emitters emitters(s);
    const size_t step = std::max<size_t>(1, s.triangles.size() / 32);
    for (size_t t = 0; t < s.triangles.size(); t += step)
        for (const vec2 at : {vec2(0), vec2(1, 0), vec2(0.3f, 0.4f)}) {
            const Surface surface = surfaces.surface_at(uint(t), at);
            require(is_finite(surface.position) && is_light(surface.base_color) && is_light(surface.emissive),
                    "a surface is not finite");
            for (uint lamp = 0; lamp < std::min<size_t>(s.lights.size(), 8); ++lamp) {
                emitters.arrive(lamp, surface.position, 0.3f, 0.7f);
                require(is_light(emitters.emit(lamp, {0.1f, 0.2f, 0.3f, 0.4f, 0.5f}).flux), "a lamp emits no light");
            }
        }
}

uint64_t word_at(const std::string& bytes, size_t at) {
    uint64_t word;
    std::memcpy(&word, bytes.data() + at, sizeof word);
    return word;
}

/// Cells that one search may visit at most.
double cells_of_a_search(const PhotonMap& map) {
    double most = 1;
    for (const SurfaceGrid& grid : map.grids)
        if (grid.cell_size > 0)
            most = std::max(most, std::min(double(grid.columns) * double(grid.rows),
                                           std::pow(2.0 * double(grid.radius) / double(grid.cell_size) + 1, 2.0)));
    return most;
}

/// At all triangles, or at fewer where searches are long: 200,000 cells in sum, for a fuzzer that tries many maps.
void estimate_everywhere(const Scene& scene, const PhotonMap& map) {
    static const Bvh bvh = build_bvh(scene_of_maps());
    const std::vector<vec3> weights = lamp_powers(scene, {});
    const double searches = std::clamp(2e5 / cells_of_a_search(map), 1.0, 1e6);
    const auto step = uint(std::max(1.0, 4.0 * double(scene.triangles.size()) / searches)) | 1u;  // odd: both sides
    for (uint mode : {gather_mode_exact, gather_mode_smooth, gather_mode_cached}) {
        const PhotonEstimator estimator(scene, map, weights, {mode, 20, 1}, bvh);
        for (uint i = 0; i < 4 * scene.triangles.size(); i += mode == gather_mode_cached ? 1 : step) {
            const vec2 at = (i & 2u) != 0 ? vec2(1, 0) : vec2(0.3f, 0.3f);
            const Surface s = estimator.surface_at(i / 4, at);
            const Gathered light = estimator.estimate(i / 4, at, s.geometric_normal * ((i & 1u) != 0 ? 1.0f : -1.0f));
            require(is_light(light.irradiance) && is_light(light.radiance), "an estimate is no light");
        }
    }
}

}  // namespace

std::optional<Scene> feed_gltf(Bytes bytes) {
    const Remover file{write(bytes, "scene.gltf")};
    Scene scene;
    try {
        scene = load_gltf(file.path);
        check_arrays(scene);
        check_lamps_and_cameras(scene);
        look_around(scene);
    } catch (const Error& e) {
        require(std::strchr(e.what(), '\n') == nullptr, "the message has more than one line");
        return {};
    }
    return scene;
}

const Scene& scene_of_maps() {
    static const Scene scene = load_gltf(LUMENWALK_SOURCE_DIR "/data/cube.gltf");
    return scene;
}

void sign_map(std::string& bytes) {
    if (bytes.size() < map_header_bytes) return;
    Checksum sum;
    sum.add(bytes.data() + map_scene_at, map_header_bytes - map_scene_at);
    size_t begin = map_header_bytes;
    for (size_t at = map_sizes_at; at < map_header_bytes; at += 8) {
        const uint64_t size = word_at(bytes, at);
        if (size > bytes.size() - begin) return;
        sum.add(bytes.data() + begin, size);
        begin += size;
    }
    const uint64_t value = sum.value();
    std::memcpy(bytes.data() + map_checksum_at, &value, sizeof value);
}

std::optional<PhotonMap> feed_map(Bytes input) {
    std::string bytes(input.begin(), input.end());
    const Scene& scene = scene_of_maps();
    if (bytes.size() >= map_header_bytes)
        std::memcpy(bytes.data() + map_scene_at, &scene.content_hash, sizeof scene.content_hash);
    sign_map(bytes);
    const Remover file{write({reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()}, "scene.pmap")};
    PhotonMap map;
    try {
        map = load_photon_map(file.path, scene);
    } catch (const Error& e) {
        require(std::strchr(e.what(), '\n') == nullptr, "the message has more than one line");
        return {};
    }
    estimate_everywhere(scene, map);
    return map;
}

}  // namespace lw::test
