// The text of the gather over readers that count: what a pixel reads and tests, on any device.
#pragma once
#include <array>

#include "maps/estimate.h"

namespace lw {

/// Records read, by kind.
class Reads {
  public:
    void operator()(Record kind) const { ++counts_[size_t(kind)]; }
    uint64_t of(Record kind) const { return counts_[size_t(kind)]; }

    /// As they lie on the device: 96 bytes for the corners of a triangle, 36 for their positions alone.
    double bytes() const {
        const auto count = [this](Record kind) { return double(of(kind)); };
        return count(Record::surface) * (96 + sizeof(Material)) + count(Record::grid) * sizeof(SurfaceGrid) +
               count(Record::cell) * sizeof(uvec4) + count(Record::photon) * sizeof(PhotonPlace) +
               4 * (count(Record::flux) + count(Record::number)) + 2 * count(Record::direction) +
               count(Record::box) * sizeof(BvhNode) + 40 * count(Record::triangle);
    }

  private:
    mutable std::array<uint64_t, size_t(Record::number) + 1> counts_{};
};

using CountingEstimator = GatherText<Reads>;

}  // namespace lw
