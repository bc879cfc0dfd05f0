#include "app/window/clipboard.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "base/error.h"
#include "image/png.h"

namespace lw {
namespace {

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

/// Runs a program with these bytes as its input. Returns true when it ended with status 0, false also when there is no
/// such program.
bool run_with_input(std::vector<std::string> arguments, const std::vector<uint8_t>& bytes) {
    const File input(std::tmpfile(), std::fclose);
    if (!input || std::fwrite(bytes.data(), 1, bytes.size(), input.get()) != bytes.size()) return false;
    std::rewind(input.get());
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, fileno(input.get()), STDIN_FILENO);
    for (int stream : {STDOUT_FILENO, STDERR_FILENO})  // it lives on after lumenwalk, and must not keep its output open
        posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", O_WRONLY, 0);
    pid_t process = 0;
    const int failure = posix_spawnp(&process, argv[0], &actions, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    int status = 0;
    return failure == 0 && waitpid(process, &status, 0) == process && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace

void copy_to_clipboard(const Rgb8Image& image) {
    const std::vector<uint8_t> png = encode_png(image);
    const bool wayland = std::getenv("WAYLAND_DISPLAY") != nullptr;
    if (wayland && run_with_input({"wl-copy", "--type", "image/png"}, png)) return;
    if (run_with_input({"xclip", "-selection", "clipboard", "-t", "image/png", "-i"}, png)) return;
    throw Error(std::string("clipboard: install ") + (wayland ? "wl-clipboard" : "xclip") +
                " to copy; F2 saves a file");
}

}  // namespace lw
