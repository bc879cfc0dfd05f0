#include "scene/gltf_repairs.h"

#include <tiny_gltf.h>

#include <nlohmann/json.hpp>

namespace lw {
namespace {

using Json = nlohmann::json;

/// True when tinygltf can read the bytes of this image. It refuses the whole file for one image that it cannot.
bool has_readable_source(const Json& image, size_t view_count) {
    const bool has_uri = image.contains("uri"), has_view = image.contains("bufferView");
    if (has_uri == has_view) return false;
    if (has_view) return image["bufferView"].is_number_unsigned() && image["bufferView"].get<uint64_t>() < view_count;
    if (!image["uri"].is_string()) return false;
    const auto uri = image["uri"].get<std::string>();
    std::vector<unsigned char> bytes;
    std::string mime;
    return !tinygltf::IsDataURI(uri) || tinygltf::DecodeDataURI(&bytes, mime, uri, 0, false);
}

/// Replaces the source of every unreadable image by a few bytes that are no picture; later it is treated like any
/// picture that cannot be decoded. Returns true when there was one.
bool replace_unreadable_images(Json& root) {
    const auto images = root.find("images"), views = root.find("bufferViews");
    if (images == root.end() || !images->is_array()) return false;
    const size_t view_count = views != root.end() && views->is_array() ? views->size() : 0;
    bool replaced = false;
    for (Json& image : *images) {
        if (!image.is_object() || has_readable_source(image, view_count)) continue;
        image.erase("bufferView");
        image["uri"] = "data:image/png;base64,AAAA";
        replaced = true;
    }
    return replaced;
}

/// Gives the fallback buffers of compressed views, which have no bytes, a byte: tinygltf refuses a buffer without any.
/// True when there were some.
bool replace_fallback_buffers(Json& root) {
    const auto buffers = root.find("buffers");
    if (buffers == root.end() || !buffers->is_array()) return false;
    bool replaced = false;
    for (Json& buffer : *buffers) {
        if (!buffer.is_object() || buffer.contains("uri")) continue;
        for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
            const Json::json_pointer place(std::string("/extensions/") + name + "/fallback");
            if (!buffer.contains(place) || buffer.at(place) != true) continue;
            buffer["uri"] = "data:application/octet-stream;base64,AA==";
            buffer["byteLength"] = 1;
            replaced = true;
        }
    }
    return replaced;
}

/// Lets the accessors of primitives compressed by Draco, which have no buffer view of their own, name the compressed
/// one: tinygltf refuses an accessor without any. True when there were some.
bool name_draco_views(Json& root) {
    bool named = false;
    const auto name = [&](const Json& accessor, const Json& view) {
        if (!accessor.is_number_unsigned() || !root.contains("accessors") || !root["accessors"].is_array()) return;
        Json& accessors = root["accessors"];
        if (accessor.get<uint64_t>() >= accessors.size() || !accessors[accessor.get<size_t>()].is_object()) return;
        Json& record = accessors[accessor.get<size_t>()];
        if (record.contains("bufferView")) return;
        record["bufferView"] = view;
        named = true;
    };
    const Json meshes = root.contains("meshes") && root["meshes"].is_array() ? root["meshes"] : Json::array();
    const Json::json_pointer draco_view("/extensions/KHR_draco_mesh_compression/bufferView");
    for (const Json& mesh : meshes)
        for (const Json& primitive : mesh.is_object() ? mesh.value("primitives", Json::array()) : Json::array()) {
            if (!primitive.is_object() || !primitive.contains(draco_view)) continue;
            name(primitive.value("indices", Json()), primitive.at(draco_view));
            const Json attributes = primitive.value("attributes", Json::object());
            for (const auto& [key, accessor] : attributes.items()) name(accessor, primitive.at(draco_view));
        }
    return named;
}

}  // namespace

bool repair_for_tinygltf(Json& root) {
    const bool images = replace_unreadable_images(root), buffers = replace_fallback_buffers(root);
    return name_draco_views(root) || images || buffers;
}

}  // namespace lw
