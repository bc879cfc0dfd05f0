#include "file/map_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <system_error>

#include "base/error.h"
#include "base/input_file.h"
#include "base/memory.h"
#include "base/replaced_file.h"
#include "file/checksum.h"

namespace lw {
namespace {

constexpr std::array<char, 8> magic{'L', 'W', 'P', 'H', 'O', 'T', 'O', 'N'};
constexpr uint32_t version = 4;
constexpr size_t section_count = 15;

/// The fixed head of the file; sections follow in this order, each `bytes` long.
struct Header {
    std::array<char, 8> magic;
    uint32_t version;
    uint32_t sections;
    uint64_t checksum;  // of everything after this field
    uint64_t scene_hash;
    uint64_t photons_wanted;
    uint64_t photons_stored;
    uint64_t seed;
    float radius;
    float neighbour_angle_deg;
    float flux_scale;
    uint32_t direct_in_photons;
    float irradiance_scale;
    uint32_t caustic_grids;  // the last of the grids; 0 in files of scenes without
    std::array<uint64_t, section_count> bytes;
};
static_assert(sizeof(Header) == 200);
constexpr size_t checked_from = offsetof(Header, scene_hash);

/// Calls visit(array) for the sections in file order; Map is PhotonMap or const PhotonMap.
template <class Map, class Visit>
void for_each_section(Map& map, const Visit& visit) {
    visit(map.emitted);
    visit(map.triangle_maps);
    visit(map.caustic_sides.marks);
    visit(map.caustic_sides.values);
    visit(map.grids);
    visit(map.cell_starts);
    visit(map.places);
    visit(map.fluxes);
    visit(map.directions);
    visit(map.coverage);
    visit(map.visible_lamps);
    visit(map.irradiance.marks);
    visit(map.irradiance.values);
    visit(map.smooth_caustics);
    visit(map.shadow_masks);
}

template <class T>
size_t byte_size(const std::vector<T>& v) {
    return v.size() * sizeof(T);
}

uint64_t checksum_of(const Header& header, const PhotonMap& map) {
    Checksum sum;
    sum.add(reinterpret_cast<const char*>(&header) + checked_from, sizeof header - checked_from);
    for_each_section(map, [&](const auto& section) { sum.add(section.data(), byte_size(section)); });
    return sum.value();
}

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& what) {
    throw Error(path.string() + ": " + what + "; bake the map again");
}

constexpr float max_metres = 1e10f;     // beyond it, shaders may compute infinities or NaN from a position
constexpr float max_cells = 512;        // most cells across a search radius: the exact gather visits rings of them
constexpr float farthest_cell = 1e8f;   // from a grid's corner to a point of the scene: shaders count cells in ints
constexpr uint max_columns = 1u << 23;  // and rows: the shaders count them in floats

bool is_place(float metres) { return std::abs(metres) < max_metres; }

/// True for 2^-100 to 2^100: light divided by such a scale stays finite.
bool is_scale(float scale) { return scale >= 0x1p-100f && scale <= 0x1p100f; }

bool is_usable(const SurfaceGrid& g, float scene_size) {
    const auto place = [](vec3 v) { return is_place(v.x) && is_place(v.y) && is_place(v.z); };
    const auto axis = [](vec3 v) { return std::abs(v.x) < 2 && std::abs(v.y) < 2 && std::abs(v.z) < 2; };
    return place(g.origin) && axis(g.u_axis) && axis(g.v_axis) && axis(g.normal) && place(g.quantum) &&
           is_place(g.h_origin) && is_place(g.cell_size) && g.cell_size > 0 && is_place(g.radius) && g.radius > 0 &&
           g.radius <= max_cells * g.cell_size && length(g.origin) + scene_size <= farthest_cell * g.cell_size &&
           g.columns <= max_columns && g.rows <= max_columns;
}

/// Checks that every grid except those of caustics has a lattice, and that all arrays of nodes have a value per node.
void check_lattices(const std::filesystem::path& path, const PhotonMap& map) {
    uint64_t nodes = 0;
    for (size_t i = 0; i < map.grids.size() - map.caustic_grids; ++i) {
        const SurfaceLattice& l = map.grids[i].lattice;
        if (map.grids[i].columns == 0) continue;
        const auto is_step = [](float v) { return v > 0 && is_place(v); };
        if (l.columns < 2 || l.rows < 2 || l.columns > max_columns || l.rows > max_columns || l.first_node != nodes ||
            !is_step(l.step.x) || !is_step(l.step.y) || !is_place(l.low.x) || !is_place(l.low.y) ||
            uint64_t(l.columns) * l.rows > map.coverage.size() - nodes)
            refuse(path, "the lattice of grid " + std::to_string(i) + " is not valid");
        nodes += uint64_t(l.columns) * l.rows;
    }
    if (nodes != map.coverage.size()) refuse(path, "lattices and coverage do not agree");
}

/// Checks that every cut among the grids [first, last) leads to later cuts or to grids, and that no way through the
/// cuts is too long.
void check_cuts(const std::filesystem::path& path, const PhotonMap& map, size_t first, size_t last) {
    std::vector<uint> deep(last - first, 0);  // the longest way from each cut, in cuts
    for (size_t i = last; i-- > first;) {
        const SurfaceGrid& cut = map.grids[i];
        if (cut.columns > 0) continue;
        if (i + 1 < last && map.grids[i + 1].columns > 0)
            refuse(path, "grid " + std::to_string(i + 1) + " comes after cuts");
        for (uint next : {cut.rows, cut.first_cell}) {
            if (next == no_map) continue;
            if (next < first || next >= last || (map.grids[next].columns == 0 && next <= i))
                refuse(path, "cut " + std::to_string(i) + " leads to grid " + std::to_string(next));
            deep[i - first] = std::max(deep[i - first], deep[next - first] + 1);
        }
        if (deep[i - first] > max_cuts_deep) refuse(path, "cut " + std::to_string(i) + " leads too deep");
    }
}

bool is_usable_cut(const SurfaceGrid& g) {
    return is_place(length(g.origin)) && std::abs(g.normal.x) < 2 && std::abs(g.normal.y) < 2 &&
           std::abs(g.normal.z) < 2 && g.lattice.columns == 0 && g.lattice.rows == 0;
}

void check_grids(const std::filesystem::path& path, const PhotonMap& map, const Scene& scene) {
    uint64_t cells = 0;
    for (size_t i = 0; i < map.grids.size(); ++i) {
        const SurfaceGrid& g = map.grids[i];
        const uint64_t here = uint64_t(g.columns) * g.rows;
        if (g.columns == 0 && is_usable_cut(g)) continue;
        if (!is_usable(g, scene.size()) || here == 0 || g.first_cell != cells || here > map.cell_starts.size() - cells)
            refuse(path, "grid " + std::to_string(i) + " is not valid");
        cells += here;
    }
    if (cells + 1 != map.cell_starts.size()) refuse(path, "cells and grids do not agree");
    if (map.cell_starts.front() != 0) refuse(path, "its first cell does not start with the first reference");
    for (size_t c = 0; c + 1 < map.cell_starts.size(); ++c)
        if (map.cell_starts[c] > map.cell_starts[c + 1])
            refuse(path, "cell " + std::to_string(c) + " ends before it starts");
    if (map.cell_starts.back() != map.places.size()) refuse(path, "cells and references do not agree");
}

void check_indices(const std::filesystem::path& path, PhotonMap& map, const Scene& scene) {
    if (map.cell_starts.empty()) refuse(path, "it has no cells");
    if (map.emitted.size() != scene.lights.size()) refuse(path, "the number of lamps does not agree with the scene");
    if (map.caustic_grids > map.grids.size()) refuse(path, "it has more grids of caustics than grids");
    const uint64_t sides = 2 * scene.triangles.size(), of_caustics = map.caustic_grids > 0 ? sides : 0;
    if (map.triangle_maps.size() != sides || !map.caustic_sides.accept(of_caustics))
        refuse(path, "the number of triangles does not agree with the scene");
    if (map.fluxes.size() != map.places.size() || (map.has_directions() && map.directions.size() != map.places.size()))
        refuse(path, "the record arrays differ in length");
    check_grids(path, map, scene);
    const size_t others = map.grids.size() - map.caustic_grids;
    check_cuts(path, map, 0, others);
    check_cuts(path, map, others, map.grids.size());
    const auto refuse_grid = [&](uint index) {
        refuse(path, "a triangle refers to grid " + std::to_string(index) + " which does not exist");
    };
    for (uint index : map.triangle_maps)
        if (index != no_map && index >= others) refuse_grid(index);
    for (uint word : map.caustic_sides.values)
        if (word != 0 && (word - 1 < others || word - 1 >= map.grids.size())) refuse_grid(word - 1);
    for (const PhotonPlace& place : map.places)
        if (light_of(place) >= scene.lights.size())
            refuse(path, "a photon refers to lamp " + std::to_string(light_of(place)) + " which does not exist");
}

Header read_header(std::ifstream& in, const std::filesystem::path& path, uint64_t file_size) {
    Header header{};
    if (file_size < sizeof header || !in.read(reinterpret_cast<char*>(&header), sizeof header))
        refuse(path, "too short for a photon map");
    if (header.magic != magic) throw Error(path.string() + ": not a Lumenwalk photon map");
    if (header.version != version || header.sections != section_count)
        refuse(path, "written by another version (" + std::to_string(header.version) + ", this program reads " +
                         std::to_string(version) + ")");
    uint64_t left = file_size - sizeof header;
    for (uint64_t bytes : header.bytes) {
        if (bytes > left) refuse(path, "it is cut short or its section sizes are wrong");
        left -= bytes;
    }
    if (left) refuse(path, "it has bytes after its last section");
    if (!(header.radius > 0) || !is_place(header.radius) || !is_scale(header.flux_scale) ||
        !is_scale(header.irradiance_scale))
        refuse(path, "its radius, flux scale or irradiance scale is not valid");
    if (!(header.neighbour_angle_deg >= 0 && header.neighbour_angle_deg <= 90) || header.direct_in_photons > 1)
        refuse(path, "its settings are not valid");
    return header;
}

/// Checks that shadow masks are in the order of cells and lamps, that these exist, and that the map has visibility
/// bits.
void check_masks(const std::filesystem::path& path, const PhotonMap& map, const Scene& scene) {
    if (map.shadow_masks.size() >= 1u << (32 - first_mask_shift) ||
        (!map.shadow_masks.empty() && !map.has_visible_lamps()))
        refuse(path, "it has more shadow masks than it may");
    for (size_t i = 0; i < map.shadow_masks.size(); ++i) {
        const ShadowMask& mask = map.shadow_masks[i];
        const auto before = [](const ShadowMask& a, const ShadowMask& b) {
            return a.cell < b.cell || (a.cell == b.cell && a.lamp < b.lamp);
        };
        if (mask.cell >= map.coverage.size() || mask.lamp >= scene.lights.size() ||
            scene.lights[mask.lamp].type == light_mesh || (i > 0 && !before(map.shadow_masks[i - 1], mask)))
            refuse(path, "shadow mask " + std::to_string(i) + " is not valid");
    }
}

}  // namespace

void save_photon_map(const std::filesystem::path& path, const PhotonMap& map) {
    Header header{magic,
                  version,
                  section_count,
                  0,
                  map.scene_hash,
                  map.settings.photons,
                  map.stored_photons,
                  map.settings.seed,
                  map.settings.radius,
                  map.settings.neighbour_angle_deg,
                  map.flux_scale,
                  map.settings.direct_in_photons,
                  map.irradiance_scale,
                  map.caustic_grids,
                  {}};
    size_t s = 0;
    for_each_section(map, [&](const auto& section) { header.bytes[s++] = byte_size(section); });
    header.checksum = checksum_of(header, map);

    ReplacedFile file(path);
    file.stream().write(reinterpret_cast<const char*>(&header), sizeof header);
    for_each_section(map, [&](const auto& section) {
        file.stream().write(reinterpret_cast<const char*>(section.data()), std::streamsize(byte_size(section)));
    });
    file.commit();
}

PhotonMap load_photon_map(const std::filesystem::path& path, const Scene& scene) {
    std::error_code failure;
    const uint64_t file_size = std::filesystem::file_size(path, failure);
    std::ifstream in = open_input(path);
    if (failure || !in) throw Error(path.string() + ": no photon map here; make one with lumenwalk-bake");
    const Header header = read_header(in, path, file_size);
    if (header.scene_hash != scene.content_hash)
        throw Error(path.string() + ": the scene " + scene.path.filename().string() +
                    " has changed since this map was baked, or the map is of another scene; bake it again");

    constexpr uint64_t always_there = uint64_t(256) << 20;  // bytes read without a look at the available memory
    if (file_size > always_there && file_size > available_memory())
        throw Error(path.string() + ": the map takes " + bytes_text(file_size) + " of memory, there are " +
                    bytes_text(available_memory()));

    PhotonMap map;
    map.scene_hash = header.scene_hash;
    map.settings = {header.photons_wanted, header.radius, header.neighbour_angle_deg, header.seed,
                    header.direct_in_photons != 0};
    map.stored_photons = header.photons_stored;
    map.flux_scale = header.flux_scale;
    map.irradiance_scale = header.irradiance_scale;
    map.caustic_grids = header.caustic_grids;
    size_t s = 0;
    for_each_section(map, [&](auto& section) {
        const uint64_t bytes = header.bytes[s++];
        if (bytes % sizeof(section[0]))
            refuse(path, "section " + std::to_string(s) + " is not a whole number of records");
        section.resize(bytes / sizeof(section[0]));
        if (!in.read(reinterpret_cast<char*>(section.data()), std::streamsize(bytes)))
            refuse(path, "it could not be read to its end");
    });
    if (checksum_of(header, map) != header.checksum)
        refuse(path, "the map file has changed since it was written (checksum)");
    check_indices(path, map, scene);
    check_lattices(path, map);
    if (map.has_visible_lamps() &&
        map.visible_lamps.size() != map.coverage.size() * visibility_words(uint(scene.lights.size())))
        refuse(path, "lattices and lamp visibility do not agree");
    if (!map.irradiance.accept(map.coverage.size() * scene.lights.size()))
        refuse(path, "lattices and irradiance do not agree");
    const size_t marks = map.caustic_grids > 0 && map.has_visible_lamps() ? (map.coverage.size() + 31) / 32 : 0;
    if (map.smooth_caustics.size() != marks) refuse(path, "lattices and marks of caustics do not agree");
    check_masks(path, map, scene);
    return map;
}

std::filesystem::path default_map_path(const std::filesystem::path& scene) {
    std::filesystem::path path = scene;
    return path.replace_extension(".pmap");
}

}  // namespace lw
