#include <cstring>
#include <map>
#include <memory>

// Draco's headers do not hold our warnings.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#include <draco/compression/decode.h>
#pragma GCC diagnostic pop

#include "scene/gltf_accessor.h"
#include "scene/gltf_compression.h"

namespace lw {
namespace {

using DracoMesh = std::unique_ptr<draco::Mesh>;

DracoMesh decode_stream(const GltfFile& file, std::span<const unsigned char> bytes, const std::string& where) {
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const auto type = draco::Decoder::GetEncodedGeometryType(&buffer);
    if (!type.ok() || type.value() != draco::TRIANGULAR_MESH) file.fail(where + ": is no Draco triangle mesh");
    draco::Decoder decoder;
    auto mesh = decoder.DecodeMeshFromBuffer(&buffer);
    if (!mesh.ok()) file.fail(where + ": the Draco stream is damaged: " + mesh.status().error_msg_string());
    return std::move(mesh).value();
}

/// Appends bytes as a buffer and a view of their own; returns the view.
int add_view(tinygltf::Model& model, std::vector<unsigned char> bytes) {
    tinygltf::BufferView view;
    view.buffer = int(model.buffers.size());
    view.byteLength = bytes.size();
    tinygltf::Buffer& buffer = model.buffers.emplace_back();
    buffer.data = std::move(bytes);
    model.bufferViews.push_back(view);
    return int(model.bufferViews.size() - 1);
}

std::vector<unsigned char> indices_of(const draco::Mesh& mesh) {
    std::vector<uint32_t> indices;
    indices.reserve(size_t(mesh.num_faces()) * 3);
    for (draco::FaceIndex f(0); f < mesh.num_faces(); ++f)
        for (int c = 0; c < 3; ++c) indices.push_back(mesh.face(f)[size_t(c)].value());
    std::vector<unsigned char> bytes(indices.size() * sizeof(uint32_t));
    if (!bytes.empty()) std::memcpy(bytes.data(), indices.data(), bytes.size());
    return bytes;
}

/// The values of an attribute for each point of the mesh, in the component type of its accessor. False when a value
/// cannot be had.
template <class T>
bool write_values(const draco::Mesh& mesh, const draco::PointAttribute& attribute, int components,
                  std::vector<unsigned char>& bytes) {
    std::vector<T> row(static_cast<size_t>(components));
    const size_t row_bytes = row.size() * sizeof(T);
    bytes.resize(size_t(mesh.num_points()) * row_bytes);
    for (draco::PointIndex p(0); p < mesh.num_points(); ++p) {
        const draco::AttributeValueIndex value = attribute.mapped_index(p);
        if (value.value() >= attribute.size()) return false;
        if (!attribute.ConvertValue<T>(value, int8_t(components), row.data())) return false;
        std::memcpy(bytes.data() + size_t(p.value()) * row_bytes, row.data(), row_bytes);
    }
    return true;
}

bool write_values(const draco::Mesh& mesh, const draco::PointAttribute& attribute, int type, int components,
                  std::vector<unsigned char>& bytes) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return write_values<int8_t>(mesh, attribute, components, bytes);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return write_values<uint8_t>(mesh, attribute, components, bytes);
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return write_values<int16_t>(mesh, attribute, components, bytes);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return write_values<uint16_t>(mesh, attribute, components, bytes);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return write_values<uint32_t>(mesh, attribute, components, bytes);
        case TINYGLTF_COMPONENT_TYPE_FLOAT:
            return write_values<float>(mesh, attribute, components, bytes);
        default:
            return false;
    }
}

tinygltf::Accessor& accessor_of(GltfFile& file, int index, const std::string& where) {
    if (index < 0 || size_t(index) >= file.model.accessors.size())
        file.fail(where + ": there is no accessor " + std::to_string(index));
    return file.model.accessors[size_t(index)];
}

void set_rows(tinygltf::Accessor& accessor, int view, size_t count) {
    accessor.bufferView = view;
    accessor.byteOffset = 0;
    accessor.count = count;
    accessor.sparse.isSparse = false;
}

void replace_attribute(GltfFile& file, const draco::Mesh& mesh, int id, int accessor_index, const std::string& where) {
    const draco::PointAttribute* attribute = id < 0 ? nullptr : mesh.GetAttributeByUniqueId(uint32_t(id));
    if (!attribute) file.fail(where + ": the Draco stream has no attribute " + std::to_string(id));
    tinygltf::Accessor& accessor = accessor_of(file, accessor_index, where);
    const int components = tinygltf::GetNumComponentsInType(uint32_t(accessor.type));
    std::vector<unsigned char> bytes;
    if (components != attribute->num_components() ||
        !write_values(mesh, *attribute, accessor.componentType, components, bytes))
        file.fail(where + ": the Draco attribute and its accessor differ in type");
    const int view = add_view(file.model, std::move(bytes));
    set_rows(accessor, view, mesh.num_points());
}

void replace_indices(GltfFile& file, const draco::Mesh& mesh, int accessor_index, const std::string& where) {
    tinygltf::Accessor& accessor = accessor_of(file, accessor_index, where);
    accessor.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    accessor.type = TINYGLTF_TYPE_SCALAR;
    const int view = add_view(file.model, indices_of(mesh));
    set_rows(accessor, view, size_t(mesh.num_faces()) * 3);
}

void decode_primitive(GltfFile& file, const tinygltf::Value& object, size_t mesh_index, size_t index) {
    tinygltf::Primitive& primitive = file.model.meshes[mesh_index].primitives[index];
    const std::string where = label("mesh", mesh_index, file.model.meshes[mesh_index].name) + ": primitive " +
                              std::to_string(index) + ": KHR_draco_mesh_compression";
    const std::span<const unsigned char> bytes = read_view(file, index_of(object, "bufferView", -1), where);
    const DracoMesh mesh = decode_stream(file, bytes, where);
    const uint64_t corners = uint64_t(mesh->num_faces()) * 3;
    check_memory(file, where + ": the decoded triangles", corners * 4 + uint64_t(mesh->num_points()) * 64);
    if (primitive.indices < 0) {
        primitive.indices = int(file.model.accessors.size());
        file.model.accessors.emplace_back();
    }
    replace_indices(file, *mesh, primitive.indices, where);
    const tinygltf::Value& attributes = object.Get("attributes");
    for (const auto& [name, accessor] : primitive.attributes)
        if (attributes.Has(name)) replace_attribute(file, *mesh, index_of(attributes, name, -1), accessor, where);
    primitive.mode = TINYGLTF_MODE_TRIANGLES;  // strips too are decoded to lists
}

}  // namespace

void decode_draco_primitives(GltfFile& file) {
    for (size_t m = 0; m < file.model.meshes.size(); ++m)
        for (size_t p = 0; p < file.model.meshes[m].primitives.size(); ++p) {
            const tinygltf::ExtensionMap& extensions = file.model.meshes[m].primitives[p].extensions;
            const tinygltf::Value* object = extension_of(extensions, "KHR_draco_mesh_compression");
            if (object && object->Has("attributes") && object->Get("attributes").IsObject())
                decode_primitive(file, *object, m, p);
        }
}

}  // namespace lw
