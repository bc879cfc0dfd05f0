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
#include <vector>

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

// ThreadSanitizer does not know the locks of TBB, which is compiled without it. In its builds the same loops run on
// plain threads.
template <class Body>
void parallel_for(size_t count, const Body& body, size_t grain = 1) {
    std::atomic<size_t> next{0};
    const auto work = [&] {
        for (size_t begin; (begin = next.fetch_add(grain, std::memory_order_relaxed)) < count;)
            for (size_t i = begin; i < std::min(begin + grain, count); ++i) body(i);
    };
    const size_t most = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    std::vector<std::thread> threads;
    for (size_t t = 1; t < std::min(most, count); ++t) threads.emplace_back(work);
    work();
    for (std::thread& thread : threads) thread.join();
}

template <class Iterator, class Less>
void parallel_sort(Iterator first, Iterator last, const Less& less) {
    std::sort(first, last, less);
}

#else

/// Calls body(i) for i in [0, count), in any order, on any thread, in runs of about `grain` indices or more. An
/// exception of body ends the loop and reaches the caller; it is meant for errors, not for leaving the loop early.
template <class Body>
void parallel_for(size_t count, const Body& body, size_t grain = 1) {
    tbb::parallel_for(tbb::blocked_range<size_t>(0, count, grain), [&](const tbb::blocked_range<size_t>& range) {
        for (size_t i = range.begin(); i != range.end(); ++i) body(i);
    });
}

/// Sorts [first, last) by a strict total order, so that the result does not depend on the thread count.
template <class Iterator, class Less>
void parallel_sort(Iterator first, Iterator last, const Less& less) {
    tbb::parallel_sort(first, last, less);
}

#endif

}  // namespace lw
