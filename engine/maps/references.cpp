#include "maps/references.h"

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "maps/patch_finder.h"

namespace lw {
namespace {

constexpr size_t max_tasks = 64;
constexpr size_t min_task = 8192;
constexpr uint moved_out = ~0u;  // in place of a photon that its own patch does not keep

/// The photons [begin, end) of an order, and what was found of them for each patch.
struct Task {
    size_t begin, end;
    std::vector<uint> counts;
    std::vector<NeighbourReference> foreign{};
};

/// All photons in at most `max_tasks` pieces, with a count for each patch.
std::vector<Task> split(const ReferenceInput& input) {
    const size_t photons = input.photons.size(), size = std::max(min_task, photons / max_tasks + 1);
    std::vector<Task> tasks;
    for (size_t begin = 0; begin < photons; begin += size)
        tasks.push_back({begin, std::min(begin + size, photons), std::vector<uint>(input.partition.patches.count, 0)});
    return tasks;
}

/// Turns the counts of the tasks into the places at which each task writes first: for each patch they begin at
/// begin(patch), and end(patch, place) is called with their end.
template <class Begin, class End>
void place_counts(std::vector<Task>& tasks, size_t patches, const Begin& begin, const End& end) {
    for (size_t p = 0; p < patches; ++p) {
        uint64_t next = begin(p);
        for (Task& task : tasks) next += std::exchange(task.counts[p], uint(next));
        end(p, next);
    }
}

/// The photons in the order of their own patches: those of patch p are photons[starts[p]] .. photons[starts[p + 1] -
/// 1].
References sort_by_patch(const ReferenceInput& input, const PatchFinder& finder) {
    References sorted{{0}, std::vector<uint>(input.photons.size())};
    std::vector<uint> own(input.photons.size());
    std::vector<Task> tasks = split(input);
    parallel_for(tasks.size(), [&](size_t t) {
        for (size_t i = tasks[t].begin; i < tasks[t].end; ++i) ++tasks[t].counts[own[i] = finder.own_patch(uint(i))];
    });
    place_counts(
        tasks, input.partition.patches.count, [&](size_t p) { return sorted.starts[p]; },
        [&](size_t, uint64_t place) { sorted.starts.push_back(place); });
    parallel_for(tasks.size(), [&](size_t t) {
        for (size_t i = tasks[t].begin; i < tasks[t].end; ++i) sorted.photons[tasks[t].counts[own[i]]++] = uint(i);
    });
    return sorted;
}

/// What other patches refer to, in pieces; photons that move out of their own patch are struck from `sorted`.
std::vector<Task> find_foreign(const ReferenceInput& input, const PatchFinder& finder, References& sorted) {
    constexpr size_t ahead = 16;  // photons on their way from memory
    std::vector<Task> tasks = split(input);
    Progress progress("references", input.photons.size());
    parallel_for(tasks.size(), [&](size_t t) {
        Task& task = tasks[t];
        const auto after = std::upper_bound(sorted.starts.begin(), sorted.starts.end(), task.begin);
        size_t own = size_t(after - sorted.starts.begin()) - 1;
        for (size_t i = task.begin; i < task.end; ++i) {
            while (i >= sorted.starts[own + 1]) ++own;
            if (i + ahead < task.end) prefetch(input.photons[sorted.photons[i + ahead]]);
            if (!finder.find(sorted.photons[i], uint(own), task.foreign)) sorted.photons[i] = moved_out;
        }
        for (const NeighbourReference& reference : task.foreign) ++task.counts[reference.patch];
        progress.step(task.end - task.begin);
    });
    return tasks;
}

}  // namespace

References find_references(const ReferenceInput& input) {
    const PatchFinder finder(input);
    References sorted = sort_by_patch(input, finder);
    std::vector<Task> tasks = find_foreign(input, finder, sorted);
    References result{{0}, {}};
    const auto is_kept = [](uint photon) { return photon != moved_out; };
    const auto own_end = [&](size_t p) {
        const auto first = sorted.photons.begin() + int64_t(sorted.starts[p]),
                   last = sorted.photons.begin() + int64_t(sorted.starts[p + 1]);
        return result.starts[p] + uint64_t(std::count_if(first, last, is_kept));
    };
    place_counts(tasks, input.partition.patches.count, own_end,
                 [&](size_t, uint64_t place) { result.starts.push_back(place); });
    if (result.starts.back() > 0xfffffff0ull)
        throw Error("photon map: more than 2^32 references; use fewer photons or a smaller radius");
    result.photons.resize(result.starts.back());
    parallel_for(input.partition.patches.count, [&](size_t p) {
        std::copy_if(sorted.photons.begin() + int64_t(sorted.starts[p]),
                     sorted.photons.begin() + int64_t(sorted.starts[p + 1]),
                     result.photons.begin() + int64_t(result.starts[p]), is_kept);
    });
    parallel_for(tasks.size(), [&](size_t t) {
        for (const NeighbourReference& reference : tasks[t].foreign)
            result.photons[tasks[t].counts[reference.patch]++] = reference.photon;
        tasks[t] = {};
    });
    return result;
}

}  // namespace lw
