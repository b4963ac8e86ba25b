// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace lacuna::program {

enum class Action { run, parameters, batch, prompt, command, version, help };

/// One of several recipes to run in parallel.
struct Job {
    std::string recipe;
    std::vector<std::string> words; ///< key=value
};

/// The parsed command line.
struct CommandLine {
    Action action = Action::help;
    std::string file;               ///< the recipe to run or to list the parameters of; "-": standard input
    std::string command;            ///< the command to run or to explain; empty: explain all
    std::vector<std::string> words; ///< key=value words after the recipe, or the files of a command
    std::vector<Job> batch;         ///< recipes to run in parallel, in order
    int jobs = 0;                   ///< number of recipes to run at once
    int threads = 0;                ///< default number of threads; 0: all cores
    bool option = false;            ///< the command's own option is set: --json or --faces
    bool verbose = false;           ///< print notes of the kernel on standard error
    bool quiet = false;             ///< print no progress
    std::string timing;             ///< file for the seconds by stage; "-": standard error; empty: none
    bool traceback = false;
    bool sandbox = false;
    std::string output_dir; ///< for the sandbox; empty: no files can be written
    double memory = 2048;   ///< limit of the sandbox [MB]
    double seconds = 300;   ///< limit of the sandbox
    std::string history;    ///< history file of the prompt; empty: none
};

/// The command line is invalid; exit code 2.
class BadUsage : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// @throw BadUsage
CommandLine parse(const std::vector<std::string>& words);

/// The text of --help: for the program, or for one command.
std::string help_text(const std::string& command);

} // namespace lacuna::program
