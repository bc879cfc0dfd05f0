// Points so close under another surface that no light gets there.
#include "maps/buried.h"

#include <gtest/gtest.h>

#include "benchmark/lab_scene.h"

namespace lw {
namespace {

TEST(Buried, ArePointsUnderALowSheetAndNotThoseUnderATable) {
    LabScene lab;
    lab.add_rectangle("floor", vec3(0), vec3(0, 0, 4), vec3(4, 0, 0), 0.5f);
    lab.add_rectangle("rug", vec3(0, 0.02f, 0), vec3(0, 0, 4), vec3(2, 0, 0), 0.5f);
    lab.add_rectangle("table", vec3(2, 0.7f, 0), vec3(0, 0, 4), vec3(2, 0, 0), 0.5f);
    const Scene scene = lab.finish();
    const RayCaster caster(scene);
    int under_rug = 0;
    for (uint i = 0; i < 100; ++i) {
        Rng rng(1, 1, i);
        const float z = 0.5f + 3 * rng.next();
        under_rug += is_buried(caster, vec3(0.5f + rng.next(), 0, z), vec3(0, 1, 0), {clearance_of(0.5f)}, rng);
        EXPECT_FALSE(is_buried(caster, vec3(2.5f + rng.next(), 0, z), vec3(0, 1, 0), {clearance_of(0.5f)}, rng));
    }
    EXPECT_GT(under_rug, 95);  // a ray along the floor now and then passes far below the rug
}

}  // namespace
}  // namespace lw
