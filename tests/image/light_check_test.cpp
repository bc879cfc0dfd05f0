// Pictures and readings that hold something else than light are refused before they are written.
#include "image/light_check.h"

#include <gtest/gtest.h>

#include <limits>

#include "base/error.h"
#include "measure/reading.h"

namespace lw {
namespace {

TEST(LightCheck, RefusesWhatIsNoLightAndNamesThePixel) {
    Image image{3, 2, {}};
    for (const char* name : {"R", "G", "B", "illuminance", "normal.X"}) image.add(name);
    EXPECT_NO_THROW(check_is_light(image));
    image.channels[4].values[0] = -1;  // a normal may be negative
    EXPECT_NO_THROW(check_is_light(image));
    using Limits = std::numeric_limits<float>;
    for (float bad : {Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity(), -1e-6f})
        for (size_t channel = 0; channel < 4; ++channel) {
            Image broken = image;
            broken.channels[channel].values[4] = bad;
            try {
                check_is_light(broken);
                ADD_FAILURE() << bad << " passes in " << broken.channels[channel].name;
            } catch (const Error& e) {
                EXPECT_NE(std::string(e.what()).find("at pixel (1, 1)"), std::string::npos) << e.what();
            }
        }
}

TEST(LightCheck, RefusesAReadingThatIsNoLightAndNamesItsSensor) {
    const std::vector<ChannelLux> light(2, vec3(1, 0, 2));
    const Reading good{light, light, light, light, light, light};
    EXPECT_NO_THROW(check_is_light(std::vector<Reading>{good, good}));
    using Limits = std::numeric_limits<float>;
    for (float bad : {Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity(), -1e-6f})
        for (std::vector<ChannelLux> Reading::*part :
             {&Reading::lamps, &Reading::repeated, &Reading::scatter, &Reading::photon_variance, &Reading::by_photons,
              &Reading::blur}) {
            Reading broken = good;
            (broken.*part)[1].z = bad;
            try {
                check_is_light(std::vector<Reading>{good, broken});
                ADD_FAILURE() << bad << " passes";
            } catch (const Error& e) {
                EXPECT_NE(std::string(e.what()).find("sensor 2 reads"), std::string::npos) << e.what();
            }
        }
}

}  // namespace
}  // namespace lw
