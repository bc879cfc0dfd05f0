// What the programs' one exception says, for tests of refusals.
#pragma once
#include <string>

#include "base/error.h"

namespace lw::test {

/// The message of the Error that `body` throws; "" when it throws none.
template <class Body>
std::string error_of(const Body& body) {
    try {
        body();
        return "";
    } catch (const Error& e) {
        return e.what();
    }
}

}  // namespace lw::test
