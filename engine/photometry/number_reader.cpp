#include "photometry/number_reader.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/error.h"
#include "base/one_line.h"
#include "photometry/plain_text.h"

namespace lw {
namespace {

constexpr size_t max_quoted = 20;  // characters of a file in a message

bool is_digit(char c) { return c >= '0' && c <= '9'; }

}  // namespace

NumberReader::NumberReader(const std::string& bytes, std::string name)
    : text_(plain_text(bytes)), name_(std::move(name)) {}

void NumberReader::fail(const std::string& what) const {
    throw Error(one_line(name_ + ": line " + std::to_string(line_) + ": " + what));
}

std::string NumberReader::line(const std::string& what) {
    if (at_end()) fail("the file ends before " + what);
    const size_t end = std::min(text_.find('\n', at_), text_.size());
    std::string line = text_.substr(at_, end - at_);
    at_ = end + 1;
    ++line_;
    const size_t first = line.find_first_not_of(" \t"), last = line.find_last_not_of(" \t");
    return first == std::string::npos ? "" : line.substr(first, last - first + 1);
}

void NumberReader::skip_blanks() {
    for (; at_ < text_.size(); ++at_) {
        const char c = text_[at_];
        if (c == '\n')
            ++line_;
        else if (c != ' ' && c != '\t' && c != ',' && c != '\0' && c != 0x1a)
            break;
    }
}

std::string NumberReader::next_word() {
    const size_t end = std::min(text_.find_first_of(decimal_commas_ ? " \t\n" : " \t\n,", at_), text_.size());
    if (end > at_ && end + 1 < text_.size() && text_[end] == ',')
        glued_commas_ |= is_digit(text_[end - 1]) && is_digit(text_[end + 1]);
    std::string word = text_.substr(at_, end - at_);
    at_ = end;
    if (!decimal_commas_) return word;
    while (word.ends_with(',')) word.pop_back();
    std::replace(word.begin(), word.end(), ',', '.');
    return word;
}

double NumberReader::number(const std::string& what) {
    skip_blanks();
    if (at_end()) fail("the file ends before " + what);
    const std::string word = next_word();
    const char *first = word.data() + (word.starts_with('+') ? 1 : 0), *last = word.data() + word.size();
    double value = 0;
    const std::from_chars_result result = std::from_chars(first, last, value);
    if (result.ec != std::errc() || result.ptr != last || !std::isfinite(value))
        fail(what + ": \"" + word.substr(0, max_quoted) + "\" is not a number");
    return value;
}

size_t NumberReader::count(const std::string& what, size_t least, size_t most) {
    const double value = number(what);
    if (value < double(least) || value > double(most) || value != std::floor(value))
        fail(what + " must be a whole number from " + std::to_string(least) + " to " + std::to_string(most));
    return size_t(value);
}

std::vector<double> NumberReader::numbers(const std::string& what, size_t count, bool rising) {
    std::vector<double> values;
    for (size_t i = 0; i < count; ++i) {
        values.push_back(number(what));
        if (rising && i > 0 && values[i] <= values[i - 1]) fail(what + " must rise");
    }
    return values;
}

void NumberReader::start_over_with_decimal_commas() {
    at_ = 0, line_ = 1;
    decimal_commas_ = true;
}

std::string NumberReader::left_over() {
    skip_blanks();
    if (at_end()) return "";
    const size_t first_line = line_;
    const std::string first = next_word();
    size_t words = 1;
    for (skip_blanks(); !at_end(); skip_blanks(), ++words) next_word();
    return "line " + std::to_string(first_line) + ": \"" + first.substr(0, max_quoted) + "\"" +
           (words == 1 ? " is" : " and " + std::to_string(words - 1) + " more are") +
           " left over after the last intensity";
}

}  // namespace lw
