#include "gpu/buffer.h"

#include <gtest/gtest.h>

#include <numeric>

#include "base/error.h"

namespace lw {

TEST(Device, OpensWithValidationAndWithoutAMessage) {
    const Device device({"", true});
    EXPECT_FALSE(device.name().empty());
    EXPECT_TRUE(device.validation_messages().empty());
}

TEST(Device, RefusesAnUnknownNameAndListsTheOthers) {
    try {
        const Device device({"no such device", false});
        FAIL();
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find(device_names().at(0)), std::string::npos) << error.what();
    }
}

TEST(Buffer, ReturnsWhatWasUploadedBeyondOneStagingBuffer) {
    const Device device({"", true});
    std::vector<uint32_t> values((size_t(33) << 20) / 4 + 3);
    std::iota(values.begin(), values.end(), 7u);
    const Buffer buffer = upload<uint32_t>(device, values, "numbers");
    EXPECT_EQ(read_back<uint32_t>(device, buffer, values.size()), values);
    EXPECT_EQ(device.validation_messages(), std::vector<std::string>{});
}

TEST(Buffer, OfNothingIsSmallAndZero) {
    const Device device({"", true});
    const Buffer buffer = upload<float>(device, {}, "nothing");
    EXPECT_EQ(buffer.size(), 128u);
    EXPECT_EQ(read_back<float>(device, buffer, 4), std::vector<float>(4, 0.0f));
}

}  // namespace lw
