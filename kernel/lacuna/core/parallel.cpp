// SPDX-License-Identifier: MIT
#include <lacuna/core/shared/parallel.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace lacuna {

void parallel_for(const RunContext& context, std::size_t count, std::size_t grain,
                  const std::function<void(std::size_t, std::size_t)>& body)
{
    if (count == 0) return;
    grain = std::max<std::size_t>(grain, 1);
    // Ask for the number of cores only if there is work for two threads.
    const std::size_t most = count / grain;
    const std::size_t threads = most < 2 ? 1
                                         : std::min(most, static_cast<std::size_t>(thread_count(context)));

    std::atomic<std::size_t> next{0};
    std::atomic<bool> stop{false};
    std::exception_ptr failure;
    std::mutex failure_lock;
    const auto work = [&] {
        try {
            while (!stop) {
                const std::size_t begin = next.fetch_add(grain);
                if (begin >= count) return;
                check_cancelled(context);
                body(begin, std::min(begin + grain, count));
            }
        } catch (...) {
            const std::lock_guard<std::mutex> hold(failure_lock);
            if (!failure) failure = std::current_exception();
            stop = true;
        }
    };

    std::vector<std::thread> helpers;
    helpers.reserve(threads - 1);
    try {
        for (std::size_t i = 1; i < threads; ++i) helpers.emplace_back(work);
    } catch (const std::system_error&) {
        // The system cannot create more threads: this thread and those created so far do all the work.
    }
    work();
    for (std::thread& helper : helpers) helper.join();
    if (failure) std::rethrow_exception(failure);
}

double parallel_min(const RunContext& context, std::size_t count, std::size_t grain, double none,
                    const std::function<double(std::size_t, std::size_t)>& least_of)
{
    grain = std::max<std::size_t>(grain, 1);
    std::vector<double> least((count + grain - 1) / grain, none);
    parallel_for(context, count, grain, [&](std::size_t begin, std::size_t end) {
        least[begin / grain] = std::min(none, least_of(begin, end));
    });
    return least.empty() ? none : *std::min_element(least.begin(), least.end());
}

} // namespace lacuna
