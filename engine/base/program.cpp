#include "base/program.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <iostream>
#include <new>
#include <string>

#include "base/interrupt.h"
#include "base/one_line.h"

namespace lw {
namespace {

/// The lowest free number is what open() takes: the files of the work come after the three.
void open_closed_streams() {
    for (int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (fcntl(stream, F_GETFD) < 0 && errno == EBADF) [[maybe_unused]]
            const int opened = open("/dev/null", stream == STDIN_FILENO ? O_RDONLY : O_WRONLY);
}

int fail(const char* program, const std::string& what) {
    std::fprintf(stderr, "%s: %s\n", program, one_line(what).c_str());
    return 1;
}

/// Whether all that was printed has left the program.
bool has_printed() { return std::cout.flush().good() && std::fflush(stdout) == 0 && std::ferror(stdout) == 0; }

}  // namespace

int run_program(const char* program, const std::function<void()>& work) {
    open_closed_streams();
    std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is told like a full disk
    watch_for_interrupt();
    try {
        work();
    } catch (const std::bad_alloc&) {
        return fail(program, "not enough memory");
    } catch (const std::exception& failure) {
        return fail(program, failure.what());
    }
    return has_printed() ? 0 : fail(program, std::string("what was printed is lost: ") + std::strerror(errno));
}

}  // namespace lw
