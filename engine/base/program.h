// What every main does around its work: streams that exist, Ctrl-C, one line for what goes wrong, the exit status.
#pragma once
#include <functional>

namespace lw {

/// Does the work and returns the exit status of the program: 0, or 1 after one line "PROGRAM: what" on stderr, which is
/// also told when what was printed could not be written (a full disk). Standard streams that were closed lead to
/// /dev/null, so that no file that the work opens takes their place.
int run_program(const char* program, const std::function<void()>& work);

}  // namespace lw
