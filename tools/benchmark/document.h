// Tables of the benchmark in a Markdown file: each section stands between two lines of its own.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace lw {

/// Throws Error naming the file and the first of `sections` for which it has no lines `<!-- benchmark SECTION -->` and,
/// below, `<!-- end of benchmark -->`. To be called before hours of measuring.
void check_places(const std::filesystem::path& document, const std::vector<std::string>& sections);

/// Puts `text` in the place of what stands between these lines, the rest of the file untouched. Throws Error as
/// check_places does, or naming the file that cannot be written.
void replace_section(const std::filesystem::path& document, const std::string& section, const std::string& text);

}  // namespace lw
