// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/interpreter.h>

#include <chrono>
#include <string>
#include <string_view>
#include <vector>

namespace lacuna::program {

/// Seconds by the stage of the work, of a whole run.
class StageTimes {
public:
    /// Fill in the callbacks that feed it, over those there are.
    void watch(InterpreterOptions& options);

    /// As an object in JSON, in a line: `seconds` and `processor_seconds` of the process until now,
    /// `peak_mib`, `threads` asked for, and `stages`, an array of { stage, seconds } in the order they began
    /// in. What is left is "recipe": Lua, and work that tells no stage.
    [[nodiscard]] std::string to_json(const std::string& recipe, int threads) const;
    /// Write that to a file, "-" for standard error. @throw std::runtime_error  it cannot be written.
    void write(const std::string& path, const std::string& recipe, int threads) const;

private:
    using Clock = std::chrono::steady_clock;
    void begin(std::string_view stage);
    void end();

    struct Stage {
        std::string name;
        double seconds = 0;
    };
    std::vector<Stage> stages_;
    std::string stage_; ///< that goes on; empty: none
    Clock::time_point start_ = Clock::now(), since_ = start_;
};

} // namespace lacuna::program
