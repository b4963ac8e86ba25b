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

/// Shows the progress of the kernel on standard error: the stage and, if its fraction is known, its speed and
/// the estimated time left. On a terminal it is one line, shown if a stage takes long, and removed before
/// other output. Elsewhere it prints a line every few seconds.
class ProgressLine {
public:
    /// @param wanted  false: never show anything.
    explicit ProgressLine(bool wanted);
    ~ProgressLine();
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    /// Set the callbacks that report progress.
    void watch(InterpreterOptions& options);
    /// Show the expected number of cells with every stage of the current call.
    void expect(std::string_view cells);
    /// Remove the line until the next stage.
    void clear();

private:
    using Clock = std::chrono::steady_clock;
    void draw();
    void erase();
    [[nodiscard]] std::string text(Clock::time_point now) const;

    bool wanted_, terminal_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::string stage_;    ///< empty: no stage is running
    std::string expected_; ///< expected number of cells; empty: unknown
    double share_ = 0;
    Clock::time_point begin_;       ///< start of the current series of stages
    Clock::time_point told_;        ///< time of the last line, if not on a terminal
    bool shown_ = false, ended_ = false;
    std::thread thread_;
};

} // namespace lacuna::program
