// A small baked room on lavapipe, and frames of it without a window.
#pragma once
#include "app/picture/progressive_renderer.h"
#include "app/session/world.h"
#include "gpu/buffer.h"
#include "maps/bake.h"

namespace lw {

struct Room {
    explicit Room(const std::string& name = "cornell.gltf", vk::Extent2D pixels = {96, 128}, uint64_t photons = 30'000)
        : size(pixels),
          world(LUMENWALK_SOURCE_DIR "/data/" + name, {}, {}),
          map(std::make_shared<const PhotonMap>(bake(world.scene, world.caster, {.photons = photons}))),
          device({"llvmpipe", true, {}}),
          renderer(device, world.scene, map, world.bvh) {
        renderer.resize(size);
        request.camera = world.scene.cameras[0];
        request.factors_a.assign(world.scene.lights.size(), vec3(1));
    }

    /// Codes of the screen after one more frame.
    std::vector<uint32_t> frame(const DisplaySettings& display) {
        submit_and_wait(device, [&](vk::CommandBuffer commands) { renderer.record(commands, request, display, 0); });
        return read_back<uint32_t>(device, renderer.screen(), size_t(size.width) * size.height);
    }

    vk::Extent2D size;
    World world;
    std::shared_ptr<const PhotonMap> map;
    Device device;
    ProgressiveRenderer renderer;
    FrameRequest request;
};

}  // namespace lw
