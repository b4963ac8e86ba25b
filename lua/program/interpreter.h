// SPDX-License-Identifier: MIT
#pragma once

#include "bindings/lacuna_lua.h"
#include "program/command_line.h"

#include <memory>
#include <string>
#include <vector>

namespace lacuna::program {

/// Exit codes of the program.
enum class Exit { done = 0, failed = 1, bad_usage = 2, interrupted = 130, terminated = 143 };

/// A Lua state with `lacuna` ready to be required, that can be interrupted and, in the sandbox, limited.
class Interpreter {
public:
    explicit Interpreter(const CommandLine& line);
    ~Interpreter();
    Interpreter(const Interpreter&) = delete;
    Interpreter& operator=(const Interpreter&) = delete;

    /// Run a recipe file, "-" for standard input.
    Exit run_file(const std::string& file, const std::vector<std::string>& words);
    /// Run Lua of the program's own with one argument.
    Exit run_text(const char* source, const std::string& argument);
    /// Call the function under `arguments` values on the stack; a failure is reported on standard error.
    Exit call(int arguments, int results);
    /// Forget a request to stop, so that the next line of the prompt runs.
    void resume_after_stop();
    /// Report the message on top of the stack on standard error, and pop it.
    Exit report();

    [[nodiscard]] lua_State* state() const { return state_; }

private:
    struct Budget {
        std::size_t used = 0, limit = 0; ///< limit 0: none [bytes]
    };
    static void* allocate(void* budget, void* block, std::size_t old_size, std::size_t new_size);
    void warn_of_unused(const std::string& file, const std::vector<std::string>& words);

    CommandLine line_;
    lua::Host host_;
    Budget budget_;
    lua_State* state_ = nullptr;
};

/// Take away what a recipe in the sandbox must not have; opens the libraries it may.
void open_sandbox_libraries(lua_State* L);
/// Limit the process: memory by its data segment, time by an alarm that asks first and later ends
/// the process.
void limit_process(double megabytes, double seconds);

/// Read, run, print until the end of the input.
Exit run_prompt(Interpreter& interpreter);

// --- stopping: set by signals, read by Lua's count hook and by the kernel -------------------------------

/// Stop on Ctrl-C, SIGTERM and SIGHUP from now on (a second one ends the process), or as before.
void watch_interrupts(bool watch);

} // namespace lacuna::program
