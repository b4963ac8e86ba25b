// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/interpreter.h>

#include <chrono>
#include <string>
#include <string_view>
#include <vector>

namespace lacuna::program {

/// Elapsed time and processor time of each stage of a run.
class StageTimes {
public:
    /// Add callbacks that measure the stages, in addition to existing ones.
    void watch(InterpreterOptions& options);

    /// The times as a JSON object in one line: `seconds` and `processor_seconds` of the process so far,
    /// `peak_mib`, `threads` requested, and `stages`, an array of { stage, seconds, processor_seconds } in
    /// order of their start.
    /// Time outside any stage (Lua, and work without progress) is the stage "recipe".
    [[nodiscard]] std::string to_json(const std::string& recipe, int threads) const;
    /// Write the JSON to a file, "-" for standard error. @throw std::runtime_error  it cannot be written.
    void write(const std::string& path, const std::string& recipe, int threads) const;

private:
    using Clock = std::chrono::steady_clock;
    void begin(std::string_view stage);
    void end();

    struct Stage {
        std::string name;
        double seconds = 0, processor_seconds = 0;
    };
    std::vector<Stage> stages_;
    std::string stage_; ///< current stage; empty: none
    Clock::time_point start_ = Clock::now(), since_ = start_;
    double processor_since_ = 0;
};

} // namespace lacuna::program
