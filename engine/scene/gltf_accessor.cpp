#include "scene/gltf_accessor.h"

#include <algorithm>
#include <cstring>

namespace lw {
namespace {

constexpr uint64_t max_rows = uint64_t(1) << 31;
constexpr uint64_t max_zero_rows = uint64_t(1) << 22;  // an accessor without a view costs the file nothing

/// Rows of raw components somewhere in a buffer.
struct RawRows {
    const unsigned char* bytes;
    size_t stride;
    size_t row(size_t i) const { return i * stride; }
};

size_t component_bytes(int type) {
    const int bytes = tinygltf::GetComponentSizeInBytes(uint32_t(type));
    return bytes > 0 && type != TINYGLTF_COMPONENT_TYPE_DOUBLE ? size_t(bytes) : 0;
}

/// Checks that `count` rows of `row_bytes` from `offset` lie inside the view; no sum here can overflow 64 bits.
RawRows rows_in_view(const GltfFile& file, int view_index, uint64_t offset, uint64_t count, uint64_t row_bytes,
                     const std::string& where) {
    const std::span<const unsigned char> view = read_view(file, view_index, where);
    const uint64_t declared = file.model.bufferViews[size_t(view_index)].byteStride;
    const uint64_t stride = declared ? declared : row_bytes;
    if (stride < row_bytes) file.fail(where + ": byteStride is smaller than an element");
    if (offset > view.size() ||
        (count > 0 && (row_bytes > view.size() - offset || (view.size() - offset - row_bytes) / stride < count - 1)))
        file.fail(where + ": reaches past the end of buffer view " + std::to_string(view_index));
    return {view.data() + offset, size_t(stride)};
}

template <class T>
float component(const unsigned char* bytes, bool normalized) {
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    if constexpr (!std::is_same_v<T, float>)
        if (normalized) return std::max(float(double(value) / double(std::numeric_limits<T>::max())), -1.0f);
    return float(value);
}

float read_component(const unsigned char* bytes, int type, bool normalized) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return component<int8_t>(bytes, normalized);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return component<uint8_t>(bytes, normalized);
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return component<int16_t>(bytes, normalized);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return component<uint16_t>(bytes, normalized);
        case TINYGLTF_COMPONENT_TYPE_INT:
            return component<int32_t>(bytes, normalized);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return component<uint32_t>(bytes, normalized);
        default:
            return component<float>(bytes, false);
    }
}

bool is_unsigned(int type) {
    return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
           type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

uint32_t read_unsigned(const unsigned char* bytes, size_t size) {
    uint32_t value = 0;
    std::memcpy(&value, bytes, size);  // little endian, as every machine with the GPUs we use
    return value;
}

const tinygltf::Accessor& checked_accessor(const GltfFile& file, int index, const std::string& where) {
    if (index < 0 || size_t(index) >= file.model.accessors.size())
        file.fail(where + ": there is no accessor " + std::to_string(index));
    const tinygltf::Accessor& accessor = file.model.accessors[size_t(index)];
    if (!component_bytes(accessor.componentType) || tinygltf::GetNumComponentsInType(uint32_t(accessor.type)) <= 0)
        file.fail(where + ": accessor " + std::to_string(index) + " has an unknown type");
    if (accessor.count > (accessor.bufferView < 0 ? max_zero_rows : max_rows))
        file.fail(where + ": accessor " + std::to_string(index) + " has too many elements");
    return accessor;
}

std::vector<uint32_t> sparse_rows(const GltfFile& file, const tinygltf::Accessor& accessor, const std::string& where) {
    const auto& sparse = accessor.sparse;
    const int type = sparse.indices.componentType;
    if (!is_unsigned(type)) file.fail(where + ": sparse indices must be unsigned");
    const size_t bytes = component_bytes(type);
    const RawRows raw = rows_in_view(file, sparse.indices.bufferView, uint64_t(sparse.indices.byteOffset),
                                     uint64_t(sparse.count), bytes, where);
    std::vector<uint32_t> rows(static_cast<size_t>(sparse.count));
    for (size_t i = 0; i < rows.size(); ++i) {
        rows[i] = read_unsigned(raw.bytes + raw.row(i), bytes);
        if (rows[i] >= accessor.count) file.fail(where + ": a sparse index is out of range");
    }
    return rows;
}

/// Calls write(row, bytes) for every stored row of the accessor: first the dense ones, then the sparse replacements.
template <class Write>
void for_each_row(const GltfFile& file, const tinygltf::Accessor& accessor, size_t row_bytes, const std::string& where,
                  const Write& write) {
    if (accessor.bufferView >= 0) {
        const RawRows raw =
            rows_in_view(file, accessor.bufferView, accessor.byteOffset, accessor.count, row_bytes, where);
        for (size_t i = 0; i < accessor.count; ++i) write(i, raw.bytes + raw.row(i));
    }
    if (!accessor.sparse.isSparse) return;
    const std::vector<uint32_t> rows = sparse_rows(file, accessor, where);
    const RawRows raw = rows_in_view(file, accessor.sparse.values.bufferView,
                                     uint64_t(accessor.sparse.values.byteOffset), rows.size(), row_bytes, where);
    for (size_t i = 0; i < rows.size(); ++i) write(rows[i], raw.bytes + raw.row(i));
}

}  // namespace

std::span<const unsigned char> read_view(const GltfFile& file, int view_index, const std::string& where) {
    const tinygltf::Model& model = file.model;
    if (view_index < 0 || size_t(view_index) >= model.bufferViews.size())
        file.fail(where + ": there is no buffer view " + std::to_string(view_index));
    const tinygltf::BufferView& view = model.bufferViews[size_t(view_index)];
    if (view.buffer < 0 || size_t(view.buffer) >= model.buffers.size())
        file.fail(where + ": buffer view " + std::to_string(view_index) + " has no buffer");
    const std::vector<unsigned char>& buffer = model.buffers[size_t(view.buffer)].data;
    if (view.byteOffset > buffer.size() || view.byteLength > buffer.size() - view.byteOffset)
        file.fail(where + ": buffer view " + std::to_string(view_index) + " reaches past the end of buffer " +
                  std::to_string(view.buffer));
    return {buffer.data() + view.byteOffset, view.byteLength};
}

FloatRows read_floats(const GltfFile& file, int index, const std::string& where) {
    const tinygltf::Accessor& accessor = checked_accessor(file, index, where);
    const size_t size = component_bytes(accessor.componentType);
    FloatRows rows;
    rows.count = accessor.count;
    rows.components = size_t(tinygltf::GetNumComponentsInType(uint32_t(accessor.type)));
    if (accessor.bufferView >= 0)  // before the allocation, so that a lying count does not ask for the memory
        rows_in_view(file, accessor.bufferView, accessor.byteOffset, accessor.count, size * rows.components, where);
    rows.values.assign(rows.count * rows.components, 0.0f);
    for_each_row(file, accessor, size * rows.components, where, [&](size_t row, const unsigned char* bytes) {
        for (size_t c = 0; c < rows.components; ++c)
            rows.values[row * rows.components + c] =
                read_component(bytes + c * size, accessor.componentType, accessor.normalized);
    });
    return rows;
}

std::vector<uint32_t> read_indices(const GltfFile& file, int index, const std::string& where) {
    const tinygltf::Accessor& accessor = checked_accessor(file, index, where);
    const int type = accessor.componentType;
    if (!is_unsigned(type) || accessor.type != TINYGLTF_TYPE_SCALAR)
        file.fail(where + ": indices must be unsigned scalars");
    const size_t size = component_bytes(type);
    if (accessor.bufferView >= 0)
        rows_in_view(file, accessor.bufferView, accessor.byteOffset, accessor.count, size, where);
    std::vector<uint32_t> indices(accessor.count, 0);
    for_each_row(file, accessor, size, where,
                 [&](size_t row, const unsigned char* bytes) { indices[row] = read_unsigned(bytes, size); });
    return indices;
}

}  // namespace lw
