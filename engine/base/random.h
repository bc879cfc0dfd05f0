// Counter-based random numbers: every number is a pure function of (seed, stream, index, dimension),
// so any thread may draw it and a bake gives the same bytes at any thread count.
#pragma once
#include <cstdint>

namespace lw {

/// Mixes 64 bits into 64 (the finaliser of splitmix64, Steele, Lea & Flood 2014).
inline uint64_t mix64(uint64_t x) {
    x += 0x9e3779b97f4a7c15ull;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
    return x ^ (x >> 31);
}

/// The upper 24 bits of a 32-bit hash as a float in [0, 1).
inline float to_unit_float(uint32_t bits) { return float(bits >> 8) * 0x1p-24f; }

/// A stream of uniform numbers, seeded by (seed, stream, index). Value type, 16 bytes.
class Rng {
  public:
    Rng(uint64_t seed, uint64_t stream, uint64_t index) : state_(mix64(mix64(mix64(seed) ^ stream) ^ index)) {}

    /// Uniform in [0, 1).
    float next() {
        state_ += 0x9e3779b97f4a7c15ull;
        uint64_t x = state_;
        x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
        x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
        return to_unit_float(uint32_t((x ^ (x >> 31)) >> 32));
    }

  private:
    uint64_t state_;
};

}  // namespace lw
