// A built program, run as a user runs it: what it printed, how it ended. Also a folder that is gone afterwards.
#pragma once
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "base/error.h"

namespace lw {

inline std::string read_text(const std::filesystem::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

inline void write_text(const std::filesystem::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}

/// A fresh, empty folder, removed with all it holds.
class TempFolder {
  public:
    TempFolder() {
        std::string pattern = (std::filesystem::temp_directory_path() / "lumenwalk-test-XXXXXX").string();
        if (!mkdtemp(pattern.data())) throw Error(pattern + ": cannot be created");
        path_ = pattern;
    }
    TempFolder(const TempFolder&) = delete;
    TempFolder& operator=(const TempFolder&) = delete;
    ~TempFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }

    const std::filesystem::path& path() const { return path_; }
    std::string operator/(const std::string& name) const { return (path_ / name).string(); }
    /// Names of what lies in the folder, sorted.
    std::vector<std::string> names() const {
        std::vector<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(path_)) names.push_back(entry.path().filename());
        std::sort(names.begin(), names.end());
        return names;
    }

  private:
    std::filesystem::path path_;
};

struct Outcome {
    int exit_code;  // 128 + the signal when one ended the program
    std::string out, err;
};

/// A program of the build folder ("" is lumenwalk itself) at work in the source folder; its output goes to files, so no
/// terminal is seen.
class Process {
  public:
    Process(const std::string& program, std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(),
                         std::string(LUMENWALK_BINARY_DIR "/lumenwalk") + (program.empty() ? "" : "-" + program));
        std::vector<char*> argv;
        for (std::string& argument : arguments) argv.push_back(argument.data());
        argv.push_back(nullptr);
        posix_spawn_file_actions_t actions;
        posix_spawn_file_actions_init(&actions);
        posix_spawn_file_actions_addchdir_np(&actions, LUMENWALK_SOURCE_DIR);
        const int flags = O_WRONLY | O_CREAT | O_TRUNC;
        posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, (printed_ / "out").c_str(), flags, 0600);
        posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, (printed_ / "err").c_str(), flags, 0600);
        const int failure = posix_spawn(&pid_, argv[0], &actions, nullptr, argv.data(), environ);
        posix_spawn_file_actions_destroy(&actions);
        if (failure) throw Error(arguments[0] + ": cannot be started");
    }
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;
    ~Process() {
        if (pid_ <= 0) return;
        kill(pid_, SIGKILL);
        waitpid(pid_, nullptr, 0);
    }

    pid_t id() const { return pid_; }
    void interrupt() const { send(SIGINT); }
    void send(int signal) const { kill(pid_, signal); }
    std::string err_so_far() const { return read_text(printed_ / "err"); }

    Outcome wait() {
        int status = 0;
        waitpid(pid_, &status, 0);
        pid_ = 0;
        const int exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
        return {exit_code, read_text(printed_ / "out"), read_text(printed_ / "err")};
    }

  private:
    TempFolder printed_;
    pid_t pid_ = 0;
};

inline Outcome run(const std::string& program, const std::vector<std::string>& arguments) {
    return Process(program, arguments).wait();
}

}  // namespace lw
