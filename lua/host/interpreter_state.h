// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/interpreter.h>

#include "bindings/lacuna_lua.h"

#include <atomic>
#include <cstdint>
#include <exception>
#include <new>
#include <string>
#include <type_traits>

namespace lacuna {

/// The text at an index of Lua's stack; empty if there is no string. Raises no Lua error.
inline std::string text_at(lua_State* L, int index)
{
    std::size_t length = 0;
    const char* text = lua_type(L, index) == LUA_TSTRING ? lua_tolstring(L, index, &length) : nullptr;
    return text ? std::string(text, length) : std::string();
}

struct Interpreter::State {
    /// A call of the host while no recipe runs: restores the height of Lua's stack on every exit.
    /// @throw InvalidInput "lua.busy"  a recipe runs.
    class Visit {
    public:
        explicit Visit(State& state) : state_(state), top_(lua_gettop(state.lua)) { state.check_free(); }
        ~Visit() { lua_settop(state_.lua, top_); }
        Visit(const Visit&) = delete;
        Visit& operator=(const Visit&) = delete;
        State* operator->() const { return &state_; }

    private:
        State& state_;
        int top_;
    };

    enum class Why { nothing, cancelled, instructions };

    InterpreterOptions options;
    lua::Host host;
    std::atomic<bool> stop{false};
    Why why = Why::nothing;
    std::uint64_t steps = 0;
    bool running = false;
    std::exception_ptr thrown; ///< exception thrown by a callback
    std::size_t used = 0;      ///< [bytes]
    std::string traceback;
    lua_State* lua = nullptr;

    explicit State(InterpreterOptions asked);
    ~State()
    {
        if (lua) lua_close(lua);
    }
    State(const State&) = delete;
    State& operator=(const State&) = delete;

    static State& of(lua_State* L) { return **static_cast<State**>(lua_getextraspace(L)); }
    static void* allocate(void* state, void* block, std::size_t old_size, std::size_t new_size);
    static void hook(lua_State* L, lua_Debug*);
    static int handle_message(lua_State* L);
    static int open(lua_State* L);
    static int print(lua_State* L);
    static int call_host(lua_State* L);

    /// Run a callback. An exception is stored, and stops the run.
    template <class Body>
    void call_back(Body&& body) noexcept
    {
        try {
            body();
        } catch (...) {
            if (!thrown) thrown = std::current_exception();
            stop = true;
        }
    }
    void ask_host() noexcept
    {
        if (options.cancelled && !stop)
            call_back([&] {
                if (options.cancelled()) stop = true;
            });
    }

    /// Begin a call. If it is a run, a pending request to stop ends it at once.
    void start(bool is_run);
    void end() noexcept;
    [[noreturn]] void fail(int status);
    void call(int arguments, int results, bool is_run = true);
    Value value_at(int index) const;

    /// Run `work(L)` in a protected call; the values that it pushes stay on the stack.
    template <class Work>
    void protect(const Work& work)
    {
        static_assert(std::is_trivially_destructible_v<Work>, "capture by reference");
        if (!lua_checkstack(lua, 4)) throw std::bad_alloc();
        lua_pushcfunction(lua, [](lua_State* L) {
            const auto& body = *static_cast<const Work*>(lua_touserdata(L, 1));
            lua_settop(L, 0);
            body(L);
            return lua_gettop(L);
        });
        lua_pushlightuserdata(lua, const_cast<Work*>(&work));
        call(1, LUA_MULTRET, false);
    }
    void check_free() const
    {
        if (running)
            throw InvalidInput(Message("lua.busy", "this interpreter is running a recipe")
                                   .remedy("call it after the recipe has ended"));
    }
};

} // namespace lacuna
