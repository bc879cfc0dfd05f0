#include "photometry/photometry.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/error.h"
#include "base/one_line.h"
#include "photometry/plain_text.h"

namespace lw {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double degrees = 180 / pi;
constexpr double largest_difference = 0.1;  // relative, between the integrated flux of a file and the flux it states
constexpr double max_candela = 1e12;        // a thousand lighthouses of a thousand million candela

/// The plane of the file that holds the light of plane `c` (degrees, in [0, 360)), by the symmetry of `planes`.
double folded(const std::vector<double>& planes, double c) {
    const double first = planes.front(), last = planes.back();
    if (planes.size() == 1) return first;
    if (last - first > 359.999) return c < first ? c + 360 : c > last ? c - 360 : c;
    if (first == -90) {  // C270 to C90
        if (c > 270) return c - 360;
        return c > 90 ? 180 - c : c;
    }
    if (first == 90) {  // C90 to C270
        if (c < 90) return 180 - c;
        return c > 270 ? 540 - c : c;
    }
    if (last == 90) {
        c = c > 180 ? 360 - c : c;
        return c > 90 ? 180 - c : c;
    }
    return last == 180 && c > 180 ? 360 - c : c;
}

/// Finds the interval of the rising `values` that holds x: `index` of its lower end, and `share` in [0, 1] from there
/// to the upper end. Returns false when x is outside of all.
bool locate(const std::vector<double>& values, double x, size_t& index, double& share) {
    constexpr double rounding = 1e-9;
    if (x < values.front() - rounding || x > values.back() + rounding) return false;
    if (values.size() == 1) {
        index = 0, share = 0;
        return true;
    }
    const auto above = std::upper_bound(values.begin() + 1, values.end() - 1, x);
    index = size_t(above - values.begin()) - 1;
    share = std::clamp((x - values[index]) / (values[index + 1] - values[index]), 0.0, 1.0);
    return true;
}

double interpolated(const Photometry& p, double horizontal, double vertical) {
    size_t h = 0, v = 0;
    double fh = 0, fv = 0;
    if (!locate(p.vertical, vertical, v, fv) || !locate(p.horizontal, horizontal, h, fh)) return 0;
    const size_t rows = p.vertical.size(), h1 = std::min(h + 1, p.horizontal.size() - 1),
                 v1 = std::min(v + 1, rows - 1);
    const auto at = [&](size_t i, size_t j) { return p.candela[i * rows + j]; };
    return (at(h, v) * (1 - fv) + at(h, v1) * fv) * (1 - fh) + (at(h1, v) * (1 - fv) + at(h1, v1) * fv) * fh;
}

/// Integral over polar angles `from` to `to` of a value linear from `a` to `b`, times the sine of the angle.
double band_integral(double from, double to, double a, double b) {
    if (to - from < 1e-7) return (a + b) / 2 * (std::cos(from) - std::cos(to));
    const double slope = (b - a) / (to - from);
    return a * std::cos(from) - b * std::cos(to) + slope * (std::sin(to) - std::sin(from));
}

void check_flux(const Photometry& photometry, const std::string& name) {
    for (const double value : photometry.candela)
        if (!(value <= max_candela)) throw Error(name + ": gives more than 1e12 cd");
    const double flux = flux_of(photometry), stated = photometry.stated_output;
    if (!(flux > 0)) throw Error(name + ": gives no light");
    if (!(stated > 0) || std::abs(flux / stated - 1) <= largest_difference) return;
    char text[96];
    std::snprintf(text, sizeof text, ": its intensities give %.5g lm but it states %.5g lm", flux, stated);
    throw Error(name + text);
}

Photometry checked(const std::string& text, const std::string& name, const std::filesystem::path& folder) {
    const bool eulumdat = upper_case(std::filesystem::path(name).extension().string()) == ".LDT";
    Photometry photometry = eulumdat ? parse_eulumdat(text, name) : parse_lm63(text, name, folder);
    check_flux(photometry, name);
    photometry.file = one_line(name);
    return photometry;
}

}  // namespace

double candela_at(const Photometry& p, glm::dvec3 d) {
    if (p.type == Photometry::Type::C) {
        double c = std::atan2(d.y, d.x) * degrees;
        if (c < 0) c += 360;
        return interpolated(p, folded(p.horizontal, c), std::acos(std::clamp(-d.z, -1.0, 1.0)) * degrees);
    }
    // Goniometers with an upright (A) or a lying (B) polar axis; only what is in front of the luminaire.
    if (d.z >= 0) return 0;
    double horizontal = p.type == Photometry::Type::A ? std::atan2(d.x, -d.z) : std::asin(std::clamp(d.x, -1.0, 1.0));
    double vertical = p.type == Photometry::Type::A ? std::asin(std::clamp(d.y, -1.0, 1.0)) : std::atan2(d.y, -d.z);
    if (p.horizontal.front() >= 0) horizontal = std::abs(horizontal);
    if (p.vertical.front() >= 0) vertical = std::abs(vertical);
    return interpolated(p, p.horizontal.size() == 1 ? p.horizontal[0] : horizontal * degrees, vertical * degrees);
}

glm::dvec3 direction_of_angles(Photometry::Type type, double horizontal, double vertical) {
    const double h = horizontal / degrees, v = vertical / degrees;
    if (type == Photometry::Type::A) return {std::cos(v) * std::sin(h), std::sin(v), -std::cos(v) * std::cos(h)};
    if (type == Photometry::Type::B) return {std::sin(h), std::cos(h) * std::sin(v), -std::cos(h) * std::cos(v)};
    return {std::sin(v) * std::cos(h), std::sin(v) * std::sin(h), -std::cos(v)};
}

double flux_of(const Photometry& p) {
    // The angle from the polar axis is the vertical one of types C and A, the horizontal one of type B.
    const bool lies = p.type == Photometry::Type::B, front = p.type != Photometry::Type::C;
    std::vector<double> polar = lies ? p.horizontal : p.vertical, around = lies ? p.vertical : p.horizontal;
    if (polar.size() == 1) polar = {-90, 90};
    if (around.size() == 1) around = front ? std::vector<double>{-90, 90} : std::vector<double>{0, 360};
    const size_t rows = p.vertical.size();
    const auto at = [&](size_t i, size_t j) {
        const size_t h = std::min(lies ? i : j, p.horizontal.size() - 1), v = lies ? j : i;
        return p.candela[h * rows + std::min(v, rows - 1)];
    };
    double flux = 0;
    for (size_t j = 0; j + 1 < around.size(); ++j)
        for (size_t i = 0; i + 1 < polar.size(); ++i) {
            const double from = (polar[i] + (front ? 90 : 0)) / degrees,
                         to = (polar[i + 1] + (front ? 90 : 0)) / degrees;
            flux += band_integral(from, to, (at(i, j) + at(i, j + 1)) / 2, (at(i + 1, j) + at(i + 1, j + 1)) / 2) *
                    (around[j + 1] - around[j]) / degrees;
        }
    if (!front) return flux * 360 / (around.back() - around.front());
    return flux * (polar.front() >= 0 ? 2 : 1) * (around.front() >= 0 ? 2 : 1);
}

double light_output_ratio(const Photometry& photometry) {
    return photometry.lamp_lumens > 0 ? flux_of(photometry) / photometry.lamp_lumens : 0;
}

std::string summary_of(const Photometry& photometry) {
    char text[160];
    const double strongest = *std::max_element(photometry.candela.begin(), photometry.candela.end());
    std::snprintf(text, sizeof text, "%.4g lm, at most %.4g cd", flux_of(photometry), strongest);
    std::string line = text;
    if (photometry.lamp_lumens > 0) {
        std::snprintf(text, sizeof text, ", light output ratio %.0f %% of %.5g lm",
                      100 * light_output_ratio(photometry), photometry.lamp_lumens);
        line += text;
    }
    if (photometry.color_temperature > 0) {
        std::snprintf(text, sizeof text, ", %.0f K", photometry.color_temperature);
        line += text;
    }
    return line;
}

double tilt_factor(const Photometry& photometry, double angle) {
    size_t i = 0;
    double share = 0;
    const std::vector<double>&angles = photometry.tilt_angles, &factors = photometry.tilt_factors;
    if (angles.empty() || !locate(angles, angle, i, share)) return 1;
    return angles.size() == 1 ? factors[0] : factors[i] * (1 - share) + factors[i + 1] * share;
}

Photometry parse_photometry(const std::string& text, const std::string& name) { return checked(text, name, {}); }

Photometry read_photometry(const std::filesystem::path& path) {
    const std::filesystem::path folder = path.parent_path();
    return checked(read_text_file(path), path.filename().string(), folder.empty() ? "." : folder);
}

}  // namespace lw
