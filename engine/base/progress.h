// Progress of long work: a redrawn line with rate and time left on a terminal, a plain line every
// tenth in a pipe.
#pragma once
#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>

namespace lw {

/// Thread-safe counter of `total` units of work named `what`; prints to stderr.
class Progress {
  public:
    Progress(std::string what, uint64_t total);
    ~Progress();
    /// Adds finished units, redraws at most ten times a second.
    void step(uint64_t units = 1);

  private:
    void draw(uint64_t done, bool last);

    std::string what_;
    uint64_t total_;
    bool terminal_;
    std::chrono::steady_clock::time_point start_;
    std::atomic<uint64_t> done_{0};
    std::mutex drawing_;
    std::chrono::steady_clock::time_point last_draw_;
    int printed_tenths_ = -1;
};

}  // namespace lw
