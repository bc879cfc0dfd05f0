#include "neighbour_search.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "base/parallel.h"
#include "base/random.h"
#include "scene/triangle.h"

namespace lw {

struct GridTreeSearch::Points {
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
constexpr int first_ring = 2;     // 25 cells, which hold about 60 photons
constexpr float surplus = 1.35f;  // photons looked at per photon wanted, so that few searches are repeated

using Floats = float __attribute__((vector_size(16)));
using Words = int __attribute__((vector_size(16)));
Floats to_floats(Words w) { return __builtin_convertvector(w, Floats); }

/// What a photon of the whole scene must pass to count at a query: the rules by which a patch refers to it
/// (engine/maps/references.cpp, with the distance to the query for that to the patch) and by which the gather takes it.
struct Rules {
    const Query& query;
    float cos_angle, search_radius;

    Rules(const Query& q, const PhotonMap& map)
        : query(q),
          cos_angle(std::cos(map.settings.neighbour_angle_deg * lw_pi / 180)),
          search_radius(map.grids[q.grid].radius) {}
    bool accept(vec3 position, vec3 normal, float distance_squared) const {
        const float cosine = dot(normal, query.normal);
        if (cosine < cos_angle) return false;
        const float height = std::fabs(dot(position - query.position, query.normal));
        return is_explained(height, cosine, distance_squared) &&
               on_same_surface(height, distance_squared, search_radius);
    }
    /// A sheet above or below is no part of the surface unless it is turned against it.
    bool is_explained(float height, float cosine, float distance_squared) const {
        const float excess = std::max(height - 0.01f * search_radius, 0.0f);
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

void NearestPhotons::select(size_t found_count) {
    Entry* found = candidates_.data();
    const size_t count = std::min<size_t>(k_, found_count);
    if (count == 0) return;
    std::nth_element(found, found + count - 1, found + found_count);
    std::swap(found[0], found[count - 1]);
    entries_.assign(found, found + count);
    if (full()) bound_ = entries_.front().distance_squared;
}

vec3 GridSearch::position(const Query& query, uint index) const {
    const SurfaceGrid& grid = map_.grids[query.grid];
    return position_of(grid, place_in_grid(map_.places[index], grid));
}

/// The radius within which somewhat more than the wanted photons lie, from the counts of a growing window of cells.
float GridSearch::expected_radius(const SurfaceGrid& grid, vec3 local, uint wanted) const {
    const int columns = int(grid.columns), rows = int(grid.rows);
    const ivec2 cell = clamp(ivec2(floor(vec2(local) / grid.cell_size)), ivec2(0), ivec2(columns - 1, rows - 1));
    for (int ring = first_ring;; ++ring) {
        const int x0 = std::max(cell.x - ring, 0), x1 = std::min(cell.x + ring, columns - 1);
        const int y0 = std::max(cell.y - ring, 0), y1 = std::min(cell.y + ring, rows - 1);
        uint count = 0;
        for (int y = y0; y <= y1; ++y) {
            const uint* row = map_.cell_starts.data() + grid.first_cell + size_t(y) * grid.columns;
            count += row[x1 + 1] - row[x0];
        }
        const bool whole = x0 == 0 && y0 == 0 && x1 == columns - 1 && y1 == rows - 1;
        if (count < wanted && !whole) continue;
        const float area = float((x1 - x0 + 1) * (y1 - y0 + 1)) * grid.cell_size * grid.cell_size;
        return std::sqrt(surplus * float(wanted) * area / (lw_pi * float(std::max(count, 1u))));
    }
}

struct GridSearch::Disc {
    const SurfaceGrid& grid;
    vec3 local;
    float radius;
};

/// Writes all photons within the radius, row of cells after row, and returns their number.
size_t GridSearch::collect(const Disc& disc, NearestPhotons& nearest) const {
    const auto& [grid, local, radius] = disc;
    const float r2 = radius * radius, size = grid.cell_size;
    size_t count = 0;
    const auto cell = [size](float v, uint cells) { return int(clamp(std::floor(v / size), -1.0f, float(cells))); };
    const int y1 = std::min(cell(local.y + radius, grid.rows), int(grid.rows) - 1);
    for (int y = std::max(cell(local.y - radius, grid.rows), 0); y <= y1; ++y) {
        const float below = float(y) * size - local.y, dy = std::max({below, -below - size, 0.0f});
        const float half_width = std::sqrt(std::max(r2 - dy * dy, 0.0f));
        const int x0 = std::max(cell(local.x - half_width, grid.columns), 0);
        const int x1 = std::min(cell(local.x + half_width, grid.columns), int(grid.columns) - 1);
        const uint* row = map_.cell_starts.data() + grid.first_cell + size_t(y) * grid.columns;
        if (x0 > x1) continue;
        NearestPhotons::Entry* found = nearest.candidates(count + row[x1 + 1] - row[x0] + 1).data();
        count = size_t(collect_run(disc, row[x0], row[x1 + 1], found + count) - found);
    }
    return count;
}

/// Four photons at a time, then the rest.
NearestPhotons::Entry* GridSearch::collect_run(const Disc& disc, uint first, uint last,
                                               NearestPhotons::Entry* found) const {
    const auto& [grid, local, radius] = disc;
    const float radius_squared = radius * radius;
    const float tolerance = 0.01f * grid.radius;  // of on_same_surface(), written out for vectors
    uint i = first;
    for (; i + 4 <= last; i += 4) {
        Words low, high;  // u and v of a photon, its height and lamp, then the next one's
        std::memcpy(&low, &map_.places[i], sizeof low);
        std::memcpy(&high, &map_.places[i + 2], sizeof high);
        const Words uv = __builtin_shufflevector(low, high, 0, 2, 4, 6),
                    h = __builtin_shufflevector(low, high, 1, 3, 5, 7);
        const Floats du = to_floats(uv & 0xffff) * grid.quantum.x - local.x,
                     dv = to_floats(uv >> 16 & 0xffff) * grid.quantum.y - local.y,
                     dh = to_floats(h & 0xffff) * grid.quantum.z + (grid.h_origin - local.z);
        const Floats d2 = du * du + dv * dv + dh * dh, height = (dh < 0 ? -dh : dh) - tolerance;
        const Words kept = (d2 < radius_squared) & ((height <= 0) | (height * height <= 0.75f * d2));
        for (uint lane = 0; lane < 4; ++lane) {
            *found = {d2[lane], i + lane};
            found -= kept[lane];  // -1 where true
        }
    }
    for (; i < last; ++i) {
        const vec3 d = place_in_grid(map_.places[i], grid) - local;
        const float d2 = dot(d, d);
        *found = {d2, i};
        found += (d2 < radius_squared) & on_same_surface(d.z, d2, grid.radius);
    }
    return found;
}

/// Looks as far as the cells say, farther if that was not far enough, and selects.
void GridSearch::find(const Query& query, NearestPhotons& nearest) const {
    const SurfaceGrid& grid = map_.grids[query.grid];
    const vec3 local = position_in_grid(grid, query.position);
    const float farthest = std::sqrt(nearest.bound());
    Disc disc{grid, local, std::min(expected_radius(grid, local, nearest.wanted()), farthest)};
    size_t count = collect(disc, nearest);
    while (count < nearest.wanted() && disc.radius < farthest) {
        disc.radius = std::min(1.3f * disc.radius, farthest);
        count = collect(disc, nearest);
    }
    nearest.select(count);
}

GridTreeSearch::GridTreeSearch(const PhotonMap& map)
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

GridTreeSearch::~GridTreeSearch() = default;

/// The tree knows the distance in the plane; the height is added, so that the 3D distance decides.
void GridTreeSearch::find(const Query& query, NearestPhotons& nearest) const {
    const SurfaceGrid& grid = map_.grids[query.grid];
    const vec3 local = position_in_grid(grid, query.position);
    const vec3* points = points_[query.grid]->local;
    search(*trees_[query.grid], &local.x, nearest, [&](uint index, float& distance_squared) {
        const float height = points[index].z - local.z;
        distance_squared += height * height;
        return on_same_surface(height, distance_squared, grid.radius);
    });
}

vec3 GridTreeSearch::position(const Query& query, uint index) const {
    return position_of(map_.grids[query.grid], points_[query.grid]->local[index]);
}

PhotonCloud::PhotonCloud(const Scene& scene, const std::vector<Photon>& photons)
    : positions(photons.size()), normals(photons.size()) {
    parallel_for(
        photons.size(),
        [&](size_t i) {
            const vec3 n = normalize(triangle_product(scene, photons[i].triangle));
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
