#include "photometry/number_reader.h"

#include <charconv>
#include <cmath>

#include "base/error.h"
#include "base/one_line.h"

namespace lw {

NumberReader::NumberReader(const std::string& text, const std::string& name) : text_(text), name_(name) {}

void NumberReader::fail(const std::string& what) const {
    throw Error(one_line(name_ + ": line " + std::to_string(line_) + ": " + what));
}

std::string NumberReader::line(const std::string& what) {
    if (at_end()) fail("the file ends before " + what);
    const size_t end = std::min(text_.find('\n', at_), text_.size());
    std::string line = text_.substr(at_, end - at_);
    at_ = end + 1;
    ++line_;
    const size_t first = line.find_first_not_of(" \t\r"), last = line.find_last_not_of(" \t\r");
    return first == std::string::npos ? "" : line.substr(first, last - first + 1);
}

double NumberReader::number(const std::string& what) {
    for (; at_ < text_.size(); ++at_) {
        const char c = text_[at_];
        if (c == '\n')
            ++line_;
        else if (c != ' ' && c != '\t' && c != '\r' && c != ',' && c != '\0' && c != 0x1a)
            break;
    }
    if (at_end()) fail("the file ends before " + what);
    const size_t end = std::min(text_.find_first_of(" \t\r\n,", at_), text_.size());
    const char *first = text_.data() + at_ + (text_[at_] == '+' ? 1 : 0), *last = text_.data() + end;
    double value = 0;
    const std::from_chars_result result = std::from_chars(first, last, value);
    if (result.ec != std::errc() || result.ptr != last || !std::isfinite(value))
        fail(what + ": \"" + text_.substr(at_, std::min<size_t>(end - at_, 20)) + "\" is not a number");
    at_ = end;
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

}  // namespace lw
