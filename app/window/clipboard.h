// Pictures on the clipboard. GLFW has none, so that the desktop's own program is asked: wl-copy under Wayland, xclip
// under X11; either keeps the picture after lumenwalk has ended.
#pragma once
#include "image/rgb8_image.h"

namespace lw {

/// Throws Error saying what to install when neither program is there, or that it refuses.
void copy_to_clipboard(const Rgb8Image& image);

}  // namespace lw
