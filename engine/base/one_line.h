// Keeps messages on one line, even when they quote a name from a file that holds line ends or control characters.
#pragma once
#include <string>

namespace lw {

/// The text with every control character (line ends, escapes) replaced by a question mark.
inline std::string one_line(std::string text) {
    for (char& c : text)
        if (static_cast<unsigned char>(c) < 32 || c == 127) c = '?';
    return text;
}

}  // namespace lw
