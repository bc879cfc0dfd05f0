// Bytes as text of letters, digits, + and / (RFC 4648, section 4), as URIs of the kind "data:" hold them.
#pragma once
#include <cstdint>
#include <span>
#include <string>

namespace lw {

/// Four characters for every three bytes; the last ones are filled up with =.
inline std::string base64(std::span<const uint8_t> bytes) {
    static constexpr char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (size_t i = 0; i < bytes.size(); i += 3) {
        uint32_t bits = 0;
        for (size_t k = 0; k < 3; ++k) bits = bits << 8 | (i + k < bytes.size() ? bytes[i + k] : 0u);
        for (size_t k = 0; k < 4; ++k) text += i + k <= bytes.size() ? letters[bits >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

}  // namespace lw
