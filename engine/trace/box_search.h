// Which of many axis-aligned boxes lie near a point; an Embree point query over user geometry.
#pragma once
#include <vector>

#include "shaders/types.h"

namespace lw {

struct Box {
    vec3 low, high;
};

/// Owns its Embree scene; thread-safe for queries.
class BoxSearch {
  public:
    /// Throws Error when Embree cannot build.
    explicit BoxSearch(std::vector<Box> boxes);
    ~BoxSearch();
    BoxSearch(const BoxSearch&) = delete;
    BoxSearch& operator=(const BoxSearch&) = delete;

    /// Calls visit(index) for every box within `radius` of `point` (and possibly a few more).
    template <class Visit>
    void near(vec3 point, float radius, Visit&& visit) const {
        query(
            point, radius, [](void* context, uint box) { (*static_cast<Visit*>(context))(box); }, &visit);
    }

  private:
    void query(vec3 point, float radius, void (*visit)(void*, uint), void* context) const;

    std::vector<Box> boxes_;
    void* device_ = nullptr;
    void* scene_ = nullptr;
};

}  // namespace lw
