#include "base/memory.h"

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>

#include "base/error.h"

namespace lw {
namespace {

constexpr uint64_t unknown = std::numeric_limits<uint64_t>::max();

/// The number that a file holds; nothing when the file is missing or holds a word such as "max".
std::optional<uint64_t> number_in(const std::filesystem::path& path) {
    std::ifstream stream(path);
    uint64_t number = 0;
    return stream >> number ? std::optional(number) : std::nullopt;
}

uint64_t available_in_system() {
    std::ifstream stream("/proc/meminfo");
    std::string name, unit;
    for (uint64_t kibibytes; stream >> name >> kibibytes; std::getline(stream, unit))
        if (name == "MemAvailable:") return kibibytes * 1024;
    return unknown;
}

/// The bytes that the memory limits of the process's control group, and of the groups above it, still allow (cgroup
/// version 2).
uint64_t available_in_groups() {
    std::ifstream stream("/proc/self/cgroup");
    std::string line;
    while (std::getline(stream, line) && !line.starts_with("0::")) {
    }
    uint64_t least = unknown;
    if (!line.starts_with("0::/")) return least;
    const std::filesystem::path root = "/sys/fs/cgroup";
    for (auto group = root / line.substr(4);; group = group.parent_path()) {
        const auto limit = number_in(group / "memory.max"), used = number_in(group / "memory.current");
        if (limit && used) least = std::min(least, *limit - std::min(*limit, *used));
        if (group.string().size() <= root.string().size()) return least;
    }
}

/// The value of a line such as "VmRSS: 1234 kB" in /proc/self/status, in bytes; 0 when there is no line of that name.
uint64_t bytes_of_process(const std::string& wanted) {
    std::ifstream stream("/proc/self/status");
    std::string name, unit;
    while (stream >> name) {
        uint64_t kibibytes = 0;
        if (name == wanted && stream >> kibibytes) return kibibytes * 1024;
        std::getline(stream, unit);
    }
    return 0;
}

uint64_t available_addresses() {
    rlimit limit{};
    if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return unknown;
    return limit.rlim_cur - std::min<uint64_t>(limit.rlim_cur, bytes_of_process("VmSize:"));
}

}  // namespace

uint64_t available_memory() { return std::min({available_in_system(), available_in_groups(), available_addresses()}); }

uint64_t resident_memory() { return bytes_of_process("VmRSS:"); }

uint64_t peak_memory() { return bytes_of_process("VmHWM:"); }

std::string bytes_text(uint64_t bytes) {
    char text[32];
    if (bytes >= 1'000'000'000)
        std::snprintf(text, sizeof text, "%.1f GB", double(bytes) / 1e9);
    else
        std::snprintf(text, sizeof text, "%.0f MB", double(bytes) / 1e6);
    return text;
}

void check_picture_fits(uint64_t width, uint64_t height, uint64_t bytes_per_pixel, uint64_t available) {
    const uint64_t bytes = width * height * bytes_per_pixel;
    if (bytes <= available) return;
    const double share = std::sqrt(double(available) / double(bytes));
    const auto size = [](double w, double h) {
        return std::to_string(uint64_t(w)) + "x" + std::to_string(uint64_t(h));
    };
    throw Error("a picture of " + size(double(width), double(height)) + " takes about " + bytes_text(bytes) +
                " of memory, there are " + bytes_text(available) + "; " +
                size(share * double(width), share * double(height)) + " would fit");
}

}  // namespace lw
