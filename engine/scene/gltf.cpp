#include "scene/gltf.h"

#include <new>

#include "base/error.h"
#include "base/one_line.h"
#include "scene/content_hash.h"
#include "scene/gltf_cameras.h"
#include "scene/gltf_compression.h"
#include "scene/gltf_extensions.h"
#include "scene/gltf_geometry.h"
#include "scene/gltf_lights.h"
#include "scene/gltf_materials.h"

namespace lw {

Scene load_gltf(const std::filesystem::path& path, const GltfSettings& settings) try {
    GltfFile file = open_gltf(path, settings.strict);
    decode_meshopt_views(file);
    decode_draco_primitives(file);
    if (!settings.variant.empty()) choose_variant(file, settings.variant);
    Scene scene;
    scene.path = path;
    scene.files = std::move(file.read);
    const std::vector<PlacedNode> nodes = place_nodes(file);
    load_materials(file, scene);
    const std::vector<size_t> object_nodes = load_geometry(file, nodes, scene);
    load_lights(file, nodes, object_nodes, scene);
    if (settings.needs_lamp && scene.lights.empty())
        file.fail(
            "the scene has no light: add a point, spot or sun lamp (KHR_lights_punctual) or give a mesh an emissive "
            "material");
    load_cameras(file, nodes, scene);
    scene.content_hash = content_hash(scene);
    scene.warnings.insert(scene.warnings.begin(), file.warnings.begin(), file.warnings.end());
    return scene;
} catch (const std::bad_alloc&) {
    throw Error(one_line(path.filename().string() + ": needs more memory than there is"));
} catch (const std::length_error&) {
    throw Error(one_line(path.filename().string() + ": needs more memory than there is"));
}

}  // namespace lw
