// Compiles chosen functions once more for processors with AVX2.
#pragma once

/// Written before a function: the function is compiled for all x86-64 processors and once more for AVX2, and at its
/// start the program chooses what its processor has. Neither version fuses multiplications with additions, so both give
/// the same bits. Builds with sanitizers have one version only.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define LW_WIDE_VECTORS __attribute__((target_clones("avx2", "default")))
#else
#define LW_WIDE_VECTORS
#endif
