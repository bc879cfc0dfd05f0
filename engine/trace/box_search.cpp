#include "trace/box_search.h"

#include <algorithm>
#include <numeric>

namespace lw {
namespace {

constexpr uint boxes_per_leaf = 4;

}  // namespace

BoxSearch::BoxSearch(std::vector<Box> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    if (!boxes_.empty()) build(0, uint(boxes_.size()));
}

void BoxSearch::build(uint first, uint last) {
    const size_t node = nodes_.size();
    Box bounds = boxes_[order_[first]];
    for (uint i = first; i < last; ++i) {
        bounds.low = min(bounds.low, boxes_[order_[i]].low);
        bounds.high = max(bounds.high, boxes_[order_[i]].high);
    }
    const bool leaf = last - first <= boxes_per_leaf;
    nodes_.push_back({bounds, 0, first, leaf ? last : first});
    if (!leaf) {
        const vec3 size = bounds.high - bounds.low;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const uint middle = (first + last) / 2;
        const auto place = [&](uint box) { return boxes_[box].low[axis] + boxes_[box].high[axis]; };
        std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                         [&](uint a, uint b) { return place(a) < place(b); });
        build(first, middle);
        build(middle, last);
    }
    nodes_[node].next = uint(nodes_.size());
}

}  // namespace lw
