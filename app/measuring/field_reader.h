// Reads the sensors of calculation grids on a thread of its own, one grid after the other, while the user walks on.
#pragma once
#include <atomic>
#include <memory>
#include <thread>

#include "app/measuring/fields.h"
#include "base/progress.h"

namespace lw {

class FieldReader {
  public:
    /// Scene and caster must outlive it.
    FieldReader(const Scene& scene, const RayCaster& caster) : scene_(scene), caster_(caster) {}
    /// Cancels what is being read and waits for the thread.
    ~FieldReader();
    FieldReader(const FieldReader&) = delete;
    FieldReader& operator=(const FieldReader&) = delete;

    /// Gives finished readings to their field and starts to read the next field that has no readings from `map`.
    /// Returns true when readings have come in. Throws Error when reading failed.
    bool follow(Fields& fields, const std::shared_ptr<const PhotonMap>& map);
    /// The name of the field that is read and how much of it is done, 0 to 1; nothing when none is read.
    std::optional<ProgressBoard::State> progress() const;

  private:
    void begin(const Field& field, const std::shared_ptr<const PhotonMap>& map);
    bool finish(Fields& fields);

    const Scene& scene_;
    const RayCaster& caster_;
    std::shared_ptr<const PhotonMap> map_, reads_;  // the newest; the one that is being read
    uint id_ = 0;                                   // of the field at work
    std::unique_ptr<ProgressBoard> board_;
    std::vector<Reading> readings_;
    std::string failure_;
    std::atomic<bool> done_{false};
    std::thread thread_;
};

}  // namespace lw
