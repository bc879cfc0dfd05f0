#include "base/memory.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>

namespace lw {
namespace {

constexpr uint64_t unknown = std::numeric_limits<uint64_t>::max();

/// The number in a file of one number; nothing for "max" or no file.
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

/// What the control group of the process and those above it leave (version 2 of the hierarchy).
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

}  // namespace

uint64_t available_memory() { return std::min(available_in_system(), available_in_groups()); }

uint64_t resident_memory() {
    std::ifstream stream("/proc/self/status");
    std::string name, unit;
    while (stream >> name) {
        uint64_t kibibytes = 0;
        if (name == "VmRSS:" && stream >> kibibytes) return kibibytes * 1024;
        std::getline(stream, unit);
    }
    return 0;
}

std::string bytes_text(uint64_t bytes) {
    char text[32];
    if (bytes >= 1'000'000'000)
        std::snprintf(text, sizeof text, "%.1f GB", double(bytes) / 1e9);
    else
        std::snprintf(text, sizeof text, "%.0f MB", double(bytes) / 1e6);
    return text;
}

}  // namespace lw
