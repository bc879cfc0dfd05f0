// A display of its own (Xvfb), lumenwalk in a window on it, and a user made of xdotool.
#pragma once
#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <thread>

#include "image/rgb8_image.h"
#include "programs/command.h"
#include "programs/lavapipe.h"

namespace lw {

inline bool has_display_tools() {
    return std::system(
               "(command -v Xvfb && command -v xdotool && command -v openbox && command -v xprop && command -v xclip) "
               ">/dev/null") == 0;
}

inline void pause_ms(int ms) { std::this_thread::sleep_for(std::chrono::milliseconds(ms)); }

/// True as soon as `done` is, false after `seconds`.
inline bool wait_until(const std::function<bool()>& done, double seconds = 30) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    while (!done()) {
        if (std::chrono::steady_clock::now() > end) return false;
        pause_ms(30);
    }
    return true;
}

/// Starts a program of the search path, its messages dropped; number 9, when given, is the file it may write to.
inline pid_t start(std::vector<std::string> words, const std::string& ninth = "/dev/null") {
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 9, ninth.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    pid_t process = 0;
    const int failure = posix_spawnp(&process, argv[0], &actions, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (failure) throw Error(words[0] + ": cannot be started");
    return process;
}

inline void end(pid_t process) {
    kill(process, SIGTERM);
    waitpid(process, nullptr, 0);
}

/// Xvfb on a number it picks itself; DISPLAY names it until it ends.
class Display {
  public:
    /// 96 dots per inch: a unit of the desktop is a pixel; 192: two.
    explicit Display(const std::string& dpi = "96") {
        const std::string file = folder_ / "number";
        process_ = start({"Xvfb", "-displayfd", "9", "-screen", "0", "1280x800x24", "-fbdir", folder_.path().string(),
                          "-noreset", "-nolisten", "tcp"},
                         file);
        if (!wait_until([&] { return read_text(file).find('\n') != std::string::npos; }))
            throw Error("Xvfb: no display");
        const std::string number = read_text(file);
        setenv("DISPLAY", (":" + number.substr(0, number.find('\n'))).c_str(), 1);
        const std::string resource = "xprop -root -f RESOURCE_MANAGER 8s -set RESOURCE_MANAGER 'Xft.dpi: " + dpi + "'";
        if (std::system(resource.c_str()) != 0) throw Error("xprop: does not set the display's resolution");
    }
    Display(const Display&) = delete;
    Display& operator=(const Display&) = delete;
    ~Display() { leave(SIGTERM); }
    /// Goes away at once, as when its server crashes.
    void vanish() { leave(SIGKILL); }

    /// What the screen shows, from the X window dump that Xvfb keeps: a header of big-endian words, then its pixels.
    Rgb8Image screen() const {
        const std::string dump = read_text(folder_ / "Xvfb_screen0");
        const auto word = [&](size_t i) {
            uint32_t value = 0;
            for (size_t b = 0; b < 4; ++b) value = value << 8 | uint8_t(dump.at(4 * i + b));
            return value;
        };
        Rgb8Image image{int(word(4)), int(word(5)), {}};
        const size_t first = word(0) + 12 * size_t(word(19)), row = word(12);
        for (size_t y = 0; y < size_t(image.height); ++y)
            for (size_t x = 0; x < size_t(image.width); ++x)
                for (size_t c = 0; c < 3; ++c) image.rgb.push_back(uint8_t(dump.at(first + y * row + 4 * x + 2 - c)));
        return image;
    }

  private:
    void leave(int signal) {
        unsetenv("DISPLAY");
        if (process_ > 0) kill(process_, signal), waitpid(process_, nullptr, 0);
        process_ = 0;
    }

    TempFolder folder_;
    pid_t process_ = 0;
};

/// A desktop's window manager on the display: windows have frames, become icons, fill the screen.
class WindowManager {
  public:
    WindowManager() : process_(start({"openbox", "--sm-disable"})) {
        const auto is_there = [] {
            return std::system("xdotool get_desktop >/dev/null 2>&1") == 0;  // a property that managers set
        };
        if (!wait_until(is_there)) throw Error("openbox: does not start");
    }
    WindowManager(const WindowManager&) = delete;
    WindowManager& operator=(const WindowManager&) = delete;
    ~WindowManager() { end(process_); }

  private:
    pid_t process_;
};

inline void xdotool(const std::string& words) {
    EXPECT_EQ(std::system(("timeout 20 xdotool " + words + " >/dev/null 2>&1").c_str()), 0) << "xdotool " << words;
}

/// lumenwalk at work in a window that has the keyboard; a scene of data/ is copied into its folder first,
/// and text for its bookmarks and ambiances.
class WalkingWindow {
  public:
    WalkingWindow(const std::string& scene, const std::vector<std::string>& more, const std::string& bookmarks = "",
                  const std::string& ambiances = "") {
        std::filesystem::copy_file(LUMENWALK_SOURCE_DIR "/data/" + scene, folder_ / scene);
        std::filesystem::copy(LUMENWALK_SOURCE_DIR "/data/photometry", folder_ / "photometry");
        stem_ = std::filesystem::path(scene).stem().string();
        if (!bookmarks.empty()) write_text(folder_ / (stem_ + ".bookmarks.json"), bookmarks);
        if (!ambiances.empty()) write_text(folder_ / (stem_ + ".ambiances.json"), ambiances);
        std::vector<std::string> words{folder_ / scene, "--size", "320x240", "--validation", "--device", "llvmpipe"};
        words.insert(words.end(), more.begin(), more.end());
        process_ = std::make_unique<Process>("", words);
        const std::string found = folder_ / "window";
        const bool shown = wait_until([&] {
            return std::system(
                       ("xdotool search --name 'Lumenwalk - " + scene + "' > " + found + " 2>/dev/null").c_str()) ==
                       0 &&
                   !read_text(found).empty();
        });
        if (!shown) throw Error("lumenwalk shows no window: " + process_->err_so_far());
        id_ = read_text(found);
        id_.erase(id_.find('\n'));
        xdotool("windowfocus --sync " + id_);
    }

    const TempFolder& folder() const { return folder_; }
    const Process& process() const { return *process_; }
    const std::string& id() const { return id_; }
    bool says(const std::string& text) const { return process_->err_so_far().find(text) != std::string::npos; }
    bool waits_for(const std::string& text, double seconds = 60) const {
        return wait_until([&] { return says(text); }, seconds);
    }
    void key(const std::string& keys) const { xdotool("key " + keys); }

    /// Takes a screenshot and returns its path without extension.
    std::string screenshot() {
        char name[64];
        std::snprintf(name, sizeof name, "%s-%03d", stem_.c_str(), ++screenshots_);
        key("F2");
        EXPECT_TRUE(waits_for(std::string("saved ") + (folder_ / name))) << process_->err_so_far();
        return folder_ / name;
    }

    /// Ends it as a user does.
    Outcome close() {
        key("ctrl+q");
        return wait();
    }

    /// Its end; by force, which fails the test, when it does not go within a minute.
    Outcome wait() {
        const auto is_gone = [&] {
            siginfo_t state{};
            return waitid(P_PID, id_t(process_->id()), &state, WEXITED | WNOHANG | WNOWAIT) == 0 && state.si_pid != 0;
        };
        if (!wait_until(is_gone, 60)) kill(process_->id(), SIGKILL);
        return process_->wait();
    }

  private:
    TempFolder folder_;
    std::string stem_, id_;
    std::unique_ptr<Process> process_;
    int screenshots_ = 0;
};

}  // namespace lw

#define SKIP_WITHOUT_DISPLAY()    \
    SKIP_WITHOUT_LAVAPIPE();      \
    if (!lw::has_display_tools()) \
    GTEST_SKIP() << "no Xvfb, xdotool, openbox, xprop and xclip here: tools/install-packages installs them"
