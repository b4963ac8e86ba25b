// SPDX-License-Identifier: MIT
#pragma once

/// Macros and types for functions that are compiled for several instruction sets. At run time, the version
/// for the widest vectors that the processor supports is called.

/// LACUNA_INLINE: a function that is inlined into each caller, and so compiled for the caller's instruction
/// set. LACUNA_INLINE_BODY: the same for a lambda, written after its parameters.
#if defined(__GNUC__)
#define LACUNA_INLINE [[gnu::always_inline]] inline
#define LACUNA_INLINE_BODY __attribute__((always_inline))
#else
#define LACUNA_INLINE inline
#define LACUNA_INLINE_BODY
#endif

/// Whether the compiler can compile single functions for wider vectors: `[[gnu::target("avx2")]]`.
#if defined(__GNUC__) && defined(__x86_64__)
#define LACUNA_WIDER_VECTORS
#endif

namespace lacuna {

/// Four doubles, processed two or four at a time by the processor. May be unaligned.
using Four = double __attribute__((vector_size(32), aligned(8)));

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

template <class Body>
[[gnu::target("avx2")]] auto in_avx2(const Body& body)
{
    return body();
}

template <class Body>
[[gnu::target("avx512f,avx512dq")]] auto in_avx512(const Body& body)
{
    return body();
}
#endif

/// Call `body`: the version compiled for AVX2 if the processor has it, otherwise the plain version. Results
/// of both versions are the same bit for bit.
/// @param body  a lambda marked LACUNA_INLINE_BODY, which calls LACUNA_INLINE functions.
template <class Body>
auto with_avx2(const Body& body)
{
#if defined(LACUNA_WIDER_VECTORS)
    if (has_avx2()) return in_avx2(body);
#endif
    return body();
}

/// As `with_avx2()`, but with the version for AVX-512 if the processor has it.
template <class Body>
auto with_avx512(const Body& body)
{
#if defined(LACUNA_WIDER_VECTORS)
    if (has_avx512()) return in_avx512(body);
#endif
    return with_avx2(body);
}

} // namespace lacuna
