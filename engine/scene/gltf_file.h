// A parsed glTF file before it becomes a Scene: tinygltf's model, the name used in messages, and the warnings so far.
// Only engine/scene/gltf*.{h,cpp} include this.
#pragma once
#include <tiny_gltf.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/one_line.h"

namespace lw {

/// Largest extent of a scene. Beyond it, powers of distances overflow the floats of rays and estimates.
constexpr double max_metres = 1e9;
/// Largest intensity of a lamp, in cd, lx or cd/m2. Squares of errors then still fit into floats.
constexpr float max_strength = 1e15f;

struct GltfFile {
    std::string name;  // file name without folder, the first word of every message
    tinygltf::Model model;
    std::vector<std::string> warnings;
    std::vector<std::filesystem::path> read;  // this file, its buffers and images

    /// Throws Error("name: what").
    [[noreturn]] void fail(const std::string& what) const { throw Error(one_line(name + ": " + what)); }
    /// Adds a warning unless the same was said before.
    void warn(const std::string& what);
};

/// Reads and parses a .glb or .gltf (told apart by content) with its external buffers; images stay encoded in
/// Image::image. Throws Error for a truncated file, a URI out of the folder, and a required extension that is not read:
/// when it may change the geometry, or any when `strict`.
GltfFile open_gltf(const std::filesystem::path& path, bool strict);

/// Throws Error("NAME: WHAT take 5 GB, there are 4 GB") when `bytes` are more than the memory available. Called before
/// a large allocation.
void check_memory(const GltfFile& file, const std::string& what, uint64_t bytes);

/// The path that a URI of the file names, relative to its folder. Throws Error for one that leaves the folder.
std::string decoded_uri(const GltfFile& file, const std::string& uri);

/// `mesh 3 "lamp"`, or `mesh 3` when it has no name.
std::string label(std::string_view kind, size_t index, const std::string& name);

/// A member of a JSON extension object, or the default when absent or of another type.
double number_of(const tinygltf::Value& object, const std::string& key, double otherwise);
int index_of(const tinygltf::Value& object, const std::string& key, int otherwise);
/// Extension `key` as an object, or nullptr.
const tinygltf::Value* extension_of(const tinygltf::ExtensionMap& extensions, const std::string& key);

}  // namespace lw
