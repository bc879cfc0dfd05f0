// Opens files for reading. Only regular files are opened, so that no program waits for a pipe or a device.
#pragma once
#include <filesystem>
#include <fstream>

namespace lw {

/// Opens `path` for reading in binary mode, with the flags `more` added. The stream is in the failed state when there
/// is no such file, or when it is a folder, a device or a pipe.
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
