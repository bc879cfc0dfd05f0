// Parses the texts of options: words, numbers, points and KEY=VALUE pairs. `where` begins the message of every Error.
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "measure/sensor.h"

namespace lw {

/// The lines of a text file; throws Error naming a file that cannot be read or is no text (larger than 64 MB).
std::vector<std::string> read_lines(const std::filesystem::path& path);

std::string trimmed(const std::string& text);
std::vector<std::string> split(const std::string& text, char separator);

/// A finite number. Throws Error("WHERE: "TEXT" is not a number").
double parse_number(const std::string& text, const std::string& where);

/// Parses "X,Y,Z".
glm::dvec3 parse_point(const std::string& text, const std::string& where);

/// Parses "+x", "-x", "+y", "-y", "+z" or "-z" to a unit vector.
vec3 parse_axis(const std::string& text, const std::string& where);

Response parse_response(const std::string& text, const std::string& where);

/// Parses tokens "KEY=VALUE" to a map. Throws Error for a key that is not in `known` or is given twice.
std::map<std::string, std::string> parse_pairs(const std::vector<std::string>& tokens,
                                               const std::vector<std::string>& known, const std::string& where);

}  // namespace lw
