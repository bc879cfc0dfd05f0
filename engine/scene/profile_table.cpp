#include "scene/profile_table.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace lw {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double largest_error = 0.004;        // of the strongest intensity, in each of both angles
constexpr double largest_flux_error = 0.0025;  // of the flux
constexpr size_t max_entries = 2'700'000;
constexpr std::array<uint, 6> columns_to_try{144, 288, 360, 720, 1440, 3600};
constexpr std::array<uint, 8> steps_to_try{360, 720, 1440, 1800, 3600, 7200, 14400, 18000};  // of gamma
constexpr size_t fewest_steps_before_columns = 4;  // a table that is too large loses rows down to these, then columns

/// C and gamma, radians.
struct Angles {
    double c, gamma;
};

double candela_towards(const Photometry& photometry, Angles a) {
    return candela_at(photometry,
                      {std::sin(a.gamma) * std::cos(a.c), std::sin(a.gamma) * std::sin(a.c), -std::cos(a.gamma)});
}

/// Whether an angle is one beyond which the file may give no more: there its intensities fall to 0 at once.
bool at_rim(const std::vector<double>& angles, size_t index) {
    const bool end = angles.size() > 1 && (index == 0 || index + 1 == angles.size());
    return end && angles[index] != 0 && angles[index] != 180;
}

/// Where the file gives intensities, but for its rim, and for types A and B, whose angles are not C and gamma, the
/// middles between.
std::vector<Angles> places_of(const Photometry& p) {
    std::vector<Angles> places;
    const bool front = p.type != Photometry::Type::C;
    const auto add = [&](double h, double v) {
        const glm::dvec3 d = direction_of_angles(p.type, h, v);
        const double c = std::atan2(d.y, d.x);
        if (!front || d.z < -1e-6) places.push_back({c < 0 ? c + 2 * pi : c, std::acos(std::clamp(-d.z, -1.0, 1.0))});
    };
    for (size_t i = 0; i < p.horizontal.size(); ++i)
        for (size_t j = 0; j < p.vertical.size(); ++j) {
            const double h = p.horizontal[i], v = p.vertical[j];
            if (!at_rim(p.vertical, j) && !(front && at_rim(p.horizontal, i))) add(h, v);
            if (front && i + 1 < p.horizontal.size() && j + 1 < p.vertical.size())
                add((h + p.horizontal[i + 1]) / 2, (v + p.vertical[j + 1]) / 2);
        }
    return places;
}

/// How far f(x) is from the line between f at the whole numbers beside x.
template <class F>
double error_between(const F& f, double x) {
    const double low = std::floor(x), share = x - low;
    return share < 1e-9 ? 0 : std::abs(f(low) * (1 - share) + f(low + 1) * share - f(x));
}

/// The first of `tries` with which error(place, try) is at most `largest` at all places; their number when none is.
template <class Tries, class E>
size_t first_that_follows(const Tries& tries, const std::vector<Angles>& places, double largest, const E& error) {
    size_t i = 0;
    const auto good = [&](const Angles& place) { return error(place, double(tries[i])) <= largest; };
    while (i < tries.size() && !std::all_of(places.begin(), places.end(), good)) ++i;
    return i;
}

std::vector<double> sampled(const Photometry& photometry, uint columns, uint rows, bool mirrored) {
    std::vector<double> candela;
    candela.reserve(size_t(columns) * rows);
    for (uint column = 0; column < columns; ++column)
        for (uint row = 0; row < rows; ++row) {
            const double c = 2 * pi * column / columns;
            candela.push_back(candela_towards(photometry, {mirrored ? -c : c, pi * row / (rows - 1)}));
        }
    return candela;
}

/// Flux in lm as photons carry it: cells with the mean of their corners.
double flux_of(const ProfileTable& table) {
    double flux = 0;
    for (uint row = 0; row + 1 < table.rows; ++row) {
        double sum = 0;
        for (uint column = 0; column < table.columns; ++column)
            sum += table.candela[column * table.rows + row] + table.candela[column * table.rows + row + 1];
        const double steps = table.rows - 1, band = std::cos(pi * row / steps) - std::cos(pi * (row + 1) / steps);
        flux += pi * band * sum / table.columns;
    }
    return flux;
}

struct Resolution {
    size_t columns, steps;  // places in the lists to try
    bool round;             // one column for all
    bool follows = true;

    uint column_count() const { return round ? 1 : columns_to_try[columns]; }
    uint row_count() const { return steps_to_try[steps] + 1; }
    bool fits() const { return size_t(column_count()) * row_count() <= max_entries; }
};

Resolution resolution_for(const Photometry& p) {
    const std::vector<Angles> places = places_of(p);
    const double largest = largest_error * *std::max_element(p.candela.begin(), p.candela.end());
    const auto error_of_steps = [&](const Angles& a, double count) {
        const auto along = [&](double x) { return candela_towards(p, {a.c, pi * x / count}); };
        return error_between(along, a.gamma * count / pi);
    };
    const auto error_of_columns = [&](const Angles& a, double count) {
        const auto around = [&](double x) { return candela_towards(p, {2 * pi * x / count, a.gamma}); };
        return error_between(around, a.c * count / (2 * pi));
    };
    Resolution r{0, first_that_follows(steps_to_try, places, largest, error_of_steps),
                 p.type == Photometry::Type::C && p.horizontal.size() == 1};
    if (!r.round) r.columns = first_that_follows(columns_to_try, places, largest, error_of_columns);
    r.follows = r.steps < steps_to_try.size() && r.columns < columns_to_try.size();
    r.steps = std::min(r.steps, steps_to_try.size() - 1);
    r.columns = std::min(r.columns, columns_to_try.size() - 1);
    for (; !r.fits(); r.follows = false) --(r.steps > fewest_steps_before_columns ? r.steps : r.columns);
    return r;
}

}  // namespace

ProfileTable profile_table(const Photometry& photometry, bool mirrored) {
    const double flux = flux_of(photometry);
    for (Resolution r = resolution_for(photometry);; ++r.steps) {
        ProfileTable table{r.column_count(), r.row_count(), {}};
        table.candela = sampled(photometry, table.columns, table.rows, mirrored);
        const bool exact = std::abs(flux_of(table) - flux) <= largest_flux_error * flux;
        Resolution finer = r;
        const bool finest = ++finer.steps == steps_to_try.size() || !finer.fits();
        table.follows = r.follows && exact;
        if (exact || finest) return table;
    }
}

}  // namespace lw
