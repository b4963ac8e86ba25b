// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/interpreter.h>

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace lacuna::program {

/// The one line on standard error that says what the kernel is at, where that is a terminal. It is shown when
/// a stage goes on for a while, and goes away before anything else is written.
class ProgressLine {
public:
    /// @param wanted  false: nothing is ever shown.
    explicit ProgressLine(bool wanted);
    ~ProgressLine();
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    /// Fill in the callbacks that feed it.
    void watch(InterpreterOptions& options);
    /// Nothing is shown until the next stage.
    void clear();

private:
    using Clock = std::chrono::steady_clock;
    void draw();
    void erase();

    bool wanted_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::string stage_; ///< empty: nothing goes on
    double share_ = 0;
    Clock::time_point begin_; ///< of what goes on without a pause
    bool shown_ = false, ended_ = false;
    std::thread thread_;
};

} // namespace lacuna::program
