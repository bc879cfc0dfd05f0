// The specialization constants of the shaders as structs whose members are the rows of the shaders' tables
// (shaders/frame_constants.h, shaders/view_constants.h).
#pragma once
#include <vector>

#include "gpu/specialize.h"
#include "maps/photon_map.h"
#include "scene/scene.h"
#include "shaders/frame.h"
#include "shaders/view.h"

namespace lw {

#define LW_CONSTANT(type, name, value) type name = value;
/// Of culling, visibility and gather. Members not set have the shader's own default.
struct FrameConstants {
#include "shaders/frame_constants.h"
};
/// Of the view pass.
struct ViewConstants {
#include "shaders/view_constants.h"
};
#undef LW_CONSTANT

/// What shaders must do for a scene and its map; `traces_rays`: there is a hierarchy for rays. What depends on the
/// device and on how light is gathered keeps its default.
FrameConstants constants_of(const Scene& scene, const PhotonMap& map, bool traces_rays);

/// The members with their ids, as pipelines take them.
std::vector<SpecConstant> spec_constants_of(const FrameConstants& constants);
std::vector<SpecConstant> spec_constants_of(const ViewConstants& constants);

}  // namespace lw
