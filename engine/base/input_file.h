// A file to read, and nothing that would be waited for.
#pragma once
#include <filesystem>
#include <fstream>

namespace lw {

/// A stream to read the bytes of `path`; a failed one when there is no such file or when it is something else (a
/// folder, a device, a pipe that nobody writes to).
inline std::ifstream open_input(const std::filesystem::path& path, std::ios::openmode more = {}) {
    std::error_code failure;
    std::ifstream stream;
    if (std::filesystem::is_regular_file(path, failure))
        stream.open(path, std::ios::binary | more);
    else
        stream.setstate(std::ios::failbit);
    return stream;
}

}  // namespace lw
