// Ctrl-C and kill: the process ends at once, by the signal itself, and leaves no half-written file.
#pragma once
#include <filesystem>

namespace lw {

/// From now on SIGINT, SIGTERM and SIGHUP remove the files of remove_on_interrupt(), say one line to stderr and end the
/// process by the signal: the shell sees 130, 143 or 129. A signal that is ignored (nohup) stays so.
void watch_for_interrupt();

/// The file is half written: it goes when a watched signal arrives. At most 16 at a time; the rest stay.
void remove_on_interrupt(const std::filesystem::path& path);

/// The file is whole or gone.
void keep_on_interrupt(const std::filesystem::path& path);

}  // namespace lw
