#include "photometry/lamp_color.h"

#include <array>
#include <cctype>
#include <vector>

#include "photometry/plain_text.h"

namespace lw {
namespace {

constexpr double lowest = 1000, highest = 1e5;  // K

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// The whole numbers in a text; of decimal fractions the whole part.
std::vector<double> whole_numbers(const std::string& text) {
    std::vector<double> numbers;
    for (size_t i = 0; i < text.size(); ++i) {
        const size_t start = i;
        double value = 0;
        for (; i < text.size() && is_digit(text[i]); ++i) value = 10 * value + (text[i] - '0');
        const bool fraction = start > 1 && text[start - 1] == '.' && is_digit(text[start - 2]);
        if (i > start && !fraction) numbers.push_back(value);
    }
    return numbers;
}

/// Of "830" and the like; 0 for a number that is none.
double temperature_of_code(double code) {
    if (code < 500 || code >= 1000) return 0;
    const int hundreds = int(code) % 100;
    return hundreds >= 18 ? 100.0 * hundreds : 0;
}

double temperature_of_words(const std::string& upper) {
    struct Class {
        const char *beginning, *letters;
        double kelvin;
    };
    static constexpr std::array<Class, 5> classes{{{"WARM", "WW", 3000},
                                                   {"NEUTRAL", "NW", 4000},
                                                   {"COOL", "CW", 6500},
                                                   {"DAYLIGHT", "DW", 6500},
                                                   {"TAGESLICHT", "TW", 6500}}};
    std::string word;
    for (size_t i = 0; i <= upper.size(); ++i) {
        if (i < upper.size() && std::isalpha(static_cast<unsigned char>(upper[i]))) {
            word += upper[i];
            continue;
        }
        for (const Class& c : classes)
            if (word == c.letters || word.starts_with(c.beginning)) return c.kelvin;
        word.clear();
    }
    return 0;
}

}  // namespace

double temperature_of(const std::string& text) {
    const std::vector<double> numbers = whole_numbers(text);
    for (const double number : numbers)
        if (number >= lowest && number < highest) return number;
    for (const double number : numbers)
        if (const double kelvin = temperature_of_code(number)) return kelvin;
    return temperature_of_words(upper_case(text));
}

}  // namespace lw
