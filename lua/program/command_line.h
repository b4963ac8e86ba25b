// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace lacuna::program {

enum class Action { run, prompt, info, view, check, version, help };

/// What the command line asks for.
struct CommandLine {
    Action action = Action::help;
    std::string file; ///< recipe ("-": standard input), or the file of `info`, `view` and `check`
    std::vector<std::string> words; ///< key=value words after the recipe
    bool verbose = false;           ///< notes of the kernel and tracebacks on standard error
    bool sandbox = false;
    std::string output_dir; ///< of the sandbox; empty: nothing is written
    double memory = 2048;   ///< of the sandbox [MB]
    double seconds = 300;   ///< of the sandbox
};

/// The command line makes no sense; exit code 2.
class BadUsage : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// @throw BadUsage
CommandLine parse(const std::vector<std::string>& words);

/// Text of --help.
extern const char* const kHelp;

} // namespace lacuna::program
