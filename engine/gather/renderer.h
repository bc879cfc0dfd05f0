// Renders views of a resident scene: visibility, gather and tone mapping in order, then reads the pixels back.
#pragma once
#include <memory>
#include <optional>

#include "gather/gather_pass.h"
#include "gather/tonemap_pass.h"
#include "gather/visibility_pass.h"
#include "image/image.h"
#include "image/rgb8_image.h"

namespace lw {

struct RenderSettings {
    GatherSettings gather{};
    std::optional<float> exposure_ev{};  // EV100; nothing: from the picture
    uint samples = 1;                    // jittered views averaged per pixel; at most, when an error is given
    uint frames = 1;                     // how often the picture is made, to measure times
    bool centred = false;                // all samples go through the pixels' centres, as those of a reference
    float error = 0;                     // ends once Rendering::error is below it; 0: all samples
    bool shows_progress = false;         // on stderr, of the samples
};

/// Medians over the frames, from GPU timestamps.
struct PassTimes {
    double visibility_ms = 0;
    double gather_ms = 0;
    double tonemap_ms = 0;
};

struct Rendering {
    Image image;  // R, G, B cd/m2; illuminance lx; depth m along -Z, 0: nothing seen; normal.X .Y .Z; triangle or -1
    Rgb8Image screen;
    float exposure_ev = 0;
    PassTimes times;
    uint samples = 0;  // that were averaged
    /// The standard error of a pixel's luminance, RMS over the picture in parts of its mean: what the second half of
    /// the samples changed. Nothing below 16 samples.
    std::optional<float> error;
};

class Renderer {
  public:
    /// Device and resident scene must outlive it. Throws Error when the size is beyond the device. width, height > 0.
    Renderer(const Device& device, const Resident& resident, uint width, uint height);
    /// Renders a picture and waits for it. Throws Error when the exact mode is asked for too many neighbours.
    Rendering render(const Camera& camera, const RenderSettings& settings);
    /// The visibility of the last sample of the last render.
    std::vector<VisibleSample> visible_samples() const { return visibility_.read_samples(); }

  private:
    void choose_gather(GatherSettings settings);
    PassTimes render_frame(const Camera& camera, const RenderSettings& settings, Rendering& result) const;
    std::vector<float> read_luminance(float scale) const;
    double render_screen(float exposure_ev) const;
    Rgb8Image read_screen() const;

    const Device* device_;
    const Resident* resident_;
    uint width_, height_;
    VisibilityPass visibility_;
    Picture picture_;
    TonemapPass tonemap_;
    GatherSettings gather_settings_;
    std::unique_ptr<GatherPass> gather_;
};

/// A picture of `size` pixels as an image with the channels of Rendering::image. Waits for the device. `visible`: what
/// its pixels see.
Image read_picture(const Device& device, const Scene& scene, const Camera& camera, const Picture& picture,
                   vk::Extent2D size, const std::vector<VisibleSample>& visible);

/// The push constants of sample `index` of `count` of a view. The samples are spread inside the pixel when count > 1.
Frame make_frame(const Camera& camera, vk::Extent2D size, uint index, uint count);

}  // namespace lw
