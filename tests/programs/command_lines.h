// Command lines of the programs, and what is expected of a program that refuses one.
#pragma once
#include <gtest/gtest.h>

#include "programs/command.h"

namespace lw::test {

using Words = std::vector<std::string>;

inline std::string scene_path(const std::string& name) { return LUMENWALK_SOURCE_DIR "/data/" + name; }

/// A short but complete command line about the scene (or picture) `input`, writing `output` and an extension.
inline Words command_line(const std::string& program, const std::string& input, const std::string& output) {
    if (program == "bake") return {input, "-o", output + ".pmap", "--photons", "100"};
    if (program == "screenshot") return {input, input + ".pmap", "-o", output + ".png", "--size", "8x8"};
    if (program == "reference") return {input, "-o", output + ".exr", "--size", "8x8", "--samples", "1"};
    return {input, input, "--difference", output + ".png"};
}

inline size_t count_lines(const std::string& text) { return size_t(std::count(text.begin(), text.end(), '\n')); }

inline bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

inline void expect_refusal(const Outcome& outcome, const std::string& named) {
    EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
    EXPECT_EQ(count_lines(outcome.err), 1u) << outcome.err;
    EXPECT_TRUE(contains(outcome.err, named)) << outcome.err;
}

/// Copies a scene of data/ with one piece of its text replaced.
inline std::string edited_scene(const TempFolder& folder, const std::string& name, const std::string& old_text,
                                const std::string& new_text) {
    std::string text = read_text(scene_path(name));
    const size_t place = text.find(old_text);
    if (place == std::string::npos) throw Error(name + ": has no " + old_text);
    write_text(folder / name, text.replace(place, old_text.size(), new_text));
    return folder / name;
}

inline void expect_success(const Outcome& outcome) { ASSERT_EQ(outcome.exit_code, 0) << outcome.err; }

inline void bake(const std::string& scene, const std::string& map, const Words& more = {"--photons", "5000"}) {
    Words words{scene, "-o", map};
    words.insert(words.end(), more.begin(), more.end());
    expect_success(run("bake", words));
}

}  // namespace lw::test
