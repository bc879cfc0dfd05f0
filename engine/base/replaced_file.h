// A file that appears complete or not at all. It is written beside its place and then renamed. While it is written it
// has no name (O_TMPFILE), so that nothing is left when the process is killed; on file systems without such files it
// has a name with the number of the process.
#pragma once
#include <filesystem>
#include <fstream>
#include <span>

namespace lw {

/// An open stream to a file beside `path`. commit() moves the file to `path`; without it the destructor removes the
/// file, as does Ctrl-C (base/interrupt.h). Two processes may write the same path at once: the last to commit wins.
/// Throws Error naming `path` when that is a folder, a device or a pipe, and when the file cannot be created, written
/// to its end, or renamed.
class ReplacedFile {
  public:
    explicit ReplacedFile(const std::filesystem::path& path, bool nameless = true);
    ReplacedFile(const ReplacedFile&) = delete;
    ReplacedFile& operator=(const ReplacedFile&) = delete;
    ~ReplacedFile();

    std::ofstream& stream() { return stream_; }

    void commit();

  private:
    bool open_nameless();
    void open_partial();

    std::filesystem::path path_;
    std::filesystem::path partial_;
    std::ofstream stream_;
    int nameless_ = -1;  // descriptor of the file when it has no name, else -1
    bool committed_ = false;
};

/// A check to make before long work whose result is written to `path`: throws what ReplacedFile would throw, and throws
/// Error when `path` is one of the `inputs`, which would be overwritten. Leaves no file.
void check_can_create(const std::filesystem::path& path, std::span<const std::filesystem::path> inputs = {});

/// Throws Error when two of the paths are the same file. Empty paths stand for outputs that are not written and are
/// skipped.
void check_different(std::span<const std::filesystem::path> outputs);

}  // namespace lw
