#include "file/map_file.h"

#include <array>
#include <fstream>
#include <system_error>

#include "base/error.h"
#include "base/input_file.h"
#include "base/memory.h"
#include "base/replaced_file.h"
#include "file/checksum.h"
#include "file/grid_records.h"
#include "file/map_checks.h"

namespace lw {
namespace {

constexpr std::array<char, 8> magic{'L', 'W', 'P', 'H', 'O', 'T', 'O', 'N'};
constexpr uint32_t version = 4;
constexpr size_t section_count = 15;

/// The header at the start of the file. The sections follow it in a fixed order; bytes[i] is the length of section i.
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
    uint32_t caustic_grids;  // the last of the grids and cuts; 0 in files of scenes without
    std::array<uint64_t, section_count> bytes;
};
static_assert(sizeof(Header) == 200);
constexpr size_t checked_from = offsetof(Header, scene_hash);

/// Calls visit(array) for the sections in file order. Map and Records are PhotonMap and GridRecords, both const to
/// write.
template <class Map, class Records, class Visit>
void for_each_section(Map& map, Records& records, const Visit& visit) {
    visit(map.emitted);
    visit(records.of_side);
    visit(map.caustic_sides.marks);
    visit(records.caustic_sides);
    visit(records.records);
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

uint64_t checksum_of(const Header& header, const PhotonMap& map, const GridRecords& records) {
    Checksum sum;
    sum.add(reinterpret_cast<const char*>(&header) + checked_from, sizeof header - checked_from);
    for_each_section(map, records, [&](const auto& section) { sum.add(section.data(), byte_size(section)); });
    return sum.value();
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
    if (!(header.radius >= 0) || !is_place(header.radius) || !is_scale(header.flux_scale) ||
        !is_scale(header.irradiance_scale))
        refuse(path, "its radius, flux scale or irradiance scale is not valid");
    if (!(header.neighbour_angle_deg >= 0 && header.neighbour_angle_deg <= 90) || header.direct_in_photons > 1)
        refuse(path, "its settings are not valid");
    return header;
}

}  // namespace

void save_photon_map(const std::filesystem::path& path, const PhotonMap& map) {
    const GridRecords records = records_of(map);
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
                  records.of_caustics,
                  {}};
    size_t s = 0;
    for_each_section(map, records, [&](const auto& section) { header.bytes[s++] = byte_size(section); });
    header.checksum = checksum_of(header, map, records);

    ReplacedFile file(path);
    file.stream().write(reinterpret_cast<const char*>(&header), sizeof header);
    for_each_section(map, records, [&](const auto& section) {
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
    GridRecords records;
    records.of_caustics = header.caustic_grids;
    size_t s = 0;
    for_each_section(map, records, [&](auto& section) {
        const uint64_t bytes = header.bytes[s++];
        if (bytes % sizeof(section[0]))
            refuse(path, "section " + std::to_string(s) + " is not a whole number of records");
        section.resize(bytes / sizeof(section[0]));
        if (!in.read(reinterpret_cast<char*>(section.data()), std::streamsize(bytes)))
            refuse(path, "it could not be read to its end");
    });
    if (checksum_of(header, map, records) != header.checksum)
        refuse(path, "the map file has changed since it was written (checksum)");
    check_records(path, records, map, scene);
    take_records(std::move(records), map);
    check_map(path, map, scene);
    return map;
}

std::filesystem::path default_map_path(const std::filesystem::path& scene) {
    std::filesystem::path path = scene;
    return path.replace_extension(".pmap");
}

}  // namespace lw
