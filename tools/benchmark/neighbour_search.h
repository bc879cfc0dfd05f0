// Exact k nearest photons by four structures, for Figure 6 and Table 1: the 2D grids of our patches, a 2D kd-tree per
// grid, a global 3D kd-tree and a 3D hash grid. All use the same rules: side and orientation (60 degrees, by the maps'
// references or by a test), height above the surface, the radius of the map. Trees and hash grid keep a bounded
// max-heap, without which they could not end early; the 2D grid knows from its cells how far to look, and selects once.
// kd-trees are nanoflann's (Blanco & Rai 2014).
#pragma once
#include <memory>
#include <nanoflann.hpp>
#include <vector>

#include "maps/photon_map.h"
#include "photons/photon.h"
#include "scene/scene.h"

namespace lw {

struct Query {
    vec3 position;
    vec3 normal;  // geometric, to the viewer
    uint grid;    // of the seen side of the triangle; not no_grid
};

/// The k nearest so far; indices belong to the structure that was searched.
class NearestPhotons {
  public:
    struct Entry {
        float distance_squared;
        uint index;
        bool operator<(const Entry& other) const { return distance_squared < other.distance_squared; }
    };
    void start(uint k, float radius_squared);
    uint wanted() const { return k_; }
    /// The squared distance below which a photon is still wanted.
    float bound() const { return bound_; }
    void add(float distance_squared, uint index);
    /// Another way than add(): the candidates of a search, written at once, of which select() takes the nearest of the
    /// first `count`. Keeps what was written when it grows to hold `size`.
    std::vector<Entry>& candidates(size_t size) {
        if (candidates_.size() < size) candidates_.resize(2 * size);
        return candidates_;
    }
    void select(size_t count);
    bool full() const { return entries_.size() == k_; }
    /// The farthest first.
    const std::vector<Entry>& entries() const { return entries_; }

  private:
    uint k_ = 0;
    float bound_ = 0;
    std::vector<Entry> entries_, candidates_;
};

/// The 2D grid of each patch, searched on the arrays that the file and the GPU hold.
class GridSearch {
  public:
    explicit GridSearch(const PhotonMap& map) : map_(map) {}
    void find(const Query& query, NearestPhotons& nearest) const;
    vec3 position(const Query& query, uint index) const;

  private:
    float expected_radius(const SurfaceGrid& grid, vec3 local, uint wanted) const;
    struct Disc;
    size_t collect(const Disc& disc, NearestPhotons& nearest) const;
    NearestPhotons::Entry* collect_run(const Disc& disc, uint first, uint last, NearestPhotons::Entry* found) const;

    const PhotonMap& map_;
};

/// A 2D kd-tree over u and v of each grid's references.
class GridTreeSearch {
  public:
    explicit GridTreeSearch(const PhotonMap& map);
    ~GridTreeSearch();
    void find(const Query& query, NearestPhotons& nearest) const;
    vec3 position(const Query& query, uint index) const;

    struct Points;

  private:
    using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Points>, Points, 2, uint>;
    const PhotonMap& map_;
    std::vector<vec3> local_;  // u, v, h per reference, m
    std::vector<std::unique_ptr<Points>> points_;
    std::vector<std::unique_ptr<Tree>> trees_;
};

/// Positions of all photons, and the normals of the sides they struck.
struct PhotonCloud {
    PhotonCloud(const Scene& scene, const std::vector<Photon>& photons);
    std::vector<vec3> positions, normals;
};

/// One 3D kd-tree over all photons.
class GlobalTreeSearch {
  public:
    GlobalTreeSearch(const PhotonCloud& cloud, const PhotonMap& map);
    ~GlobalTreeSearch();
    void find(const Query& query, NearestPhotons& nearest) const;
    vec3 position(const Query&, uint index) const { return cloud_.positions[index]; }

    struct Points;

  private:
    using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Points>, Points, 3, uint>;
    const PhotonCloud& cloud_;
    const PhotonMap& map_;
    std::unique_ptr<Points> points_;
    std::unique_ptr<Tree> tree_;
};

/// A hash table of 3D cells, photons copied in cell order; shells of cells outwards.
class HashGridSearch {
  public:
    HashGridSearch(const PhotonCloud& cloud, const PhotonMap& map, float cell_size);
    void find(const Query& query, NearestPhotons& nearest) const;
    vec3 position(const Query&, uint index) const { return positions_[index]; }

  private:
    struct Slot {
        uint64_t key;
        uint first, last;
    };
    const Slot* slot_of(glm::ivec3 cell) const;
    void visit(glm::ivec3 cell, const Query& query, NearestPhotons& nearest) const;

    const PhotonMap& map_;
    float cell_size_;
    std::vector<vec3> positions_, normals_;
    std::vector<Slot> slots_;
};

}  // namespace lw
