#include <gtest/gtest.h>

#include <cmath>

#include "scene/gltf_text.h"

namespace lw::test {

TEST(GltfGeometry, ReadsIndicesOfEveryWidth) {
    for (const int component : {5121, 5123, 5125}) {
        GltfText g = square();
        Json& primitive = g.primitive();
        if (component == 5121)
            primitive["indices"] = g.accessor(std::vector<uint8_t>{0, 1, 2, 0, 2, 3}, "SCALAR", component);
        if (component == 5125)
            primitive["indices"] = g.accessor(std::vector<uint32_t>{0, 1, 2, 0, 2, 3}, "SCALAR", component);
        const Scene s = g.load();
        ASSERT_EQ(s.triangles.size(), 2u);
        EXPECT_EQ(s.triangles[1], uvec3(0, 2, 3));
        EXPECT_EQ(s.positions.size(), 4u);
        EXPECT_EQ(front_of(s, 0), vec3(0, 0, 1));
    }
}

TEST(GltfGeometry, ReadsTrianglesWithoutIndices) {
    GltfText g;
    g.floats("POSITION", {0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
    EXPECT_EQ(g.load().triangles.size(), 1u);
}

TEST(GltfGeometry, StripsAndFansKeepTheirFront) {
    GltfText strip = square();
    strip.primitive()["mode"] = 5;
    strip.primitive()["indices"] = strip.accessor(std::vector<uint8_t>{0, 1, 3, 2}, "SCALAR", 5121);
    GltfText fan = square();
    fan.primitive()["mode"] = 6;
    fan.primitive()["indices"] = fan.accessor(std::vector<uint8_t>{0, 1, 2, 3}, "SCALAR", 5121);
    for (const Scene& s : {strip.load(), fan.load()}) {
        ASSERT_EQ(s.triangles.size(), 2u);
        for (size_t t = 0; t < 2; ++t) EXPECT_EQ(front_of(s, t), vec3(0, 0, 1));
    }
}

TEST(GltfGeometry, PointsAndLinesAreSkippedWithAWarning) {
    GltfText g = square();
    g.doc["meshes"][0]["primitives"].push_back({{"mode", 1}, {"attributes", {{"POSITION", 0}}}});
    const Scene s = g.load();
    EXPECT_EQ(s.triangles.size(), 2u);
    ASSERT_EQ(s.warnings.size(), 1u);
    EXPECT_NE(s.warnings[0].find("points and lines"), std::string::npos);
}

TEST(GltfGeometry, SparseValuesReplaceDenseOnes) {
    GltfText g = square();
    const int indices = g.view(std::vector<uint16_t>{2}), values = g.view(std::vector<float>{5, 1, 0});
    g.doc["accessors"][0]["sparse"] = {{"count", 1},
                                       {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
                                       {"values", {{"bufferView", values}}}};
    EXPECT_EQ(world(g.load(), 2), glm::dvec3(5, 1, 0));
}

TEST(GltfGeometry, MirroringKeepsFrontAndNormalTogether) {
    GltfText g = square();
    g.node()["scale"] = {-1, 2, 3};
    const Scene s = g.load();
    for (size_t t = 0; t < 2; ++t) EXPECT_EQ(front_of(s, t), vec3(0, 0, 1));
    for (vec3 n : s.normals) EXPECT_EQ(n, vec3(0, 0, 1));
}

TEST(GltfGeometry, NormalsFollowTheInverseTranspose) {
    GltfText g;
    g.floats("POSITION", {0, 0, 0, 1, -1, 0, 0, 0, 1}, "VEC3");
    const float h = std::sqrt(0.5f);
    g.floats("NORMAL", {-h, -h, 0, -h, -h, 0, -h, -h, 0}, "VEC3");
    g.node()["scale"] = {2, 1, 1};
    const Scene s = g.load();
    EXPECT_NEAR(std::abs(dot(s.normals[0], front_of(s, 0))), 1, 1e-6);
}

TEST(GltfGeometry, MissingNormalsAreFlat) {
    GltfText g;
    g.floats("POSITION", {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 1}, "VEC3");
    g.primitive()["indices"] = g.accessor(std::vector<uint8_t>{0, 1, 2, 0, 3, 1}, "SCALAR", 5121);
    const Scene s = g.load();
    ASSERT_EQ(s.positions.size(), 6u);
    for (size_t t = 0; t < 2; ++t)
        for (int c = 0; c < 3; ++c) EXPECT_EQ(s.normals[s.triangles[t][c]], front_of(s, t));
}

TEST(GltfGeometry, QuantizedPositionsAndNormals) {
    GltfText g;
    g.doc["extensionsUsed"].push_back("KHR_mesh_quantization");
    g.doc["extensionsRequired"] = {"KHR_mesh_quantization"};
    g.attribute("POSITION",
                g.accessor(std::vector<int16_t>{-32767, 0, 0, 32767, 0, 0, 0, 32767, 0}, "VEC3", 5122, true));
    g.doc["bufferViews"][0]["byteLength"] = 18;
    g.attribute("NORMAL",
                g.accessor(std::vector<int8_t>{0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 127, 0}, "VEC4", 5120, true));
    g.doc["accessors"][1]["type"] = "VEC3";
    g.doc["bufferViews"][1]["byteStride"] = 4;
    const Scene s = g.load();
    EXPECT_EQ(world(s, 0), glm::dvec3(-1, 0, 0));
    EXPECT_EQ(world(s, 2), glm::dvec3(0, 1, 0));
    EXPECT_EQ(s.normals[1], vec3(0, 0, 1));
}

TEST(GltfGeometry, GpuInstancesAreCopies) {
    GltfText g = square();
    const int places = g.accessor(std::vector<float>{0, 0, 0, 10, 0, 0, 0, 20, 0}, "VEC3", 5126);
    g.node()["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = places;
    g.doc["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
    const Scene s = g.load();
    EXPECT_EQ(s.objects.size(), 3u);
    EXPECT_EQ(s.triangles.size(), 6u);
    EXPECT_EQ(world(s, 4), glm::dvec3(10, 0, 0));
}

TEST(GltfGeometry, NodesSharingAMeshAndHierarchy) {
    GltfText g = square();
    g.node()["children"] = {2};
    g.node()["translation"] = {1, 0, 0};
    g.doc["nodes"].push_back({{"mesh", 0}, {"translation", {0, 5, 0}}});
    const Scene s = g.load();
    ASSERT_EQ(s.objects.size(), 2u);
    EXPECT_EQ(world(s, 4), glm::dvec3(1, 5, 0));
    EXPECT_EQ(s.object_names[0], "thing");
}

TEST(GltfGeometry, FarFromZeroNothingIsLost) {
    GltfText g = square();
    g.node()["translation"] = {1e7, 0, 0};
    g.doc["nodes"][1]["translation"] = {1e7, 0, 1};
    const Scene s = g.load();
    EXPECT_EQ(s.positions[1] - s.positions[0], vec3(1, 0, 0));
    EXPECT_EQ(s.origin.x, 1e7 + 0.5);
    EXPECT_EQ(s.lights[0].position, vec3(-0.5f, -0.5f, 1));
}

TEST(GltfGeometry, UnreferencedVerticesAreDropped) {
    GltfText g = square();
    g.primitive()["indices"] = g.accessor(std::vector<uint8_t>{1, 2, 3}, "SCALAR", 5121);
    const Scene s = g.load();
    EXPECT_EQ(s.positions.size(), 3u);
    EXPECT_EQ(world(s, 0), glm::dvec3(1, 0, 0));
}

}  // namespace lw::test
