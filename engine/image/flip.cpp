#include "image/flip.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/parallel.h"

namespace lw {
namespace {

constexpr float pi = 3.14159265f;
using Plane = std::vector<float>;
using Kernel = std::vector<float>;  // odd length, centre in the middle

struct Planes {
    Plane x, y, z;
};

const vec3 rgb_to_xyz_rows[3] = {
    {0.4123866f, 0.3575915f, 0.1804505f}, {0.2126368f, 0.7151830f, 0.0721802f}, {0.0193306f, 0.1191972f, 0.9503726f}};
const vec3 xyz_to_rgb_rows[3] = {{3.2410032f, -1.5373990f, -0.4986159f},
                                 {-0.9692243f, 1.8759300f, 0.0415542f},
                                 {0.0556394f, -0.2040112f, 1.0571490f}};
const vec3 white_xyz = {0.9504286f, 1.0f, 1.0889004f};

vec3 apply(const vec3 (&rows)[3], const vec3& v) { return {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)}; }

/// The opponent space of the spatial filters (section 4.1.1): achromatic, red-green, blue-yellow.
vec3 to_ycxcz(const vec3& rgb) {
    vec3 v = apply(rgb_to_xyz_rows, rgb) / white_xyz;
    return {116 * v.y - 16, 500 * (v.x - v.y), 200 * (v.y - v.z)};
}

vec3 from_ycxcz(const vec3& c) {
    float y = (c.x + 16) / 116;
    return apply(xyz_to_rgb_rows, vec3(y + c.y / 500, y, y - c.z / 200) * white_xyz);
}

float lab_curve(float t) {
    constexpr float delta = 6.0f / 29.0f;
    return t > delta * delta * delta ? std::cbrt(t) : t / (3 * delta * delta) + 4.0f / 29.0f;
}

/// CIELAB with the chroma scaled by lightness, for the Hunt effect (section 4.1.2).
vec3 to_hunt_lab(const vec3& rgb) {
    vec3 v = apply(rgb_to_xyz_rows, rgb) / white_xyz;
    float fx = lab_curve(v.x), fy = lab_curve(v.y), fz = lab_curve(v.z);
    float lightness = 116 * fy - 16;
    return {lightness, 0.01f * lightness * 500 * (fx - fy), 0.01f * lightness * 200 * (fy - fz)};
}

float hyab(const vec3& a, const vec3& b) {
    vec3 d = a - b;
    return std::abs(d.x) + std::hypot(d.y, d.z);
}

/// Divides positive weights by their sum and negative weights by theirs.
Kernel normalised(Kernel kernel) {
    float positive = 0, negative = 0;
    for (float w : kernel) (w > 0 ? positive : negative) += std::abs(w);
    for (float& w : kernel) w /= w > 0 ? positive : std::max(negative, 1e-30f);
    return kernel;
}

template <class Function>
Kernel make_kernel(int radius, const Function& weight) {
    Kernel kernel;
    for (int i = -radius; i <= radius; ++i) kernel.push_back(weight(float(i)));
    return kernel;
}

/// Convolves rows with `across`, then columns with `down`.
Plane convolve(const Plane& in, int width, int height, const Kernel& across, const Kernel& down) {
    int radius = int(across.size() / 2);
    Plane rows(in.size()), out(in.size());
    parallel_for(size_t(height), [&](size_t y) {
        for (int x = 0; x < width; ++x) {
            float sum = 0;
            for (int i = -radius; i <= radius; ++i)
                sum += across[size_t(i + radius)] * in[y * size_t(width) + size_t(std::clamp(x + i, 0, width - 1))];
            rows[y * size_t(width) + size_t(x)] = sum;
        }
    });
    parallel_for(size_t(height), [&](size_t y) {
        float* line = out.data() + y * size_t(width);
        for (int i = -radius; i <= radius; ++i) {
            const float* from = rows.data() + size_t(std::clamp(int(y) + i, 0, height - 1)) * size_t(width);
            for (int x = 0; x < width; ++x) line[x] += down[size_t(i + radius)] * from[x];
        }
    });
    return out;
}

/// One Gaussian of a contrast sensitivity function: a * sqrt(pi / b) * exp(-pi^2 d^2 / b), d in degrees (equation 3).
struct Sensitivity {
    float a, b;
};

/// Filters with a normalised sum of Gaussians, each of which is separable.
Plane filter(const Plane& in, int width, int height, float ppd, const std::vector<Sensitivity>& sums) {
    int radius = int(std::ceil(3 * std::sqrt(0.04f / (2 * pi * pi)) * ppd));
    Plane out(in.size());
    float total = 0;
    for (const Sensitivity& s : sums) {
        Kernel kernel = make_kernel(radius, [&](float i) { return std::exp(-pi * pi * i * i / (ppd * ppd * s.b)); });
        float sum = 0;
        for (float w : kernel) sum += w;
        float volume = s.a * std::sqrt(pi / s.b) * sum * sum;
        kernel = normalised(kernel);
        Plane part = convolve(in, width, height, kernel, kernel);
        for (size_t i = 0; i < out.size(); ++i) out[i] += volume * part[i];
        total += volume;
    }
    for (float& v : out) v /= total;
    return out;
}

Planes to_opponent_planes(const std::vector<vec3>& rgb) {
    Planes p{Plane(rgb.size()), Plane(rgb.size()), Plane(rgb.size())};
    for (size_t i = 0; i < rgb.size(); ++i) {
        vec3 c = to_ycxcz(rgb[i]);
        p.x[i] = c.x, p.y[i] = c.y, p.z[i] = c.z;
    }
    return p;
}

/// What the eye still resolves, in Hunt-adjusted CIELAB. Constants of table 1.
std::vector<vec3> perceived_colours(const Planes& p, int width, int height, float ppd) {
    Plane y = filter(p.x, width, height, ppd, {{1.0f, 0.0047f}});
    Plane cx = filter(p.y, width, height, ppd, {{1.0f, 0.0053f}});
    Plane cz = filter(p.z, width, height, ppd, {{34.1f, 0.04f}, {13.5f, 0.025f}});
    std::vector<vec3> result(y.size());
    for (size_t i = 0; i < y.size(); ++i)
        result[i] = to_hunt_lab(clamp(from_ycxcz({y[i], cx[i], cz[i]}), vec3(0.0f), vec3(1.0f)));
    return result;
}

/// The colour difference compressed to [0, 1], 95 % of which is for the first 40 % (section 4.1.3).
float redistribute(float distance) {
    static const float most = std::pow(hyab(to_hunt_lab({0, 1, 0}), to_hunt_lab({0, 0, 1})), 0.7f);
    float d = std::pow(distance, 0.7f), knee = 0.4f * most;
    return d < knee ? 0.95f / knee * d : 0.95f + 0.05f * std::min(1.0f, (d - knee) / (most - knee));
}

/// Lengths of the edge and point responses of the achromatic plane (section 4.2).
struct Features {
    Plane edges, points;
};

Features find_features(const Plane& achromatic, int width, int height, float ppd) {
    Plane y(achromatic.size());
    std::transform(achromatic.begin(), achromatic.end(), y.begin(), [](float v) { return (v + 16) / 116; });
    float sd = 0.5f * 0.082f * ppd;
    int radius = int(std::ceil(3 * sd));
    auto gauss = [&](float x) { return std::exp(-x * x / (2 * sd * sd)); };
    Kernel smooth = normalised(make_kernel(radius, gauss));
    Kernel edge = normalised(make_kernel(radius, [&](float x) { return -x * gauss(x); }));
    Kernel point = normalised(make_kernel(radius, [&](float x) { return (x * x / (sd * sd) - 1) * gauss(x); }));
    auto response = [&](const Kernel& kernel) {
        Plane across = convolve(y, width, height, kernel, smooth), down = convolve(y, width, height, smooth, kernel);
        for (size_t i = 0; i < across.size(); ++i) across[i] = std::hypot(across[i], down[i]);
        return across;
    };
    return {response(edge), response(point)};
}

}  // namespace

std::vector<float> flip(const std::vector<vec3>& test, const std::vector<vec3>& reference, int width, int height,
                        float ppd) {
    assert(test.size() == reference.size() && test.size() == size_t(width) * size_t(height));
    Planes test_planes = to_opponent_planes(test), reference_planes = to_opponent_planes(reference);
    std::vector<vec3> a = perceived_colours(test_planes, width, height, ppd);
    std::vector<vec3> b = perceived_colours(reference_planes, width, height, ppd);
    Features fa = find_features(test_planes.x, width, height, ppd);
    Features fb = find_features(reference_planes.x, width, height, ppd);
    std::vector<float> result(test.size());
    for (size_t i = 0; i < result.size(); ++i) {
        float feature = std::max(std::abs(fa.edges[i] - fb.edges[i]), std::abs(fa.points[i] - fb.points[i]));
        float exponent = 1 - std::min(1.0f, std::sqrt(feature / std::sqrt(2.0f)));
        float colour = redistribute(hyab(a[i], b[i]));
        result[i] = colour > 0 ? std::pow(colour, exponent) : 0.0f;
    }
    return result;
}

}  // namespace lw
