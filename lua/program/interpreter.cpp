// SPDX-License-Identifier: MIT
#include "program/interpreter.h"

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>
#include <unistd.h>

namespace lacuna::program {

namespace {

// Signal handlers reach nothing but globals; these are the program's only ones.
enum class Stop { none, interrupt, terminate, time };
std::atomic<bool> g_stop{false};
std::atomic<Stop> g_reason{Stop::none};

Exit exit_code(Stop reason)
{
    return reason == Stop::interrupt   ? Exit::interrupted
           : reason == Stop::terminate ? Exit::terminated
                                       : Exit::failed;
}

void on_signal(int signal)
{
    const Stop reason = signal == SIGALRM ? Stop::time : signal == SIGINT ? Stop::interrupt : Stop::terminate;
    if (g_stop.exchange(true)) { // asked before, and nothing came of it
        constexpr char kOver[] = "lacuna: stopped: the time limit is over\n";
        if (reason == Stop::time) {
            [[maybe_unused]] const auto written = write(STDERR_FILENO, kOver, sizeof kOver - 1);
        }
        _exit(static_cast<int>(exit_code(reason)));
    }
    g_reason = reason;
}

constexpr int kHookInstructions = 10'000; // often enough to feel immediate, too seldom to cost time

/// Runs every so many instructions. Once asked to stop it raises at every one, so that no pcall can go on.
void stop_hook(lua_State* L, lua_Debug*)
{
    if (!g_stop) return;
    lua_sethook(L, stop_hook, LUA_MASKCOUNT, 1);
    luaL_error(L, "interrupted");
}

/// The error as a text, with the traceback where it is wanted (upvalue 1).
int message_handler(lua_State* L)
{
    if (!lua_isstring(L, 1)) {
        if (luaL_callmeta(L, 1, "__tostring") == 0 || !lua_isstring(L, -1))
            lua_pushfstring(L, "(error object is a %s value)", luaL_typename(L, 1));
        lua_replace(L, 1);
    }
    lua_settop(L, 1);
    if (lua_toboolean(L, lua_upvalueindex(1))) luaL_traceback(L, L, lua_tostring(L, 1), 1);
    return 1;
}

int open_everything(lua_State* L)
{
    if (lua_toboolean(L, 1)) {
        open_sandbox_libraries(L);
    } else {
        luaL_openlibs(L);
        luaL_getsubtable(L, LUA_REGISTRYINDEX, LUA_PRELOAD_TABLE);
        lua_pushcfunction(L, luaopen_lacuna);
        lua_setfield(L, -2, "lacuna");
    }
    return 0;
}

} // namespace

void watch_interrupts(bool watch)
{
    struct sigaction action = {};
    action.sa_handler = watch ? on_signal : SIG_DFL;
    sigaction(SIGINT, &action, nullptr);
    if (!watch) return;
    for (const int signal : {SIGALRM, SIGTERM, SIGHUP}) sigaction(signal, &action, nullptr);
    // A file that grows past a limit is then an error of writing, which is told, and not the end.
    std::signal(SIGXFSZ, SIG_IGN);
}

void* Interpreter::allocate(void* budget, void* block, std::size_t old_size, std::size_t new_size)
{
    Budget& account = *static_cast<Budget*>(budget);
    if (!block) old_size = 0; // Lua then gives a kind of object instead
    if (new_size > old_size && account.limit > 0 && account.used + (new_size - old_size) > account.limit)
        return nullptr;
    void* moved = nullptr;
    if (new_size == 0) {
        std::free(block);
    } else {
        moved = std::realloc(block, new_size);
        if (!moved) return nullptr;
    }
    account.used = account.used - old_size + new_size;
    return moved;
}

Interpreter::Interpreter(const CommandLine& line) : line_(line)
{
    watch_interrupts(true);
    host_.cancel = &g_stop;
    host_.sandboxed = line.sandbox;
    if (!line.output_dir.empty()) host_.output_folder = std::make_shared<const io::Folder>(line.output_dir);
    if (line.verbose)
        host_.log = [](std::string_view text) {
            std::fprintf(stderr, "lacuna: %.*s\n", static_cast<int>(text.size()), text.data());
        };
    if (line.sandbox) {
        budget_.limit = static_cast<std::size_t>(line.memory * 1024 * 1024);
        limit_process(line.memory, line.seconds);
    }
    state_ = lua_newstate(allocate, &budget_);
    if (!state_) throw std::bad_alloc();
    lua::set_host(state_, &host_);
    lua_sethook(state_, stop_hook, LUA_MASKCOUNT, kHookInstructions);
    lua_pushcfunction(state_, open_everything);
    lua_pushboolean(state_, line.sandbox);
    if (call(1, 0) != Exit::done) throw std::runtime_error("the interpreter cannot be started");
}

Interpreter::~Interpreter()
{
    if (state_) lua_close(state_);
}

Exit Interpreter::report()
{
    const char* text = lua_tostring(state_, -1);
    [[maybe_unused]] const int flushed = std::fflush(stdout); // what fails is told at the end
    const Stop reason = g_reason;
    if (reason == Stop::time)
        std::fprintf(stderr, "lacuna: stopped: the time limit of %g seconds is over\n", line_.seconds);
    else
        std::fprintf(stderr, "lacuna: %s\n",
                     reason == Stop::interrupt   ? "interrupted"
                     : reason == Stop::terminate ? "terminated"
                     : text                      ? text
                                                 : "unknown error");
    lua_pop(state_, 1);
    return exit_code(reason);
}

void Interpreter::resume_after_stop()
{
    g_stop = false;
    g_reason = Stop::none;
    lua_sethook(state_, stop_hook, LUA_MASKCOUNT, kHookInstructions);
}

Exit Interpreter::call(int arguments, int results)
{
    const int base = lua_gettop(state_) - arguments;
    lua_pushboolean(state_, line_.verbose);
    lua_pushcclosure(state_, message_handler, 1);
    lua_insert(state_, base);
    const int status = lua_pcall(state_, arguments, results, base);
    lua_remove(state_, base);
    if (status != LUA_OK) return report();
    if (!g_stop) return Exit::done;
    // Asked to stop while the last step ran, or by a recipe that caught the error: it did not do all it was
    // to do.
    lua_pushliteral(state_, "interrupted");
    return report();
}

Exit Interpreter::run_file(const std::string& file, const std::vector<std::string>& words)
{
    lua_State* L = state_;
    lua_createtable(L, static_cast<int>(words.size()), 2);
    lua_pushstring(L, file.c_str());
    lua_rawseti(L, -2, 0);
    lua_pushliteral(L, "lacuna");
    lua_rawseti(L, -2, -1);
    for (std::size_t i = 0; i < words.size(); ++i) {
        lua_pushstring(L, words[i].c_str());
        lua_rawseti(L, -2, static_cast<lua_Integer>(i) + 1);
    }
    lua_setglobal(L, "arg");

    const char* const mode = line_.sandbox ? "t" : nullptr; // bytecode can crash the machine that runs it
    if (luaL_loadfilex(L, file == "-" ? nullptr : file.c_str(), mode) != LUA_OK) return report();
    for (const std::string& word : words) lua_pushstring(L, word.c_str());
    const Exit result = call(static_cast<int>(words.size()), 0);
    if (result == Exit::done) warn_of_unused(file, words);
    return result;
}

void Interpreter::warn_of_unused(const std::string& file, const std::vector<std::string>& words)
{
    lua_getfield(state_, LUA_REGISTRYINDEX, lua::kUsedParams);
    const bool used = lua_toboolean(state_, -1);
    lua_pop(state_, 1);
    if (!used && !words.empty())
        std::fprintf(stderr, "lacuna: note: %s changed nothing: %s does not call lacuna.params\n",
                     words.front().c_str(), file.c_str());
}

Exit Interpreter::run_text(const char* source, const std::string& argument)
{
    if (luaL_loadbufferx(state_, source, std::strlen(source), lua::kEmbeddedSource, "t") != LUA_OK)
        return report();
    lua_pushstring(state_, argument.c_str());
    return call(1, 0);
}

} // namespace lacuna::program
