// Data-parallel loops over index ranges; the only user of oneTBB.
#pragma once
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <thread>

namespace lw {

/// Limits the worker threads of every parallel_for while it lives; 0 means all cores.
class ThreadLimit {
  public:
    explicit ThreadLimit(unsigned threads)
        : control_(tbb::global_control::max_allowed_parallelism,
                   threads ? threads : std::max(1u, std::thread::hardware_concurrency())) {}

  private:
    tbb::global_control control_;
};

#if defined(__SANITIZE_THREAD__)
/// Tells ThreadSanitizer what it cannot see in TBB, which is not instrumented: what comes before a loop happens before
/// its bodies, and these before what follows. Bodies stay unordered among themselves.
class LoopOrder {
  public:
    LoopOrder() { begun_.store(true, std::memory_order_release); }
    ~LoopOrder() { ended_.load(std::memory_order_acquire); }
    void begin_body() { begun_.load(std::memory_order_acquire); }
    void end_body() { ended_.fetch_add(1, std::memory_order_release); }

  private:
    std::atomic<bool> begun_{false};
    std::atomic<size_t> ended_{0};
};
#else
struct LoopOrder {
    void begin_body() {}
    void end_body() {}
};
#endif

/// Calls body(i) for i in [0, count), in any order, on any thread. body must not throw for control flow.
template <class Body>
void parallel_for(size_t count, const Body& body, size_t grain = 1) {
    LoopOrder order;
    tbb::parallel_for(tbb::blocked_range<size_t>(0, count, grain), [&](const tbb::blocked_range<size_t>& range) {
        order.begin_body();
        for (size_t i = range.begin(); i != range.end(); ++i) body(i);
        order.end_body();
    });
}

/// Sorts [first, last) by a strict total order, so that the result does not depend on the thread count.
template <class Iterator, class Less>
void parallel_sort(Iterator first, Iterator last, const Less& less) {
#if defined(__SANITIZE_THREAD__)
    std::sort(first, last, less);
#else
    tbb::parallel_sort(first, last, less);
#endif
}

}  // namespace lw
