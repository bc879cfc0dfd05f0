// A display of its own (Xvfb), lumenwalk in a window on it, and a user made of xdotool.
#pragma once
#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <thread>

#include "programs/command.h"
#include "programs/lavapipe.h"

namespace lw {

inline bool has_display_tools() {
    return std::system("command -v Xvfb >/dev/null && command -v xdotool >/dev/null") == 0;
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

/// Xvfb on a number it picks itself; DISPLAY names it until it ends.
class Display {
  public:
    Display() {
        const std::string file = folder_ / "number";
        std::vector<std::string> words{"Xvfb", "-displayfd", "9", "-screen", "0", "1280x800x24", "-nolisten", "tcp"};
        std::vector<char*> argv;
        for (std::string& word : words) argv.push_back(word.data());
        argv.push_back(nullptr);
        posix_spawn_file_actions_t actions;
        posix_spawn_file_actions_init(&actions);
        posix_spawn_file_actions_addopen(&actions, 9, file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
        posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
        const int failure = posix_spawnp(&pid_, "Xvfb", &actions, nullptr, argv.data(), environ);
        posix_spawn_file_actions_destroy(&actions);
        if (failure) throw Error("Xvfb: cannot be started");
        if (!wait_until([&] { return read_text(file).find('\n') != std::string::npos; }))
            throw Error("Xvfb: no display");
        const std::string number = read_text(file);
        setenv("DISPLAY", (":" + number.substr(0, number.find('\n'))).c_str(), 1);
    }
    Display(const Display&) = delete;
    Display& operator=(const Display&) = delete;
    ~Display() { end(SIGTERM); }
    /// Goes away at once, as when its server crashes.
    void vanish() { end(SIGKILL); }

  private:
    void end(int signal) {
        unsetenv("DISPLAY");
        if (pid_ > 0) kill(pid_, signal), waitpid(pid_, nullptr, 0);
        pid_ = 0;
    }

    TempFolder folder_;
    pid_t pid_ = 0;
};

inline void xdotool(const std::string& words) {
    EXPECT_EQ(std::system(("timeout 20 xdotool " + words + " >/dev/null 2>&1").c_str()), 0) << "xdotool " << words;
}

/// lumenwalk at work in a window that has the keyboard; a scene of data/ is copied into its folder first,
/// and text for its bookmarks.
class WalkingWindow {
  public:
    WalkingWindow(const std::string& scene, const std::vector<std::string>& more, const std::string& bookmarks = "") {
        std::filesystem::copy_file(LUMENWALK_SOURCE_DIR "/data/" + scene, folder_ / scene);
        stem_ = std::filesystem::path(scene).stem().string();
        if (!bookmarks.empty()) write_text(folder_ / (stem_ + ".bookmarks.json"), bookmarks);
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

    /// Ends it as a user does; by force, which fails the test, when it does not go within a minute.
    Outcome close() {
        key("ctrl+q");
        return wait();
    }

    /// Waits until it ends by itself, a minute at most.
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

#define SKIP_WITHOUT_DISPLAY() \
    SKIP_WITHOUT_LAVAPIPE();   \
    if (!lw::has_display_tools()) GTEST_SKIP() << "no Xvfb and xdotool here: tools/install-packages installs them"
