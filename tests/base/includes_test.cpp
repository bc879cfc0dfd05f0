// "Who may include whom" of docs/house.md, and one library behind one fence, held by reading the sources.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
using Names = std::set<std::string>;

/// Folder of engine/ -> folders it may include besides itself.
const std::map<std::string, Names> allowed_folders = {
    {"base", {}},
    {"image", {"base"}},
    {"photometry", {"base"}},
    {"scene", {"base", "image", "photometry"}},
    {"daylight", {"base", "photometry", "scene"}},
    {"trace", {"base", "image", "scene", "daylight"}},
    {"photons", {"base", "scene", "trace"}},
    {"maps", {"base", "scene", "photons", "trace"}},
    {"file", {"base", "scene", "maps"}},
    {"measure", {"base", "image", "scene", "daylight", "trace", "photons", "maps"}},
    {"gpu", {"base"}},
    {"gather", {"base", "image", "scene", "maps", "gpu"}},
};

/// Start of an include path, of a library or of the whole text of the gather -> the sources of engine/ (files or
/// folders) that may name it.
const std::map<std::string, std::vector<std::string>> fences = {
    {"embree", {"trace/ray_caster.", "trace/build_bvh."}},
    {"tiny_gltf", {"scene/gltf"}},
    {"OpenEXR/", {"image/exr."}},
    {"stb/", {"image/png."}},
    {"webp/", {"image/webp."}},
    {"draco/", {"scene/gltf_draco."}},
    {"meshoptimizer", {"scene/gltf_meshopt."}},
    {"tbb/", {"base/parallel.h"}},
    {"vulkan/", {"gpu/", "gather/"}},
    {"CLI/", {}},
    {"GLFW/", {}},
    {"imgui", {}},
    {"spirv-tools/", {"gpu/specialize."}},
    {"maps/estimate.h", {"measure/probe.", "measure/view."}},
    {"shaders/gather.glsl", {"maps/estimate."}},
    {"shaders/follow.glsl", {"maps/estimate."}},
    {"nlohmann/",
     {"scene/ambiance.", "scene/json_file.", "scene/recorded_path.", "scene/gltf_file.", "scene/gltf_ranges.",
      "scene/gltf_repairs."}},
};

struct Include {
    std::string source;  // relative to engine/, "maps/build.cpp"
    std::string target;  // as written, "base/error.h"
};

/// What an `#include` line names, or nothing for any other line. By hand: std::regex under ASan trips GCC 12's -Werror.
std::string included_path(const std::string& line) {
    size_t start = line.find_first_not_of(" \t");
    if (start == std::string::npos || line.compare(start, 8, "#include") != 0) return "";
    size_t open = line.find_first_of("<\"", start), close = line.find_first_of(">\"", open + 1);
    return close == std::string::npos ? "" : line.substr(open + 1, close - open - 1);
}

std::vector<Include> find_includes(const fs::path& engine) {
    std::vector<Include> includes;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(engine)) {
        if (!entry.is_regular_file()) continue;
        std::string source = fs::relative(entry.path(), engine).generic_string();
        std::ifstream stream(entry.path());
        for (std::string line; std::getline(stream, line);)
            if (std::string target = included_path(line); !target.empty()) includes.push_back({source, target});
    }
    return includes;
}

std::string first_folder(const std::string& path) { return path.substr(0, path.find('/')); }

bool starts_with(const std::string& text, const std::string& start) { return text.rfind(start, 0) == 0; }

std::vector<Include> engine_includes() {
    std::vector<Include> includes = find_includes(fs::path(LUMENWALK_SOURCE_DIR) / "engine");
    EXPECT_GT(includes.size(), 20u) << "no sources found: is LUMENWALK_SOURCE_DIR right?";
    return includes;
}

TEST(Includes, EachFolderSeesOnlyTheFoldersBeforeIt) {
    for (const Include& include : engine_includes()) {
        std::string from = first_folder(include.source), to = first_folder(include.target);
        ASSERT_TRUE(allowed_folders.count(from))
            << "engine/" << from << " is not in the house: add it to docs/house.md";
        EXPECT_NE(to, "tools") << include.source;
        EXPECT_NE(to, "app") << include.source;
        if (include.target.find('/') == std::string::npos || to == from || !allowed_folders.count(to)) continue;
        EXPECT_TRUE(allowed_folders.at(from).count(to))
            << "engine/" << include.source << " includes " << include.target;
    }
}

TEST(Includes, EachLibraryIsNamedBehindItsFenceOnly) {
    for (const Include& include : engine_includes()) {
        for (const auto& [library, users] : fences) {
            if (!starts_with(include.target, library)) continue;
            bool allowed = false;
            for (const std::string& user : users) allowed = allowed || starts_with(include.source, user);
            EXPECT_TRUE(allowed) << "engine/" << include.source << " includes <" << include.target << ">";
        }
    }
}

}  // namespace
