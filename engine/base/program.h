// What every main does around its work: standard streams that are open, Ctrl-C, one line for an error, the exit status.
#pragma once
#include <functional>

namespace lw {

/// Calls work() and returns the exit status of the program: 0, or 1 after the line "PROGRAM: what went wrong" on
/// stderr. Output that could not be written (a full disk) counts as an error. Standard streams that are closed are
/// opened to /dev/null first, so that no file opened by the work gets their number and their output.
int run_program(const char* program, const std::function<void()>& work);

}  // namespace lw
