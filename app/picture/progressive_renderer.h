// A baked scene on the device and its picture at one size, frame by frame. While the view is still, samples add up. A
// second picture B may show other powers of the lamps.
#pragma once
#include <optional>

#include "gather/frame_renderer.h"

namespace lw {

/// How a picture is shown: views, exposure, ranges.
struct DisplaySettings {
    ViewKind kind;
    float exposure_ev = 7;
    float low = 0, high = 500;  // false colours
    bool logarithmic = false;
    uint lines = 0;      // isolux lines over the range
    float split = 0.5f;  // B is shown right of this part of the width
    bool bgr = false;    // byte order of the screen
};

/// What a picture shows: camera, lamps, quality. A change starts a new picture.
struct FrameRequest {
    Camera camera;
    std::vector<vec3> factors_a, factors_b;  // RGB factor per lamp of pictures A and B; b empty: no B
    GatherSettings gather;
    uint max_samples = 1;  // samples that add up while nothing changes
    uint divisor = 1;      // divides the picture's width and height while things change
    bool sharpens = true;  // full resolution once nothing changes
    double max_ms = 0;     // most gather time of a frame of a still picture, in bands of rows; 0: whole samples
};

/// Milliseconds of the passes of a frame, on the device's clock.
struct RendererTimes {
    double visibility_ms = 0, gather_ms = 0, view_ms = 0;
    uint divisor = 1;  // of the picture's width and height
    uint rows = 0;     // rows of a later sample that were added to a still picture; 0: the first sample, or none
    bool drew = false;
    double sum() const { return visibility_ms + gather_ms + view_ms; }
};

class ProgressiveRenderer {
  public:
    /// Device, scene and hierarchy must outlive it. Throws Error when the device has not enough memory.
    ProgressiveRenderer(const Device& device, const Scene& scene, std::shared_ptr<const PhotonMap> map, const Bvh& bvh);

    const PhotonMap& map() const { return *map_; }
    uint64_t bytes() const { return resident_.bytes(); }
    /// Throws Error when the size is beyond the device.
    void resize(vk::Extent2D size);

    /// Records a frame into the commands; `slot`, 0 or 1, is that of the frame in flight. Samples of equal requests add
    /// up.
    void record(vk::CommandBuffer commands, const FrameRequest& request, const DisplaySettings& display, uint slot);
    /// Makes the next frame start a new picture.
    void forget() { drawn_.reset(); }
    /// True when a frame of this request would add to the picture instead of starting a new one.
    bool shows(const FrameRequest& request, uint view) const;
    const Buffer& screen() const { return live_->screen(); }
    uint samples() const { return samples_; }
    /// True when more frames of this request would change nothing.
    bool is_finished(const FrameRequest& request) const;
    /// The readback of the last frame of a slot, whose commands must have finished; empty when it showed another view
    /// than `view`.
    std::vector<ReadbackPixel> readback(uint slot, uint view) const;
    /// Renders the inspecting view `view` of picture A, waits for it and returns its values. Uses the slot, so its next
    /// frame must be recorded after. Not allowed while B is shown.
    std::vector<ReadbackPixel> inspect(const FrameRequest& request, uint view, uint slot);
    /// Times of the last frame of a slot; its commands must have finished.
    RendererTimes times(uint slot) const;
    /// The values of picture A (channels as Rendering::image); waits for the device.
    Image read_values() const {
        return live_->read_values(drawn_ ? drawn_->request.camera : Camera(), picture_size_, std::max(samples_, 1u),
                                  fresh_rows_);
    }

  private:
    struct Drawn {  // what the samples added so far show
        FrameRequest request;
        uint inspected_view = view_shaded;
    };
    struct Band {       // what the last frame of a slot added
        uint rows = 0;  // as RendererTimes
        uint view = 0;
        bool drew = false;
    };
    Rows next_rows(const FrameRequest& request) const;
    void record_lights(vk::CommandBuffer commands, const FrameRequest& request, const DisplaySettings& display,
                       Rows rows);

    const Device* device_;
    std::shared_ptr<const PhotonMap> map_;
    Resident resident_;
    std::optional<FrameRenderer> live_;
    std::optional<Drawn> drawn_;
    vk::Extent2D picture_size_;
    uint samples_ = 0;       // complete samples in the picture
    uint fresh_rows_ = 0;    // rows, from the top, that have one sample more
    uint rows_at_once_ = 0;  // rows in the last band; 0: none yet
    double ms_per_row_ = 0;  // gather time per row of this still picture; 0: not known
    uint view_ = 0;          // number of pictures started so far
    std::array<Timestamps, 2> timestamps_;
    std::array<uint, 2> views_{};  // of each slot's frame
    std::array<uint, 2> timed_{};  // divisor of each slot's frame, 0: none yet
    std::array<Band, 2> bands_{};
};

}  // namespace lw
