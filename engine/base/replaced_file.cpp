#include "base/replaced_file.h"

#include <unistd.h>

#include <atomic>
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

}  // namespace

ReplacedFile::ReplacedFile(const std::filesystem::path& path) : path_(path), partial_(partial_name(path)) {
    std::error_code failure;
    if (std::filesystem::is_directory(path_, failure)) throw Error(path_.string() + ": is a folder, not a file");
    remove_on_interrupt(partial_);
    stream_.open(partial_, std::ios::binary | std::ios::trunc);
    if (stream_) return;
    keep_on_interrupt(partial_);
    throw Error(path_.string() + ": cannot be created here; choose another place with -o");
}

ReplacedFile::~ReplacedFile() {
    if (committed_) return;
    stream_.close();
    std::error_code ignored;
    std::filesystem::remove(partial_, ignored);
    keep_on_interrupt(partial_);
}

void ReplacedFile::commit() {
    stream_.close();
    if (!stream_) throw Error(path_.string() + ": cannot be written to its end (is the disk full?)");
    std::error_code failure;
    std::filesystem::rename(partial_, path_, failure);
    if (failure) throw Error(path_.string() + ": cannot be replaced: " + failure.message());
    committed_ = true;
    keep_on_interrupt(partial_);
}

void check_can_create(const std::filesystem::path& path, std::initializer_list<std::filesystem::path> inputs) {
    for (const std::filesystem::path& input : inputs) {
        std::error_code ignored;
        if (std::filesystem::equivalent(path, input, ignored))
            throw Error(path.string() + ": is an input of this program; choose another place with -o");
    }
    const ReplacedFile unused(path);
}

}  // namespace lw
