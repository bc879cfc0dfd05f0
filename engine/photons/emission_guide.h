// Guides the photons of a sun to the places of its disc from which light enters rooms: an importance grid over the two
// position numbers of the emission, learnt from a pilot. Unbiased: each photon is weighted by 1 / its relative density.
#pragma once
#include <array>
#include <vector>

namespace lw {

class EmissionGuide {
  public:
    static constexpr int side = 64;  // cells per number

    /// Uniform: leaves the numbers as they are.
    EmissionGuide() = default;
    /// Cells are chosen in proportion to `usefulness` (side x side, row = first number), blurred over the neighbours,
    /// with a floor of 3 % of the mean.
    explicit EmissionGuide(const std::vector<double>& usefulness);

    /// Moves the numbers u[0], u[1] in [0, 1) to the guided distribution and returns the weight of the photon.
    float warp(std::array<float, 5>& u) const;

  private:
    std::vector<float> rows_;   // cumulative, side entries
    std::vector<float> cells_;  // cumulative within each row
};

}  // namespace lw
