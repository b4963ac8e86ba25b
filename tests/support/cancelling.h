// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/error.h>
#include <lacuna/core/run_context.h>

#include <atomic>
#include <chrono>
#include <ctime>
#include <functional>
#include <optional>
#include <thread>

namespace lacuna::test {

/// By a clock of the system [s].
template <clockid_t kClock>
double clock_time()
{
    timespec now{};
    clock_gettime(kClock, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

constexpr auto wall_time = &clock_time<CLOCK_MONOTONIC>;
constexpr auto processor_time = &clock_time<CLOCK_PROCESS_CPUTIME_ID>; ///< of the whole process

/// How long work goes on once it is asked to stop, so long after it began [s], both by the same clock.
/// Nothing where it ended before that, or took no notice.
inline std::optional<double> stops_after(double seconds, double (*clock)(), RunContext context,
                                         const std::function<void(const RunContext&)>& work)
{
    std::atomic<bool> cancel{false}, over{false};
    double asked = 0;
    const double begun = clock();
    std::thread host([&] {
        while (!over && clock() - begun < seconds) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        asked = clock();
        cancel = true;
    });
    context.cancel = &cancel;
    bool stopped = false;
    try {
        work(context);
    } catch (const Cancelled&) {
        stopped = true;
    }
    const double ended = clock();
    over = true;
    host.join();
    if (!stopped) return std::nullopt;
    return ended - asked;
}

/// The same by the clock on the wall.
inline std::optional<double> stops_within(std::chrono::milliseconds wait,
                                          const std::function<void(const RunContext&)>& work)
{
    return stops_after(std::chrono::duration<double>(wait).count(), wall_time, {}, work);
}

/// Whether work that is cancelled before it begins says so.
inline bool heeds_cancel(const std::function<void(const RunContext&)>& work)
{
    const std::atomic<bool> cancel{true};
    RunContext context;
    context.cancel = &cancel;
    try {
        work(context);
    } catch (const Cancelled&) {
        return true;
    }
    return false;
}

} // namespace lacuna::test
