// FNV-1a (Fowler, Noll, Vo 1991) over 8-byte words, with a shift so that high bits reach low ones.
#include "scene/content_hash.h"

#include <cmath>
#include <cstring>

namespace lw {
namespace {

class Hasher {
  public:
    void add(const void* bytes, size_t size) {
        const auto* p = static_cast<const unsigned char*>(bytes);
        for (; size >= 8; p += 8, size -= 8) add_word(word_at(p, 8));
        if (size) add_word(word_at(p, size));
    }
    template <class T>
    void add_value(const T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        add(&value, sizeof(T));
    }
    template <class T>
    void add_array(const std::vector<T>& values) {
        add_value(uint64_t(values.size()));
        add(values.data(), values.size() * sizeof(T));
    }
    uint64_t value() const { return state_ ^ (state_ >> 32); }

  private:
    static uint64_t word_at(const unsigned char* p, size_t size) {
        uint64_t word = 0;
        std::memcpy(&word, p, size);
        return word;
    }
    void add_word(uint64_t word) {
        state_ = (state_ ^ word) * 0x100000001b3ull;
        state_ ^= state_ >> 29;
    }
    uint64_t state_ = 0xcbf29ce484222325ull;
};

/// The emission of an object divided by the intensity of its lamp, per channel. Rounded, so that a file with the lamp
/// dimmed has the same hash.
uvec3 emission_share(const Scene& scene, const Object& object) {
    uvec3 share(0);
    if (object.light < 0) return share;
    const vec3 own = scene.materials[object.material].emissive, lamp = scene.lights[size_t(object.light)].intensity;
    for (int c = 0; c < 3; ++c) share[c] = lamp[c] > 0 ? uint(std::lround(own[c] / lamp[c] * 1024.0f)) : 0u;
    return share;
}

void add_lights(const Scene& scene, Hasher& hasher) {
    hasher.add_value(uint64_t(scene.lights.size()));
    for (Light light : scene.lights) {
        light.intensity = vec3(0);
        hasher.add_value(light);
    }
    for (const Object& object : scene.objects) hasher.add_value(emission_share(scene, object));
    hasher.add_array(scene.emitters);
}

}  // namespace

uint64_t content_hash(const Scene& scene) {
    Hasher hasher;
    hasher.add_array(scene.positions);
    hasher.add_array(scene.normals);
    hasher.add_array(scene.uv0);
    hasher.add_array(scene.uv1);
    hasher.add_array(scene.colors);
    hasher.add_array(scene.tangents);
    hasher.add_array(scene.triangles);
    hasher.add_array(scene.triangle_objects);
    hasher.add_array(scene.objects);
    hasher.add_value(uint64_t(scene.materials.size()));
    for (Material material : scene.materials) {
        material.emissive = vec3(0);
        hasher.add_value(material);
    }
    hasher.add_array(scene.textures);
    hasher.add_array(scene.texels);
    add_lights(scene, hasher);
    return hasher.value();
}

}  // namespace lw
