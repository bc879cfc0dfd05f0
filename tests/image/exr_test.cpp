#include "image/exr.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <limits>

#include "base/error.h"

namespace lw {
namespace {

std::filesystem::path test_path(const std::string& name) {
    return std::filesystem::path(LUMENWALK_BINARY_DIR) / ("lumenwalk-" + std::to_string(::getpid()) + "-" + name);
}

struct RemovedFile {
    std::filesystem::path path;
    ~RemovedFile() { std::filesystem::remove(path); }
};

Image sample_image() {
    Image image;
    image.width = 37;
    image.height = 21;
    for (const char* name : {"R", "G", "B"}) image.add(name, 0.0f, true);
    image.add("illuminance");
    for (Channel& channel : image.channels)
        for (size_t i = 0; i < channel.values.size(); ++i)
            channel.values[i] = float(i % 101) * (channel.half ? 0.25f : 0.1f);
    return image;
}

std::vector<char> read_bytes(const std::filesystem::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

void write_bytes(const std::filesystem::path& path, const std::vector<char>& bytes, size_t count) {
    std::ofstream(path, std::ios::binary).write(bytes.data(), std::streamsize(count));
}

TEST(Exr, GivesBackEveryChannelExactly) {
    RemovedFile file{test_path("roundtrip.exr")};
    Image written = sample_image();
    write_exr(file.path, written);
    Image read = read_exr(file.path);
    ASSERT_EQ(read.width, written.width);
    ASSERT_EQ(read.height, written.height);
    ASSERT_EQ(read.channels.size(), written.channels.size());
    for (const Channel& channel : written.channels) {
        const Channel* found = read.find(channel.name);
        ASSERT_NE(found, nullptr) << channel.name;
        EXPECT_EQ(found->half, channel.half) << channel.name;
        EXPECT_EQ(found->values, channel.values) << channel.name;
    }
}

TEST(Exr, HalfChannelsAreRoundedAndClampedFloatsAreNot) {
    RemovedFile file{test_path("half.exr")};
    Image image;
    image.width = 2;
    image.height = 1;
    image.add("R", 1e6f, true);
    image.add("G", 1e6f, false);
    image.add("B", 0.1f, true);
    image.channels[0].values[1] = std::numeric_limits<float>::quiet_NaN();
    write_exr(file.path, image);
    Image read = read_exr(file.path);
    EXPECT_EQ(read.find("R")->values[0], 65504.0f);
    EXPECT_TRUE(std::isnan(read.find("R")->values[1]));
    EXPECT_EQ(read.find("G")->values[0], 1e6f);
    EXPECT_NEAR(read.find("B")->values[0], 0.1f, 0.1f * 0x1p-11f);
}

TEST(Exr, AFileCutAtAnyLengthIsRefusedByName) {
    RemovedFile whole{test_path("whole.exr")}, cut{test_path("cut.exr")};
    write_exr(whole.path, sample_image());
    std::vector<char> bytes = read_bytes(whole.path);
    for (size_t count = 0; count < bytes.size(); count += 1 + count / 200) {
        write_bytes(cut.path, bytes, count);
        try {
            read_exr(cut.path);
            FAIL() << "accepted " << count << " of " << bytes.size() << " bytes";
        } catch (const Error& e) {
            EXPECT_NE(std::string(e.what()).find(cut.path.string()), std::string::npos) << e.what();
        }
    }
}

TEST(Exr, ADamagedByteNeverCrashes) {
    RemovedFile whole{test_path("sound.exr")}, damaged{test_path("damaged.exr")};
    write_exr(whole.path, sample_image());
    std::vector<char> bytes = read_bytes(whole.path);
    for (size_t i = 0; i < bytes.size(); i += 1 + i / 200) {
        std::vector<char> changed = bytes;
        changed[i] = char(~changed[i]);
        write_bytes(damaged.path, changed, changed.size());
        try {
            read_exr(damaged.path);
        } catch (const Error&) {
        }
    }
}

TEST(Exr, AMissingFileAndAnImpossiblePlaceAreErrors) {
    EXPECT_THROW(read_exr("/nonexistent/a.exr"), Error);
    EXPECT_THROW(write_exr("/nonexistent/a.exr", sample_image()), Error);
}

TEST(Exr, LeavesNoPartialFile) {
    RemovedFile file{test_path("clean.exr")};
    write_exr(file.path, sample_image());
    EXPECT_FALSE(std::filesystem::exists(file.path.string() + ".partial"));
}

}  // namespace
}  // namespace lw
