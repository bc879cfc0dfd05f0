// How much memory the process may use and uses, for checks before large allocations.
#pragma once
#include <cstdint>
#include <string>

namespace lw {

/// Bytes that this process may still take without swapping: what the system has available, or what its control group or
/// its limit of addresses (ulimit -v) leave when that is less. UINT64_MAX when the system does not tell.
uint64_t available_memory();

/// Bytes of memory that this process holds at the moment; 0 when the system does not tell.
uint64_t resident_memory();

/// The most bytes this process ever held. Unlike getrusage(2), it does not count what the process that started it held.
uint64_t peak_memory();

/// A size for messages: "12 MB", "3.4 GB". A megabyte is 10^6 bytes.
std::string bytes_text(uint64_t bytes);

/// Throws Error when a picture of width x height pixels takes more than `available` bytes. The message says which size
/// would fit.
void check_picture_fits(uint64_t width, uint64_t height, uint64_t bytes_per_pixel, uint64_t available);

}  // namespace lw
