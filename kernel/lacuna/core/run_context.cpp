// SPDX-License-Identifier: MIT
#include <lacuna/core/run_context.h>

#include <lacuna/core/error.h>

#include <algorithm>
#include <thread>

namespace lacuna {

namespace {

/// More threads than this are asked for by mistake unless there are as many cores: a choice, not a
/// measurement.
constexpr int kMostThreads = 64;

} // namespace

void check_cancelled(const RunContext& context)
{
    if (context.cancel != nullptr && context.cancel->load(std::memory_order_relaxed)) throw Cancelled();
}

int thread_count(const RunContext& context)
{
    // Asked once: the system reads a file for it, and small loops ask more often than they work.
    static const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    return context.threads > 0 ? std::min(context.threads, std::max(cores, kMostThreads)) : cores;
}

void log_line(const RunContext& context, std::string_view line)
{
    if (context.log) context.log(line);
}

} // namespace lacuna
