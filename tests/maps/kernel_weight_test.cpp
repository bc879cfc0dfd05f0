#include "maps/kernel_weight.h"

#include <gtest/gtest.h>

#include "shaders/photon_map.h"

namespace lw {
namespace {

TEST(Weighing, SharesASurfaceWhereTheShadersDo) {
    constexpr float radius = 0.1f;
    int on = 0, off = 0;
    for (int h = -100; h <= 100; ++h)
        for (int d = 0; d <= 100; ++d) {
            const float height = 1e-3f * float(h), squared = 1e-4f * float(d);
            const bool same = on_same_surface(height, squared, radius);
            EXPECT_EQ(same_surface_weight(height, squared, radius), same ? 1.0f : 0.0f) << height << " " << squared;
            ++(same ? on : off);
        }
    EXPECT_GT(on, 1000);
    EXPECT_GT(off, 1000);
}

}  // namespace
}  // namespace lw
