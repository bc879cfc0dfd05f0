// Reads the numbers of a text file one after the other. Every error names the file and the line.
#pragma once
#include <string>
#include <vector>

namespace lw {

class NumberReader {
  public:
    /// `bytes` as the file has them (plain_text.h); `name` begins every message.
    NumberReader(const std::string& bytes, std::string name);

    /// The rest of the current line, without blanks at its ends. `what` names the expected value in messages, here and
    /// below. Throws Error at the end of the file.
    std::string line(const std::string& what);
    /// The next number; blanks, commas and line ends before it are skipped.
    double number(const std::string& what);
    /// The next number, which must be whole and in [least, most].
    size_t count(const std::string& what, size_t least, size_t most);
    /// The next `count` numbers, all finite. With `rising` each must be larger than the one before.
    std::vector<double> numbers(const std::string& what, size_t count, bool rising = false);
    bool at_end() const { return at_ >= text_.size(); }
    const std::string& name() const { return name_; }

    /// Whether a comma stood between two numbers without a blank: it may have been a decimal point.
    bool met_glued_commas() const { return glued_commas_; }
    /// Begins anew; commas within numbers are decimal points from here on.
    void start_over_with_decimal_commas();
    /// "" when only blanks follow, else what follows in a few words, with its line.
    std::string left_over();

    /// Throws Error("NAME: line N: what").
    [[noreturn]] void fail(const std::string& what) const;

  private:
    void skip_blanks();
    /// The characters up to the next blank or, unless it is a decimal point, comma.
    std::string next_word();

    std::string text_, name_;
    size_t at_ = 0, line_ = 1;
    bool decimal_commas_ = false, glued_commas_ = false;
};

}  // namespace lw
