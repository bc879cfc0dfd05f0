// Copies pictures to the clipboard. GLFW copies text only, so a program of the desktop does it: wl-copy under Wayland,
// xclip under X11. Either keeps the picture after lumenwalk has ended.
#pragma once
#include "image/rgb8_image.h"

namespace lw {

/// Copies a picture. Throws Error when the program is missing, saying what to install, or when it fails.
void copy_to_clipboard(const Rgb8Image& image);

}  // namespace lw
