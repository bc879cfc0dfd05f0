// Reads glTF accessors into plain arrays with every bound checked: accessor -> buffer view -> buffer, sparse or not.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "scene/gltf_file.h"

namespace lw {

/// `count` rows of `components` floats; normalised integers are mapped to [0, 1] or [-1, 1].
struct FloatRows {
    size_t count = 0;
    size_t components = 0;
    std::vector<float> values;
    const float* row(size_t i) const { return values.data() + i * components; }
};

/// Reads any numeric accessor as floats; `where` opens the error message ("mesh 3 \"lamp\": primitive 0: POSITION").
FloatRows read_floats(const GltfFile& file, int accessor, const std::string& where);

/// Reads an unsigned scalar accessor of 8, 16 or 32 bits.
std::vector<uint32_t> read_indices(const GltfFile& file, int accessor, const std::string& where);

/// The bytes of a buffer view.
std::span<const unsigned char> read_view(const GltfFile& file, int view, const std::string& where);

}  // namespace lw
