#include "file/grid_records.h"

#include <algorithm>

namespace lw {
namespace {

SurfaceGrid record_of(const Cut& cut) {
    SurfaceGrid record{};
    record.origin = cut.point;
    record.normal = cut.normal;
    record.rows = cut.front;
    record.first_cell = cut.back;
    return record;
}

}  // namespace

GridRecords records_of(const PhotonMap& map) {
    const size_t grids = map.grids.size() - std::min<size_t>(map.caustic_grids, map.grids.size());
    const size_t cuts = map.cuts.size() - std::min<size_t>(map.caustic_cuts, map.cuts.size());
    const auto reference = [&](uint id) {
        if (id == no_grid) return id;
        const uint number = id & ~cut_bit;
        if (is_cut(id)) return uint(number + (number < cuts ? grids : map.grids.size()));
        return uint(number + (number < grids ? 0 : cuts));
    };
    GridRecords file;
    file.of_caustics = map.caustic_grids + map.caustic_cuts;
    file.of_side.reserve(map.grid_of_side.size());
    for (uint id : map.grid_of_side) file.of_side.push_back(reference(id));
    for (uint value : map.caustic_sides.values) file.caustic_sides.push_back(reference(value - 1) + 1);
    file.records.reserve(map.grids.size() + map.cuts.size());
    const auto append = [&](size_t first_grid, size_t last_grid, size_t first_cut, size_t last_cut) {
        file.records.insert(file.records.end(), map.grids.begin() + int64_t(first_grid),
                            map.grids.begin() + int64_t(last_grid));
        for (size_t c = first_cut; c < last_cut; ++c) {
            const Cut& cut = map.cuts[c];
            file.records.push_back(record_of({cut.point, reference(cut.front), cut.normal, reference(cut.back)}));
        }
    };
    append(0, grids, 0, cuts);
    append(grids, map.grids.size(), cuts, map.cuts.size());
    return file;
}

void take_records(GridRecords file, PhotonMap& map) {
    std::vector<uint> ids;  // of each record
    uint grids = 0, cuts = 0;
    for (const SurfaceGrid& record : file.records) ids.push_back(is_cut(record) ? cut_bit | cuts++ : grids++);
    const auto id_of = [&](uint reference) { return reference == no_grid ? no_grid : ids[reference]; };
    const auto first_of_caustics = file.records.end() - int64_t(file.of_caustics);
    map.caustic_cuts = uint(
        std::count_if(first_of_caustics, file.records.end(), [](const SurfaceGrid& record) { return is_cut(record); }));
    map.caustic_grids = file.of_caustics - map.caustic_cuts;
    for (uint& reference : file.of_side) reference = id_of(reference);
    for (uint& reference : file.caustic_sides) reference = id_of(reference - 1) + 1;
    map.cuts.reserve(cuts);
    for (const SurfaceGrid& record : file.records)
        if (is_cut(record))
            map.cuts.push_back({record.origin, id_of(record.rows), record.normal, id_of(record.first_cell)});
    std::erase_if(file.records, [](const SurfaceGrid& record) { return is_cut(record); });
    map.grids = std::move(file.records);
    map.grid_of_side = std::move(file.of_side);
    map.caustic_sides.values = std::move(file.caustic_sides);
}

}  // namespace lw
