// What no light reaches changes no light: a closed room with and without a lawn around it.
#include <gtest/gtest.h>

#include <cmath>

#include "maps/build.h"
#include "maps/estimate.h"
#include "robustness/room.h"

namespace lw::test {
namespace {

/// The plain room in a shell, and a lawn under it.
Room on_lawn(double width) {
    Room room = plain_room();
    const glm::dvec3 corner(2 - width / 2, -0.5, 2.5 - width / 2);
    if (width > 0) room.walls = joined(room.walls, quad(corner, {0, 0, width}, {width, 0, 0}));
    return room;
}

TEST(Lawn, ChangesNoLightOfAClosedRoom) {
    const Room plain = on_lawn(0);
    const Baked alone(plain, 100'000), other(plain, 100'000, 2);
    const double noise =
        difference(read(alone, plain, gather_mode_cached), read(other, plain, gather_mode_cached)).rmse;
    for (const double width : {60.0, 600.0}) {
        const Room room = on_lawn(width);
        const Baked baked(room, 100'000);
        const Difference d = difference(read(alone, plain, gather_mode_cached), read(baked, room, gather_mode_cached));
        tell_case("a lawn of " + std::to_string(int(width)) + " m under it", "bias <= 0.5 %",
                  "RMSE %.1f %%, bias %+.2f %%", 100 * d.rmse, 100 * (d.mean_ratio - 1));
        EXPECT_GT(d.compared, 550u);
        EXPECT_NEAR(d.mean_ratio, 1, 0.005);
        EXPECT_LE(d.rmse, noise);
        EXPECT_NEAR(double(baked.map.coverage.size()), double(alone.map.coverage.size()),
                    0.02 * double(alone.map.coverage.size()));
    }
}

}  // namespace
}  // namespace lw::test
