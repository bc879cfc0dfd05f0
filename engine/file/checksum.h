// The checksum of a photon map file. Public, so that a test can change a file and give it a valid checksum again.
#pragma once
#include <cstring>

#include "base/random.h"

namespace lw {

/// 64-bit hash of a sequence of pieces, in words of 8 bytes. The last word of each piece is padded with zeros, so the
/// value depends on where pieces end.
class Checksum {
  public:
    void add(const void* bytes, size_t size) {
        const auto* p = static_cast<const unsigned char*>(bytes);
        for (; size >= 8; p += 8, size -= 8) add_word(p, 8);
        if (size) add_word(p, size);
    }
    uint64_t value() const { return mix64(state_); }

  private:
    void add_word(const unsigned char* p, size_t size) {
        uint64_t word = 0;
        std::memcpy(&word, p, size);
        state_ = (state_ ^ word) * 0x9fb21c651e98df25ull;
        state_ ^= state_ >> 32;
    }
    uint64_t state_ = 0x6c756d656e77616cull;
};

}  // namespace lw
