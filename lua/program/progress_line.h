// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/interpreter.h>

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>

namespace lacuna::program {

/// Says on standard error what the kernel is at: the stage, and where it tells its share how fast it goes and
/// how long the rest may take. On a terminal it is one line, which is shown when a stage goes on for a while
/// and goes away before anything else is written. Elsewhere it is a line every few seconds.
class ProgressLine {
public:
    /// @param wanted  false: nothing is ever shown.
    explicit ProgressLine(bool wanted);
    ~ProgressLine();
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    /// Fill in the callbacks that feed it.
    void watch(InterpreterOptions& options);
    /// Say with every stage of the call that runs how many cells it is expected to make.
    void expect(std::string_view cells);
    /// Nothing is shown until the next stage.
    void clear();

private:
    using Clock = std::chrono::steady_clock;
    void draw();
    void erase();
    [[nodiscard]] std::string text(Clock::time_point now) const;

    bool wanted_, terminal_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::string stage_;    ///< empty: nothing goes on
    std::string expected_; ///< cells; empty: nobody knows
    double share_ = 0;
    Clock::time_point begin_;       ///< of what goes on without a pause
    Clock::time_point stage_begin_; ///< of the stage
    Clock::time_point told_;        ///< when the last line was written, where there is no terminal
    bool shown_ = false, ended_ = false;
    std::thread thread_;
};

} // namespace lacuna::program
