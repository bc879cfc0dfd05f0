// Writes small glTF files for the tests: attributes as arrays in C++, the rest as JSON that a test may bend.
#pragma once
#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/base64.h"
#include "base/error_of.h"
#include "scene/gltf.h"
#include "scene/triangle.h"

namespace lw::test {

using Json = nlohmann::json;

/// A glTF document with one node, one mesh, one primitive and a lamp of 100 cd at (0, 0, 1); tests change `doc`.
struct GltfText {
    Json doc = Json::parse(
        R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_lights_punctual"], "accessors": [], "bufferViews": [],
        "scene": 0, "scenes": [{"nodes": [0, 1]}], "meshes": [{"name": "lamp", "primitives": [{"attributes": {}}]}],
        "nodes": [{"mesh": 0, "name": "thing"}, {"name": "bulb", "translation": [0, 0, 1], "extensions": {"KHR_lights_punctual": {"light": 0}}}],
        "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "intensity": 100}]}}})");
    std::vector<unsigned char> bytes;

    Json& primitive() { return doc["meshes"][0]["primitives"][0]; }
    Json& node() { return doc["nodes"][0]; }

    template <class T>
    int view(const std::vector<T>& values) {
        while (bytes.size() % 4) bytes.push_back(0);
        const size_t offset = bytes.size(), size = values.size() * sizeof(T);
        bytes.resize(offset + size);
        std::memcpy(bytes.data() + offset, values.data(), size);
        doc["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", offset}, {"byteLength", size}});
        return int(doc["bufferViews"].size()) - 1;
    }
    template <class T>
    int accessor(const std::vector<T>& values, const std::string& type, int component, bool normalized = false) {
        const size_t width = type == "SCALAR" ? 1 : size_t(type[3] - '0');
        doc["accessors"].push_back({{"bufferView", view(values)},
                                    {"componentType", component},
                                    {"type", type},
                                    {"count", values.size() / width},
                                    {"normalized", normalized}});
        return int(doc["accessors"].size()) - 1;
    }
    void attribute(const std::string& name, int accessor_index) { primitive()["attributes"][name] = accessor_index; }
    void floats(const std::string& name, const std::vector<float>& values, const std::string& type) {
        attribute(name, accessor(values, type, 5126));
    }

    std::string text() const {
        Json out = doc;
        out["buffers"] = {
            {{"byteLength", bytes.size()}, {"uri", "data:application/octet-stream;base64," + base64(bytes)}}};
        return out.dump();
    }
    std::filesystem::path save() const { return write(text(), "room.gltf"); }
    Scene load() const { return load_gltf(save()); }

    /// The folder belongs to this process: ctest runs the tests in parallel.
    static std::filesystem::path write(const std::string& content, const std::string& name) {
        const auto folder = std::filesystem::temp_directory_path() / ("lumenwalk_scene_" + std::to_string(getpid()));
        std::filesystem::create_directories(folder);
        std::ofstream(folder / name, std::ios::binary).write(content.data(), std::streamsize(content.size()));
        return folder / name;
    }
};

/// A unit square in the plane z = 0, front towards +z, without indices.
inline GltfText square() {
    GltfText g;
    g.floats("POSITION", {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, "VEC3");
    g.floats("NORMAL", {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
    g.primitive()["indices"] = g.accessor(std::vector<uint16_t>{0, 1, 2, 0, 2, 3}, "SCALAR", 5123);
    return g;
}

/// Whether a message is one printable line that names a file.
inline bool is_one_line_of_a_file(const std::string& message) {
    const auto steers = [](char c) { return static_cast<unsigned char>(c) < 32 || c == 127; };
    return std::none_of(message.begin(), message.end(), steers) && message.find(": ") != std::string::npos &&
           message.find(": ") > 0;
}

/// The message of the Error that loading throws, which must be one line of a file; "" when it loads.
template <class Load>
std::string load_error_of(const Load& load) {
    const std::string message = error_of(load);
    EXPECT_TRUE(message.empty() || is_one_line_of_a_file(message)) << message;
    return message;
}

/// The same of a document.
inline std::string refusal_of(const GltfText& g) {
    return load_error_of([&] { g.load(); });
}

inline void add_material(GltfText& g, const Json& material) {
    g.doc["materials"] = Json::array({material});
    g.primitive()["material"] = 0;
}

/// The unit normal of the front of a triangle.
inline vec3 front_of(const Scene& s, size_t triangle) { return normalize(triangle_product(s, triangle)); }

inline glm::dvec3 world(const Scene& s, size_t vertex) { return s.origin + glm::dvec3(s.positions[vertex]); }

}  // namespace lw::test
