// The small files beside a scene, damaged: ambiances, bookmarks and recorded walks are taken or refused by one line
// that names them, and what is taken can be used.
#include <gtest/gtest.h>

#include <cmath>

#include "app/walk/places.h"
#include "base/error.h"
#include "base/random.h"
#include "programs/command.h"
#include "scene/ambiance.h"
#include "scene/gltf.h"

namespace lw {
namespace {

const Scene& cornell() {
    static const Scene scene = load_gltf(LUMENWALK_SOURCE_DIR "/data/cornell.gltf");
    return scene;
}

/// Tokens that JSON of a stranger may hold where a number, a name or a list was.
const char* const odd_tokens[] = {"null", "true",  "-1",       "1e308", "-1e308",      "1e-320", "9223372036854775808",
                                  "[]",   "{}",    "\"\"",     "[[[[",  "\"\\ud800\"", "nan",    "Infinity",
                                  "-0.0", "1e999", "\"\xff\"", "0.5",   "[1,2,3,4]",   "//",     ","};

/// One to three damages: a byte flipped, a piece cut out or doubled, the end cut off, an odd token put in.
std::string damaged(std::string text, uint64_t index) {
    Rng rng(11, 5, index);
    const auto below = [&](size_t count) { return std::min(size_t(rng.next() * float(count)), count - 1); };
    for (size_t left = 1 + below(3); left > 0 && !text.empty(); --left) {
        const size_t at = below(text.size()), size = 1 + below(12);
        switch (below(5)) {
            case 0:
                text[at] = char(below(256));
                break;
            case 1:
                text.erase(at, size);
                break;
            case 2:
                text.insert(below(text.size()), text.substr(at, size));
                break;
            case 3:
                text.resize(at);
                break;
            default: {  // in place of a number, if one begins nearby
                const size_t digit = std::min(text.find_first_of("0123456789", at), text.size());
                const size_t end = std::min(text.find_first_not_of("0123456789.-+e", digit), text.size());
                text.replace(digit, end - digit, odd_tokens[below(std::size(odd_tokens))]);
            }
        }
    }
    return text;
}

/// Reads 10,000 damaged copies with `take`, which uses what it gets; returns how many were taken.
template <class Take>
size_t feed(const std::string& whole, const Take& take) {
    const TempFolder folder;
    const std::string path = folder / "cornell.some.json";
    size_t taken = 0;
    for (uint64_t i = 0; i < 10'000; ++i) {
        const std::string text = damaged(whole, i);
        write_text(path, text);
        try {
            take(path);
            ++taken;
        } catch (const Error& refusal) {
            const std::string told = refusal.what();
            EXPECT_NE(told.find("cornell"), std::string::npos) << told;
            EXPECT_EQ(told.find('\n'), std::string::npos) << told << "\n" << text;
        }
        if (testing::Test::HasFailure()) {
            ADD_FAILURE() << "damage " << i << ":\n" << text;
            break;
        }
    }
    return taken;
}

TEST(DamagedJson, OfAmbiancesIsRefusedOrGivesPowersThatAreNumbers) {
    const std::string whole = R"({"ambiances": {"Evening": {"ceiling_lamp": 0.4, "floor lamp": {"factor": 1.25,
        "color": [1, 0.8, 0.5]}}, "Off": {"ceiling_lamp": 0}}, "groups": {"Ceiling": ["ceiling_lamp", "spot"]}})";
    const size_t taken = feed(whole, [](const std::string& path) {
        for (const auto& [name, ambiance] : load_lamp_presets(path).ambiances)
            for (const auto& [lamp, setting] : ambiance) {
                const vec3 power = setting.factor * setting.color;
                EXPECT_TRUE(std::isfinite(power.x + power.y + power.z)) << name;
                EXPECT_TRUE(power.x >= 0 && power.y >= 0 && power.z >= 0) << name;
            }
    });
    EXPECT_GT(taken, 100u);
    EXPECT_LT(taken, 9'900u);
}

void expect_usable(const Camera& camera) {
    const vec3 p = camera.position;
    EXPECT_TRUE(std::isfinite(p.x + p.y + p.z));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(length(camera.rotation[c]), 1, 1e-3f);
    EXPECT_GT(camera.yfov, 0.01f);
    EXPECT_LT(camera.yfov, 3.0f);
}

TEST(DamagedJson, OfBookmarksIsRefusedOrGivesCameras) {
    const std::string whole = R"({"bookmarks": [{"name": "desk", "position": [1.5, 1.2, -3], "yaw_deg": 12.5,
        "pitch_deg": -7, "fov_deg": 60}, {"name": "door", "position": [0, 1.6, 4e2], "fov_deg": 0}]})";
    const size_t taken = feed(whole, [](const std::string& path) {
        for (const Bookmark& b : load_bookmarks(path)) expect_usable(camera_of(b, cornell(), 1.0f, 0.05f));
    });
    EXPECT_GT(taken, 100u);
    EXPECT_LT(taken, 9'900u);
}

TEST(DamagedJson, OfWalksIsRefusedOrGivesCamerasAtAllTimes) {
    const std::string whole = R"({"fps": 30, "fov_deg": 60, "keys": [{"time": 0, "position": [0, 1, 4], "yaw_deg": 10},
        {"time": 1.5, "position": [1, 1.5, 3], "yaw_deg": -170, "pitch_deg": 5}, {"time": 2, "position": [1, 1, 0]}]})";
    const size_t taken = feed(whole, [](const std::string& file) {
        const Path path = load_path(file);
        EXPECT_LE(path.seconds() * path.frames_per_second, 1e6);
        for (double part : {-1.0, 0.0, 0.3, 0.7, 1.0, 2.0})
            expect_usable(camera_on(path, part * path.seconds(), cornell()));
    });
    EXPECT_GT(taken, 100u);
    EXPECT_LT(taken, 9'900u);
}

/// Each of these was found by taking its check away: no test failed.
TEST(DamagedJson, WhatOnlyOneCheckRefusesIsNamed) {
    const TempFolder folder;
    const std::string path = folder / "cornell.some.json";
    const auto told_of = [&](const std::string& text) -> std::string {
        write_text(path, text);
        try {
            load_bookmarks(path);
        } catch (const Error& refusal) {
            return refusal.what();
        }
        return "";
    };
    const auto refused = [&](const std::string& entry, const std::string& told) {
        EXPECT_EQ(told_of(R"({"bookmarks": [{"position": [0, 0, 0]}, )" + entry + "]}"), path + ": " + told) << entry;
    };
    refused("{}", "bookmark 2: position must be [x, y, z] in metres");
    refused(R"({"position": [0, 0]})", "bookmark 2: position must be [x, y, z] in metres");
    refused(R"({"position": [0, "x", 0]})", "bookmark 2: position must be [x, y, z] in metres");
    refused(R"({"position": [0, 1e300, 0]})", "bookmark 2: position is out of range");
    refused(R"({"position": [0, 0, 0], "yaw_deg": "north"})", "bookmark 2: yaw_deg must be a number");
    refused(R"({"position": [0, 0, 0], "yaw_deg": 1e10})", "bookmark 2: yaw_deg is out of range");
    refused(R"({"position": [0, 0, 0], "fov_deg": 0.5})", "bookmark 2: fov_deg must be from 1 to 150");
    refused("3", "bookmarks: every entry must be an object");
    EXPECT_EQ(told_of("[]"), path + ": must have a list \"bookmarks\"");
    EXPECT_EQ(told_of(R"({"bookmarks": {}})"), path + ": must have a list \"bookmarks\"");
    for (const std::string& other : {folder / "cornell.none.json", folder / "."}) {
        try {
            load_path(other);
            ADD_FAILURE() << other;
        } catch (const Error& refusal) {
            EXPECT_EQ(std::string(refusal.what()), other + ": cannot be opened");
        }
    }
}

TEST(DamagedJson, NamesWrittenTwiceAreRefused) {
    const TempFolder folder;
    const std::string path = folder / "cornell.ambiances.json";
    write_text(path, R"({"ambiances": {"day": {"lamp": 1}, "evening": {"lamp": 0.5}, "day": {"lamp": 2}}})");
    try {
        load_lamp_presets(path);
        ADD_FAILURE();
    } catch (const Error& refusal) {
        EXPECT_EQ(std::string(refusal.what()), path + ": \"day\" is written twice in one object");
    }
    write_text(path, R"({"ambiances": {"day": {"lamp": 1}, "evening": {"lamp": 0.5}}})");
    EXPECT_EQ(load_lamp_presets(path).ambiances.size(), 2u);
}

TEST(DamagedJson, NestedDeeplyOrHugeIsRefused) {
    const TempFolder folder;
    const std::string path = folder / "cornell.some.json";
    for (const std::string& text : {std::string(200'000, '['), std::string(200'000, '[') + std::string(200'000, ']'),
                                    std::string((65u << 20), ' ')}) {
        write_text(path, text);
        EXPECT_THROW(load_lamp_presets(path), Error) << text.size();
        EXPECT_THROW(load_bookmarks(path), Error) << text.size();
        EXPECT_THROW(load_path(path), Error) << text.size();
    }
    try {
        load_lamp_presets(path);
    } catch (const Error& refusal) {  // before 65 MiB are parsed
        EXPECT_NE(std::string(refusal.what()).find("larger than 64 MiB"), std::string::npos) << refusal.what();
    }
}

}  // namespace
}  // namespace lw
