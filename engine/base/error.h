// The one exception of Lumenwalk: bad input or environment, told in one line "where: what".
// A programmer's mistake is an assert, never an Error.
#pragma once
#include <stdexcept>
#include <string>

namespace lw {

struct Error : std::runtime_error {
    using std::runtime_error::runtime_error;
};

}  // namespace lw
