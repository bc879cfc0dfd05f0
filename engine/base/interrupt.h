// Ctrl-C and kill: the process ends at once, by the signal itself, and leaves no half-written file.
#pragma once
#include <filesystem>

namespace lw {

/// From now on SIGINT, SIGTERM and SIGHUP remove the files of remove_on_interrupt(), say one line to stderr and end the
/// process by the signal: the shell sees 130, 143 or 129. A signal that is ignored (nohup) stays so.
void watch_for_interrupt();

/// Registers a half-written file, to be removed when a watched signal arrives. Up to 16 files can be registered at a
/// time; further ones are ignored and would stay on disk.
void remove_on_interrupt(const std::filesystem::path& path);

/// Takes a file off that list, once it is complete or removed.
void keep_on_interrupt(const std::filesystem::path& path);

}  // namespace lw
