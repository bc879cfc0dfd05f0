#include "image/tonemap.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/parallel.h"

namespace lw {
namespace {

constexpr float brightest = 1e9f;  // beyond the sun's disk; keeps infinities out of the curve

const std::vector<float>& samples(const Image& image, const char* name) {
    const Channel* channel = image.find(name);
    if (!channel) throw Error(std::string("picture has no channel \"") + name + "\"");
    return channel->values;
}

bool is_number(const vec3& v) { return !std::isnan(v.x) && !std::isnan(v.y) && !std::isnan(v.z); }

}  // namespace

std::vector<vec3> rgb_pixels(const Image& image) {
    const std::vector<float>&r = samples(image, "R"), &g = samples(image, "G"), &b = samples(image, "B");
    std::vector<vec3> pixels(image.pixel_count());
    for (size_t i = 0; i < pixels.size(); ++i) pixels[i] = vec3(r[i], g[i], b[i]);
    return pixels;
}

vec3 tone_map_pixel(const vec3& rgb_cd_m2, float exposure_ev) {
    vec3 exposed = clamp(rgb_cd_m2, vec3(0.0f), vec3(brightest)) * exposure_scale(exposure_ev);
    return tone_curve(exposed);
}

Rgb8Image tonemap(const Image& image, float exposure_ev) {
    std::vector<vec3> pixels = rgb_pixels(image);
    Rgb8Image result{image.width, image.height, std::vector<uint8_t>(3 * pixels.size())};
    auto convert = [&](size_t i) {
        vec3 codes = is_number(pixels[i]) ? encode_srgb(tone_map_pixel(pixels[i], exposure_ev)) : vec3(1, 0, 1);
        for (int c = 0; c < 3; ++c) result.rgb[3 * i + size_t(c)] = uint8_t(codes[c] * 255.0f + 0.5f);
    };
    parallel_for(pixels.size(), convert, 4096);
    return result;
}

float auto_exposure_ev(const Image& image) {
    std::vector<float> luminances;
    for (const vec3& rgb : rgb_pixels(image)) luminances.push_back(luminance(rgb));
    return auto_exposure_ev(std::move(luminances));
}

float auto_exposure_ev(std::vector<float> luminances) {
    std::erase_if(luminances, [](float l) { return !(l > 1e-6f && l <= brightest); });
    std::sort(luminances.begin(), luminances.end());
    if (luminances.empty()) return 0.0f;
    size_t first = luminances.size() / 20, last = luminances.size() - first;
    double log_sum = 0;
    for (size_t i = first; i < last; ++i) log_sum += std::log2(luminances[i]);
    double average_ev = log_sum / double(last - first) - std::log2(0.2 * 1.2);
    double highlight_ev = std::log2(luminances[luminances.size() * 9 / 10]) - std::log2(1.2 * 1.2);
    return float(std::max(average_ev, highlight_ev));
}

}  // namespace lw
