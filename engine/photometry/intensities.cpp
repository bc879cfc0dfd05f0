#include "photometry/intensities.h"

#include <algorithm>
#include <cstdio>

#include "base/error.h"
#include "base/one_line.h"

namespace lw {
namespace {

constexpr double noise_share = 0.001, noise = 0.01;  // of the strongest intensity; candela, or candela per kilolumen

std::string text_of(const char* format, double a, double b = 0, double c = 0) {
    char text[160];
    std::snprintf(text, sizeof text, format, a, b, c);
    return text;
}

/// Types A and B: whether the angles reach as far as the half in front, on one side by symmetry.
bool covers_front(const std::vector<double>& angles) {
    return angles.size() == 1 || ((angles.front() == 0 || angles.front() == -90) && angles.back() == 90);
}

}  // namespace

void note(const NumberReader& reader, Photometry& photometry, const std::string& what) {
    photometry.notes.push_back(one_line(reader.name() + ": " + what));
}

void settle_negative_intensities(const NumberReader& reader, Photometry& photometry) {
    const size_t rows = photometry.vertical.size();
    const double strongest = *std::max_element(photometry.candela.begin(), photometry.candela.end());
    const double most = std::max(noise_share * strongest, noise);
    double worst = 0;
    for (size_t i = 0; i < photometry.candela.size(); ++i) {
        double& value = photometry.candela[i];
        if (!(value < 0)) continue;
        if (-value > most)
            throw Error(one_line(reader.name() + ": " +
                                 text_of("the intensity at plane %g, angle %g is negative (%g)",
                                         photometry.horizontal[i / rows], photometry.vertical[i % rows], value)));
        worst = std::min(worst, value);
        value = 0;
    }
    if (worst < 0)
        note(reader, photometry, text_of("negative intensities, the lowest of them %g, are taken as 0", worst));
}

void note_missing_angles(const NumberReader& reader, Photometry& photometry) {
    const std::vector<double>&vertical = photometry.vertical, &horizontal = photometry.horizontal;
    const double low = vertical.front(), high = vertical.back();
    if (photometry.type == Photometry::Type::C) {
        if ((low != 0 && low != 90) || (high != 90 && high != 180))
            note(reader, photometry,
                 text_of("gives intensities from %g to %g degrees only; 0 is taken elsewhere", low, high));
    } else if (!covers_front(vertical) || !covers_front(horizontal)) {
        note(reader, photometry,
             text_of("gives intensities to %g degrees up and %g sideways only; 0 is taken elsewhere", high,
                     horizontal.back()));
    }
}

void close_ring(Photometry& photometry) {
    photometry.horizontal.push_back(photometry.horizontal.front() + 360);
    for (size_t i = 0; i < photometry.vertical.size(); ++i) photometry.candela.push_back(photometry.candela[i]);
}

void note_left_over(NumberReader& reader, Photometry& photometry) {
    const std::string left_over = reader.left_over();
    if (!left_over.empty()) note(reader, photometry, left_over);
}

}  // namespace lw
