// The fuzzers' corpora as ordinary tests: every input that once mattered is refused or harmless, under ASan too.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "base/error.h"
#include "fuzz/feed.h"
#include "maps/bake.h"

namespace lw::test {
namespace {

std::vector<std::filesystem::path> files_in(const char* corpus) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry :
         std::filesystem::directory_iterator(std::string(LUMENWALK_SOURCE_DIR "/tests/fuzz/") + corpus))
        files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

std::vector<uint8_t> bytes_of(const std::filesystem::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// A whole bake of what was accepted: it ends, by a map or by one Error.
void bake(const Scene& scene) {
    try {
        const RayCaster caster(scene);
        lw::bake(scene, caster, {.photons = 200});
    } catch (const Error&) {
    }
}

TEST(Corpus, OfGltfFilesIsRefusedOrBakes) {
    size_t accepted = 0;
    for (const std::filesystem::path& path : files_in("corpus_gltf")) {
        std::optional<Scene> scene;
        ASSERT_NO_THROW(scene = feed_gltf(bytes_of(path))) << path;
        if (!scene) continue;
        ++accepted;
        if (scene->triangles.size() > 10000) continue;
        ASSERT_NO_THROW(bake(*scene)) << path;
    }
    EXPECT_GE(accepted, 7u);  // the seeds
}

TEST(Corpus, OfMapsIsRefusedOrGathers) {
    size_t accepted = 0;
    for (const std::filesystem::path& path : files_in("corpus_map"))
        ASSERT_NO_THROW(accepted += feed_map(bytes_of(path)).has_value()) << path;
    EXPECT_GE(accepted, 1u) << "none is of the present version";
}

}  // namespace
}  // namespace lw::test
