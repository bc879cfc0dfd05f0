// Which of many axis-aligned boxes overlap a given one; a hierarchy of median splits, traversed without a stack.
#pragma once
#include <vector>

#include "shaders/types.h"

namespace lw {

struct Box {
    vec3 low, high;
};

/// A set of boxes that is built once. Queries are thread-safe.
class BoxSearch {
  public:
    explicit BoxSearch(std::vector<Box> boxes);

    /// Calls visit(index) for every box that overlaps `wanted`.
    template <class Visit>
    void overlapping(const Box& wanted, const Visit& visit) const {
        for (uint n = 0; n < nodes_.size();) {
            const Node& node = nodes_[n];
            const bool missed = !overlap(node.bounds, wanted);
            n = missed ? node.next : n + 1;
            for (uint i = node.first; i < node.last && !missed; ++i)
                if (overlap(boxes_[order_[i]], wanted)) visit(order_[i]);
        }
    }

  private:
    /// Nodes are stored depth first: the subtree of a node follows it and ends before node `next`.
    struct Node {
        Box bounds;
        uint next = 0;
        uint first = 0, last = 0;  // range [first, last) in order_; empty in an inner node
    };

    static bool overlap(const Box& a, const Box& b) {
        return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y &&
               a.low.z <= b.high.z && b.low.z <= a.high.z;
    }
    void build(uint first, uint last);

    std::vector<Box> boxes_;
    std::vector<uint> order_;
    std::vector<Node> nodes_;
};

}  // namespace lw
