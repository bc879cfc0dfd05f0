#include "maps/fill_grid.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/random.h"
#include "maps/packing.h"

namespace lw {
namespace {

/// What a grid keeps of a photon.
struct Record {
    vec3 local;  // u, v, h from the anchor of the patch, m
    uint origin, flux;
    uint16_t direction;
};

struct Bounds {
    vec3 low{1e30f}, high{-1e30f};
};

/// Two numbers in [0, 1) to dither the direction of a photon, the same for all references to it.
vec2 dither_of(uint photon) {
    const uint64_t bits = mix64(photon);
    return vec2(float(bits & 0xffffu), float((bits >> 16) & 0xffffu)) / 65536.0f;
}

std::vector<Record> bring_into_frame(const SurfaceGrid& grid, const std::vector<Photon>& photons,
                                     std::span<const uint> chosen, const PhotonRecords& packed, Bounds& bounds) {
    std::vector<Record> records;
    records.reserve(chosen.size());
    constexpr size_t ahead = 24;  // photons prefetched ahead
    for (size_t i = 0; i < chosen.size(); ++i) {
        if (i + ahead < chosen.size()) prefetch(photons[chosen[i + ahead]]);
        const Photon& p = photons[chosen[i]];
        const vec3 local = position_in_grid(grid, p.position);
        bounds.low = min(bounds.low, local), bounds.high = max(bounds.high, local);
        records.push_back({local, p.origin & 0xffffu, pack_rgb9e5(p.flux * packed.flux_scale),
                           packed.has_directions() ? pack_direction(p.from, dither_of(chosen[i])) : uint16_t(0)});
    }
    return records;
}

/// One cell without photons.
void lay_empty_cell(SurfaceGrid& grid) {
    grid.cell_size = grid.radius;
    grid.quantum = vec3(grid.radius / 65535.0f);
    grid.columns = grid.rows = 1;
}

/// Moves the origin to the corner of the photons' bounds and sets quantum and cells for `count` references.
void fit_grid(SurfaceGrid& grid, const Bounds& bounds, size_t count) {
    const vec3 reach = max(abs(grid.origin), vec3(1e-20f));
    const float floor_size = 1e-6f * std::max({reach.x, reach.y, reach.z});
    const vec3 extent = max((bounds.high - bounds.low) * 1.0001f, vec3(floor_size));
    if (count == 0) return lay_empty_cell(grid);
    grid.origin += grid.u_axis * bounds.low.x + grid.v_axis * bounds.low.y;
    grid.h_origin = bounds.low.z;
    grid.quantum = extent / 65535.0f;
    const double cells = std::max(1.0, double(count) / references_per_cell);
    double cell = std::sqrt(double(extent.x) * double(extent.y) / cells);
    // With few or coincident photons cells must not become so small that a search within the radius visits thousands.
    cell = std::max({cell, double(extent.x) / cells, double(extent.y) / cells, double(grid.radius) / 256});
    grid.cell_size = float(cell);
    grid.columns = uint(std::max(1.0, std::ceil(double(extent.x) / double(grid.cell_size))));
    grid.rows = uint(std::max(1.0, std::ceil(double(extent.y) / double(grid.cell_size))));
}

/// Packs a place. `local`: u, v, h relative to the corner of the grid and its lowest height, m.
PhotonPlace place_of(vec3 local, uint origin, const SurfaceGrid& grid) {
    const auto step = [](float v, float quantum) {  // rounded to nearest
        return uint(std::min(std::max(v / quantum, 0.0f), 65535.0f) + 0.5f);
    };
    return {step(local.x, grid.quantum.x) | step(local.y, grid.quantum.y) << 16,
            step(local.z, grid.quantum.z) | origin << 16};
}

uint grid_cell_of(PhotonPlace place, const SurfaceGrid& grid) {
    const vec3 local = place_in_grid(place, grid);
    const uint x = std::min(uint(local.x / grid.cell_size), grid.columns - 1);
    const uint y = std::min(uint(local.y / grid.cell_size), grid.rows - 1);
    return y * grid.columns + x;
}

}  // namespace

FilledGrid fill_grid(SurfaceGrid& grid, const std::vector<Photon>& photons, std::span<const uint> chosen, uint begin,
                     PhotonRecords& packed) {
    Bounds bounds;
    const std::vector<Record> records = bring_into_frame(grid, photons, chosen, packed, bounds);
    fit_grid(grid, bounds, records.size());
    std::vector<PhotonPlace> places(records.size());
    std::vector<uint> cells(records.size()), next(size_t(grid.columns) * grid.rows, 0);
    for (size_t i = 0; i < records.size(); ++i) {
        places[i] = place_of(records[i].local - bounds.low, records[i].origin, grid);
        cells[i] = grid_cell_of(places[i], grid);
        ++next[cells[i]];
    }
    const uint first = begin;
    for (uint& start : next) begin += std::exchange(start, begin);
    FilledGrid filled{next, std::vector<uint>(records.size())};
    for (size_t i = 0; i < records.size(); ++i) {
        const uint slot = next[cells[i]]++;
        packed.places[slot] = places[i];
        packed.fluxes[slot] = records[i].flux;
        filled.photons[slot - first] = chosen[i];
        if (packed.has_directions()) packed.directions[slot] = records[i].direction;
    }
    return filled;
}

}  // namespace lw
