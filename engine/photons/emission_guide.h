// Sends more photons of a sun from those places of its disc from which light enters rooms. The guide is a grid over the
// two random numbers that choose the position on the disc; its probabilities are learnt from a pilot run. The result is
// unbiased: each photon is weighted by 1 / its relative density.
#pragma once
#include <array>
#include <vector>

namespace lw {

class EmissionGuide {
  public:
    static constexpr int side = 64;  // cells per number

    /// A uniform guide: warp() changes nothing and returns 1.
    EmissionGuide() = default;
    /// A guide that chooses cells in proportion to `usefulness`: side x side values, rows along the first number. The
    /// values are averaged with those of the neighbouring cells first, and raised to at least 3 % of the mean.
    explicit EmissionGuide(const std::vector<double>& usefulness);

    /// Moves the numbers u[0], u[1] in [0, 1) to the guided distribution and returns the weight of the photon.
    float warp(std::array<float, 5>& u) const;

  private:
    std::vector<float> rows_;   // cumulative probabilities of the rows, `side` entries
    std::vector<float> cells_;  // cumulative within each row
};

}  // namespace lw
