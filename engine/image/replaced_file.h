// A file that appears whole or not at all: written beside its place, then renamed.
#pragma once
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>

#include "base/error.h"

namespace lw {

/// An open stream to `path` + ".partial"; commit() moves it into place, otherwise the destructor removes it.
/// Throws Error naming the file when it cannot be created, written to the end, or renamed.
class ReplacedFile {
  public:
    explicit ReplacedFile(const std::filesystem::path& path) : path_(path), partial_(path.string() + ".partial") {
        std::error_code ignored;
        if (std::filesystem::is_directory(path_, ignored)) throw Error(path_.string() + ": is a folder, not a file");
        stream_.open(partial_, std::ios::binary | std::ios::trunc);
        if (!stream_) throw Error(path_.string() + ": cannot be created");
    }
    ReplacedFile(const ReplacedFile&) = delete;
    ReplacedFile& operator=(const ReplacedFile&) = delete;
    ~ReplacedFile() {
        if (committed_) return;
        stream_.close();
        std::error_code ignored;
        std::filesystem::remove(partial_, ignored);
    }

    std::ofstream& stream() { return stream_; }

    void commit() {
        stream_.close();
        if (!stream_) throw Error(path_.string() + ": cannot be written (is the disk full?)");
        std::error_code failure;
        std::filesystem::rename(partial_, path_, failure);
        if (failure) throw Error(path_.string() + ": cannot be replaced: " + failure.message());
        committed_ = true;
    }

  private:
    std::filesystem::path path_;
    std::filesystem::path partial_;
    std::ofstream stream_;
    bool committed_ = false;
};

/// Throws what ReplacedFile would throw for `path`, before long work whose result shall lie there. Leaves no trace.
inline void check_can_create(const std::filesystem::path& path) { const ReplacedFile unused(path); }

}  // namespace lw
