// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>

#include <cstddef>
#include <functional>

namespace lacuna {

/// Largest number of threads: larger than the core count of any supported machine, and far below the thread
/// limit of an operating system.
inline constexpr int kMostThreads = 1024;

/// Run `body(begin, end)` over [0, count), divided into ranges of at least `grain`, on the threads of the
/// context.
///
/// The ranges depend only on `count`, `grain` and the number of threads. A body that writes only to its own
/// indices gives the same result for any number of threads. If the system cannot create all the threads, the
/// available ones do all the work.
/// @throw the first exception of a body, after all threads have stopped; Cancelled between ranges.
void parallel_for(const RunContext& context, std::size_t count, std::size_t grain,
                  const std::function<void(std::size_t, std::size_t)>& body);

/// As `parallel_for()`, with `body(i)` for each index.
template <class Body>
void parallel_each(const RunContext& context, std::size_t count, std::size_t grain, const Body& body)
{
    parallel_for(context, count, grain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) body(i);
    });
}

/// The smallest value of `least_of(begin, end)` over the ranges of [0, count), `grain` indices each, in
/// parallel. Returns `none` if there are no ranges or no value is smaller.
/// @throw  as `parallel_for()`
double parallel_min(const RunContext& context, std::size_t count, std::size_t grain, double none,
                    const std::function<double(std::size_t, std::size_t)>& least_of);

} // namespace lacuna
