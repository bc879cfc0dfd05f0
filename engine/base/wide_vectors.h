// Loops that are compiled twice.
#pragma once

/// Before a function: its loops are compiled for all processors and once more for AVX2, and the program takes what its
/// processor has. Without fused operations both give the same bits. Sanitizers see one text only.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define LW_WIDE_VECTORS __attribute__((target_clones("avx2", "default")))
#else
#define LW_WIDE_VECTORS
#endif
