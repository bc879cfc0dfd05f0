#include "document.h"

#include <sstream>

#include "base/error.h"
#include "base/replaced_file.h"

namespace lw {
namespace {

std::string text_of(const std::filesystem::path& document) {
    std::ifstream stream(document);
    std::ostringstream text;
    if (!(text << stream.rdbuf())) throw Error(document.string() + ": cannot be read");
    return text.str();
}

struct Place {
    size_t begin, end;
};

/// What stands between the two lines of a section.
Place find_place(const std::filesystem::path& document, const std::string& text, const std::string& section) {
    const std::string first = "<!-- benchmark " + section + " -->\n", last = "<!-- end of benchmark -->\n";
    const size_t line = text.find(first);
    const size_t end = line == std::string::npos ? line : text.find(last, line);
    if (end == std::string::npos || text.find("<!-- benchmark ", line + first.size()) < end)
        throw Error(document.string() + ": has no lines '<!-- benchmark " + section +
                    " -->' and '<!-- end of benchmark -->' to put the section between");
    return {line + first.size(), end};
}

}  // namespace

void check_places(const std::filesystem::path& document, const std::vector<std::string>& sections) {
    const std::string text = text_of(document);
    for (const std::string& section : sections) find_place(document, text, section);
}

void replace_section(const std::filesystem::path& document, const std::string& section, const std::string& text) {
    std::string all = text_of(document);
    const Place place = find_place(document, all, section);
    all.replace(place.begin, place.end - place.begin, text);
    ReplacedFile file(document);
    file.stream() << all;
    file.commit();
}

}  // namespace lw
