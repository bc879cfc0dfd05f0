#include "base/replaced_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <set>
#include <string>
#include <system_error>

#include "base/error.h"
#include "base/interrupt.h"

namespace lw {
namespace {

std::filesystem::path partial_name(const std::filesystem::path& path) {
    static std::atomic<unsigned> count{0};
    std::filesystem::path partial = path;
    return partial += ".partial-" + std::to_string(getpid()) + "-" + std::to_string(count++);
}

/// A path under which the file with this descriptor can be opened or linked.
std::string name_of(int file) { return "/proc/self/fd/" + std::to_string(file); }

}  // namespace

ReplacedFile::ReplacedFile(const std::filesystem::path& path, bool nameless)
    : path_(path), partial_(partial_name(path)) {
    std::error_code failure;
    const std::filesystem::file_status there = std::filesystem::status(path_, failure);
    if (std::filesystem::is_directory(there)) throw Error(path_.string() + ": is a folder, not a file");
    if (std::filesystem::exists(there) && !std::filesystem::is_regular_file(there))
        throw Error(path_.string() + ": is a device or a pipe, not a file");
    if (!path_.has_filename()) throw Error(path_.string() + ": is no name of a file");
    if (!nameless || !open_nameless()) open_partial();
}

bool ReplacedFile::open_nameless() {
    const std::filesystem::path folder = path_.has_parent_path() ? path_.parent_path() : ".";
    nameless_ = open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
    if (nameless_ < 0) return false;
    stream_.open(name_of(nameless_), std::ios::binary);
    if (stream_) return true;
    close(nameless_);
    nameless_ = -1;
    stream_.clear();
    return false;
}

void ReplacedFile::open_partial() {
    remove_on_interrupt(partial_);
    stream_.open(partial_, std::ios::binary | std::ios::trunc);
    if (stream_) return;
    keep_on_interrupt(partial_);
    throw Error(path_.string() + ": cannot be created here; choose another place with -o");
}

ReplacedFile::~ReplacedFile() {
    stream_.close();
    if (nameless_ >= 0) close(nameless_);
    if (committed_) return;
    std::error_code ignored;
    std::filesystem::remove(partial_, ignored);
    keep_on_interrupt(partial_);
}

void ReplacedFile::commit() {
    stream_.close();
    if (!stream_) throw Error(path_.string() + ": cannot be written to its end (is the disk full?)");
    if (nameless_ >= 0) {
        remove_on_interrupt(partial_);
        if (linkat(AT_FDCWD, name_of(nameless_).c_str(), AT_FDCWD, partial_.c_str(), AT_SYMLINK_FOLLOW) != 0)
            throw Error(path_.string() + ": cannot be created here: " + std::strerror(errno));
    }
    std::error_code failure;
    std::filesystem::rename(partial_, path_, failure);
    if (failure) throw Error(path_.string() + ": cannot be replaced: " + failure.message());
    committed_ = true;
    keep_on_interrupt(partial_);
}

void check_can_create(const std::filesystem::path& path, std::span<const std::filesystem::path> inputs) {
    for (const std::filesystem::path& input : inputs) {
        std::error_code ignored;  // an input that does not exist (yet) is no error here
        if (std::filesystem::equivalent(path, input, ignored) ||
            std::filesystem::weakly_canonical(path, ignored) == std::filesystem::weakly_canonical(input, ignored))
            throw Error(path.string() + ": is an input of this program; choose another name for what it writes");
    }
    const ReplacedFile unused(path);
}

void check_different(std::span<const std::filesystem::path> outputs) {
    std::set<std::filesystem::path> seen;
    for (const std::filesystem::path& output : outputs) {
        std::error_code ignored;
        if (!output.empty() && !seen.insert(std::filesystem::weakly_canonical(output, ignored)).second)
            throw Error(output.string() + ": would be written twice; give each output a name of its own");
    }
}

}  // namespace lw
