// SPDX-License-Identifier: MIT
#include "bindings/unexpected.h"
#include "program/batch.h"
#include "program/chunks.h"
#include "program/command_line.h"
#include "program/progress_line.h"
#include "program/prompt.h"
#include "program/stage_times.h"
#include "program/stopping.h"
#ifdef LACUNA_WITH_MPI
#include "program/several.h"
#endif

#include <lacuna/interpreter.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace {

using namespace lacuna::program;

const char* const kVersion = R"lua(
local lacuna = require "lacuna"
print(("lacuna %s (%s, Gmsh %s)"):format(lacuna.version, _VERSION, lacuna.gmsh_version))
)lua";

/// Whether the compiled text of a recipe names lacuna.params. If it does not compile, or comes from standard
/// input, only a run can tell.
bool may_declare_parameters(lua_State* L, const std::string& recipe)
{
    if (recipe == "-") return true;
    std::string code;
    const auto append = [](lua_State* /*state*/, const void* part, std::size_t size, void* to) {
        static_cast<std::string*>(to)->append(static_cast<const char*>(part), size);
        return 0;
    };
    const bool compiles = luaL_loadfile(L, recipe.c_str()) == LUA_OK && lua_dump(L, append, &code, 1) == 0;
    lua_pop(L, 1);
    return !compiles || code.find("params") != std::string::npos;
}

/// Run a recipe until it calls lacuna.params, and list the parameters that it declares. A recipe that does
/// not name lacuna.params is not run.
void list_parameters(const std::string& recipe, lacuna::Interpreter& interpreter)
{
    struct Listing {
        lacuna::Interpreter& interpreter;
        bool done = false;
    } listing{interpreter};
    lua_State* const L = push_chunk(interpreter, "commands");
    lua_pushliteral(L, "parameters");
    lua_pushboolean(L, 0);
    lua_pushstring(L, recipe.c_str());
    lua_pushlightuserdata(L, &listing);
    const auto stop = [](lua_State* state) {
        auto& own = *static_cast<Listing*>(lua_touserdata(state, lua_upvalueindex(1)));
        own.done = true;
        own.interpreter.cancel();
        return 0;
    };
    lua_pushcclosure(L, stop, 1);
    interpreter.call(4);
    try {
        if (may_declare_parameters(L, recipe)) interpreter.run_file(recipe);
        std::printf("%s has no parameters: it does not call lacuna.params\n", recipe.c_str());
    } catch (const lacuna::Cancelled&) {
        if (!listing.done) throw;
    }
}

void run_action(const CommandLine& line, lacuna::Interpreter& interpreter, ProgressLine& progress)
{
    switch (line.action) {
    case Action::run:
        interpreter.run_file(line.file, line.words);
        if (!line.words.empty() && !interpreter.words_used())
            std::fprintf(stderr, "lacuna: note: %s had no effect: %s does not call lacuna.params\n",
                         line.words.front().c_str(), line.file.c_str());
        break;
    case Action::parameters:
        list_parameters(line.file, interpreter);
        break;
    case Action::prompt:
        run_prompt(interpreter, line.history, progress);
        break;
    case Action::command: {
        lua_State* const L = push_chunk(interpreter, "commands");
        lua_pushstring(L, line.command.c_str());
        lua_pushboolean(L, line.option);
        for (const std::string& word : line.words) lua_pushstring(L, word.c_str());
        interpreter.call(2 + static_cast<int>(line.words.size()));
        break;
    }
    case Action::version:
        interpreter.run_string(kVersion, "lacuna");
        break;
    case Action::batch:
    case Action::help:
        break;
    }
}

Exit run(const CommandLine& line, const lacuna::Crew* crew)
{
    if (line.action == Action::help) {
        std::fputs(help_text(line.command).c_str(), stdout);
        return Exit::done;
    }
    if (line.action == Action::batch) return run_batch(line);
    ProgressLine progress(!line.quiet);
    lacuna::InterpreterOptions options;
    progress.watch(options);
    StageTimes times;
    if (!line.timing.empty()) times.watch(options);
    options.sandbox = line.sandbox;
    options.output_folder = line.output_dir;
    options.traceback = line.traceback;
    options.threads = line.threads;
    options.crew = crew;
    // Notes say what the output format cannot store, and what a mesh lacks.
    const bool all = line.verbose || line.command == "convert";
    options.log = [&progress, all](std::string_view text) {
        constexpr std::string_view kEstimate = "estimate: ";
        if (text.starts_with(kEstimate)) progress.expect(text.substr(kEstimate.size()));
        if (!all && !text.starts_with("note: ")) return;
        progress.clear();
        std::fprintf(stderr, "lacuna: %.*s\n", static_cast<int>(text.size()), text.data());
    };
    if (line.sandbox) {
        options.memory = static_cast<std::size_t>(line.memory * 1024 * 1024);
        limit_process(line.memory, line.seconds);
    }
    lacuna::Interpreter interpreter(std::move(options));
    struct Watched {
        explicit Watched(lacuna::Interpreter* own) { watch_interrupts(own); }
        ~Watched() { watch_interrupts(nullptr); }
    } const watched(&interpreter);
    const auto tell_times = [&] { // called for failed runs too
        if (line.timing.empty()) return;
        progress.clear();
        times.write(line.timing, line.file.empty() ? line.command : line.file, line.threads);
    };
    try {
        run_action(line, interpreter, progress);
        tell_times();
        return Exit::done;
    } catch (const lacuna::Cancelled&) {
        progress.clear();
        std::fflush(stdout); // print errors after all other output
        tell_times();
        return report_stop(line.seconds);
    } catch (const lacuna::ScriptError& error) {
        progress.clear();
        std::fflush(stdout);
        tell_times();
        report(error);
        if (line.action == Action::run && error.code() == "lua.syntax" && !line.file.ends_with(".lua"))
            std::fprintf(stderr, "`lacuna info %s` lists the faces of a file, `lacuna view %s` shows it\n",
                         line.file.c_str(), line.file.c_str());
        return Exit::failed;
    }
}

/// Whether all output was written; a full disk is an error for standard output too.
bool flushed()
{
    errno = 0;
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return true;
    std::fprintf(stderr, "lacuna: cannot write to standard output: %s\n",
                 errno != 0 ? std::strerror(errno) : "some output was lost");
    return false;
}

#ifdef LACUNA_WITH_MPI
Exit run_alone_or_not(const CommandLine& line)
{
    return is_one_of_several() ? run_as_several(line, run) : run(line, nullptr);
}
#else
bool is_first() { return true; }
Exit run_alone_or_not(const CommandLine& line) { return run(line, nullptr); }
#endif

/// Keep freed memory for later allocations. Every stage allocates and frees blocks of some megabytes, each of
/// which would be mapped, zeroed and unmapped by the system. Larger blocks are still returned at once.
/// Measured on a disc and a plate of 10⁶ hexahedra: half the page faults, 4 % less processor time.
void keep_freed_memory()
{
#if defined(__GLIBC__)
    constexpr int kMegabyte = 1 << 20;
    mallopt(M_MMAP_THRESHOLD, 32 * kMegabyte);
    mallopt(M_TRIM_THRESHOLD, 64 * kMegabyte);
    mallopt(M_TOP_PAD, kMegabyte);
#endif
}

} // namespace

int main(int argc, char** argv)
{
    keep_freed_memory();
    const bool first = is_first();
    try {
        const Exit result = run_alone_or_not(parse(std::vector<std::string>(argv + 1, argv + argc)));
        return static_cast<int>(flushed() || result != Exit::done ? result : Exit::failed);
    } catch (const BadUsage& error) {
        if (first)
            std::fprintf(stderr, "lacuna: %s\n`lacuna --help` lists commands and options\n", error.what());
        return static_cast<int>(Exit::bad_usage);
    } catch (const std::logic_error& error) {
        if (first) std::fprintf(stderr, "lacuna: %s\n", lacuna::lua::unexpected_text(error.what()).c_str());
        return static_cast<int>(Exit::failed);
    } catch (const std::exception& error) {
        if (first) std::fprintf(stderr, "lacuna: %s\n", error.what());
        return static_cast<int>(Exit::failed);
    }
}
