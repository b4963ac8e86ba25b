// SPDX-License-Identifier: MIT
#include "program/command_line.h"

#include "bindings/options.h"

#include <cctype>
#include <cmath>
#include <cstdlib>
#include <iterator>

namespace lacuna::program {

const char* const kHelp = R"(usage: lacuna [option ...] RECIPE [key=value ...]
       lacuna [option ...] info FILE | view FILE | check FILE | -i

  RECIPE [key=value ...]  run a recipe, with parameters changed; - reads it from standard input
  -i                      a prompt
  info FILE               the faces of a file, and the roles and class they seem to have
  view FILE               a page FILE.view.html of its faces or cells, in this folder, for a browser
  check FILE          read a mesh and print its quality; exit 1 when a cell is invalid

  --sandbox               no os, io or bytecode; limits on memory and time; no file is written
    --output-dir FOLDER   ... but below this folder
    --memory MB           default 2048
    --seconds S           default 300
  --verbose               what the kernel notes as it works, and tracebacks, on standard error
  --version, --help

exit codes: 0 done, 1 the recipe failed, 2 bad usage, 130 interrupted, 143 terminated
)";

namespace {

const char* const kFlags[] = {"--sandbox", "--output-dir", "--memory", "--seconds",
                              "--verbose", "--version",    "--help"};

bool is_parameter(const std::string& word)
{
    const std::size_t equals = word.find('=');
    if (equals == std::string::npos || equals == 0 || std::isdigit(static_cast<unsigned char>(word[0])))
        return false;
    for (const char c : word.substr(0, equals))
        if (!std::isalnum(static_cast<unsigned char>(c)) && c != '_') return false;
    return true;
}

/// Reads words from the left, option values included.
struct Words {
    const std::vector<std::string>& all;
    std::size_t next = 0;

    [[nodiscard]] bool empty() const { return next == all.size(); }
    const std::string& take() { return all[next++]; }
    const std::string& value_of(const std::string& flag)
    {
        if (empty() || all[next].starts_with("--")) throw BadUsage(flag + " wants a value");
        return take();
    }
    double positive_value_of(const std::string& flag)
    {
        const std::string& word = value_of(flag);
        char* end = nullptr;
        const double value = std::strtod(word.c_str(), &end);
        if (*end != '\0' || !std::isfinite(value) || value <= 0)
            throw BadUsage(flag + " wants a positive number, found " + word);
        return value;
    }
};

/// A flag with its value; false where the word is none.
bool read_flag(const std::string& word, Words& words, CommandLine& line, bool& limits)
{
    if (word == "--sandbox")
        line.sandbox = true;
    else if (word == "--verbose")
        line.verbose = true;
    else if (word == "--output-dir")
        line.output_dir = words.value_of(word), limits = true;
    else if (word == "--memory")
        line.memory = words.positive_value_of(word), limits = true;
    else if (word == "--seconds")
        line.seconds = words.positive_value_of(word), limits = true;
    else
        return false;
    return true;
}

/// The word that says what is to be done, and what belongs to it.
void read_action(const std::string& word, Words& words, CommandLine& line)
{
    if (word == "--version")
        line.action = Action::version;
    else if (word == "--help" || word == "-h")
        line.action = Action::help;
    else if (word == "-i")
        line.action = Action::prompt;
    else if (word == "info" || word == "view" || word == "check") {
        line.action = word == "info" ? Action::info : word == "view" ? Action::view : Action::check;
        if (words.empty()) throw BadUsage(word + " wants a file");
        line.file = words.take();
    } else if (word != "-" && word.starts_with("-")) {
        const std::size_t near = lua::nearest(word.c_str(), kFlags, std::size(kFlags));
        throw BadUsage("unknown option " + word + "; the nearest is " + kFlags[near]);
    } else {
        line.action = Action::run;
        line.file = word;
        while (!words.empty()) {
            const std::string& parameter = words.take();
            if (!is_parameter(parameter))
                throw BadUsage(parameter + " after the recipe is not of the form key=value");
            line.words.push_back(parameter);
        }
    }
}

} // namespace

CommandLine parse(const std::vector<std::string>& all)
{
    CommandLine line;
    Words words{all};
    bool limits = false;
    if (words.empty()) throw BadUsage("a recipe is wanted");
    while (!words.empty()) {
        const std::string word = words.take();
        if (read_flag(word, words, line, limits)) {
            if (words.empty()) throw BadUsage("a recipe is wanted after " + word);
            continue;
        }
        read_action(word, words, line);
        if (!words.empty()) throw BadUsage("nothing is expected after " + word + ", found " + words.take());
    }
    if (limits && !line.sandbox) throw BadUsage("--output-dir, --memory and --seconds go with --sandbox");
    return line;
}

} // namespace lacuna::program
