#include "scene/gltf_file.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/input_file.h"
#include "base/memory.h"
#include "scene/gltf_extensions.h"
#include "scene/gltf_ranges.h"
#include "scene/gltf_repairs.h"

namespace lw {
namespace {

using Json = nlohmann::json;
constexpr size_t glb_header_bytes = 20;  // header and the head of the first chunk

std::vector<unsigned char> read_bytes(const std::filesystem::path& path) {
    std::ifstream stream = open_input(path, std::ios::ate);
    const std::streamoff size = stream ? std::streamoff(stream.tellg()) : -1;
    if (size < 0) throw Error(path.string() + ": cannot be opened");
    if (size >= std::streamoff(std::numeric_limits<uint32_t>::max()))
        throw Error(path.string() + ": larger than 4 GiB, which tinygltf cannot read; split it into .gltf and .bin");
    std::vector<unsigned char> bytes(size_t(size) + 1, 0);
    stream.seekg(0).read(reinterpret_cast<char*>(bytes.data()), size);
    if (!stream) throw Error(path.string() + ": cannot be read");
    bytes.pop_back();  // the zero stays in memory: tinygltf reads a few bytes beyond bad JSON
    return bytes;
}

bool is_binary(const std::vector<unsigned char>& bytes) {
    return bytes.size() >= 4 && !std::memcmp(bytes.data(), "glTF", 4);
}

uint32_t word_at(const std::vector<unsigned char>& bytes, size_t offset) {
    uint32_t word;
    std::memcpy(&word, bytes.data() + offset, 4);
    return word;
}

std::string_view json_text(const GltfFile& file, const std::vector<unsigned char>& bytes) {
    const char* text = reinterpret_cast<const char*>(bytes.data());
    if (!is_binary(bytes)) return {text, bytes.size()};
    if (bytes.size() < glb_header_bytes) file.fail("truncated: " + std::to_string(bytes.size()) + " bytes");
    const uint64_t declared = word_at(bytes, 8), json_bytes = word_at(bytes, 12);
    if (word_at(bytes, 4) != 2) file.fail("GLB version " + std::to_string(word_at(bytes, 4)) + "; only 2 is supported");
    if (declared > bytes.size())
        file.fail("truncated: " + std::to_string(bytes.size()) + " of " + std::to_string(declared) + " bytes");
    if (glb_header_bytes + json_bytes > declared) file.fail("the JSON chunk is longer than the file");
    // tinygltf 2.7 forgets the 8 bytes of this chunk's head in its own check and would read past the end.
    const uint64_t next = glb_header_bytes + json_bytes;
    if (next < declared && (next + 8 > declared || next + 8 + word_at(bytes, size_t(next)) > declared))
        file.fail("truncated: the BIN chunk is longer than the file");
    return {text + glb_header_bytes, size_t(json_bytes)};
}

/// Deepest nesting of brackets outside strings. Counted on the text: the parser's own callback takes quadratic time.
int depth_of(std::string_view text) {
    int depth = 0, deepest = 0;
    bool quoted = false;
    for (size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (quoted && c == '\\') ++i;
        if (c == '"') quoted = !quoted;
        if (quoted) continue;
        if (c == '{' || c == '[') deepest = std::max(deepest, ++depth);
        if (c == '}' || c == ']') --depth;
    }
    return deepest;
}

/// Parses the text, refusing nesting so deep that tinygltf's recursion would exhaust the stack.
Json parse_json(const GltfFile& file, std::string_view text) {
    if (depth_of(text) > 200) file.fail("JSON is nested too deeply");
    try {
        return Json::parse(text);
    } catch (const Json::exception& e) {
        file.fail(std::string("not valid JSON: ") + e.what());
    }
}

std::vector<std::string> strings_of(const Json& root, const char* key) {
    std::vector<std::string> strings;
    const auto it = root.find(key);
    if (it == root.end() || !it->is_array()) return strings;
    for (const Json& entry : *it)
        if (entry.is_string()) strings.push_back(entry.get<std::string>());
    return strings;
}

std::string percent_decoded(const std::string& uri) {
    std::string text;
    for (size_t i = 0; i < uri.size(); ++i) {
        const bool escape = uri[i] == '%' && i + 2 < uri.size() && std::isxdigit(uint8_t(uri[i + 1])) &&
                            std::isxdigit(uint8_t(uri[i + 2]));
        text += escape ? char(std::stoi(uri.substr(i + 1, 2), nullptr, 16)) : uri[i];
        if (escape) i += 2;
    }
    return text;
}

bool stays_in_folder(const std::string& uri) {
    std::string text = percent_decoded(uri);
    std::replace(text.begin(), text.end(), '\\', '/');
    if (text.starts_with('/') || text.find("://") != std::string::npos || (text.size() > 1 && text[1] == ':'))
        return false;
    const std::filesystem::path normal = std::filesystem::path(text).lexically_normal();  // a/../b is b
    return normal.empty() || *normal.begin() != "..";
}

void check_uris(const GltfFile& file, const Json& root, const char* kind) {
    const auto it = root.find(kind);
    if (it == root.end() || !it->is_array()) return;
    for (const Json& entry : *it) {
        if (!entry.is_object() || !entry.contains("uri") || !entry["uri"].is_string()) continue;
        const auto uri = entry["uri"].get<std::string>();
        if (!uri.starts_with("data:") && !stays_in_folder(uri))
            file.fail(std::string(kind) + ": \"" + uri.substr(0, 80) + "\" is not inside the folder of the file");
    }
}

std::string ignored_extension(const std::string& extension) {
    return "the extension " + extension + " is ignored; the look may differ";
}

/// What must be known before tinygltf decodes anything: it checks neither extensionsRequired nor where URIs lead.
void check_before_parsing(GltfFile& file, const Json& root, bool strict) {
    const auto asset = root.find("asset");
    const bool has_version =
        asset != root.end() && asset->is_object() && asset->contains("version") && (*asset)["version"].is_string();
    const std::string version = has_version ? (*asset)["version"].get<std::string>() : "";
    if (!version.starts_with("2."))
        file.fail(version.empty() ? "has no asset.version" : "is glTF " + version + ", not 2.0");
    for (const std::string& extension : strings_of(root, "extensionsRequired")) {
        if (reads_extension(extension)) continue;
        if (strict || may_change_geometry(extension))
            file.fail("requires the extension " + extension + ", which is not supported");
        file.warn(ignored_extension(extension));
    }
    for (const std::string& extension : strings_of(root, "extensionsUsed"))
        if (changes_look(extension)) file.warn(ignored_extension(extension));
    if (has_version && asset->contains("minVersion") && (*asset)["minVersion"] != "2.0")
        file.fail("needs a reader of glTF " + (*asset)["minVersion"].dump() + ", not 2.0");
    check_ranges(file, root);
    check_uris(file, root, "buffers");
    check_uris(file, root, "images");
}

/// The file with another JSON text.
std::vector<unsigned char> with_json(const std::vector<unsigned char>& bytes, std::string text) {
    if (!is_binary(bytes)) return {text.begin(), text.end()};
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const auto rest = bytes.begin() + glb_header_bytes + word_at(bytes, 12), end = bytes.begin() + word_at(bytes, 8);
    std::vector<unsigned char> changed(glb_header_bytes + text.size() + size_t(end - rest));
    std::copy_n(bytes.begin(), glb_header_bytes, changed.begin());
    std::copy(text.begin(), text.end(), changed.begin() + glb_header_bytes);
    std::copy(rest, end, changed.end() - (end - rest));
    const uint32_t sizes[] = {uint32_t(changed.size()), uint32_t(text.size())};
    std::memcpy(changed.data() + 8, sizes, sizeof sizes);
    return changed;
}

/// Keeps the encoded bytes of an image with a URI; images in buffer views are read, bounds-checked, when needed.
bool keep_encoded(tinygltf::Image* image, const int, std::string*, std::string*, int, int, const unsigned char* bytes,
                  int size, void*) {
    if (image->bufferView < 0 && size > 0) image->image.assign(bytes, bytes + size);
    return true;
}

/// The folder of the glTF file, and the files that tinygltf read from it.
struct ExternalFiles {
    std::string folder;
    std::vector<std::filesystem::path> read;
};

bool exists_in_folder(const std::string& path, void* files) {
    // tinygltf also searches the working directory; only files beside the scene are meant.
    return path.starts_with(static_cast<const ExternalFiles*>(files)->folder) && std::filesystem::is_regular_file(path);
}

/// The path without `a/..`, also where there is no folder a. Replaces tinygltf's own function, which hands the name to
/// wordexp(3), which runs `$(...)`.
std::string plain_path(const std::string& path, void*) {
    return std::filesystem::path(path).lexically_normal().string();
}

bool read_external(std::vector<unsigned char>* bytes, std::string* error, const std::string& path, void* files) {
    try {
        *bytes = read_bytes(path);
        static_cast<ExternalFiles*>(files)->read.push_back(path);
        return true;
    } catch (const std::exception& e) {
        *error += e.what();
        return false;
    }
}

/// Makes one line of tinygltf's messages, which have several.
std::string shortened(std::string text) {
    while (!text.empty() && text.back() == '\n') text.pop_back();
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text.size() > 300 ? text.substr(0, 300) + "..." : text;
}

/// Removes line ends from the names of all elements, which are printed and written into tables.
template <class... Lists>
void clean_names(Lists&... lists) {
    const auto clean = [](auto& list) {
        for (auto& entry : list) entry.name = one_line(std::move(entry.name));
    };
    (clean(lists), ...);
}

}  // namespace

void GltfFile::warn(const std::string& what) {
    const std::string line = one_line(name + ": " + what);
    if (std::find(warnings.begin(), warnings.end(), line) == warnings.end()) warnings.push_back(line);
}

GltfFile open_gltf(const std::filesystem::path& path, bool strict) {
    GltfFile file;
    file.name = path.filename().string();
    std::vector<unsigned char> bytes = read_bytes(path);
    Json root = parse_json(file, json_text(file, bytes));
    check_before_parsing(file, root, strict);
    if (repair_for_tinygltf(root)) bytes = with_json(bytes, root.dump());

    ExternalFiles files{std::filesystem::absolute(path).parent_path().string(), {path}};
    std::string error, unused;
    tinygltf::TinyGLTF parser;
    parser.SetImageLoader(keep_encoded, nullptr);
    parser.SetFsCallbacks({exists_in_folder, plain_path, read_external, tinygltf::WriteWholeFile, &files});
    bool parsed = false;
    try {
        const auto size = unsigned(bytes.size());
        parsed = is_binary(bytes)
                     ? parser.LoadBinaryFromMemory(&file.model, &error, &unused, bytes.data(), size, files.folder)
                     : parser.LoadASCIIFromString(&file.model, &error, &unused,
                                                  reinterpret_cast<const char*>(bytes.data()), size, files.folder);
    } catch (const std::exception& e) {
        error += e.what();
    }
    if (!parsed) file.fail("malformed glTF: " + shortened(error.empty() ? "unknown reason" : error));
    tinygltf::Model& m = file.model;
    clean_names(m.nodes, m.meshes, m.materials, m.cameras, m.lights, m.images);
    file.read = std::move(files.read);
    return file;
}

void check_memory(const GltfFile& file, const std::string& what, uint64_t bytes) {
    constexpr uint64_t always_there = uint64_t(256) << 20;  // not worth asking
    if (bytes > always_there && bytes > available_memory())
        file.fail(what + " take " + bytes_text(bytes) + ", there are " + bytes_text(available_memory()));
}

std::string decoded_uri(const GltfFile& file, const std::string& uri) {
    if (!stays_in_folder(uri)) file.fail("\"" + uri.substr(0, 80) + "\" is not inside the folder of the file");
    return percent_decoded(uri);
}

std::string label(std::string_view kind, size_t index, const std::string& name) {
    return std::string(kind) + " " + std::to_string(index) + (name.empty() ? "" : " \"" + name + "\"");
}

double number_of(const tinygltf::Value& object, const std::string& key, double otherwise) {
    if (!object.IsObject() || !object.Has(key) || !object.Get(key).IsNumber()) return otherwise;
    return object.Get(key).GetNumberAsDouble();
}

int index_of(const tinygltf::Value& object, const std::string& key, int otherwise) {
    const double value = number_of(object, key, otherwise);
    return value >= -1 && value < 2147483647.0 ? int(value) : otherwise;
}

const tinygltf::Value* extension_of(const tinygltf::ExtensionMap& extensions, const std::string& key) {
    const auto it = extensions.find(key);
    return it != extensions.end() && it->second.IsObject() ? &it->second : nullptr;
}

}  // namespace lw
