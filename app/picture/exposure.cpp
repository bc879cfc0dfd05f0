#include "app/picture/exposure.h"

#include <algorithm>
#include <cmath>

#include "image/tonemap.h"

namespace lw {
namespace {

constexpr float adapts_per_second = 3;

float rounded_up(float value) {
    if (!(value > 0)) return 0;
    const float power = std::pow(10.0f, std::floor(std::log10(value)));
    for (float step : {1.0f, 2.0f, 5.0f})
        if (value <= step * power * 1.0001f) return step * power;
    return 10 * power;
}

float rounded_down(float value) {
    if (!(value > 0)) return 0;
    const float power = std::pow(10.0f, std::floor(std::log10(value) + 1e-4f));
    for (float step : {5.0f, 2.0f})
        if (value >= step * power * 0.9999f) return step * power;
    return power;
}

}  // namespace

vec2 range_of(std::vector<float> values, uint view, bool logarithmic) {
    std::erase_if(values, [](float v) { return !std::isfinite(v); });
    if (values.empty()) return {0, 1};
    if (is_signed_view(view))
        for (float& v : values) v = std::abs(v);
    std::sort(values.begin(), values.end());
    const auto percentile = [&](size_t p) { return values[std::min(values.size() - 1, values.size() * p / 100)]; };
    float top = percentile(98);
    const float ordinary = percentile(is_signed_view(view) ? 90 : 50);
    if (ordinary > 0 && !(logarithmic && !is_signed_view(view))) top = std::min(top, 3.5f * ordinary);
    const float high = std::max(rounded_up(top), 1e-3f);
    if (is_signed_view(view)) return {-high, high};
    return {logarithmic ? std::max(rounded_down(percentile(2)), 1e-4f * high) : 0.0f, high};
}

void adapt_to(Viewing& v, const std::vector<ReadbackPixel>& readback, float seconds) {
    std::vector<float> luminances, values;
    for (const ReadbackPixel& g : readback) {
        luminances.push_back(g.luminance);
        if (g.seen > 0) values.push_back(g.value);
    }
    if (values.empty()) return;  // no picture has been read back yet
    if (v.auto_exposure) {
        const float wanted = auto_exposure_ev(std::move(luminances)), change = wanted - v.exposure_ev;
        const bool jumps = std::abs(change) > 4;  // after darkness, or in the first picture
        v.exposure_ev += jumps ? change : change * (1 - std::exp(-adapts_per_second * seconds));
    }
    if (!v.auto_range) return;
    const vec2 range = range_of(std::move(values), v.view, v.logarithmic);
    v.low = range.x, v.high = range.y;
}

std::optional<vec2> spread_of(const std::vector<ReadbackPixel>& readback) {
    std::vector<float> values;
    for (const ReadbackPixel& g : readback)
        if (g.seen > 0 && std::isfinite(g.value)) values.push_back(g.value);
    if (values.empty()) return std::nullopt;
    std::sort(values.begin(), values.end());
    return vec2(values[values.size() / 2], values[values.size() * 95 / 100]);
}

uint DynamicResolution::next(uint wanted, const RendererTimes& last, bool still) {
    if (wanted > 0) return wanted;
    if (last.drew && last.rows == 0) {
        fixed_ms_ = last.visibility_ms + last.view_ms;
        light_ms_ = last.gather_ms * last.divisor * last.divisor;
    }
    // A frame that takes a little too long does not make pixels larger, least of all in motion.
    const double max_ms = (still ? 1.1 : 1.25) * wanted_frame_ms;
    uint needed = 1;
    while (needed < max_divisor && fixed_ms_ + light_ms_ / (needed * needed) > max_ms) ++needed;
    now_ = still ? needed : std::max(now_, needed);
    return now_;
}

}  // namespace lw
