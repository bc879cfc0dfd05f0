#include "maps/neighbours.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "trace/box_search.h"

namespace lw {
namespace {

constexpr float max_cells_across = 4096;
constexpr uint block_side = 4;  // cells across a block that is searched at once

/// Another patch as the cells of one see it, in its own frame: the centre of cell (x, y) lies at start + x u_step +
/// y v_step from the middle of its box.
struct Candidate {
    uint patch;
    float radius2, height2;  // m2, how far away and how high above it photons may lie
    float tolerance;         // m, of that height
    vec3 start, u_step, v_step, half;
};

/// Cells [x0, x1] x [y0, y1].
struct CellRange {
    uint x0, y0, x1, y1;
};

/// Tests which patches may refer to photons in a cell of a patch. It never rejects one that does.
class NeighbourTest {
  public:
    NeighbourTest(const std::vector<PatchShape>& shapes, const std::vector<float>& radii, float neighbour_angle_deg)
        : shapes_(shapes), radii_(radii), cos_angle_(std::cos(glm::radians(neighbour_angle_deg))) {
        for (size_t p = 0; p < shapes.size(); ++p) {
            const vec3 reach = max(abs(shapes[p].box_low), abs(shapes[p].box_high));
            margins_.push_back(1e-3f * radii[p] + 4e-6f * std::max({reach.x, reach.y, reach.z}));
        }
    }

    /// A box that holds all photons that the patch refers to.
    Box searched_box(uint patch) const {
        const PatchShape& s = shapes_[patch];
        const float reach = radii_[patch] + margins_[patch];
        const Box box = bounds(patch, s.low, s.high);
        return {box.low - reach, box.high + reach};
    }

    /// The bounds, in the axes of the scene, of a box in the frame of a patch.
    Box bounds(uint patch, vec3 low, vec3 high) const {
        const PatchShape& s = shapes_[patch];
        const vec3 middle = 0.5f * (low + high), half = 0.5f * (high - low);
        const vec3 centre = s.to_scene(middle);
        const vec3 extent = abs(s.u_axis) * half.x + abs(s.v_axis) * half.y + abs(s.normal) * half.z;
        return {centre - extent, centre + extent};
    }

    /// True when a triangle of `own` may have a normal within the angle of that of `other`.
    bool normals_agree(uint own, uint other) const {
        const float spread = shapes_[own].cos_spread, cosine = dot(shapes_[other].normal, shapes_[own].normal);
        return own != other && cosine >= (spread < 0.9999f ? cosine_of_sum(cos_angle_, spread) : cos_angle_) - 0.02f;
    }

    Candidate candidate(uint own, uint other, vec3 step) const {
        const PatchShape &from = shapes_[own], &to = shapes_[other];
        const auto turned = [&](vec3 v) { return vec3(dot(v, to.u_axis), dot(v, to.v_axis), dot(v, to.normal)); };
        const vec3 u = turned(from.u_axis), v = turned(from.v_axis), h = turned(from.normal);
        const vec3 first = from.low + 0.5f * step;
        Candidate c{other, radii_[other] * radii_[other], 0, 0.01f * radii_[other], {}, u * step.x, v * step.y, {}};
        c.start = to.to_local(from.anchor) + u * first.x + v * first.y + h * first.z - 0.5f * (to.low + to.high);
        c.half = 0.5f * (to.high - to.low + abs(u) * step.x + abs(v) * step.y + abs(h) * step.z) + margins_[own] +
                 margins_[other];
        const bool wide = cosine_of_sum(h.z, from.cos_spread) <= 0;
        const float sine = wide ? 1 : sine_of(h.z) * from.cos_spread + h.z * sine_of(from.cos_spread);
        c.height2 = (sine * sine * 1.2f + 2e-3f) * c.radius2;
        return c;
    }

    bool reaches(const Candidate& c, const CellRange& cells) const {
        const float width = 0.5f * float(cells.x1 - cells.x0), depth = 0.5f * float(cells.y1 - cells.y0);
        const float x = float(cells.x0) + width, y = float(cells.y0) + depth;
        const auto outside = [&](int axis) {  // without branches: they would be mispredicted
            const float u = c.u_step[axis], v = c.v_step[axis], local = c.start[axis] + u * x + v * y;
            return std::max(std::abs(local) - std::abs(u) * width - std::abs(v) * depth - c.half[axis], 0.0f);
        };
        const float du = outside(0), dv = outside(1), dh = outside(2);
        const float height = std::max(dh - c.tolerance, 0.0f);
        return (du * du + dv * dv + dh * dh <= c.radius2) & (height * height <= c.height2);
    }

  private:
    static float sine_of(float cosine) { return std::sqrt(std::max(0.0f, 1 - cosine * cosine)); }
    static float cosine_of_sum(float a, float b) { return a * b - sine_of(a) * sine_of(b); }

    const std::vector<PatchShape>& shapes_;
    const std::vector<float>& radii_;
    float cos_angle_;
    std::vector<float> margins_;  // m, of each patch: more than the rounding of positions around it in any frame
};

}  // namespace

Neighbours::Neighbours(const std::vector<PatchShape>& shapes, const std::vector<float>& radii,
                       float neighbour_angle_deg, const std::vector<float>& cell_sizes)
    : cells_(shapes.size()) {
    const NeighbourTest test(shapes, radii, neighbour_angle_deg);
    std::vector<Box> boxes;
    for (uint patch = 0; patch < shapes.size(); ++patch) boxes.push_back(test.searched_box(patch));
    const BoxSearch search(std::move(boxes));
    parallel_for(shapes.size(), [&](size_t p) {
        const uint own = uint(p);
        PatchCells& grid = cells_[p];
        const vec3 step = grid.divide(shapes[p], cell_sizes[p]), low = shapes[p].low;
        std::vector<Candidate> around;
        for (uint y0 = 0; y0 < grid.rows; y0 += block_side)
            for (uint x0 = 0; x0 < grid.columns; x0 += block_side) {
                const CellRange block{x0, y0, std::min(x0 + block_side, grid.columns) - 1,
                                      std::min(y0 + block_side, grid.rows) - 1};
                const Box box = test.bounds(own, low + step * vec3(float(x0), float(y0), 0),
                                            low + step * vec3(float(block.x1 + 1), float(block.y1 + 1), 1));
                around.clear();
                search.overlapping(box, [&](uint other) {
                    if (!test.normals_agree(own, other)) return;
                    const Candidate candidate = test.candidate(own, other, step);
                    if (test.reaches(candidate, block)) around.push_back(candidate);
                });
                for (uint y = y0; y <= block.y1; ++y)
                    for (uint x = x0; x <= block.x1; ++x) {
                        const size_t start = grid.list.size();
                        for (const Candidate& candidate : around)
                            if (test.reaches(candidate, {x, y, x, y})) grid.list.push_back(candidate.patch);
                        grid.set_cell(x, y, start);
                    }
            }
        grid.list.shrink_to_fit();
    });
}

vec3 Neighbours::PatchCells::divide(const PatchShape& shape, float cell_size) {
    const vec3 size = shape.high - shape.low;
    const auto count = [=](float edge) { return uint(clamp(std::ceil(edge / cell_size), 1.0f, max_cells_across)); };
    columns = count(size.x), rows = count(size.y);
    list.resize(2 * columns * rows);
    const vec3 step = size / vec3(float(columns), float(rows), 1);
    u_row = shape.u_axis / std::max(step.x, 1e-20f), v_row = shape.v_axis / std::max(step.y, 1e-20f);
    const vec3 corner = shape.anchor + shape.u_axis * shape.low.x + shape.v_axis * shape.low.y;
    low = vec2(dot(u_row, corner), dot(v_row, corner));
    return step;
}

}  // namespace lw
