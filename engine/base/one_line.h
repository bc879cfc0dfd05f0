// Messages are one line, whatever the names in files and of files hold.
#pragma once
#include <string>

namespace lw {

/// The text with a question mark for every line end and other byte that steers a terminal.
inline std::string one_line(std::string text) {
    for (char& c : text)
        if (static_cast<unsigned char>(c) < 32 || c == 127) c = '?';
    return text;
}

}  // namespace lw
