#include "maps/flat_coverage.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "maps/buried.h"
#include "scene/triangle.h"

namespace lw {
namespace {

constexpr uint block_side = 8;  // nodes across a block that is looked at as a whole
constexpr uint min_block = 2;
constexpr size_t max_triangles = 48;    // around a block; more are sampled faster
constexpr float flatness = 2e-3f;       // radii: heights of what lies in the plane
constexpr float burying_reach = 1.3f;   // scales: how far is_buried() looks sideways from the rim of a kernel
constexpr float parallel_walls = 0.9f;  // cosine between walls that may leave a slit

using Polygon = std::vector<vec2>;

float cross2(vec2 a, vec2 b) { return a.x * b.y - a.y * b.x; }

/// The part of a polygon on the left of the line through `a` along unit `along`.
Polygon clip(const Polygon& polygon, vec2 a, vec2 along) {
    Polygon kept;
    for (size_t i = 0; i < polygon.size(); ++i) {
        const vec2 p = polygon[i], q = polygon[(i + 1) % polygon.size()];
        const float left_p = cross2(along, p - a), left_q = cross2(along, q - a);
        if (left_p >= 0) kept.push_back(p);
        if ((left_p >= 0) != (left_q >= 0)) kept.push_back(p + (q - p) * (left_p / (left_p - left_q)));
    }
    return kept;
}

/// The part of a polygon inside the rectangle [low, high].
Polygon clip_to_rectangle(const Polygon& polygon, vec2 low, vec2 high) {
    const Polygon right = clip(clip(polygon, low, vec2(1, 0)), low, vec2(0, -1));
    return clip(clip(right, high, vec2(-1, 0)), high, vec2(0, 1));
}

/// True when some edge of `a` has all of `b` on its right, or closer to it than `gap`.
bool is_parted(const Polygon& a, const Polygon& b, float gap) {
    for (size_t i = 0; i < a.size(); ++i) {
        const vec2 edge = a[(i + 1) % a.size()] - a[i];
        const float size = length(edge);
        if (size > 0 && std::all_of(b.begin(), b.end(), [&](vec2 p) { return cross2(edge, p - a[i]) <= gap * size; }))
            return true;
    }
    return false;
}

/// True when the rectangle [low, high] lies inside the convex polygon.
bool contains(const Polygon& polygon, vec2 low, vec2 high) {
    for (size_t i = 0; i < polygon.size(); ++i) {
        const vec2 a = polygon[i], edge = polygon[(i + 1) % polygon.size()] - a;
        for (const vec2 corner : {low, vec2(high.x, low.y), high, vec2(low.x, high.y)})
            if (cross2(edge, corner - a) < 0) return false;
    }
    return polygon.size() > 2;
}

/// A plane across the ground.
struct Wall {
    vec3 normal, point;
};

/// The ground around the blocks of one patch, in the frame of its grid.
class Ground {
  public:
    Ground(const CoverageInput& input, size_t m)
        : scene_(input.scene),
          caster_(input.caster),
          grid_(input.nodes.surfaces.grids[m]),
          shape_(input.partition.shapes[input.nodes.surfaces.patches[m]]),
          radius_(grid_.radius),
          scale_(input.partition.scales[input.nodes.surfaces.patches[m]]),
          cos_angle_(std::cos(glm::radians(input.partition.neighbour_angle_deg))) {
        limit_support();
    }

    /// The polygons of the plane at `height` around the rectangle [low, high], clipped to where the patch refers to
    /// photons; nullopt when the ground is not as simple as that.
    std::optional<std::vector<Polygon>> look(vec2 low, vec2 high, float height) {
        const float reach = radius_ + burying_reach * scale_;
        const vec3 middle(0.5f * (low + high), height);
        const vec3 centre = position_of(grid_, middle);
        if (!caster_.triangles_around(centre, length(0.5f * (high - low) + reach), max_triangles, found_))
            return std::nullopt;
        std::vector<Polygon> flats;
        std::vector<Wall> walls;
        for (uint triangle : found_)
            if (!add(triangle, low - reach, high + reach, height, flats, walls)) return std::nullopt;
        for (Polygon& flat : flats) flat = clip_to_rectangle(flat, low - 1.01f * radius_, high + 1.01f * radius_);
        std::erase_if(flats, [](const Polygon& flat) { return flat.size() < 3; });
        if (!are_disjoint(flats) || has_slit(walls)) return std::nullopt;
        for (Polygon& flat : flats)
            for (const auto& [point, along] : support_) flat = clip(flat, point, along);
        return flats;
    }

  private:
    /// Lines around the places whose photons the patch refers to.
    void limit_support() {
        Polygon rim;
        if (shape_.triangles == 1) {
            for (const vec3& corner : corners_of(shape_.triangle)) rim.emplace_back(corner);
            if (cross2(rim[1] - rim[0], rim[2] - rim[0]) < 0) std::swap(rim[1], rim[2]);
        } else {
            const vec2 low = grid_.lattice.low, high = low + vec2(shape_.high - shape_.low);
            rim = {low, {high.x, low.y}, high, {low.x, high.y}};
        }
        for (size_t i = 0; i < rim.size(); ++i) {
            const vec2 edge = rim[(i + 1) % rim.size()] - rim[i];
            if (!(length(edge) > 0)) continue;
            const vec2 along = edge / length(edge);
            support_.push_back({rim[i] + vec2(along.y, -along.x) * grid_.radius, along});
        }
    }

    std::array<vec3, 3> corners_of(uint triangle) const {
        std::array<vec3, 3> corners = triangle_corners(scene_, triangle);
        for (vec3& corner : corners) corner = position_in_grid(grid_, corner);
        return corners;
    }

    /// Returns false when the triangle is neither ground nor wall and near enough to matter.
    bool add(uint triangle, vec2 low, vec2 high, float height, std::vector<Polygon>& flats, std::vector<Wall>& walls) {
        std::array<vec3, 3> p = corners_of(triangle);
        const vec3 least = min(p[0], min(p[1], p[2])), most = max(p[0], max(p[1], p[2]));
        const float above = std::max(radius_, clearance_of(scale_));
        if (most.x < low.x || most.y < low.y || least.x > high.x || least.y > high.y || least.z > height + above ||
            most.z < height - radius_)
            return true;
        const vec3 product = edge_product(p[0], p[1], p[2]);
        const float size = length(product);
        if (!(size > 0)) return true;
        const float thickness = flatness * radius_;
        if (least.z >= height - thickness && most.z <= height + thickness) {
            if (product.z < 0) std::swap(p[1], p[2]);
            flats.push_back({vec2(p[0]), vec2(p[1]), vec2(p[2])});
            return true;
        }
        walls.push_back({product / size, p[0]});
        return std::abs(product.z) < 0.9f * cos_angle_ * size;
    }

    bool are_disjoint(const std::vector<Polygon>& flats) const {
        const float gap = flatness * radius_;
        for (size_t i = 0; i < flats.size(); ++i)
            for (size_t j = i + 1; j < flats.size(); ++j)
                if (!is_parted(flats[i], flats[j], gap) && !is_parted(flats[j], flats[i], gap)) return false;
        return true;
    }

    /// True when two walls face each other or away from each other: light may not reach what is between.
    bool has_slit(const std::vector<Wall>& walls) const {
        for (const Wall& a : walls)
            for (const Wall& b : walls)
                if (std::abs(dot(a.normal, b.normal)) > parallel_walls &&
                    std::abs(dot(a.normal, b.point - a.point)) > flatness * radius_)
                    return true;
        return false;
    }

    const Scene& scene_;
    const RayCaster& caster_;
    const SurfaceGrid& grid_;
    const PatchShape& shape_;
    float radius_, scale_, cos_angle_;
    std::vector<std::pair<vec2, vec2>> support_;  // a point of each line, and its direction with the inside on the left
    std::vector<uint> found_;
};

}  // namespace

CoverageLevels radii_of_levels(const SurfaceGrid& grid) {
    CoverageLevels radii;
    for (uint i = 0; i < coverage_levels; ++i) radii[i] = grid.radius * float(i + 1) / float(coverage_levels);
    return radii;
}

CoverageLevels integrate_kernels(const std::vector<vec2>& polygon, const CoverageLevels& radii) {
    CoverageLevels sums{};
    for (size_t i = 0; i < polygon.size(); ++i) {
        const vec2 a = polygon[i], edge = polygon[(i + 1) % polygon.size()] - a;
        const float size = length(edge);
        if (!(size > 0)) continue;
        const vec2 along = edge / size;
        // The edge from t = from to t = to on a line that passes the origin at distance |p|, on its left if p > 0.
        const float from = dot(a, along), to = from + size, p = cross2(a, along);
        if (p == 0) continue;
        const auto angle = [p](float t) { return std::copysign(std::atan2(t, std::abs(p)), p * t); };
        const float whole = angle(to) - angle(from);
        for (size_t level = 0; level < radii.size(); ++level) {
            const float r2 = radii[level] * radii[level], half = std::sqrt(std::max(r2 - p * p, 0.0f));
            const float first = std::max(from, -half), last = std::min(to, half);
            float outside = whole, inside = 0;
            if (first < last) {
                outside -= angle(last) - angle(first);
                inside = kernel_peak(r2) *
                         (kernel_shape_over_triangle(p, last, r2) - kernel_shape_over_triangle(p, first, r2));
            }
            sums[level] += inside + outside / (2 * lw_pi);
        }
    }
    return sums;
}

namespace {

/// The nodes of a lattice, block after block.
class FlatCoverage {
  public:
    FlatCoverage(Ground ground, const SurfaceGrid& grid, const NodePoint* nodes, CoverageLevels* coverage,
                 std::vector<uint>& others)
        : ground_(std::move(ground)),
          lattice_(grid.lattice),
          radius_(grid.radius),
          radii_(radii_of_levels(grid)),
          nodes_(nodes),
          coverage_(coverage),
          others_(others) {}

    /// Nodes [x0, x0 + side) x [y0, y0 + side): all at once, or in four quarters, or not at all.
    void cover(uint x0, uint y0, uint side) {
        vec2 low(1e30f), high(-1e30f);
        float lowest = 1e30f, highest = -1e30f;
        std::vector<uint> block;
        for (uint y = y0; y < std::min(y0 + side, lattice_.rows); ++y)
            for (uint x = x0; x < std::min(x0 + side, lattice_.columns); ++x) {
                const uint i = y * lattice_.columns + x;
                if (!nodes_[i].exists()) continue;
                block.push_back(i);
                low = min(low, place(i)), high = max(high, place(i));
                lowest = std::min(lowest, nodes_[i].height), highest = std::max(highest, nodes_[i].height);
            }
        if (block.empty()) return;
        const bool level = highest - lowest <= flatness * radius_;
        if (const auto flats = level ? ground_.look(low, high, 0.5f * (lowest + highest)) : std::nullopt) {
            cover(block, *flats, low, high);
        } else if (side > min_block && level) {
            for (uint quarter = 0; quarter < 4; ++quarter)
                cover(x0 + quarter % 2 * side / 2, y0 + quarter / 2 * side / 2, side / 2);
        } else {
            others_.insert(others_.end(), block.begin(), block.end());
        }
    }

  private:
    vec2 place(uint i) const {
        return lattice_.low + vec2(float(i % lattice_.columns), float(i / lattice_.columns)) * lattice_.step;
    }

    void cover(const std::vector<uint>& block, const std::vector<Polygon>& flats, vec2 low, vec2 high) {
        const bool open = flats.size() == 1 && contains(flats[0], low - radius_, high + radius_);
        for (uint i : block) {
            coverage_[i].fill(open ? 1.0f : 0.0f);
            for (size_t f = 0; f < flats.size() && !open; ++f) {
                Polygon polygon = flats[f];
                for (vec2& corner : polygon) corner -= place(i);
                const CoverageLevels part = integrate_kernels(polygon, radii_);
                for (uint k = 0; k < coverage_levels; ++k) coverage_[i][k] += part[k];
            }
        }
    }

    Ground ground_;
    const SurfaceLattice& lattice_;
    float radius_;
    CoverageLevels radii_;
    const NodePoint* nodes_;
    CoverageLevels* coverage_;
    std::vector<uint>& others_;
};

}  // namespace

std::vector<uint> find_flat_coverage(const CoverageInput& input, size_t m, CoverageLevels* coverage) {
    const SurfaceGrid& grid = input.nodes.surfaces.grids[m];
    const SurfaceLattice& lattice = grid.lattice;
    std::vector<uint> others;
    FlatCoverage flat(Ground(input, m), grid, &input.nodes.points[lattice.first_node], coverage, others);
    for (uint y = 0; y < lattice.rows; y += block_side)
        for (uint x = 0; x < lattice.columns; x += block_side) flat.cover(x, y, block_side);
    return others;
}

}  // namespace lw
