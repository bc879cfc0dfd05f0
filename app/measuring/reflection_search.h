// Looks for bright reflections of lamps in the current view, on a thread of its own, once the view stands still.
#pragma once
#include <atomic>
#include <optional>
#include <thread>

#include "measure/reflections.h"
#include "trace/ray_caster.h"

namespace lw {

/// All that the reflections of a view depend on.
struct ReflectionView {
    vec3 position{0};
    mat3 rotation{1};
    float yfov = 0;
    uvec2 size{0};             // pixels of the picture
    std::vector<vec3> powers;  // RGB power of each lamp
    bool operator==(const ReflectionView&) const = default;
};

class ReflectionSearch {
  public:
    /// Scene and caster must outlive it.
    ReflectionSearch(const Scene& scene, const RayCaster& caster) : scene_(scene), caster_(caster) {}
    /// Waits for a running search.
    ~ReflectionSearch();
    ReflectionSearch(const ReflectionSearch&) = delete;
    ReflectionSearch& operator=(const ReflectionSearch&) = delete;

    /// The report on this view, or null while it is not known. Starts a search when the view has not changed for a
    /// moment; `now`: time in seconds.
    const ReflectionReport* report(const ReflectionView& view, double now);

  private:
    void search();

    const Scene& scene_;
    const RayCaster& caster_;
    ReflectionView seen_, asked_;
    double changed_ = 0;
    std::optional<ReflectionReport> found_;
    std::thread thread_;
    std::atomic<bool> running_{false};
};

}  // namespace lw
