// A damaged map whose checksum is right is refused, or it is harmless: an estimate on the CPU (under ASan in its
// preset) and a small picture on the device read nothing outside its arrays and are light.
#include <gtest/gtest.h>

#include <unistd.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "base/error.h"
#include "base/random.h"
#include "file/map_file.h"
#include "fuzz/feed.h"
#include "gather/renderer.h"
#include "maps/bake.h"
#include "programs/lavapipe.h"
#include "trace/build_bvh.h"

namespace lw::test {
namespace {

constexpr size_t header_bytes = 200;

/// The bytes of a small map of scene_of_maps().
std::string small_map(uint64_t photons, bool direct_in_photons) {
    const Scene& scene = scene_of_maps();
    const RayCaster caster(scene);
    const auto path = std::filesystem::temp_directory_path() / ("lw_hostile_" + std::to_string(getpid()) + ".pmap");
    save_photon_map(path, bake(scene, caster, {.photons = photons, .direct_in_photons = direct_in_photons}));
    std::ifstream in(path, std::ios::binary);
    std::string bytes(std::istreambuf_iterator<char>(in), {});
    std::filesystem::remove(path);
    return bytes;
}

std::optional<PhotonMap> feed(const std::string& bytes) {
    return feed_map({reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()});
}

/// Small pictures of maps on the device, all modes.
class DevicePictures {
  public:
    DevicePictures() : device_({"llvmpipe", true}), bvh_(build_bvh(scene_of_maps())) {}

    void expect_light(const PhotonMap& map) const {
        const Resident resident(device_, scene_of_maps(), map, bvh_);
        Renderer renderer(device_, resident, 8, 6);
        for (uint mode : {gather_mode_cached, gather_mode_smooth, gather_mode_exact}) {
            RenderSettings settings;
            settings.gather.mode = mode;
            settings.gather.neighbours = 20;
            const Image image = renderer.render(scene_of_maps().cameras[0], settings).image;
            for (const char* channel : {"R", "G", "B", "illuminance"})
                for (float v : image.find(channel)->values) ASSERT_TRUE(std::isfinite(v) && v >= 0) << mode;
        }
        ASSERT_EQ(device_.validation_messages(), std::vector<std::string>{});
    }

  private:
    Device device_;
    Bvh bvh_;
};

TEST(HostileMap, CutAnywhereAndSignedIsRefused) {
    const std::string whole = small_map(20, false);
    ASSERT_TRUE(feed(whole));
    for (size_t length = 0; length < whole.size(); ++length) ASSERT_FALSE(feed(whole.substr(0, length))) << length;
}

TEST(HostileMap, EachWrongHeaderFieldIsRefusedOrHarmless) {
    const std::string whole = small_map(20, false);
    const uint64_t odd[] = {0,
                            1,
                            2,
                            0x7f,
                            0xff,
                            0xffff,
                            0x7fffffff,
                            0xffffffff,
                            0x7fc00000,
                            0x7f800000,
                            0xff800000,
                            0x80000000,
                            0xffffffffffffffffull,
                            1ull << 32,
                            1ull << 62};
    size_t accepted = 0;
    for (size_t at = 0; at + 4 <= header_bytes; at += 4)
        for (size_t size : {size_t(4), size_t(8)})
            for (uint64_t value : odd) {
                std::string damaged = whole;
                std::memcpy(damaged.data() + at, &value, std::min(size, header_bytes - at));
                std::optional<PhotonMap> map;
                ASSERT_NO_THROW(map = feed(damaged)) << at;
                accepted += map.has_value();
                const bool is_checked = at < 16 || at >= 80;  // magic, version, sections, sizes
                EXPECT_TRUE(!is_checked || !map || damaged == whole) << at;
            }
    EXPECT_GT(accepted, 20u);  // counts and seeds are for the reader only
}

TEST(HostileMap, TenThousandSignedByteFlipsAreRefusedOrHarmless) {
    const bool has_device = has_lavapipe();
    std::optional<DevicePictures> pictures;
    if (has_device) pictures.emplace();
    size_t accepted = 0, drawn = 0;
    for (const bool direct : {false, true}) {
        const std::string whole = small_map(20, direct);
        for (uint64_t i = 0; i < 5000; ++i) {
            Rng rng(7, direct, i);
            std::string damaged = whole;
            const auto any = [&] { return size_t(rng.next() * float(whole.size())) % whole.size(); };
            for (int flips = 1 + int(rng.next() * 3); flips > 0; --flips)
                damaged[any()] = char(rng.next() < 0.5f ? 255 : int(rng.next() * 256));
            std::optional<PhotonMap> map;
            ASSERT_NO_THROW(map = feed(damaged)) << "flip " << i << " of " << direct;
            if (!map) continue;
            ++accepted;
            if (pictures && accepted % 2000 == 0) ++drawn, pictures->expect_light(*map);
        }
    }
    EXPECT_GT(accepted, 1000u);
    EXPECT_TRUE(!has_device || drawn > 1) << drawn;
}

}  // namespace
}  // namespace lw::test
