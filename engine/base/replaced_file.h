// A file that appears whole or not at all: written beside its place without a name, so that nothing stays behind when
// the process is killed; where the file system has no such files, under a name of this process. Then renamed.
#pragma once
#include <filesystem>
#include <fstream>
#include <span>

namespace lw {

/// An open stream to a file beside `path`; commit() moves it into place, otherwise the destructor removes it, or
/// Ctrl-C does (base/interrupt.h). Two writers of one path do not meet: the last to commit wins.
/// Throws Error naming the file when it is something else than a file (a folder, a device, a pipe), and when it cannot
/// be created, written to the end, or renamed.
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
    int nameless_ = -1;  // what stream_ writes to as well, when it has no name
    bool committed_ = false;
};

/// Throws what ReplacedFile would throw for `path`, before long work whose result shall lie there, and when `path` is
/// one of the `inputs`, which the work would destroy. Leaves no trace.
void check_can_create(const std::filesystem::path& path, std::span<const std::filesystem::path> inputs = {});

/// Throws when two of the outputs of a program, those that are not empty, are one file.
void check_different(std::span<const std::filesystem::path> outputs);

}  // namespace lw
