#include <meshoptimizer.h>

#include <algorithm>

#include "scene/gltf_accessor.h"
#include "scene/gltf_compression.h"

namespace lw {
namespace {

constexpr uint64_t max_decoded_bytes = uint64_t(1) << 33;  // of one view

/// The extension object of a compressed view (EXT_meshopt_compression, section "JSON schema updates"), checked.
struct MeshoptStream {
    std::span<const unsigned char> bytes;
    size_t count, stride;  // elements, and bytes of each once decoded
    std::string mode, filter;
};

const tinygltf::Value* stream_of(const tinygltf::BufferView& view) {
    const tinygltf::Value* extension = extension_of(view.extensions, "EXT_meshopt_compression");
    return extension ? extension : extension_of(view.extensions, "KHR_meshopt_compression");
}

uint64_t size_of(const GltfFile& file, const tinygltf::Value& object, const std::string& key,
                 const std::string& where) {
    const double value = number_of(object, key, 0);
    if (!(value >= 0 && value < 9e15)) file.fail(where + ": " + key + " is not a size");
    return uint64_t(value);
}

std::string text_of(const tinygltf::Value& object, const std::string& key) {
    return object.Has(key) && object.Get(key).IsString() ? object.Get(key).Get<std::string>() : "";
}

MeshoptStream checked_stream(const GltfFile& file, const tinygltf::Value& object, const std::string& where) {
    const int index = index_of(object, "buffer", -1);
    if (index < 0 || size_t(index) >= file.model.buffers.size())
        file.fail(where + ": there is no buffer " + std::to_string(index));
    const std::vector<unsigned char>& buffer = file.model.buffers[size_t(index)].data;
    const uint64_t offset = size_of(file, object, "byteOffset", where);
    const uint64_t length = size_of(file, object, "byteLength", where);
    if (offset > buffer.size() || length > buffer.size() - offset)
        file.fail(where + ": reaches past the end of buffer " + std::to_string(index));
    MeshoptStream stream{{buffer.data() + offset, size_t(length)},
                         size_t(size_of(file, object, "count", where)),
                         size_t(size_of(file, object, "byteStride", where)),
                         text_of(object, "mode"),
                         text_of(object, "filter")};
    const bool is_vertices = stream.mode == "ATTRIBUTES";
    const bool has_stride = is_vertices ? stream.stride % 4 == 0 && stream.stride > 0 && stream.stride <= 256
                                        : stream.stride == 2 || stream.stride == 4;
    if (!has_stride) file.fail(where + ": byteStride cannot be " + std::to_string(stream.stride));
    if (stream.count > max_decoded_bytes / stream.stride) file.fail(where + ": has too many elements");
    if (stream.mode == "TRIANGLES" && stream.count % 3 != 0) file.fail(where + ": count is not a multiple of 3");
    return stream;
}

/// True for the stream versions that the packaged library decodes: 0 of vertices, 0 and 1 of indices.
bool knows_version(const MeshoptStream& stream) {
    if (stream.bytes.empty()) return false;
    const unsigned version = stream.bytes[0] & 0x0fu;
    return stream.mode == "ATTRIBUTES" ? version == 0 : version <= 1;
}

int decode(const MeshoptStream& stream, unsigned char* decoded) {
    const unsigned char* bytes = stream.bytes.data();
    const size_t size = stream.bytes.size();
    if (stream.mode == "ATTRIBUTES")
        return meshopt_decodeVertexBuffer(decoded, stream.count, stream.stride, bytes, size);
    if (stream.mode == "TRIANGLES") return meshopt_decodeIndexBuffer(decoded, stream.count, stream.stride, bytes, size);
    return meshopt_decodeIndexSequence(decoded, stream.count, stream.stride, bytes, size);
}

void apply_filter(const GltfFile& file, const MeshoptStream& stream, const std::string& where, unsigned char* decoded) {
    if (stream.filter.empty() || stream.filter == "NONE") return;
    const bool has_stride = stream.filter == "OCTAHEDRAL"    ? stream.stride == 4 || stream.stride == 8
                            : stream.filter == "QUATERNION"  ? stream.stride == 8
                            : stream.filter == "EXPONENTIAL" ? true
                                                             : false;
    if (!has_stride || stream.mode != "ATTRIBUTES")
        file.fail(where + ": the filter \"" + stream.filter + "\" is not known for this view");
    if (stream.filter == "OCTAHEDRAL") meshopt_decodeFilterOct(decoded, stream.count, stream.stride);
    if (stream.filter == "QUATERNION") meshopt_decodeFilterQuat(decoded, stream.count, stream.stride);
    if (stream.filter == "EXPONENTIAL") meshopt_decodeFilterExp(decoded, stream.count, stream.stride);
}

std::vector<unsigned char> decode_view(const GltfFile& file, const tinygltf::Value& object, const std::string& where) {
    const MeshoptStream stream = checked_stream(file, object, where);
    if (stream.mode != "ATTRIBUTES" && stream.mode != "TRIANGLES" && stream.mode != "INDICES")
        file.fail(where + ": the mode \"" + stream.mode + "\" is not known");
    if (!knows_version(stream))
        file.fail(where +
                  ": is a meshopt stream of a version that this program does not know; write the file again with "
                  "gltfpack -c or with gltf-transform meshopt --level medium");
    const uint64_t bytes = uint64_t(stream.count) * stream.stride;
    // Vertices of one value take a byte for each block of sixteen and channel, triangles at least a byte each.
    if (bytes / 512 > stream.bytes.size()) check_memory(file, where + ": the decoded elements", bytes);
    std::vector<unsigned char> decoded(static_cast<size_t>(bytes));
    if (decode(stream, decoded.data()) != 0) file.fail(where + ": the meshopt stream is damaged");
    apply_filter(file, stream, where, decoded.data());
    return decoded;
}

}  // namespace

void decode_meshopt_views(GltfFile& file) {
    for (size_t i = 0; i < file.model.bufferViews.size(); ++i) {
        const tinygltf::Value* object = stream_of(file.model.bufferViews[i]);
        if (!object) continue;
        tinygltf::Buffer buffer;
        buffer.data = decode_view(file, *object, "buffer view " + std::to_string(i));
        tinygltf::BufferView& view = file.model.bufferViews[i];
        view.buffer = int(file.model.buffers.size());
        view.byteOffset = 0;
        view.byteLength = buffer.data.size();
        file.model.buffers.push_back(std::move(buffer));
    }
}

}  // namespace lw
