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

/// Opens standard streams that are closed to /dev/null. open() takes the lowest free number, so files opened later get
/// numbers above these three.
void open_closed_streams() {
    for (int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (fcntl(stream, F_GETFD) < 0 && errno == EBADF) [[maybe_unused]]
            const int opened = open("/dev/null", stream == STDIN_FILENO ? O_RDONLY : O_WRONLY);
}

int fail(const char* program, const std::string& what) {
    std::fprintf(stderr, "%s: %s\n", program, one_line(what).c_str());
    return 1;
}

/// True when all printed text was written to stdout without an error.
bool has_printed() { return std::cout.flush().good() && std::fflush(stdout) == 0 && std::ferror(stdout) == 0; }

}  // namespace

int run_program(const char* program, const std::function<void()>& work) {
    open_closed_streams();
    std::signal(SIGXFSZ, SIG_IGN);  // a write beyond the limit of file sizes then fails like one to a full disk
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
