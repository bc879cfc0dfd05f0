// glTF materials and textures as the records of shaders/scene.h.
#pragma once
#include "scene/gltf_file.h"
#include "scene/scene.h"

namespace lw {

/// Fills materials, material_names, textures and texels of the scene, one material per material of the file in order.
/// A texture whose image cannot be decoded is left out with a warning: its factor stays.
void load_materials(GltfFile& file, Scene& scene);

/// The material of a primitive that names none (glTF 2.0, section 3.9.1: white, metallic 1, roughness 1).
Material default_material();

/// Which optional vertex arrays the materials of a scene need.
struct VertexNeeds {
    bool uv0 = false, uv1 = false, tangents = false;
};
VertexNeeds vertex_needs(const Scene& scene);

}  // namespace lw
