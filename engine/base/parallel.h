// Data-parallel loops over index ranges; the only user of oneTBB.
#pragma once
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

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

/// Calls body(i) for i in [0, count), in any order, on any thread. body must not throw for control flow.
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

}  // namespace lw
