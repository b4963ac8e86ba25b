// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace lacuna::program {

enum class Action { run, parameters, batch, prompt, command, version, help };

/// A recipe of several that are run side by side.
struct Job {
    std::string recipe;
    std::vector<std::string> words; ///< key=value
};

/// What the command line asks for.
struct CommandLine {
    Action action = Action::help;
    std::string file;               ///< of a run, or of its parameters: the recipe, "-" for standard input
    std::string command;            ///< of a command, or of help: which; empty: all
    std::vector<std::string> words; ///< key=value words after the recipe; the files of a command
    std::vector<Job> batch;         ///< of a batch, in its order
    int jobs = 0;                   ///< of a batch: recipes at once
    int threads = 0;                ///< of the kernel, where a recipe asks for none; 0: all cores
    bool option = false;            ///< of a command: its own, --json or --faces
    bool verbose = false;           ///< notes of the kernel on standard error
    bool quiet = false;             ///< no line of progress
    std::string timing;             ///< a file for seconds by stage, "-": standard error; empty: none
    bool traceback = false;
    bool sandbox = false;
    std::string output_dir; ///< of the sandbox; empty: nothing is written
    double memory = 2048;   ///< of the sandbox [MB]
    double seconds = 300;   ///< of the sandbox
    std::string history;    ///< of the prompt: a file; empty: none is kept
};

/// The command line makes no sense; exit code 2.
class BadUsage : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// @throw BadUsage
CommandLine parse(const std::vector<std::string>& words);

/// Text of --help, of the whole or of one command.
std::string help_text(const std::string& command);

} // namespace lacuna::program
