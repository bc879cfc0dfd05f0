// How much memory there is, asked before much of it is taken.
#pragma once
#include <cstdint>
#include <string>

namespace lw {

/// Bytes that this process may still take without swapping: what the system has available, or what its control group or
/// its limit of addresses (ulimit -v) leave when that is less. UINT64_MAX when the system does not tell.
uint64_t available_memory();

/// Bytes of memory that this process holds at the moment; 0 when the system does not tell.
uint64_t resident_memory();

/// The most it ever held; what a large process that started it holds does not count, as it does in getrusage(2).
uint64_t peak_memory();

/// "12 MB", "3.4 GB": powers of ten.
std::string bytes_text(uint64_t bytes);

/// Throws Error telling the size that would fit when a picture takes more than `available` bytes.
void check_picture_fits(uint64_t width, uint64_t height, uint64_t bytes_per_pixel, uint64_t available);

}  // namespace lw
