// Reads the numbers of a text file one after the other. Every error names the file and the line.
#pragma once
#include <string>
#include <vector>

namespace lw {

class NumberReader {
  public:
    NumberReader(const std::string& text, const std::string& name);

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
    /// Throws Error("NAME: line N: what").
    [[noreturn]] void fail(const std::string& what) const;

  private:
    const std::string& text_;
    std::string name_;
    size_t at_ = 0, line_ = 1;
};

}  // namespace lw
