// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>

#include <chrono>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>

namespace lacuna::lua {

/// Seconds spent in each stage of the kernel.
using StageSeconds = std::map<std::string, double>;

/// Measures the stages that a context's progress reports, and passes the reports on. The destructor restores
/// the context.
class StageClock {
public:
    explicit StageClock(RunContext& context) : context_(context), passed_on_(std::move(context.progress))
    {
        context_.progress = [this](std::string_view stage, double share) {
            add();
            stage_ = stage;
            if (passed_on_) passed_on_(stage, share);
        };
    }
    ~StageClock() { context_.progress = std::move(passed_on_); }
    StageClock(const StageClock&) = delete;
    StageClock& operator=(const StageClock&) = delete;

    /// The seconds of all stages so far.
    StageSeconds seconds()
    {
        add();
        return seconds_;
    }

private:
    using Clock = std::chrono::steady_clock;
    void add()
    {
        const Clock::time_point now = Clock::now();
        if (!stage_.empty()) seconds_[stage_] += std::chrono::duration<double>(now - since_).count();
        since_ = now;
    }

    RunContext& context_;
    std::function<void(std::string_view, double)> passed_on_;
    std::string stage_;
    Clock::time_point since_ = Clock::now();
    StageSeconds seconds_;
};

} // namespace lacuna::lua
