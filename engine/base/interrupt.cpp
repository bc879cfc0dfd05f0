#include "base/interrupt.h"

#include <errno.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <cstring>
#include <mutex>

namespace lw {
namespace {

/// An entry of the list of half-written files. It holds no pointers, because a signal handler may read it at any
/// moment: `used` is set after the path is complete.
struct HalfWritten {
    std::atomic<bool> used{false};
    std::array<char, 4096> path{};
};
std::array<HalfWritten, 16> half_written;
std::mutex registering;

void say(const char* text) { [[maybe_unused]] const ssize_t ignored = write(STDERR_FILENO, text, std::strlen(text)); }

/// The signal handler. It calls only functions that POSIX allows in one.
void remove_and_end(int signal) {
    for (const HalfWritten& file : half_written)
        if (file.used) unlink(file.path.data());
    say(program_invocation_short_name);
    say(": interrupted: nothing was written\n");
    std::signal(signal, SIG_DFL);
    raise(signal);
}

}  // namespace

void watch_for_interrupt() {
    for (int signal : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction action {};
        if (sigaction(signal, nullptr, &action) != 0 || action.sa_handler == SIG_IGN) continue;
        action = {};
        action.sa_handler = remove_and_end;
        sigfillset(&action.sa_mask);
        sigdelset(&action.sa_mask, signal);
        sigaction(signal, &action, nullptr);
    }
}

void remove_on_interrupt(const std::filesystem::path& path) {
    const std::string name = path.string();
    const std::lock_guard lock(registering);
    for (HalfWritten& file : half_written) {
        if (file.used || name.size() >= file.path.size()) continue;
        std::copy_n(name.c_str(), name.size() + 1, file.path.begin());
        file.used = true;
        return;
    }
}

void keep_on_interrupt(const std::filesystem::path& path) {
    const std::lock_guard lock(registering);
    for (HalfWritten& file : half_written)
        if (file.used && path == file.path.data()) file.used = false;
}

}  // namespace lw
