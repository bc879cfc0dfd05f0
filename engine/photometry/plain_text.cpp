#include "photometry/plain_text.h"

#include <algorithm>

#include "base/error.h"
#include "base/input_file.h"

namespace lw {
namespace {

constexpr uintmax_t max_bytes = 16'000'000;
constexpr size_t max_files_looked_at = 10'000;

void append_utf8(uint code, std::string& text) {
    const auto part = [&](uint bits) { text += char(0x80 | (bits & 0x3f)); };
    if (code < 0x80) {
        text += char(code);
    } else if (code < 0x800) {
        text += char(0xc0 | (code >> 6));
        part(code);
    } else {
        text += char(0xe0 | (code >> 12));
        part(code >> 6);
        part(code);
    }
}

/// Characters beyond the basic plane (surrogates) become question marks: no number and no keyword has them.
std::string utf8_of_utf16(const std::string& bytes, bool big_endian) {
    std::string text;
    for (size_t i = 2; i + 1 < bytes.size(); i += 2) {
        const auto low = uint(static_cast<unsigned char>(bytes[i + (big_endian ? 1 : 0)]));
        const auto high = uint(static_cast<unsigned char>(bytes[i + (big_endian ? 0 : 1)]));
        const uint code = high << 8 | low;
        append_utf8(code >= 0xd800 && code < 0xe000 ? uint('?') : code, text);
    }
    return text;
}

/// LF for CR LF, for CR CR LF, which text written twice in text mode has, and for CR alone.
std::string with_line_feeds(const std::string& text) {
    std::string lines;
    lines.reserve(text.size());
    for (size_t i = 0; i < text.size();) {
        if (text[i] != '\r') {
            lines += text[i++];
            continue;
        }
        const size_t after = std::min(text.find_first_not_of('\r', i), text.size());
        if (after < text.size() && text[after] == '\n')
            lines += '\n';
        else
            lines.append(after - i, '\n');
        i = after + (after < text.size() && text[after] == '\n' ? 1 : 0);
    }
    return lines;
}

}  // namespace

std::string plain_text(const std::string& bytes) {
    if (bytes.starts_with("\xff\xfe")) return with_line_feeds(utf8_of_utf16(bytes, false));
    if (bytes.starts_with("\xfe\xff")) return with_line_feeds(utf8_of_utf16(bytes, true));
    return with_line_feeds(bytes.starts_with("\xef\xbb\xbf") ? bytes.substr(3) : bytes);
}

std::string read_text_file(const std::filesystem::path& path) {
    std::ifstream stream = open_input(path);
    std::error_code failure;
    const uintmax_t bytes = std::filesystem::file_size(path, failure);
    if (!stream || failure) throw Error(path.string() + ": cannot be opened");
    if (bytes > max_bytes) throw Error(path.string() + ": larger than 16 MB");
    return {std::istreambuf_iterator<char>(stream), {}};
}

std::filesystem::path file_in_folder(const std::filesystem::path& folder, const std::string& name) {
    const size_t cut = name.find_last_of("/\\:");
    const std::string wanted = cut == std::string::npos ? name : name.substr(cut + 1);
    std::error_code failure;
    if (wanted.empty() || wanted == "." || wanted == "..") return {};
    if (std::filesystem::is_regular_file(folder / wanted, failure)) return folder / wanted;
    std::filesystem::path found;
    size_t looked_at = 0;
    for (std::filesystem::directory_iterator i(folder, failure), end;
         !failure && i != end && looked_at < max_files_looked_at; i.increment(failure), ++looked_at) {
        const std::filesystem::path& path = i->path();
        if (upper_case(path.filename().string()) == upper_case(wanted) && (found.empty() || path < found)) found = path;
    }
    return found;
}

std::string upper_case(std::string text) {
    for (char& c : text) c = c >= 'a' && c <= 'z' ? char(c - 32) : c;
    return text;
}

}  // namespace lw
