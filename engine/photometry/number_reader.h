// Numbers of a text file one after the other, each error naming file and line.
#pragma once
#include <string>
#include <vector>

namespace lw {

class NumberReader {
  public:
    NumberReader(const std::string& text, const std::string& name);

    /// The rest of the present line, without blanks at its ends; throws Error at the end of the file.
    std::string line(const std::string& what);
    /// The next number, over blanks, commas and line ends.
    double number(const std::string& what);
    /// The next number, which must be whole and within the bounds.
    size_t count(const std::string& what, size_t least, size_t most);
    /// `count` finite numbers; with `rising` each larger than the one before.
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
