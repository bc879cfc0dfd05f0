// Parses "WxH", the size of a picture in pixels, for command lines.
#pragma once
#include <algorithm>
#include <charconv>
#include <string_view>
#include <system_error>

namespace lw {

struct WantedSize {
    unsigned width = 0, height = 0;  // 0 when the text was not a size
};

/// Reads "WxH" in plain digits. Returns 0 x 0 when the text is anything else, or when width or height is not in [least,
/// most].
inline WantedSize parse_picture_size(std::string_view text, unsigned least, unsigned most) {
    WantedSize size;
    const char *end = text.data() + text.size(), *cross = text.data() + std::min(text.find('x'), text.size());
    const auto is_whole = [&](const char* first, const char* last, unsigned& number) {
        const auto [stop, failure] = std::from_chars(first, last, number);
        return failure == std::errc() && stop == last && number >= least && number <= most;
    };
    const bool whole =
        cross != end && is_whole(text.data(), cross, size.width) && is_whole(cross + 1, end, size.height);
    return whole ? size : WantedSize{};
}

}  // namespace lw
