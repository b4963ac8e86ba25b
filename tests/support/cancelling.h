// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/error.h>
#include <lacuna/core/run_context.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <optional>
#include <thread>

namespace lacuna::test {

/// How long work goes on once it is asked to stop [s]; nothing where it ended before that, or took no notice.
inline std::optional<double> stops_within(std::chrono::milliseconds wait,
                                          const std::function<void(const RunContext&)>& work)
{
    using Clock = std::chrono::steady_clock;
    std::atomic<bool> cancel{false};
    Clock::time_point asked;
    std::thread host([&] {
        std::this_thread::sleep_for(wait);
        asked = Clock::now();
        cancel = true;
    });
    RunContext context;
    context.cancel = &cancel;
    bool stopped = false;
    try {
        work(context);
    } catch (const Cancelled&) {
        stopped = true;
    }
    const Clock::time_point ended = Clock::now();
    host.join();
    if (!stopped) return std::nullopt;
    return std::chrono::duration<double>(ended - asked).count();
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
