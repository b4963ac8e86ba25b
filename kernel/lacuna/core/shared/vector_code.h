// SPDX-License-Identifier: MIT
#pragma once

/// Macros and types for functions compiled for several instruction sets; the widest is chosen at run time.

/// A function that is inlined into each caller, and so compiled for the instruction set of the caller.
#if defined(__GNUC__)
#define LACUNA_INLINE [[gnu::always_inline]] inline
#else
#define LACUNA_INLINE inline
#endif

/// Whether the compiler can compile single functions for wider vectors: `[[gnu::target("avx2")]]`.
#if defined(__GNUC__) && defined(__x86_64__)
#define LACUNA_WIDER_VECTORS
#endif

namespace lacuna {

/// Four doubles, processed two or four at a time by the processor. May be unaligned.
using Four = double __attribute__((vector_size(32), aligned(8)));
/// Two doubles: one vector of the baseline instruction set.
using Two = double __attribute__((vector_size(16), aligned(8)));

#if defined(LACUNA_WIDER_VECTORS)
inline bool has_avx2()
{
    static const bool found = __builtin_cpu_supports("avx2") != 0;
    return found;
}

/// Whether the processor has AVX-512 with its DQ (doubleword and quadword) instructions.
inline bool has_avx512()
{
    static const bool found = __builtin_cpu_supports("avx512f") != 0 &&
                              __builtin_cpu_supports("avx512dq") != 0;
    return found;
}
#endif

} // namespace lacuna
