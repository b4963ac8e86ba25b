// SPDX-License-Identifier: MIT
//
// Calls every function, method and field of the Lua API in random order with generated arguments
// (fuzz_lua_api.lua makes them). A call returns or raises a Lua error; all else is a fault: a report of a
// sanitizer, an end of the process, an exception's bare text, a volume left busy, a call that cancelling does
// not end.
//   fuzz_lua_api [--calls N] [--seconds S] [--seed N] [--summary] [--show]
#include "bindings/lacuna_lua.h"
#include "fuzz/counted_new.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <functional>
#include <string>
#include <thread>

#include <unistd.h>

extern "C" const char* __asan_default_options() { return "allocator_may_return_null=1:detect_leaks=1"; }
extern "C" [[gnu::weak]] void __sanitizer_set_death_callback(void (*callback)());

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::size_t kMostOfKernel = std::size_t{1} << 30; // beyond it is std::bad_alloc
constexpr std::size_t kMostOfLua = std::size_t{1} << 27;
constexpr int kCancelAfter = 1;  // [s]
constexpr int kHangsAfter = 30;  // of work, cancelled long since; sanitizers make a step tenfold [s]
constexpr int kWaitsAfter = 600; // and of waiting, the machine may be busy [s]

std::atomic<bool> cancel{false};
std::atomic<std::clock_t> worked{0}; // by the process, when the call began
std::atomic<std::int64_t> began{0};  // of the call under way, 0: none [ns of the steady clock]
const char* volatile running = "nothing";
std::uint64_t seed = 1;
std::uint64_t calls = 0, cancelled = 0;

std::int64_t now() { return Clock::now().time_since_epoch().count(); }

void say_where()
{
    std::fprintf(stderr, "fuzz_lua_api: in %s, call %llu of seed %llu\n", running,
                 static_cast<unsigned long long>(calls), static_cast<unsigned long long>(seed));
}

[[noreturn]] void fault(const char* what)
{
    std::fprintf(stderr, "fuzz_lua_api: fault: %s\n", what);
    say_where();
    std::abort();
}

/// Cancels what lasts, and ends the process where that does not help.
void watch(const std::atomic<bool>& over)
{
    while (!over) {
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        const std::int64_t start = began;
        if (start == 0) continue;
        const double seconds = 1e-9 * static_cast<double>(now() - start);
        if (seconds > kCancelAfter) cancel = true;
        const double work = static_cast<double>(std::clock() - worked) / CLOCKS_PER_SEC;
        if (work > kHangsAfter || seconds > kWaitsAfter) fault("a call goes on after it was cancelled");
    }
}

void stop_hook(lua_State* L, lua_Debug*)
{
    if (cancel) luaL_error(L, "interrupted");
}

void* allocate(void* account, void* block, std::size_t old_size, std::size_t new_size)
{
    auto& used = *static_cast<std::size_t*>(account);
    if (!block) old_size = 0;
    if (new_size > old_size && used + (new_size - old_size) > kMostOfLua) return nullptr;
    void* moved = new_size == 0 ? nullptr : std::realloc(block, new_size);
    if (new_size == 0) std::free(block);
    if (new_size > 0 && !moved) return nullptr;
    used = used - old_size + new_size;
    return moved;
}

/// ok, results... = call(name, function, arguments...): bounded in time
int call(lua_State* L)
{
    running = lua_tostring(L, 1);
    ++calls;
    cancel = false;
    worked = std::clock();
    began = now();
    const int status = lua_pcall(L, lua_gettop(L) - 2, LUA_MULTRET, 0);
    began = 0;
    if (cancel.exchange(false)) ++cancelled;
    lua_pushboolean(L, status == LUA_OK);
    lua_replace(L, 1);
    return lua_gettop(L);
}

int count(lua_State*)
{
    ++calls;
    return 0;
}

int report_fault(lua_State* L) { fault(luaL_checkstring(L, 1)); }

int show(lua_State* L)
{
    std::fprintf(stderr, "%s: %s\n", luaL_checkstring(L, 1), luaL_checkstring(L, 2));
    return 0;
}

/// The classes as the registry holds them: metatable -> name.
void push_classes(lua_State* L)
{
    lua_newtable(L);
    for (const char* name : {"Model", "Face", "Volume", "Mesh", "Quality"}) {
        if (luaL_getmetatable(L, name) != LUA_TTABLE) fault("a class is missing");
        lua_pushstring(L, name);
        lua_rawset(L, -3);
    }
}

void check(lua_State* L, int status)
{
    if (status != LUA_OK) fault(lua_tostring(L, -1));
}

/// Call `host.name(argument)`; the host table is at index 1.
void call_host(lua_State* L, const char* name, std::uint64_t argument)
{
    lua_getfield(L, 1, name);
    lua_pushinteger(L, static_cast<lua_Integer>(argument));
    check(L, lua_pcall(L, 1, 1, 0));
}

void run_state(std::uint64_t most_calls, Clock::time_point end, std::uint64_t state_seed, bool shows,
               bool summary)
{
    constexpr std::uint64_t kCallsOfState = 4000; // then a new one: closing a state releases all at once
    constexpr int kHookInstructions = 1000;
    lacuna::lua::Host host;
    host.cancel = &cancel;
    std::size_t used = 0;
    lua_State* L = lua_newstate(allocate, &used);
    if (!L) fault("no Lua state");
    lua_sethook(L, stop_hook, LUA_MASKCOUNT, kHookInstructions);
    luaL_openlibs(L);
    lacuna::lua::set_host(L, &host);
    const luaL_Reg functions[] = {
        {"call", call}, {"count", count}, {"fault", report_fault}, {nullptr, nullptr}};
    luaL_newlib(L, functions);
    lua_pushlightuserdata(L, &host);
    lua_setfield(L, 1, "light");
    if (shows) {
        lua_pushcfunction(L, show);
        lua_setfield(L, 1, "show");
    }
    check(L, luaL_loadfile(L, LACUNA_FUZZ_SCRIPT));
    luaL_requiref(L, "lacuna", luaopen_lacuna, 0);
    push_classes(L);
    lua_pushvalue(L, 1);
    lua_pushinteger(L, static_cast<lua_Integer>(state_seed));
    check(L, lua_pcall(L, 4, 0, 0));
    const std::uint64_t stop = std::min(most_calls, calls + kCallsOfState);
    for (std::uint64_t step = 0; calls < stop && Clock::now() < end; ++step) {
        constexpr std::uint64_t kStepsOfSeed = 50, kStepsOfSowing = 400;
        if (step % kStepsOfSeed == 0) call_host(L, "reseed", step);
        if (step % kStepsOfSowing == 0) call_host(L, "sow", step);
        lua_settop(L, 1);
        lua_getfield(L, 1, "step");
        // What fails here is the script's own: a generated metamethod that raised among its values.
        if (lua_pcall(L, 0, 0, 0) != LUA_OK && shows)
            std::fprintf(stderr, "step: %s\n", luaL_tolstring(L, -1, nullptr));
        lua_settop(L, 1);
    }
    if (summary) {
        call_host(L, "summary", 0);
        std::printf("%s\n", lua_tostring(L, -1));
    }
    running = "closing the state";
    lua_close(L);
    if (used != 0) fault("the Lua state kept memory");
    // What is made once for a process is made by the first state.
    static const std::size_t held = lacuna::fuzz::held();
    if (lacuna::fuzz::held() != held) fault("values of C++ outlived the Lua state");
}

} // namespace

int main(int argc, char** argv)
{
    std::uint64_t most_calls = UINT64_MAX;
    double seconds = 5;
    bool summary = false, shows = false, timed = false;
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        if (word == "--summary") summary = true;
        if (word == "--show") shows = true;
        if (i + 1 == argc) continue;
        if (word == "--calls") most_calls = std::strtoull(argv[i + 1], nullptr, 10);
        if (word == "--seed") seed = std::strtoull(argv[i + 1], nullptr, 10);
        if (word == "--seconds") {
            seconds = std::strtod(argv[i + 1], nullptr);
            timed = true;
        }
    }
    if (most_calls != UINT64_MAX && !timed) seconds = 1e6;
    if (__sanitizer_set_death_callback) __sanitizer_set_death_callback(say_where);
    setenv("LACUNA_CAD", "/nonexistent", 1); // no CAD process: what needs one is an error

    std::string folder = (fs::temp_directory_path() / "fuzz_lua_api_XXXXXX").string();
    if (!mkdtemp(folder.data())) fault("no temporary folder");
    fs::current_path(folder);
    fs::create_directory("sub");

    lacuna::fuzz::limit_held(kMostOfKernel);
    std::atomic<bool> over{false};
    std::thread watcher(watch, std::cref(over));
    const auto start = Clock::now();
    const auto end = start +
                     std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
    std::uint64_t states = 0;
    for (; calls < most_calls && Clock::now() < end; ++states)
        run_state(most_calls, end, seed * 1'000'003 + states, shows, summary);
    over = true;
    watcher.join();
    fs::current_path("/");
    fs::remove_all(folder);
    std::printf("%llu calls in %llu states, %.1f s, %llu cancelled\n", static_cast<unsigned long long>(calls),
                static_cast<unsigned long long>(states),
                std::chrono::duration<double>(Clock::now() - start).count(),
                static_cast<unsigned long long>(cancelled));
}
