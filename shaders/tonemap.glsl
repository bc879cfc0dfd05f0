// From luminance to a screen, one text for C++ and GLSL: exposure, tone curve, sRGB encoding.
// In: linear Rec.709 RGB in cd/m2. Out: display values in [0, 1], to be written with 8 bits and no further encoding.
// Exposure: Lagarde & de Rousiers 2014, "Moving Frostbite to PBR", section 5.1. Curve: Khronos PBR Neutral (2024),
// which keeps the hue and is the identity, less a small Fresnel offset, below 0.8. Encoding: IEC 61966-2-1.
#ifndef LW_TONEMAP_GLSL
#define LW_TONEMAP_GLSL
#include "types.h"
#ifdef __cplusplus
namespace lw {
#endif

/// Factor from cd/m2 to exposed values at EV100 `ev`: a camera that clips at 1.2 * 2^ev cd/m2.
LW_INLINE float exposure_scale(float ev) { return 1.0f / (1.2f * pow(2.0f, ev)); }

/// Exposed linear RGB >= 0 to display-linear RGB in [0, 1]: highlights above 0.8 roll off towards white.
LW_INLINE vec3 tone_curve(vec3 c) {
    float start = 0.8f - 0.04f;
    float least = min(c.x, min(c.y, c.z));
    vec3 toned = c - vec3(least < 0.08f ? least - 6.25f * least * least : 0.04f);
    float peak = max(toned.x, max(toned.y, toned.z));
    if (peak < start) return toned;
    float room = 1.0f - start;
    float new_peak = 1.0f - room * room / (peak + room - start);
    float whiteness = 1.0f - 1.0f / (0.15f * (peak - new_peak) + 1.0f);
    return mix(toned * (new_peak / peak), vec3(new_peak), whiteness);
}

/// One display-linear value in [0, 1] to its sRGB code in [0, 1]. The power 1/2.4 by square roots, three times as fast
/// where there is no unit for powers: least largest error 2.1e-6, half a thousandth of an 8-bit code, none at the ends.
LW_INLINE float encode_srgb_value(float v) {
    float fourth = sqrt(sqrt(v));
    float eighth = sqrt(fourth);
    float power = eighth * (0.78009713f - 0.05768299f * fourth) + 0.40110015f * fourth - 0.06987200f;
    return v <= 0.0031308f ? 12.92f * v : fourth * power - 0.05364231f;
}

/// Display-linear RGB, clamped to [0, 1], to sRGB codes in [0, 1].
LW_INLINE vec3 encode_srgb(vec3 c) {
    vec3 v = clamp(c, vec3(0.0f), vec3(1.0f));
    return vec3(encode_srgb_value(v.x), encode_srgb_value(v.y), encode_srgb_value(v.z));
}

#ifdef __cplusplus
}  // namespace lw
#endif
#endif
