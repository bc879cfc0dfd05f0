// Compressed geometry of a glTF file, brought back to plain buffers before anything else reads them:
// EXT_meshopt_compression and KHR_meshopt_compression (buffer views), KHR_draco_mesh_compression (primitives). The only
// user of libmeshoptimizer and libdraco.
#pragma once
#include "scene/gltf_file.h"

namespace lw {

/// Decodes every compressed buffer view of the model into a buffer of its own, which the view then refers to. Throws
/// Error for a stream that is damaged, has another size than it declares, or is of a version that the library does not
/// know.
void decode_meshopt_views(GltfFile& file);

/// Decodes the primitives compressed by Draco; their accessors then refer to plain buffers. Throws Error for a stream
/// that is damaged, is no triangle mesh, or lacks an attribute that the primitive names.
void decode_draco_primitives(GltfFile& file);

}  // namespace lw
