// SPDX-License-Identifier: MIT
#include "program/command_line.h"

#include "bindings/options.h"

#include <lacuna/io/formats.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <system_error>
#include <utility>

namespace lacuna::program {

namespace {

const char* const kHelp = R"(usage: lacuna [option ...] RECIPE [key=value ...]
       lacuna [option ...] COMMAND FILE ...
       lacuna [option ...] -j N RECIPE [key=value ...] RECIPE [key=value ...] ...
       lacuna [option ...] -i

  RECIPE [key=value ...]  run a recipe, with parameters changed; - reads it from standard input
  RECIPE --help           list the parameters that it declares with lacuna.params
  -j N RECIPE ...         run recipes side by side, N at once, each in a process of its own; what each
                          prints comes whole, in this order
  -i                      a prompt; help there says what there is, exit leaves it
)";

const char* const kOptionHelp = R"(
  --verbose               what the kernel notes as it works, on standard error
  --quiet                 no progress on standard error: a line on a terminal, elsewhere one every 5 seconds
  --timing FILE           seconds by stage as a line of JSON into FILE; - for standard error
  --traceback             where in the recipe an error came from, call by call
  --threads N             most threads where a recipe asks for none; default all cores, with -j its share
  --history FILE          of the prompt: lines typed are kept there; default $LACUNA_HISTORY, else nowhere
  --sandbox               no os, io or bytecode; limits on memory and time; no file is written
    --output-dir FOLDER   ... but below this folder
    --memory MB           default 2048
    --seconds S           default 300
  --version, --help       COMMAND --help says more about one

exit codes: 0 done, 1 the recipe failed, 2 bad usage, 130 interrupted, 143 terminated
)";

/// A word that does something with files; lua/program/commands.lua has what it does.
struct Command {
    const char* name;
    const char* files;  ///< in capitals, one a file
    std::size_t count;  ///< of files
    const char* option; ///< of its own; null: none
    const char* summary;
    const char* help;
};

const Command kCommands[] = {
    {"info", "FILE", 1, "--json", "the faces of a file, and the roles and class they seem to have",
     R"(
Reads CAD, facets or a finite element mesh, and prints a line a face: its tag, which is the one Gmsh
shows, its kind with its sizes, area, centre, normal, box, edges, neighbours and what it may be. Then free
edges, gaps and the tolerance that sews them, pockets and bores; the roles and the class of the open volume
that the faces bound, where they can be found. A recipe names faces by these tags:
part:open_volume { source = 12, target = 31 }.

  --json   what model:info() says, with file =, class =, roles = or roles_refused =, for scripts
)"},
    {"view", "FILE", 1, "--faces", "a page of its cells or faces, for a browser",
     R"(
Writes FILE.view.html into the folder it is called in, from any file that is read. The page needs nothing
else: open it in a browser. A mesh or deck with solid cells is shown as cells, to be cut and coloured; any
other file as faces, to be picked by clicking and copied as roles.

  --faces  the faces of a mesh or deck too, where its voids are to be filled
)"},
    {"check", "FILE", 1, "--json", "a mesh and its quality; exit code 1 when a cell is invalid",
     R"(
Reads the hexahedra and wedges of a mesh: %MESHES.
Prints counts, a histogram of the scaled Jacobian and a line a metric. A cell is valid when its Jacobian is
proved positive everywhere in it. The exit code is 1 when one is not.

  --json   every number that is printed, and the worst cells, for scripts
)"},
    {"convert", "IN OUT", 2, nullptr, "a mesh or deck from one format to another",
     R"(
Reads a mesh, %READ, and writes it in the
format that OUT's ending says: %WRITTEN. Nodes, elements, their
numbers, regions and sets are kept. What the format cannot hold is named on standard error.
)"},
};

const char* const kFlags[] = {"--output-dir", "--memory",  "--seconds", "--history", "--threads",
                              "--timing",     "--sandbox", "--verbose", "--quiet",   "--traceback",
                              "--version",    "--help",    "--json",    "--faces"};
constexpr std::size_t kFlagsWithValue = 6; ///< the first ones

const Command* find_command(const std::string& name)
{
    const auto found = std::find_if(std::begin(kCommands), std::end(kCommands),
                                    [&](const Command& command) { return name == command.name; });
    return found == std::end(kCommands) ? nullptr : found;
}

/// " did you mean info?" where a command is like the word; else which commands there are.
std::string like_command(const std::string& word)
{
    const char* names[std::size(kCommands) + 1] = {"help"};
    std::string all;
    for (std::size_t i = 0; i < std::size(kCommands); ++i) {
        names[i + 1] = kCommands[i].name;
        all += std::string(kCommands[i].name) + ", ";
    }
    const std::string near = names[lua::nearest(word.c_str(), names, std::size(names))];
    constexpr std::size_t kSlips = 2; // two letters changed places, or one that is wrong, missing or too many
    if (near.starts_with(word) || lua::edit_distance(word.c_str(), near.c_str()) <= kSlips)
        return "did you mean " + near + "?";
    return "the commands are " + all + "help";
}

/// Whether a word can only be a command: it names no file, and no recipe that is missing.
bool is_misspelt(const std::string& word)
{
    std::error_code error;
    return word.find_first_of("./") == std::string::npos && !std::filesystem::exists(word, error);
}

/// Words as the rest of this file reads them: -j4 and --threads=4 are two each.
std::vector<std::string> split_words(const std::vector<std::string>& all)
{
    std::vector<std::string> words;
    for (const std::string& word : all) {
        const std::size_t equals = word.find('=');
        const auto is_flag = [&](const char* flag) { return word.compare(0, equals, flag) == 0; };
        if (word.starts_with("-j") && word.size() > 2) {
            words.insert(words.end(), {"-j", word.substr(2)});
        } else if (equals != std::string::npos && std::any_of(kFlags, kFlags + kFlagsWithValue, is_flag)) {
            words.insert(words.end(), {word.substr(0, equals), word.substr(equals + 1)});
        } else {
            words.push_back(word);
        }
    }
    return words;
}

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
    /// The name of a file that is written: no recipe's, which would be lost.
    const std::string& file_of(const std::string& flag)
    {
        const std::string& name = value_of(flag);
        if (name.ends_with(".lua"))
            throw BadUsage(flag + " wants the name of a file to write, found a recipe, " + name);
        return name;
    }
    int count_of(const std::string& flag)
    {
        constexpr double kMost = 1024;
        const double value = positive_value_of(flag);
        if (value != std::floor(value) || value > kMost)
            throw BadUsage(flag + " wants a whole number from 1 to 1024, found " + all[next - 1]);
        return static_cast<int>(value);
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
    else if (word == "--quiet")
        line.quiet = true;
    else if (word == "--traceback")
        line.traceback = true;
    else if (word == "--threads")
        line.threads = words.count_of(word);
    else if (word == "--timing")
        line.timing = words.file_of(word);
    else if (word == "--history")
        line.history = words.file_of(word);
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

/// What comes after the word of a command: its flags before, between or after its files.
void read_command(const Command& command, Words& words, CommandLine& line)
{
    line.action = Action::command;
    line.command = command.name;
    bool limits = false;
    while (!words.empty()) {
        const std::string& word = words.take();
        if (word == "--help" || word == "-h") {
            line.action = Action::help;
            return;
        }
        if (command.option != nullptr && word == command.option)
            line.option = true;
        else if (word.size() > 1 && word[0] == '-' && !read_flag(word, words, line, limits))
            throw BadUsage(std::string(command.name) + " has no option " + word + "; `lacuna " +
                           command.name + " --help` says what it has");
        else if (word[0] != '-' || word == "-")
            line.words.push_back(word);
    }
    if (limits) throw BadUsage("--output-dir, --memory and --seconds go before " + std::string(command.name));
    const std::string wants = std::string(command.name) + " wants " +
                              (command.count == 1 ? "a file" : "two files") + ", " + command.files;
    if (line.words.size() < command.count) throw BadUsage(wants);
    if (line.words.size() > command.count)
        throw BadUsage(wants + "; found " + line.words[command.count] + " too");
}

/// Recipes, and behind each its parameters.
void read_batch(Words& words, CommandLine& line)
{
    line.action = Action::batch;
    line.jobs = words.count_of("-j");
    while (!words.empty()) {
        const std::string& word = words.take();
        if (is_parameter(word) && !line.batch.empty())
            line.batch.back().words.push_back(word);
        else if (is_parameter(word) || word.starts_with("-"))
            throw BadUsage("-j wants recipes, each with its key=value words behind it, found " + word);
        else
            line.batch.push_back({word, {}});
    }
    if (line.batch.empty()) throw BadUsage("recipes are wanted after -j");
    if (!line.timing.empty()) throw BadUsage("--timing is of one recipe, and goes without -j");
}

/// A word behind a recipe.
void read_parameter(const std::string& word, CommandLine& line)
{
    if (word == "--help" || word == "-h") {
        line.action = Action::parameters;
    } else if (is_parameter(word)) {
        line.words.push_back(word);
    } else {
        const bool dashes = word.starts_with("--") && is_parameter(word.substr(2));
        throw BadUsage(word + " after the recipe is not of the form key=value" +
                       (dashes                  ? "; write " + word.substr(2)
                        : word.starts_with("-") ? "; options go before the recipe"
                                                : ""));
    }
}

/// The word that says what is to be done, and what belongs to it.
void read_action(const std::string& word, Words& words, CommandLine& line)
{
    if (word == "--version")
        line.action = Action::version;
    else if (word == "--help" || word == "-h" || word == "help") {
        line.action = Action::help;
        if (word == "help" && !words.empty()) {
            line.command = words.take();
            if (line.command.ends_with(".lua"))
                line.action = Action::parameters, line.file = std::exchange(line.command, {});
            else if (!find_command(line.command))
                throw BadUsage("there is no command " + line.command + "; " + like_command(line.command));
        }
    } else if (word == "-i")
        line.action = Action::prompt;
    else if (word == "-j")
        read_batch(words, line);
    else if (const Command* command = find_command(word))
        read_command(*command, words, line);
    else if (word != "-" && word.starts_with("-")) {
        const std::size_t near = lua::nearest(word.c_str(), kFlags, std::size(kFlags));
        throw BadUsage("unknown option " + word + "; the nearest is " + kFlags[near]);
    } else if (word != "-" && is_misspelt(word)) {
        throw BadUsage(
            "there is no command and no file " + word + "; " +
            (std::filesystem::exists(word + ".lua") ? "did you mean " + word + ".lua?" : like_command(word)));
    } else {
        line.action = Action::run;
        line.file = word;
        while (!words.empty()) read_parameter(words.take(), line);
    }
}

} // namespace

namespace {

/// The endings of formats in the place of their words.
std::string with_endings(std::string text)
{
    const std::pair<std::string_view, std::string> words[] = {
        {"%MESHES", io::endings_of([](const io::Format& of) { return of.is_read && of.is_mesh; })},
        {"%READ", io::endings_of([](const io::Format& of) { return of.is_read; })},
        {"%WRITTEN", io::endings_of([](const io::Format& of) { return of.has_option("with"); })}};
    for (const auto& [word, endings] : words)
        if (const std::size_t at = text.find(word); at != text.npos) text.replace(at, word.size(), endings);
    return text;
}

} // namespace

std::string help_text(const std::string& name)
{
    if (const Command* command = find_command(name))
        return std::string("usage: lacuna ") + command->name +
               (command->option ? std::string(" [") + command->option + "] " : " ") + command->files + "\n" +
               with_endings(command->help);
    std::string text = kHelp;
    for (const Command& command : kCommands) {
        std::string left = std::string("  ") + command.name + " " + command.files;
        left.resize(std::max<std::size_t>(left.size() + 1, 26), ' ');
        text += left + command.summary + "\n";
    }
    return text + kOptionHelp;
}

CommandLine parse(const std::vector<std::string>& given)
{
    CommandLine line;
    const std::vector<std::string> all = split_words(given);
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
        if (line.action == Action::help) break;
        if (!words.empty()) throw BadUsage("nothing is expected after " + word + ", found " + words.take());
    }
    if (limits && !line.sandbox) throw BadUsage("--output-dir, --memory and --seconds go with --sandbox");
    return line;
}

} // namespace lacuna::program
