// lumenwalk on desktops of many kinds: fine screens, full screen, an icon, a lost device, the clipboard.
#include "app/display.h"
#include "app/window/clipboard.h"
#include "image/exr.h"
#include "image/png.h"

namespace lw {
namespace {

double mean_illuminance(const std::string& exr) {
    const Image image = read_exr(exr);
    double sum = 0;
    for (float v : image.find("illuminance")->values) sum += double(v);
    return sum / double(image.pixel_count());
}

/// Seconds of processor time that a process has capture.
double processor_seconds(pid_t process) {
    std::istringstream words(read_text("/proc/" + std::to_string(process) + "/stat"));
    std::string word;
    double ticks = 0;
    for (int i = 1; i <= 15 && words >> word; ++i)
        if (i >= 14) ticks += std::stod(word);
    return ticks / double(sysconf(_SC_CLK_TCK));
}

/// Share of pixels that differ by more than a few codes.
double difference(const Rgb8Image& a, const Rgb8Image& b) {
    EXPECT_EQ(a.rgb.size(), b.rgb.size());
    if (a.rgb.size() != b.rgb.size()) return 1;
    size_t count = 0;
    for (size_t i = 0; i < a.rgb.size(); ++i) count += std::abs(int(a.rgb[i]) - int(b.rgb[i])) > 8;
    return double(count) / double(a.rgb.size());
}

TEST(Desktop, OnAFineScreenThePictureHasAllItsPixelsAndClicksHitWhatIsSeen) {
    SKIP_WITHOUT_DISPLAY();
    const Display display("192");
    WalkingWindow window("cornell.gltf", {"--photons", "5000"});
    ASSERT_TRUE(window.waits_for(" photons\n"));
    window.key("h");
    const std::string before = window.screenshot();
    EXPECT_EQ(read_png(before + ".png").width, 640) << "320 units of the desktop at two pixels each";
    xdotool("mousemove --window " + window.id() + " 320 70 click 1");  // the ceiling lamp, in pixels
    window.screenshot();                                               // by then it is selected
    for (int i = 0; i < 10; ++i) xdotool("click 5");
    pause_ms(1000);
    EXPECT_NEAR(mean_illuminance(window.screenshot() + ".exr"), 0.5 * mean_illuminance(before + ".exr"),
                0.01 * mean_illuminance(before + ".exr"));
    EXPECT_EQ(window.close().exit_code, 0);
}

TEST(Desktop, FillsTheScreenAndComesBackAndWaitsAsAnIcon) {
    SKIP_WITHOUT_DISPLAY();
    const Display display;
    const WindowManager manager;
    WalkingWindow window("cornell.gltf", {"--photons", "5000"});
    ASSERT_TRUE(window.waits_for(" photons\n"));
    for (const char* key : {"h", "bracketleft"}) window.key(key);  // no panels, an exposure that stays
    pause_ms(5500);                                                // the line about the photons has gone
    const Rgb8Image before = read_png(window.screenshot() + ".png");
    ASSERT_EQ(before.width, 320);
    window.key("F11");
    pause_ms(1500);
    const Rgb8Image full = read_png(window.screenshot() + ".png");
    EXPECT_EQ(full.width, 1280);
    EXPECT_EQ(full.height, 800);
    window.key("F11");
    pause_ms(1000);
    xdotool("windowminimize " + window.id());
    const auto rests = [&] {  // once the pictures and pipelines that were begun are made
        const double used = processor_seconds(window.process().id());
        pause_ms(2000);
        return processor_seconds(window.process().id()) - used < 0.3;
    };
    EXPECT_TRUE(wait_until(rests)) << "an icon has nothing to draw";
    xdotool("windowactivate --sync " + window.id());
    pause_ms(5500);
    EXPECT_LT(difference(read_png(window.screenshot() + ".png"), before), 0.02);
    const Outcome outcome = window.close();
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
}

#ifndef __SANITIZE_ADDRESS__  // must be the first library itself
/// Programs started while it lives lose their graphics device when told to.
class LosingDevice {
  public:
    LosingDevice() {
        setenv("LD_PRELOAD", LUMENWALK_BINARY_DIR "/liblosing-device.so", 1);
        setenv("LUMENWALK_LOSE_WHEN", (folder_ / "now").c_str(), 1);
    }
    ~LosingDevice() {
        unsetenv("LD_PRELOAD");
        unsetenv("LUMENWALK_LOSE_WHEN");
    }
    void lose() const {
        unsetenv("LD_PRELOAD");  // of the tools that are called meanwhile
        write_text(folder_ / "now", "");
        EXPECT_TRUE(wait_until([&] { return !std::filesystem::exists(folder_ / "now"); }));
    }

  private:
    TempFolder folder_;
};

TEST(Desktop, ALostDeviceIsStartedAgainAndTheLampsStayAsTheyWere) {
    SKIP_WITHOUT_DISPLAY();
    const Display display;
    const LosingDevice losing;
    WalkingWindow window("cornell.gltf", {"--photons", "5000"});
    ASSERT_TRUE(window.waits_for(" photons\n"));
    window.key("h");  // the panels cover so small a window
    const double full = mean_illuminance(window.screenshot() + ".exr");
    xdotool("mousemove --window " + window.id() + " 160 35 click 1");
    for (int i = 0; i < 10; ++i) xdotool("click 5");
    pause_ms(1000);
    const double dimmed = mean_illuminance(window.screenshot() + ".exr");
    EXPECT_NEAR(dimmed, 0.5 * full, 0.01 * full);
    losing.lose();
    ASSERT_TRUE(window.waits_for("the graphics device was lost: starting it again"));
    pause_ms(2000);
    EXPECT_NEAR(mean_illuminance(window.screenshot() + ".exr"), dimmed, 0.01 * dimmed);
    for (int i = 0; i < 10; ++i) xdotool("click 4");
    pause_ms(1000);
    EXPECT_NEAR(mean_illuminance(window.screenshot() + ".exr"), 2 * dimmed, 0.02 * dimmed);
    const Outcome outcome = window.close();
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
}

TEST(Desktop, ADeviceThatIsLostAgainAndAgainEndsInOneLine) {
    SKIP_WITHOUT_DISPLAY();
    const Display display;
    const LosingDevice losing;
    WalkingWindow window("cornell.gltf", {"--photons", "5000"});
    ASSERT_TRUE(window.waits_for(" photons\n"));
    losing.lose();
    ASSERT_TRUE(window.waits_for("the graphics device was lost: starting it again"));
    losing.lose();
    EXPECT_TRUE(window.waits_for("lumenwalk: Vulkan: the graphics device was lost twice within a minute"))
        << window.process().err_so_far();
    const Outcome outcome = window.wait();
    EXPECT_EQ(outcome.exit_code, 1);
}
#endif

TEST(Desktop, CopiesThePictureToTheClipboard) {
    SKIP_WITHOUT_DISPLAY();
    const Display display;
    WalkingWindow window("cornell.gltf", {"--photons", "5000"});
    ASSERT_TRUE(window.waits_for(" photons\n"));
    for (const char* key : {"h", "bracketleft"}) window.key(key);
    pause_ms(5500);
    const Rgb8Image saved = read_png(window.screenshot() + ".png");
    pause_ms(5500);  // the line about it has gone
    window.key("F3");
    ASSERT_TRUE(window.waits_for("picture copied to the clipboard")) << window.process().err_so_far();
    EXPECT_EQ(window.close().exit_code, 0);
    const std::string file = window.folder() / "pasted.png";
    ASSERT_EQ(std::system(("timeout 20 xclip -selection clipboard -t image/png -o > " + file).c_str()), 0)
        << "the picture outlives the window";
    EXPECT_LT(difference(read_png(file), saved), 0.02);
}

TEST(Desktop, SaysWhatToInstallWhenNothingKeepsTheClipboard) {
    const std::string path = std::getenv("PATH");
    setenv("PATH", "/nonexistent", 1);
    std::string said;
    try {
        copy_to_clipboard({2, 1, std::vector<uint8_t>(6, 100)});
    } catch (const Error& failure) {
        said = failure.what();
    }
    setenv("PATH", path.c_str(), 1);
    EXPECT_NE(said.find("install xclip"), std::string::npos) << said;
}

}  // namespace
}  // namespace lw
