// SPDX-License-Identifier: MIT
#pragma once

/// What code needs that is compiled for more than one processor, the widest of which is chosen when it runs.

/// A body that is compiled into each caller, for the processor of that caller.
#if defined(__GNUC__)
#define LACUNA_INLINE [[gnu::always_inline]] inline
#else
#define LACUNA_INLINE inline
#endif

/// Whether functions may be compiled for wider vectors than all processors have: `[[gnu::target("avx2")]]`.
#if defined(__GNUC__) && defined(__x86_64__)
#define LACUNA_WIDER_VECTORS
#endif

namespace lacuna {

/// Four numbers; the processor takes two or four at a time. They may lie anywhere.
using Four = double __attribute__((vector_size(32), aligned(8)));
/// Two, which processors without wider vectors take at a time.
using Two = double __attribute__((vector_size(16), aligned(8)));

#if defined(LACUNA_WIDER_VECTORS)
inline bool has_avx2()
{
    static const bool found = __builtin_cpu_supports("avx2") != 0;
    return found;
}

/// With its doublewords and quadwords.
inline bool has_avx512()
{
    static const bool found = __builtin_cpu_supports("avx512f") != 0 &&
                              __builtin_cpu_supports("avx512dq") != 0;
    return found;
}
#endif

} // namespace lacuna
