#include "measure/option_parsing.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/error.h"
#include "base/input_file.h"

namespace lw {

std::vector<std::string> read_lines(const std::filesystem::path& path) {
    std::error_code failure;
    const uintmax_t bytes = std::filesystem::file_size(path, failure);
    std::ifstream stream = open_input(path);
    if (failure || !stream) throw Error(path.string() + ": cannot be opened");
    if (bytes > 64'000'000) throw Error(path.string() + ": larger than 64 MB");
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    if (!lines.empty() && lines[0].starts_with("\xEF\xBB\xBF")) lines[0].erase(0, 3);  // as spreadsheets write it
    return lines;
}

std::string trimmed(const std::string& text) {
    const char* blank = " \t\r\n";
    const size_t first = text.find_first_not_of(blank), last = text.find_last_not_of(blank);
    return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> parts;
    size_t start = 0;
    for (size_t end = text.find(separator); end != std::string::npos;
         start = end + 1, end = text.find(separator, start))
        parts.push_back(trimmed(text.substr(start, end - start)));
    parts.push_back(trimmed(text.substr(start)));
    return parts;
}

double parse_number(const std::string& text, const std::string& where) {
    double value = 0;
    const char* begin = text.data() + (!text.empty() && text[0] == '+' ? 1 : 0);
    const char* end = text.data() + text.size();
    const std::from_chars_result result = std::from_chars(begin, end, value);
    if (result.ec != std::errc() || result.ptr != end || !std::isfinite(value))
        throw Error(where + ": \"" + text + "\" is not a number");
    return value;
}

glm::dvec3 parse_point(const std::string& text, const std::string& where) {
    const std::vector<std::string> parts = split(text, ',');
    if (parts.size() != 3) throw Error(where + ": \"" + text + "\" is not a point X,Y,Z");
    glm::dvec3 point(0);
    for (int axis = 0; axis < 3; ++axis) {
        point[axis] = parse_number(parts[size_t(axis)], where);
        if (std::abs(point[axis]) > 1e9) throw Error(where + ": \"" + text + "\" is farther than 1e9 m");
    }
    return point;
}

vec3 parse_axis(const std::string& text, const std::string& where) {
    const std::string axes = "xyz";
    const size_t axis = text.size() == 2 ? axes.find(text[1]) : std::string::npos;
    if (axis == std::string::npos || (text[0] != '+' && text[0] != '-'))
        throw Error(where + ": facing=" + text + ": write one of +x -x +y -y +z -z");
    vec3 direction(0);
    direction[int(axis)] = text[0] == '+' ? 1.0f : -1.0f;
    return direction;
}

Response parse_response(const std::string& text, const std::string& where) {
    if (text == "planar") return Response::planar;
    if (text == "cylindrical") return Response::cylindrical;
    throw Error(where + ": \"" + text + "\" is not a kind of sensor; write planar or cylindrical");
}

std::map<std::string, std::string> parse_pairs(const std::vector<std::string>& tokens,
                                               const std::vector<std::string>& known, const std::string& where) {
    std::map<std::string, std::string> pairs;
    for (const std::string& token : tokens) {
        const size_t equals = token.find('=');
        const std::string key = token.substr(0, equals);
        if (equals == std::string::npos || std::find(known.begin(), known.end(), key) == known.end()) {
            std::string list;
            for (const std::string& name : known) list += (list.empty() ? "" : ", ") + name + "=";
            throw Error(where + ": \"" + token + "\" is none of " + list);
        }
        if (!pairs.emplace(key, token.substr(equals + 1)).second) throw Error(where + ": " + key + "= is given twice");
    }
    return pairs;
}

}  // namespace lw
