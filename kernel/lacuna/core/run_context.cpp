// SPDX-License-Identifier: MIT
#include <lacuna/core/run_context.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/parallel.h>

#include <algorithm>
#include <thread>

namespace lacuna {

void check_cancelled(const RunContext& context)
{
    if (context.cancel != nullptr && context.cancel->load(std::memory_order_relaxed)) throw Cancelled();
}

int thread_count(const RunContext& context)
{
    // The number of cores is queried only if it is needed: the query takes longer than a small loop.
    if (context.threads > 0) return std::min(context.threads, kMostThreads);
    return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

void log_line(const RunContext& context, std::string_view line)
{
    if (context.log) context.log(line);
}

} // namespace lacuna
