#include "neighbour_search.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/parallel.h"
#include "base/random.h"

namespace lw {

struct MapTreeSearch::Points {
    const vec3* local;
    size_t count;
    size_t kdtree_get_point_count() const { return count; }
    float kdtree_get_pt(size_t i, size_t axis) const { return local[i][int(axis)]; }
    template <class Box>
    bool kdtree_get_bbox(Box&) const {
        return false;
    }
};

struct GlobalTreeSearch::Points {
    const std::vector<vec3>& positions;
    size_t kdtree_get_point_count() const { return positions.size(); }
    float kdtree_get_pt(size_t i, size_t axis) const { return positions[i][int(axis)]; }
    template <class Box>
    bool kdtree_get_bbox(Box&) const {
        return false;
    }
};

namespace {

constexpr size_t points_per_leaf = 10;
constexpr uint64_t no_key = ~0ull;

vec3 to_local(const SurfaceGrid& grid, vec3 position) {
    const vec3 offset = position - grid.origin;
    return {dot(offset, grid.u_axis), dot(offset, grid.v_axis), dot(offset, grid.normal)};
}

vec3 to_world(const SurfaceGrid& grid, vec3 local) {
    return grid.origin + local.x * grid.u_axis + local.y * grid.v_axis + local.z * grid.normal;
}

/// What a photon of the whole scene must pass to count at a query: the rules by which a map refers to it
/// (engine/maps/references.cpp, with the distance to the query for that to the map) and by which the gather takes it.
struct Rules {
    const Query& query;
    float cos_angle, max_radius;

    Rules(const Query& q, const PhotonMap& map)
        : query(q),
          cos_angle(std::cos(map.settings.neighbour_angle_deg * lw_pi / 180)),
          max_radius(map.settings.radius) {}
    bool accept(vec3 position, vec3 normal, float distance_squared) const {
        const float cosine = dot(normal, query.normal);
        if (cosine < cos_angle) return false;
        const float height = std::fabs(dot(position - query.position, query.normal));
        return is_explained(height, cosine, distance_squared) && on_same_surface(height, distance_squared, max_radius);
    }
    /// A sheet above or below is no part of the surface unless it is turned against it.
    bool is_explained(float height, float cosine, float distance_squared) const {
        const float excess = std::max(height - 0.01f * max_radius, 0.0f);
        const float sine_squared = 1.2f * std::max(0.0f, 1 - cosine * cosine) + 1e-4f;
        return excess * excess <= sine_squared * distance_squared;
    }
};

/// nanoflann's result set over NearestPhotons; `accept(index, distance_squared)` may refuse and correct the distance.
template <class Accept>
struct FilteredResult {
    NearestPhotons& nearest;
    const Accept& accept;

    bool addPoint(float distance_squared, uint index) {
        if (accept(index, distance_squared) && distance_squared < nearest.bound()) nearest.add(distance_squared, index);
        return true;
    }
    float worstDist() const { return nearest.bound(); }
    bool full() const { return true; }  // the radius bounds the search from the start
    size_t size() const { return nearest.entries().size(); }
    void sort() {}
};

template <class Tree, class Accept>
void search(const Tree& tree, const float* point, NearestPhotons& nearest, const Accept& accept) {
    FilteredResult<Accept> result{nearest, accept};
    tree.findNeighbors(result, point, {});
}

/// 21 bits per axis.
uint64_t key_of(glm::ivec3 cell) {
    const auto bits = [](int i) { return uint64_t(uint32_t(i + (1 << 20))) & 0x1fffffu; };
    return bits(cell.x) | bits(cell.y) << 21 | bits(cell.z) << 42;
}

glm::ivec3 cell_of(vec3 position, float cell_size) { return glm::ivec3(floor(position / cell_size)); }

}  // namespace

void NearestPhotons::start(uint k, float radius_squared) {
    k_ = k;
    bound_ = radius_squared;
    entries_.clear();
}

void NearestPhotons::add(float distance_squared, uint index) {
    if (full()) {
        std::pop_heap(entries_.begin(), entries_.end());
        entries_.back() = {distance_squared, index};
    } else {
        entries_.push_back({distance_squared, index});
    }
    std::push_heap(entries_.begin(), entries_.end());
    if (full()) bound_ = entries_.front().distance_squared;
}

struct MapGridSearch::Local {
    const SurfaceGrid& grid;
    vec3 point;
};

vec3 MapGridSearch::position(const Query& query, uint index) const {
    const SurfaceGrid& grid = map_.grids[query.map];
    return to_world(grid, place_in_grid(map_.places[index], grid));
}

/// Cells [x0, x1] of row y, clipped to the grid.
void MapGridSearch::visit(const Local& local, int x0, int x1, int y, NearestPhotons& nearest) const {
    const SurfaceGrid& grid = local.grid;
    if (y < 0 || y >= int(grid.rows) || x1 < 0 || x0 >= int(grid.columns)) return;
    const uint row = grid.first_cell + uint(y) * grid.columns;
    const uint last = map_.cell_starts[row + uint(std::min(x1, int(grid.columns) - 1)) + 1];
    for (uint i = map_.cell_starts[row + uint(std::max(x0, 0))]; i < last; ++i) {
        const vec3 d = place_in_grid(map_.places[i], grid) - local.point;
        const float d2 = dot(d, d);
        if (d2 < nearest.bound() && on_same_surface(d.z, d2, map_.settings.radius)) nearest.add(d2, i);
    }
}

/// Rings of cells outwards until the ring's border is farther than the k-th photon.
void MapGridSearch::find(const Query& query, NearestPhotons& nearest) const {
    const SurfaceGrid& grid = map_.grids[query.map];
    const Local local{grid, to_local(grid, query.position)};
    const ivec2 cell(floor(vec2(local.point) / grid.cell_size));
    const int farthest = int(grid.columns + grid.rows);
    for (int ring = 0; ring <= farthest + std::max(std::abs(cell.x), std::abs(cell.y)); ++ring) {
        const int x0 = cell.x - ring, x1 = cell.x + ring, y0 = cell.y - ring, y1 = cell.y + ring;
        visit(local, x0, x1, y0, nearest);
        if (ring > 0) visit(local, x0, x1, y1, nearest);
        for (int y = y0 + 1; y < y1; ++y) {
            visit(local, x0, x0, y, nearest);
            visit(local, x1, x1, y, nearest);
        }
        const vec2 low = vec2(local.point) - vec2(float(x0), float(y0)) * grid.cell_size;
        const vec2 high = vec2(float(x1 + 1), float(y1 + 1)) * grid.cell_size - vec2(local.point);
        const float reached = std::max(0.0f, std::min({low.x, low.y, high.x, high.y}));
        const bool whole = x0 <= 0 && y0 <= 0 && x1 >= int(grid.columns) - 1 && y1 >= int(grid.rows) - 1;
        if (reached * reached >= nearest.bound() || whole) return;
    }
}

MapTreeSearch::MapTreeSearch(const PhotonMap& map)
    : map_(map), local_(map.places.size()), points_(map.grids.size()), trees_(map.grids.size()) {
    parallel_for(map.grids.size(), [&](size_t m) {
        const SurfaceGrid& grid = map.grids[m];
        const uint first = map.cell_starts[grid.first_cell];
        const uint last = map.cell_starts[grid.first_cell + grid.columns * grid.rows];
        for (uint i = first; i < last; ++i) local_[i] = place_in_grid(map.places[i], grid);
        points_[m] = std::make_unique<Points>(Points{local_.data() + first, last - first});
        trees_[m] = std::make_unique<Tree>(2, *points_[m], nanoflann::KDTreeSingleIndexAdaptorParams(points_per_leaf));
        trees_[m]->buildIndex();
    });
}

MapTreeSearch::~MapTreeSearch() = default;

/// The tree knows the distance in the plane; the height is added, so that the 3D distance decides.
void MapTreeSearch::find(const Query& query, NearestPhotons& nearest) const {
    const SurfaceGrid& grid = map_.grids[query.map];
    const vec3 local = to_local(grid, query.position);
    const vec3* points = points_[query.map]->local;
    search(*trees_[query.map], &local.x, nearest, [&](uint index, float& distance_squared) {
        const float height = points[index].z - local.z;
        distance_squared += height * height;
        return on_same_surface(height, distance_squared, map_.settings.radius);
    });
}

vec3 MapTreeSearch::position(const Query& query, uint index) const {
    return to_world(map_.grids[query.map], points_[query.map]->local[index]);
}

PhotonCloud::PhotonCloud(const Scene& scene, const std::vector<Photon>& photons)
    : positions(photons.size()), normals(photons.size()) {
    parallel_for(
        photons.size(),
        [&](size_t i) {
            const uvec3 corner = scene.triangles[photons[i].triangle];
            const vec3 a = scene.positions[corner.x];
            const vec3 n = normalize(cross(scene.positions[corner.y] - a, scene.positions[corner.z] - a));
            positions[i] = photons[i].position;
            normals[i] = photons[i].side() ? -n : n;
        },
        4096);
}

GlobalTreeSearch::GlobalTreeSearch(const PhotonCloud& cloud, const PhotonMap& map)
    : cloud_(cloud), map_(map), points_(std::make_unique<Points>(Points{cloud.positions})) {
    tree_ = std::make_unique<Tree>(3, *points_, nanoflann::KDTreeSingleIndexAdaptorParams(points_per_leaf));
    tree_->buildIndex();
}

GlobalTreeSearch::~GlobalTreeSearch() = default;

void GlobalTreeSearch::find(const Query& query, NearestPhotons& nearest) const {
    const Rules rules(query, map_);
    search(*tree_, &query.position.x, nearest, [&](uint index, float& distance_squared) {
        return rules.accept(cloud_.positions[index], cloud_.normals[index], distance_squared);
    });
}

HashGridSearch::HashGridSearch(const PhotonCloud& cloud, const PhotonMap& map, float cell_size)
    : map_(map), cell_size_(cell_size) {
    std::vector<std::pair<uint64_t, uint>> order(cloud.positions.size());
    for (size_t i = 0; i < order.size(); ++i) order[i] = {key_of(cell_of(cloud.positions[i], cell_size)), uint(i)};
    parallel_sort(order.begin(), order.end(), std::less<>());
    size_t cells = 0;
    for (size_t i = 0; i < order.size(); ++i) {
        positions_.push_back(cloud.positions[order[i].second]);
        normals_.push_back(cloud.normals[order[i].second]);
        cells += i == 0 || order[i].first != order[i - 1].first;
    }
    slots_.assign(std::bit_ceil(2 * cells + 1), {no_key, 0, 0});
    for (size_t i = 0; i < order.size();) {
        size_t end = i;
        while (end < order.size() && order[end].first == order[i].first) ++end;
        size_t slot = mix64(order[i].first) & (slots_.size() - 1);
        while (slots_[slot].key != no_key) slot = (slot + 1) & (slots_.size() - 1);
        slots_[slot] = {order[i].first, uint(i), uint(end)};
        i = end;
    }
}

const HashGridSearch::Slot* HashGridSearch::slot_of(glm::ivec3 cell) const {
    const uint64_t key = key_of(cell);
    for (size_t slot = mix64(key) & (slots_.size() - 1);; slot = (slot + 1) & (slots_.size() - 1)) {
        if (slots_[slot].key == key) return &slots_[slot];
        if (slots_[slot].key == no_key) return nullptr;
    }
}

void HashGridSearch::visit(glm::ivec3 cell, const Query& query, NearestPhotons& nearest) const {
    const Slot* slot = slot_of(cell);
    if (!slot) return;
    const Rules rules(query, map_);
    for (uint i = slot->first; i < slot->last; ++i) {
        const vec3 d = positions_[i] - query.position;
        const float d2 = dot(d, d);
        if (d2 < nearest.bound() && rules.accept(positions_[i], normals_[i], d2)) nearest.add(d2, i);
    }
}

void HashGridSearch::find(const Query& query, NearestPhotons& nearest) const {
    const glm::ivec3 centre = cell_of(query.position, cell_size_);
    const vec3 inside = query.position - vec3(centre) * cell_size_;
    const float margin =
        std::min({inside.x, inside.y, inside.z, cell_size_ - inside.x, cell_size_ - inside.y, cell_size_ - inside.z});
    for (int ring = 0;; ++ring) {
        for (int z = -ring; z <= ring; ++z)
            for (int y = -ring; y <= ring; ++y) {
                const bool face = std::abs(z) == ring || std::abs(y) == ring;
                for (int x = -ring; x <= ring; x += face || ring == 0 ? 1 : 2 * ring)
                    visit(centre + glm::ivec3(x, y, z), query, nearest);
            }
        const float reached = margin + float(ring) * cell_size_;
        if (reached * reached >= nearest.bound()) return;
    }
}

}  // namespace lw
