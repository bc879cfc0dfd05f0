#include "image/png.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "base/error.h"

namespace lw {
namespace {

TEST(Png, GivesBackThePixels) {
    auto path = std::filesystem::path(LUMENWALK_BINARY_DIR) / ("lumenwalk-" + std::to_string(::getpid()) + ".png");
    Rgb8Image image{19, 7, std::vector<uint8_t>(3 * 19 * 7)};
    for (size_t i = 0; i < image.rgb.size(); ++i) image.rgb[i] = uint8_t(i * 7);
    write_png(path, image);
    Rgb8Image read = read_png(path);
    EXPECT_EQ(read.width, image.width);
    EXPECT_EQ(read.height, image.height);
    EXPECT_EQ(read.rgb, image.rgb);
    std::ofstream(path, std::ios::binary) << "no picture";
    EXPECT_THROW(read_png(path), Error);
    std::filesystem::remove(path);
}

TEST(Png, AnImpossiblePlaceIsAnError) {
    EXPECT_THROW(write_png("/nonexistent/a.png", Rgb8Image{1, 1, {0, 0, 0}}), Error);
    EXPECT_THROW(read_png("/nonexistent/a.png"), Error);
}

}  // namespace
}  // namespace lw
