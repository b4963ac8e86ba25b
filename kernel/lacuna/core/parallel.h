// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>

#include <cstddef>
#include <functional>

namespace lacuna {

/// Run `body(begin, end)` over [0, count) cut into ranges of at least `grain`, on the context's threads.
///
/// The ranges depend on `count`, `grain` and the number of threads alone; a body that writes only what
/// belongs to its own indices gives the same result for any number of threads.
/// Where the system gives fewer threads than asked for, those there are do the work.
/// @throw the first exception of a body, after every thread has stopped; Cancelled between ranges.
void parallel_for(const RunContext& context, std::size_t count, std::size_t grain,
                  const std::function<void(std::size_t, std::size_t)>& body);

/// The least of `least_of(begin, end)` over ranges of [0, count) of `grain` each, found on the context's
/// threads; `none` where there are no ranges, or where that is less.
/// @throw as `parallel_for()`
double parallel_min(const RunContext& context, std::size_t count, std::size_t grain, double none,
                    const std::function<double(std::size_t, std::size_t)>& least_of);

} // namespace lacuna
