#include "image/compare.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "image/flip.h"
#include "image/tonemap.h"

namespace lw {
namespace {

/// A picture prepared for both kinds of measure. When a single channel is compared, `colour` holds it three times.
struct Pixels {
    Image colour;               // channels R, G, B
    std::vector<float> values;  // luminance, or the channel
};

std::string size_text(const Image& image) { return std::to_string(image.width) + "x" + std::to_string(image.height); }

void check_finite(const Image& image, const Channel& channel, const std::string& role) {
    for (size_t i = 0; i < channel.values.size(); ++i) {
        if (std::isfinite(channel.values[i])) continue;
        size_t width = size_t(image.width);
        throw Error(role + ": channel \"" + channel.name + "\": pixel (" + std::to_string(i % width) + ", " +
                    std::to_string(i / width) + ") is not finite");
    }
}

const Channel& checked_channel(const Image& image, const std::string& name, const std::string& role) {
    const Channel* channel = image.find(name);
    if (!channel) throw Error(role + ": has no channel \"" + name + "\"");
    check_finite(image, *channel, role);
    return *channel;
}

Pixels take_pixels(const Image& image, const std::string& channel, const std::string& role) {
    Pixels pixels;
    pixels.colour.width = image.width;
    pixels.colour.height = image.height;
    for (const char* name : {"R", "G", "B"})
        pixels.colour.add(name) = checked_channel(image, channel.empty() ? name : channel, role).values;
    if (channel.empty()) {
        for (const vec3& rgb : rgb_pixels(pixels.colour)) pixels.values.push_back(luminance(rgb));
    } else {
        pixels.values = pixels.colour.channels[0].values;
    }
    return pixels;
}

double mean(const std::vector<float>& values) {
    double sum = 0;
    for (float v : values) sum += double(v);
    return sum / double(values.size());
}

/// Both pictures, after the check that they can be compared, and the mean of the reference.
struct Pair {
    Pixels picture, reference;
    double mean;
};

Pair take_pair(const Image& picture, const Image& reference, const std::string& channel) {
    if (picture.width != reference.width || picture.height != reference.height)
        throw Error("picture is " + size_text(picture) + ", reference is " + size_text(reference));
    Pair pair{take_pixels(picture, channel, "picture"), take_pixels(reference, channel, "reference"), 0};
    pair.mean = mean(pair.reference.values);
    if (!(pair.mean > 0)) throw Error("reference: is black on average, nothing can be relative to it");
    return pair;
}

/// Mean over the 8x8 pixels from (x-4, y-4) to (x+3, y+3) that lie inside, by a summed-area table.
std::vector<float> blur_8x8(const std::vector<float>& values, int width, int height) {
    size_t stride = size_t(width) + 1;
    std::vector<double> sums(stride * (size_t(height) + 1));
    for (size_t y = 0; y < size_t(height); ++y)
        for (size_t x = 0; x < size_t(width); ++x)
            sums[(y + 1) * stride + x + 1] = double(values[y * size_t(width) + x]) + sums[y * stride + x + 1] +
                                             sums[(y + 1) * stride + x] - sums[y * stride + x];
    std::vector<float> result(values.size());
    for (int y = 0; y < height; ++y) {
        size_t y0 = size_t(std::max(y - 4, 0)), y1 = size_t(std::min(y + 4, height));
        for (int x = 0; x < width; ++x) {
            size_t x0 = size_t(std::max(x - 4, 0)), x1 = size_t(std::min(x + 4, width));
            double sum =
                sums[y1 * stride + x1] - sums[y0 * stride + x1] - sums[y1 * stride + x0] + sums[y0 * stride + x0];
            result[size_t(y) * size_t(width) + size_t(x)] = float(sum / double((x1 - x0) * (y1 - y0)));
        }
    }
    return result;
}

double blurred_p95(const Pair& pair) {
    int width = pair.reference.colour.width, height = pair.reference.colour.height;
    std::vector<float> a = blur_8x8(pair.picture.values, width, height);
    std::vector<float> r = blur_8x8(pair.reference.values, width, height);
    std::vector<double> errors(a.size());  // the ratio of two floats may be too large for a float
    for (size_t i = 0; i < a.size(); ++i)
        errors[i] = std::abs(double(a[i]) - double(r[i])) / std::max(double(r[i]), 0.01 * pair.mean);
    auto rank = errors.begin() + std::ptrdiff_t(double(errors.size() - 1) * 0.95);
    std::nth_element(errors.begin(), rank, errors.end());
    return *rank;
}

std::vector<vec3> display_pixels(const Image& colour, float ev) {
    std::vector<vec3> pixels = rgb_pixels(colour);
    for (vec3& p : pixels) p = tone_map_pixel(p, ev);
    return pixels;
}

double mean_flip(const Pair& pair, float ev) {
    const Image &a = pair.picture.colour, &r = pair.reference.colour;
    return mean(flip(display_pixels(a, ev), display_pixels(r, ev), r.width, r.height));
}

/// Red above, blue below, from black at 0 to full colour at +-1.
void paint(float signed_error, uint8_t* rgb) {
    float strength = std::min(1.0f, std::abs(signed_error));
    auto full = uint8_t(255 * strength), part = uint8_t(90 * strength);
    rgb[0] = signed_error > 0 ? full : 0;
    rgb[1] = part;
    rgb[2] = signed_error > 0 ? 0 : full;
}

}  // namespace

Comparison compare(const Image& picture, const Image& reference, const std::string& channel) {
    Pair pair = take_pair(picture, reference, channel);
    double squared = 0, relative = 0, least = 0.1 * pair.mean;
    for (size_t i = 0; i < pair.reference.values.size(); ++i) {
        double r = double(pair.reference.values[i]), d = double(pair.picture.values[i]) - r;
        squared += d * d;
        relative += d * d / (r * r + least * least);
    }
    double count = double(pair.reference.values.size());
    Comparison c;
    c.reference_mean = pair.mean;
    c.mean_ratio = mean(pair.picture.values) / pair.mean;
    c.bias = c.mean_ratio - 1;
    c.rmse_relative = std::sqrt(squared / count) / pair.mean;
    c.rel_mse = relative / count;
    c.p95_relative_error = blurred_p95(pair);
    c.exposure_ev = auto_exposure_ev(pair.reference.colour);
    c.flip = mean_flip(pair, c.exposure_ev);
    return c;
}

Rgb8Image difference_picture(const Image& picture, const Image& reference, const std::string& channel) {
    Pair pair = take_pair(picture, reference, channel);
    Rgb8Image result{reference.width, reference.height, std::vector<uint8_t>(3 * reference.pixel_count())};
    float least = float(0.05 * pair.mean);
    for (size_t i = 0; i < reference.pixel_count(); ++i) {
        float r = pair.reference.values[i];
        paint((pair.picture.values[i] - r) / (0.2f * std::max(r, least)), &result.rgb[3 * i]);
    }
    return result;
}

}  // namespace lw
