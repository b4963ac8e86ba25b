// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <functional>
#include <string_view>

namespace lacuna {

/// How long work is run and watched; every member may stay at its default. Not owned by the kernel.
struct RunContext {
    int threads = 0;                                        ///< 0 or less: all cores; see thread_count()
    const std::atomic<bool>* cancel = nullptr;              ///< set by the host to stop the work
    std::function<void(std::string_view)> log;              ///< notes for a person, a line each
    std::function<void(std::string_view, double)> progress; ///< stage, fraction in [0, 1]
};

/// @throw Cancelled when the host asked for it.
void check_cancelled(const RunContext& context);

/// Number of threads the context means: at least 1, and no more than 64 or the number of cores.
int thread_count(const RunContext& context);

/// Hand a line to the context's log, if it has one.
void log_line(const RunContext& context, std::string_view line);

} // namespace lacuna
