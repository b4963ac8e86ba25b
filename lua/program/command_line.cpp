// SPDX-License-Identifier: MIT
#include "program/command_line.h"

#include "bindings/options.h"

#include <lacuna/core/message.h>
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

  RECIPE [key=value ...]  run a recipe with these parameters; - reads it from standard input
  RECIPE --help           list the parameters that it declares with lacuna.params
  -j N RECIPE ...         run recipes in parallel, N at a time, each in its own process; their outputs are
                          printed one after the other, in this order
  -i                      start a prompt; type help for an overview, exit to leave
)";

const char* const kOptionHelp = R"(
  --verbose               print the notes of the kernel on standard error
  --quiet                 do not show progress
  --timing FILE           write the seconds of each stage as a line of JSON to FILE; - for standard error
  --traceback             print the calls of the recipe that led to an error
  --threads N             threads of recipes that set none; default all cores, shared by recipes with -j
  --history FILE          file for the history of the prompt; default $LACUNA_HISTORY, otherwise none
  --sandbox               no os, io or bytecode; memory and time are limited; no file can be written
    --output-dir FOLDER   ... except below this folder
    --memory MB           default 2048
    --seconds S           default 300
  --version, --help       COMMAND --help describes a command

exit codes: 0 done, 1 the recipe failed, 2 bad usage, 130 interrupted, 143 terminated
)";

/// A command for files, implemented in lua/program/commands.lua.
struct Command {
    const char* name;
    const char* files;  ///< names of the files, in capitals
    std::size_t count;  ///< number of files, or least number of a command that takes words
    const char* option; ///< the command's own option; null: none
    bool words;         ///< whether key=value words may follow
    const char* summary;
    const char* help;
};

const Command kCommands[] = {
    {"info", "FILE", 1, "--json", false, "list the faces of a file, their likely roles and the class",
     R"(
Reads CAD, facets or a finite element mesh, and prints one line for each face: its tag (the same as in
Gmsh), type, dimensions, area, centre, normal, box, edges, neighbours and likely role. Then it lists free
edges, gaps and the tolerance that closes them, pockets and bores and, if they can be determined, the roles
and the class of the open volume. Recipes name faces by these tags:
part:open_volume { source = 12, target = 31 }.

  --json   print the result of model:info(), with file =, class =, roles = or roles_refused =, for scripts
)"},
    {"view", "FILE", 1, "--faces", false, "write an HTML page of a file's cells or faces",
     R"(
Writes FILE.view.html into the current folder, for any file that can be read. The page is self-contained:
open it in a browser. A mesh or deck with solid elements is shown as cells, which can be cut and coloured; any
other file as faces, which can be selected and copied as roles.

  --faces  show the faces of a mesh or deck, to fill its voids
)"},
    {"picture", "FILE OUT", 2, nullptr, true, "draw a file's cells or faces, as a PNG file",
     R"(
Draws any file that can be read, without a display: the cells of a mesh or deck with solid elements, otherwise
the faces. The words are the options of lacuna.picture:

  lacuna picture foam.msh foam.png view=top width=800 height=600
  lacuna picture foam.msh half.png colour=groups 'cut={ { 0, 0, 5 }, { 0, 0, 1 } }'
  lacuna picture old.inp faces.png show=faces
)"},
    {"check", "FILE", 1, "--json", false, "check a mesh; exit code 1 if a cell is invalid",
     R"(
Reads the solids of a mesh: %MESHES.
Prints counts, a histogram of the scaled Jacobian and one line for each metric. A cell is valid if its
Jacobian is proven positive everywhere in it. The exit code is 1 if a cell is invalid.

  --json   print all numbers and the worst cells as JSON, for scripts
)"},
    {"convert", "IN OUT", 2, nullptr, false, "convert a mesh or deck to another format",
     R"(
Reads a mesh, %READ, and writes it in the
format given by the extension of OUT: %WRITTEN. Nodes, elements, their numbers,
regions and sets are kept. Data that the format cannot store is listed on standard error.
)"},
    {"fill", "IN... OUT", 2, nullptr, true, "fill the void between faces of files and write the mesh",
     R"(
Reads CAD, facets or finite element meshes, fills the void between their faces with hexahedra and writes the
mesh in the format given by the extension of OUT: %WRITTEN. Then
it prints the quality. The words are the options of lacuna.load, open_volume, sweep and mesh:write:

  lacuna fill housing.step resin.inp source=16 walls=auto size=2 name=resin
  lacuna fill product.step box.step foam.vtu size=4 fallback=mixed
  lacuna fill pipe.stl case/constant/polyMesh faces=1,2 size=2
  lacuna fill old.inp new.inp source=FLOOR walls=auto with=true

Without source, target, walls and faces all faces bound the void: a closed body is filled itself, around the
bodies inside it. Several closed bodies side by side, such as the solids of a STEP file, become regions of one
mesh. A note lists the faces of pockets, bores and inner voids; to fill the room in a hollow box instead of
the box, give these: faces=3,4,5. `lacuna info IN` and `lacuna view IN` show all faces. A list is written with
commas, a table as in Lua, 'layers={count=8,bias=2}'.
with=true joins the new cells to the deck that was read.
)"},
};

const char* const kFlags[] = {"--output-dir", "--memory",  "--seconds", "--history", "--threads",
                              "--timing",     "--sandbox", "--verbose", "--quiet",   "--traceback",
                              "--version",    "--help",    "--json",    "--faces"};
constexpr std::size_t kFlagsWithValue = 6; ///< the flags with a value come first

const Command* find_command(const std::string& name)
{
    const auto found = std::find_if(std::begin(kCommands), std::end(kCommands),
                                    [&](const Command& command) { return name == command.name; });
    return found == std::end(kCommands) ? nullptr : found;
}

/// "did you mean info?" if the word is similar to a command; else the list of commands.
std::string like_command(const std::string& word)
{
    const char* names[std::size(kCommands) + 1] = {"help"};
    std::string all;
    for (std::size_t i = 0; i < std::size(kCommands); ++i) {
        names[i + 1] = kCommands[i].name;
        all += std::string(kCommands[i].name) + ", ";
    }
    const std::string near = names[nearest_word(word.c_str(), names)];
    constexpr std::size_t kSlips = 2; // edits: two letters swapped, or one that is wrong, missing or extra
    if (near.starts_with(word) || edit_distance(word.c_str(), near.c_str()) <= kSlips)
        return "did you mean " + near + "?";
    return "the commands are " + all + "help";
}

/// Whether a word looks like a command: it is not the name of a file or of a missing recipe.
bool is_misspelt(const std::string& word)
{
    std::error_code error;
    return word.find_first_of("./") == std::string::npos && !std::filesystem::exists(word, error);
}

/// Split options from their values: -j4 and --threads=4 become two words each.
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

/// The words of the command line, read from left to right.
struct Words {
    const std::vector<std::string>& all;
    std::size_t next = 0;

    [[nodiscard]] bool empty() const { return next == all.size(); }
    const std::string& take() { return all[next++]; }
    const std::string& value_of(const std::string& flag)
    {
        if (empty() || all[next].starts_with("--")) throw BadUsage(flag + " needs a value");
        return take();
    }
    /// The name of an output file. A recipe is refused, as it would be overwritten.
    const std::string& file_of(const std::string& flag)
    {
        const std::string& name = value_of(flag);
        if (name.ends_with(".lua"))
            throw BadUsage(formatted("{} needs the name of an output file, found the recipe {}", flag, name));
        return name;
    }
    int count_of(const std::string& flag)
    {
        constexpr double kMost = 1024;
        const double value = positive_value_of(flag);
        if (value != std::floor(value) || value > kMost)
            throw BadUsage(formatted("{} needs an integer from 1 to 1024, found {}", flag, all[next - 1]));
        return static_cast<int>(value);
    }
    double positive_value_of(const std::string& flag)
    {
        const std::string& word = value_of(flag);
        char* end = nullptr;
        const double value = std::strtod(word.c_str(), &end);
        if (*end != '\0' || !std::isfinite(value) || value <= 0)
            throw BadUsage(formatted("{} needs a positive number, found {}", flag, word));
        return value;
    }
};

/// Read an option with its value; false if the word is not an option.
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

/// Read the words after a command: options and files in any order.
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
            throw BadUsage(formatted("{0} has no option {1}; `lacuna {0} --help` lists its options",
                                     command.name, word));
        else if (word[0] != '-' || word == "-")
            line.words.push_back(word);
    }
    if (limits)
        throw BadUsage(formatted("write --output-dir, --memory and --seconds before {}", command.name));
    const std::string wants = formatted("{} needs {}, {}", command.name,
                                        command.count == 1 ? "a file" : "two files", command.files);
    if (line.words.size() < command.count) throw BadUsage(wants);
    if (!command.words && line.words.size() > command.count)
        throw BadUsage(formatted("{}; found {} too", wants, line.words.back()));
}

/// Read recipes, each followed by its parameters.
void read_batch(Words& words, CommandLine& line)
{
    line.action = Action::batch;
    line.jobs = words.count_of("-j");
    while (!words.empty()) {
        const std::string& word = words.take();
        if (is_parameter(word) && !line.batch.empty())
            line.batch.back().words.push_back(word);
        else if (is_parameter(word) || word.starts_with("-"))
            throw BadUsage("-j needs recipes, each followed by its key=value words; found " + word);
        else
            line.batch.push_back({word, {}});
    }
    if (line.batch.empty()) throw BadUsage("write at least one recipe after -j N");
    if (!line.timing.empty()) throw BadUsage("--timing works for one recipe only, without -j");
}

/// Read a word after the recipe.
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

/// Read the word that selects the action, and the words that belong to it.
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
                throw BadUsage(
                    formatted("there is no command {}; {}", line.command, like_command(line.command)));
        }
    } else if (word == "-i")
        line.action = Action::prompt;
    else if (word == "-j")
        read_batch(words, line);
    else if (const Command* command = find_command(word))
        read_command(*command, words, line);
    else if (word != "-" && word.starts_with("-")) {
        const std::size_t near = nearest_word(word.c_str(), kFlags);
        throw BadUsage(formatted("unknown option {}; the nearest is {}", word, kFlags[near]));
    } else if (word != "-" && is_misspelt(word)) {
        throw BadUsage(
            "there is no command or file " + word + "; " +
            (std::filesystem::exists(word + ".lua") ? "did you mean " + word + ".lua?" : like_command(word)));
    } else {
        line.action = Action::run;
        line.file = word;
        while (!words.empty()) read_parameter(words.take(), line);
    }
}

} // namespace

namespace {

/// Replace %MESHES, %READ and %WRITTEN by the endings of these formats.
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
               (command->option ? std::string(" [") + command->option + "] " : " ") + command->files +
               (command->words ? " [key=value ...]\n" : "\n") + with_endings(command->help);
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
    if (words.empty()) throw BadUsage("the name of a recipe or a command is missing");
    while (!words.empty()) {
        const std::string word = words.take();
        if (read_flag(word, words, line, limits)) {
            if (words.empty()) throw BadUsage("the name of a recipe is missing after " + word);
            continue;
        }
        read_action(word, words, line);
        if (line.action == Action::help) break;
        if (!words.empty()) throw BadUsage("too many words after " + word + ": " + words.take());
    }
    if (limits && !line.sandbox) throw BadUsage("--output-dir, --memory and --seconds need --sandbox");
    return line;
}

} // namespace lacuna::program
