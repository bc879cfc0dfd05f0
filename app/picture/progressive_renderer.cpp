#include "app/picture/progressive_renderer.h"

#include "gather/renderer.h"

namespace lw {
namespace {

bool same_camera(const Camera& a, const Camera& b) {
    return a.position == b.position && a.rotation == b.rotation && a.yfov == b.yfov && a.near == b.near;
}

vk::Extent2D divided(vk::Extent2D size, uint divisor) {
    return {std::max(1u, size.width / divisor), std::max(1u, size.height / divisor)};
}

/// The push constants of sample `index` of a sum: the first through pixel centres, the next ones jittered. Each has
/// weight 1; the view pass divides by their number.
Frame frame_of_sample(const Camera& camera, vk::Extent2D size, uint index) {
    Frame frame = make_frame(camera, size, index, index == 0 ? 1 : 2);
    frame.sample_weight = 1;
    return frame;
}

ViewPush push_of(const DisplaySettings& display, vk::Extent2D screen, vk::Extent2D picture, uint samples,
                 uint fresh_rows) {
    ViewPush push{};
    push.screen = uvec2(screen.width, screen.height);
    push.picture = uvec2(picture.width, picture.height);
    push.scale_light = 1.0f / float(std::max(samples, 1u));
    push.scale_fresh = 1.0f / float(samples + 1);
    push.fresh_rows = fresh_rows;
    push.exposure_ev = display.exposure_ev;
    push.low = display.low;
    push.high = display.high;
    push.logarithmic = display.logarithmic;
    push.lines = display.lines;
    push.split = display.split;
    push.bgr = display.bgr;
    return push;
}

}  // namespace

ProgressiveRenderer::ProgressiveRenderer(const Device& device, const Scene& scene, std::shared_ptr<const PhotonMap> map,
                                         const Bvh& bvh)
    : device_(&device),
      map_(std::move(map)),
      resident_(device, scene, *map_, bvh),
      timestamps_{Timestamps(device, 4), Timestamps(device, 4)} {}

void ProgressiveRenderer::resize(vk::Extent2D size) {
    if (live_ && live_->size() == size) return;
    device_->handle().waitIdle();
    live_.reset();
    live_.emplace(*device_, resident_, size);
    drawn_.reset();
    timed_ = {};
    bands_ = {};
}

bool ProgressiveRenderer::shows(const FrameRequest& request, uint view) const {
    if (!drawn_) return false;
    const FrameRequest& d = drawn_->request;
    return same_camera(d.camera, request.camera) && d.factors_a == request.factors_a &&
           d.factors_b == request.factors_b && d.gather == request.gather &&
           is_inspection(view) == is_inspection(drawn_->inspected_view);
}

bool ProgressiveRenderer::is_finished(const FrameRequest& request) const {
    return drawn_ && shows(request, drawn_->inspected_view) && samples_ >= request.max_samples &&
           picture_size_ == live_->size();
}

void ProgressiveRenderer::record(vk::CommandBuffer commands, const FrameRequest& request,
                                 const DisplaySettings& display, uint slot) {
    const bool same = shows(request, display.kind.view);
    const bool sharpen = same && request.sharpens && picture_size_ != live_->size();
    const bool draws = !same || sharpen || samples_ < request.max_samples;
    if (!same || sharpen) {
        samples_ = fresh_rows_ = rows_at_once_ = 0;
        ms_per_row_ = 0;
        ++view_;
        picture_size_ = divided(live_->size(), sharpen ? 1 : request.divisor);
    }
    const Timestamps& times = timestamps_[slot];
    Band& band = bands_[slot];
    if (band.rows > 0 && band.view == view_) ms_per_row_ = times.intervals_ms()[1] / band.rows;
    band = {0, view_, draws};
    times.reset(commands);
    times.write(commands, 0);
    if (draws) {
        const Rows rows = next_rows(request);
        if (rows.first == 0)
            live_->record_visibility(commands, frame_of_sample(request.camera, picture_size_, samples_));
        times.write(commands, 1);
        record_lights(commands, request, display, rows);
        drawn_ = {request, display.kind.view};
        const bool whole = rows.end == picture_size_.height;
        samples_ += whole ? 1 : 0;
        fresh_rows_ = whole ? 0 : rows.end;
        if (samples_ > 1 || !whole) band.rows = rows_at_once_ = rows.end - rows.first;
    } else {
        times.write(commands, 1);
    }
    times.write(commands, 2);
    live_->record_view(commands, display.kind, push_of(display, live_->size(), picture_size_, samples_, fresh_rows_),
                       slot);
    times.write(commands, 3);
    views_[slot] = display.kind.view;
    timed_[slot] = std::max(1u, live_->size().width / picture_size_.width);
}

/// The rows of the next sample that a frame adds: all for the first sample of a view, else as many as take
/// request.max_ms.
Rows ProgressiveRenderer::next_rows(const FrameRequest& request) const {
    const uint height = picture_size_.height;
    if (!(request.max_ms > 0) || samples_ == 0 || picture_size_ != live_->size()) return {0, height};
    double rows = rows_at_once_ > 0 ? rows_at_once_ : height / 16.0;
    if (ms_per_row_ > 0) rows = std::min(request.max_ms / ms_per_row_, 2 * rows);  // the next rows may cost more
    const uint groups = std::max(1u, uint(rows) / gather_group_side);
    return {fresh_rows_, std::min(height, fresh_rows_ + groups * gather_group_side)};
}

void ProgressiveRenderer::record_lights(vk::CommandBuffer commands, const FrameRequest& request,
                                        const DisplaySettings& display, Rows rows) {
    using Side = FrameRenderer::Side;
    constexpr uint factors_a = 0, factors_b = 1;
    const bool stands_still = samples_ > 0;  // then all lamps are summed anew, once
    resident_.record_lamp_factors(commands, request.factors_a, factors_a, stands_still);
    const Frame frame = frame_of_sample(request.camera, picture_size_, samples_);
    live_->record_light(commands, frame, request.gather, Side::a, factors_a, rows);
    if (is_inspection(display.kind.view)) {
        if (samples_ > 0) return;
        GatherSettings inspect = request.gather;
        inspect.mode = gather_mode_inspect;
        live_->record_light(commands, frame, inspect, Side::b, factors_a);
    } else if (!request.factors_b.empty()) {
        resident_.record_lamp_factors(commands, request.factors_b, factors_b, stands_still);
        live_->record_light(commands, frame, request.gather, Side::b, factors_b, rows);
    }
}

std::vector<ReadbackPixel> ProgressiveRenderer::readback(uint slot, uint view) const {
    return timed_[slot] && views_[slot] == view ? live_->readback(slot) : std::vector<ReadbackPixel>();
}

std::vector<ReadbackPixel> ProgressiveRenderer::inspect(const FrameRequest& request, uint view, uint slot) {
    GatherSettings inspect = request.gather;
    inspect.mode = gather_mode_inspect;
    DisplaySettings display;
    display.kind.view = view;
    submit_and_wait(*device_, [&](vk::CommandBuffer commands) {
        live_->record_light(commands, frame_of_sample(request.camera, picture_size_, 0), inspect,
                            FrameRenderer::Side::b);
        live_->record_view(commands, display.kind,
                           push_of(display, live_->size(), picture_size_, samples_, fresh_rows_), slot);
    });
    return live_->readback(slot);
}

RendererTimes ProgressiveRenderer::times(uint slot) const {
    if (!timed_[slot]) return {};
    const std::vector<double> ms = timestamps_[slot].intervals_ms();
    return {ms[0], ms[1], ms[2], timed_[slot], bands_[slot].rows, bands_[slot].drew};
}

}  // namespace lw
