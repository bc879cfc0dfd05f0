// Progress of long work on stderr: on a terminal one line that is redrawn, with rate and time left; in a pipe a plain
// line for every 10 %.
#pragma once
#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>

namespace lw {

/// Progress for a caller that shows it itself (a window), and its request to stop. Thread-safe.
class ProgressBoard {
  public:
    struct State {
        std::string what;
        double fraction = 0;  // 0 to 1
    };
    State state() const;
    void set(const std::string& what, double fraction);
    /// Asks the work to stop: its next Progress::step() throws Error.
    void cancel() { cancelled_ = true; }
    bool is_cancelled() const { return cancelled_; }

  private:
    mutable std::mutex mutex_;
    State state_;
    std::atomic<bool> cancelled_{false};
};

/// While it lives, every Progress made on this thread goes to the board and prints nothing.
class ProgressScope {
  public:
    explicit ProgressScope(ProgressBoard& board);
    ~ProgressScope();
    ProgressScope(const ProgressScope&) = delete;
    ProgressScope& operator=(const ProgressScope&) = delete;
};

/// Thread-safe counter of `total` units of work named `what`. Prints to stderr, or sets the board of its thread when a
/// ProgressScope is alive.
class Progress {
  public:
    Progress(std::string what, uint64_t total);
    ~Progress();
    /// Adds finished units and redraws at most ten times a second. Throws Error when the board was cancelled.
    void step(uint64_t units = 1);

  private:
    void draw(uint64_t done, bool last);

    std::string what_;
    ProgressBoard* board_;
    uint64_t total_;
    bool terminal_;
    std::chrono::steady_clock::time_point start_;
    std::atomic<uint64_t> done_{0};
    std::mutex drawing_;
    std::chrono::steady_clock::time_point last_draw_;
    int printed_tenths_ = -1;
};

}  // namespace lw
