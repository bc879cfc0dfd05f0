#include "maps/gather_settings.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "shaders/scene.h"

namespace lw {
namespace {

TEST(GatherSettings, EveryModeIsFoundByItsNumberAndByItsName) {
    for (const GatherMode& mode : gather_modes) {
        EXPECT_EQ(gather_mode(mode.mode).name, mode.name);
        EXPECT_EQ(gather_mode_named(mode.name), mode.mode);
        EXPECT_NE(gather_mode_help().find(mode.name), std::string::npos);
    }
    EXPECT_EQ(gather_mode_names().size(), std::size(gather_modes));
}

TEST(GatherSettings, AModeThatMakesNoPictureIsRefused) {
    EXPECT_THROW(gather_mode(gather_mode_inspect), Error);
    EXPECT_THROW(gather_mode_named("inspect"), Error);
}

TEST(GatherSettings, PipelinesAreSharedByPicturesThatDifferInNumbersAlone) {
    const GatherSettings cached;
    GatherSettings other = cached;
    other.neighbours = 7, other.shadow_rays = 64, other.paths = 9;
    EXPECT_NE(cached, other);
    EXPECT_EQ(pipeline_settings(cached), pipeline_settings(other));

    for (void (*change)(GatherSettings&) :
         {+[](GatherSettings& s) { s.mode = gather_mode_smooth; }, +[](GatherSettings& s) { s.shadow_rays = 0; },
          +[](GatherSettings& s) { s.followed_roughness = 0.1f; }}) {
        GatherSettings changed = cached;
        change(changed);
        EXPECT_NE(pipeline_settings(cached), pipeline_settings(changed));
    }
    GatherSettings exact{.mode = gather_mode_exact}, more = exact;
    more.neighbours *= 2;  // the heap is of another size
    EXPECT_NE(pipeline_settings(exact), pipeline_settings(more));
}

TEST(GatherSettings, WithoutShadowRaysOnlyMirrorsAreFollowed) {
    EXPECT_EQ(followed_roughness({}), max_followed_roughness);
    EXPECT_EQ(followed_roughness({.followed_roughness = 3}), 1);
    const float roughness = followed_roughness({.shadow_rays = 0});
    EXPECT_FLOAT_EQ(roughness * roughness, min_alpha);
}

TEST(GatherSettings, RaysAreTracedWhereTheMapDoesNotKnowTheLamps) {
    EXPECT_TRUE(has_shadow_rays({}, true));
    EXPECT_FALSE(has_shadow_rays({.shadow_rays = 0}, true));
    EXPECT_TRUE(has_shadow_rays({.shadow_rays = 0}, false));
}

}  // namespace
}  // namespace lw
