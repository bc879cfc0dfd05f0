// The views of the walkthrough, shared by C++ and GLSL: what is shown of a picture, push constants, false colours.
#ifndef LW_VIEW_H
#define LW_VIEW_H
#include "bindings.h"
#include "color.h"
#include "tonemap.glsl"
#include "types.h"
#ifdef __cplusplus
namespace lw {
#endif

LW_CONST uint view_shaded = 0u;
LW_CONST uint view_illuminance = 1u;          // lx
LW_CONST uint view_luminance = 2u;            // cd/m2
LW_CONST uint view_difference = 3u;           // lx, B - A
LW_CONST uint view_relative_difference = 4u;  // %, (B - A) / A
LW_CONST uint view_photons = 5u;              // the photons themselves, in a colour for each lamp
LW_CONST uint view_photon_count = 6u;         // photons per estimate
LW_CONST uint view_bandwidth = 7u;            // cm
LW_CONST uint view_error = 8u;                // %, estimated standard error of the illuminance
LW_CONST uint view_count = 9u;

LW_CONST uint curve_neutral = 0u;  // Khronos PBR Neutral
LW_CONST uint curve_linear = 1u;   // clipped at white
LW_CONST uint curve_soft = 2u;     // x / (1 + x) on the luminance (Reinhard et al. 2002)
LW_CONST uint curve_count = 3u;

/// The size of a coarse grid of pixels whose values the CPU reads back each frame, for exposure and ranges.
LW_CONST uint readback_columns = 64u;
LW_CONST uint readback_rows = 36u;

struct ReadbackPixel {
    float luminance;    // cd/m2, of A, or of B right of the split
    float illuminance;  // lx, likewise
    float value;        // the value that the view shows in false colours
    float seen;         // 1: the pixel shows a surface; 0: none
};

/// Push constants of the view pass.
struct ViewPush {
    uvec2 screen;
    uvec2 picture;      // size in pixels; may be smaller than the screen in motion
    float scale_light;  // 1 / samples summed
    float scale_fresh;  // the same in the first fresh_rows of the picture, which have one sample more
    uint fresh_rows;
    float exposure_ev;
    float low;  // ends of the range of the false colours
    float high;
    uint logarithmic;
    uint lines;   // number of isolux lines over the range; 0: none
    float split;  // A is shown left of this part of the width, B right of it; 1: A alone
    uint bgr;     // 1: blue in the low byte
};

/// Applies a tone curve to exposed RGB >= 0; returns a display-linear colour.
LW_INLINE vec3 apply_curve(vec3 exposed, uint curve) {
    if (curve == curve_linear) return min(exposed, vec3(1.0f));
    if (curve == curve_neutral) return tone_curve(exposed);
    return min(exposed * (1.0f / (1.0f + luminance(exposed))), vec3(1.0f));
}

/// sRGB colour of t in [0, 1], dark blue over green to red: "Turbo", fit of Mikhailov (2019), rises in lightness to the
/// middle.
LW_INLINE vec3 false_color(float t) {
    float x = clamp(t, 0.0f, 1.0f);
    float x2 = x * x;
    float x3 = x2 * x;
    float x4 = x2 * x2;
    float x5 = x4 * x;
    float r =
        0.13572138f + 4.61539260f * x - 42.66032258f * x2 + 132.13108234f * x3 - 152.94239396f * x4 + 59.28637943f * x5;
    float g =
        0.09140261f + 2.19418839f * x + 4.84296658f * x2 - 14.18503333f * x3 + 4.27729857f * x4 + 2.82956604f * x5;
    float b =
        0.10667330f + 12.64194608f * x - 60.58204836f * x2 + 110.36276771f * x3 - 89.90310912f * x4 + 27.34824973f * x5;
    return clamp(vec3(r, g, b), vec3(0.0f), vec3(1.0f));
}

/// sRGB colour of a signed value: blue at t = 0, light grey at 1/2, red at 1.
LW_INLINE vec3 signed_color(float t) {
    float x = clamp(t, 0.0f, 1.0f);
    vec3 middle = vec3(0.93f);
    if (x < 0.5f) return mix(vec3(0.13f, 0.33f, 0.74f), middle, 2.0f * x);
    return mix(middle, vec3(0.76f, 0.13f, 0.16f), 2.0f * x - 1.0f);
}

/// sRGB colour of lamp i: hues by the golden angle.
LW_INLINE vec3 lamp_color(uint i) {
    float h = fract(0.13f + float(i) * 0.61803399f) * 6.0f;
    vec3 hue = clamp(vec3(abs(h - 3.0f) - 1.0f, 2.0f - abs(h - 2.0f), 2.0f - abs(h - 4.0f)), vec3(0.0f), vec3(1.0f));
    return mix(vec3(1.0f), hue, 0.75f);
}

LW_INLINE bool is_signed_view(uint view) { return view == view_difference || view == view_relative_difference; }

LW_INLINE bool is_inspection(uint view) { return view >= view_photons && view <= view_error; }

/// Where `value` lies in the range from low (0) to high (1); not clamped.
LW_INLINE float place_in_range(float value, float low, float high, bool logarithmic) {
    if (!logarithmic) return (value - low) / max(high - low, 1e-20f);
    float floor_value = max(low, 1e-6f);
    return log(max(value, 1e-6f) / floor_value) / max(log(max(high, 1e-6f) / floor_value), 1e-6f);
}

/// The inverse of place_in_range().
LW_INLINE float value_in_range(float t, float low, float high, bool logarithmic) {
    if (!logarithmic) return low + t * (high - low);
    float floor_value = max(low, 1e-6f);
    return floor_value * pow(max(high, 1e-6f) / floor_value, t);
}

/// sRGB colour of a value in the false colours of a view.
LW_INLINE vec3 view_color(uint view, float value, float low, float high, bool logarithmic) {
    float t = place_in_range(value, low, high, logarithmic);
    return is_signed_view(view) ? signed_color(t) : false_color(t);
}

#ifdef __cplusplus
static_assert(sizeof(ReadbackPixel) == 16 && sizeof(ViewPush) == 56 && offsetof(ViewPush, bgr) == 52);
}  // namespace lw
#endif
#endif
