#include "app/measuring/field_reader.h"

#include <algorithm>

#include "base/error.h"

namespace lw {

FieldReader::~FieldReader() {
    if (!thread_.joinable()) return;
    board_->cancel();
    thread_.join();
}

bool FieldReader::follow(Fields& fields, const std::shared_ptr<const PhotonMap>& map) {
    if (!map) return false;
    if (map != map_) {
        map_ = map;
        for (Field& field : fields.fields) field.is_current = false;
    }
    if (thread_.joinable()) return done_ && finish(fields);
    const auto next =
        std::find_if(fields.fields.begin(), fields.fields.end(), [](const Field& f) { return !f.is_current; });
    if (next != fields.fields.end()) begin(*next, map);
    return false;
}

void FieldReader::begin(const Field& field, const std::shared_ptr<const PhotonMap>& map) {
    id_ = field.id;
    reads_ = map;
    board_ = std::make_unique<ProgressBoard>();
    board_->set("sensors", 0);
    failure_.clear();
    done_ = false;
    thread_ = std::thread([this, map, sensors = field.set.sensors] {
        const ProgressScope scope(*board_);
        try {
            readings_ = read_sensors(scene_, caster_, *map, sensors, {});
        } catch (const std::exception& failure) {
            failure_ = failure.what();
        }
        done_ = true;
    });
}

bool FieldReader::finish(Fields& fields) {
    thread_.join();
    const auto field =
        std::find_if(fields.fields.begin(), fields.fields.end(), [&](const Field& f) { return f.id == id_; });
    if (field == fields.fields.end()) return false;  // taken away meanwhile
    field->is_current = reads_ == map_;
    if (!failure_.empty()) throw Error("grid \"" + field->request.name + "\": " + failure_);
    field->readings = std::move(readings_);
    return true;
}

std::optional<ProgressBoard::State> FieldReader::progress() const {
    return thread_.joinable() ? std::optional(board_->state()) : std::nullopt;
}

}  // namespace lw
