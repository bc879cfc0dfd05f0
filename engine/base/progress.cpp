#include "base/progress.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "base/error.h"

namespace lw {
namespace {

thread_local ProgressBoard* board_of_thread = nullptr;

}  // namespace

ProgressBoard::State ProgressBoard::state() const {
    const std::lock_guard lock(mutex_);
    return state_;
}

void ProgressBoard::set(const std::string& what, double fraction) {
    const std::lock_guard lock(mutex_);
    state_ = {what, fraction < 1 ? fraction : 1.0};
}

ProgressScope::ProgressScope(ProgressBoard& board) { board_of_thread = &board; }

ProgressScope::~ProgressScope() { board_of_thread = nullptr; }

Progress::Progress(std::string what, uint64_t total)
    : what_(std::move(what)),
      board_(board_of_thread),
      total_(total ? total : 1),
      terminal_(isatty(STDERR_FILENO) != 0),
      start_(std::chrono::steady_clock::now()),
      last_draw_(start_) {}

Progress::~Progress() {
    const uint64_t done = done_.load();
    if (done) draw(done, true);
}

void Progress::step(uint64_t units) {
    if (board_ && board_->is_cancelled()) throw Error("cancelled");
    const uint64_t done = done_ += units;
    std::unique_lock lock(drawing_, std::try_to_lock);
    if (!lock) return;
    const auto now = std::chrono::steady_clock::now();
    if (now - last_draw_ < std::chrono::milliseconds(100)) return;
    last_draw_ = now;
    draw(done, false);
}

void Progress::draw(uint64_t done, bool last) {
    if (board_) {
        board_->set(what_, last ? 1.0 : std::min(1.0, double(done) / double(total_)));
        return;
    }
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    const double rate = double(done) / (seconds > 1e-6 ? seconds : 1e-6);
    const double left = done < total_ ? double(total_ - done) / (rate > 0 ? rate : 1) : 0;
    const int percent = int(100.0 * double(done < total_ ? done : total_) / double(total_));
    if (terminal_) {
        std::fprintf(stderr, "\r%-12s %3d %%  %.3g/s  %.0f s left \x1b[K%s", what_.c_str(), percent, rate, left,
                     last ? "\n" : "");
        std::fflush(stderr);
    } else if (seconds > 1 && percent / 10 > printed_tenths_) {
        printed_tenths_ = percent / 10;
        std::fprintf(stderr, "%s %d %% (%.3g/s, %.0f s left)\n", what_.c_str(), percent, rate, left);
    }
}

}  // namespace lw
