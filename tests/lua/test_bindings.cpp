// SPDX-License-Identifier: MIT
// The seam between Lua, which raises by longjmp, and C++, which throws: nothing is lost and nothing is
// destroyed twice.
#include "bindings/box.h"
#include "bindings/lacuna_lua.h"

#include <lacuna/core/error.h>

#include <doctest/doctest.h>

#include <atomic>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>

namespace lacuna::lua {

namespace {

/// Counts how many are alive.
struct Counted {
    inline static int alive = 0;
    Counted() { ++alive; }
    Counted(const Counted&) = delete;
    Counted& operator=(const Counted&) = delete;
    ~Counted() { --alive; }
};

struct State {
    lua_State* lua = luaL_newstate();
    State() { luaL_openlibs(lua); }
    ~State()
    {
        if (lua) lua_close(lua);
    }
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    operator lua_State*() const { return lua; }
};

/// A state with the module, whose host can cancel.
struct CancellableState {
    std::atomic<bool> cancel{false};
    Host lent;
    State lua;
    CancellableState()
    {
        lent.cancel = &cancel;
        set_host(lua, &lent);
        luaL_requiref(lua, "lacuna", luaopen_lacuna, 1);
        lua_settop(lua, 0);
    }
};

/// The error of a chunk as text, empty where it runs through.
std::string error_of(lua_State* L, const char* chunk)
{
    std::string message;
    if (luaL_dostring(L, chunk) != LUA_OK) message = luaL_tolstring(L, -1, nullptr);
    lua_settop(L, 0);
    return message;
}

int throw_by_number(lua_State* L)
{
    const int kind = static_cast<int>(lua_tointeger(L, 1));
    temporary<Counted>(L);
    guard(L, [&] {
        const Counted on_the_way;
        switch (kind) {
        case 1:
            throw InvalidInput("test.input", "face 12 is wrong");
        case 2:
            throw std::bad_alloc();
        case 3:
            throw std::runtime_error("plain");
        case 4:
            throw 42;
        case 5:
            throw Cancelled();
        default:
            break;
        }
    });
    lua_pushinteger(L, kind);
    return 1;
}

int make_box(lua_State* L)
{
    auto& box = new_box<Counted>(L);
    guard(L, [&] { box = std::make_shared<Counted>(); });
    return 1;
}

int use_box(lua_State* L)
{
    check<Counted>(L, 1);
    return 0;
}

} // namespace

template <>
inline constexpr const char* kClassName<Counted> = "Counted";

TEST_CASE("every exception becomes a Lua error with file and line, and destroys what it passes")
{
    State L;
    make_class<Counted>(L, {});
    lua_register(L, "throw", throw_by_number);
    CHECK(error_of(L, "assert(throw(0) == 0)") == "");
    CHECK(error_of(L, "\nthrow(1)").find(":2: face 12 is wrong [test.input]") != std::string::npos);
    CHECK(error_of(L, "throw(2)").find("not enough memory") != std::string::npos);
    for (const char* word : {":1: unexpected error inside Lacuna ", "(plain)", "please report"})
        CHECK(error_of(L, "throw(3)").find(word) != std::string::npos);
    CHECK(error_of(L, "throw(4)").find("unknown error") != std::string::npos);
    CHECK(error_of(L, "throw(5)").find("[core.cancelled]") != std::string::npos);
    lua_gc(L, LUA_GCCOLLECT);
    CHECK(Counted::alive == 0);
}

TEST_CASE("a thousand failures in a row leave nothing alive and the stack as it was")
{
    State L;
    make_class<Counted>(L, {});
    lua_register(L, "throw", throw_by_number);
    CHECK(error_of(L, "for i = 1, 1000 do assert(not pcall(throw, i % 5 + 1)) end") == "");
    CHECK(lua_gettop(L) == 0);
    lua_gc(L, LUA_GCCOLLECT);
    CHECK(Counted::alive == 0);
}

TEST_CASE("a box is released once, by scope, by collection or with the state, and says so when used after")
{
    {
        State L;
        make_class<Counted>(L, {});
        lua_register(L, "make", make_box);
        lua_register(L, "use", use_box);
        CHECK(error_of(L, "kept = make() do local b <close> = make() use(b) escaped = b end use(kept)") ==
              "");
        CHECK(Counted::alive == 1);
        CHECK(error_of(L, "use(escaped)").find("released") != std::string::npos);
        CHECK(error_of(L, "kept = nil for _ = 1, 100 do make() end collectgarbage() collectgarbage()") == "");
        CHECK(Counted::alive == 0);
        CHECK(error_of(L, "kept = make()") == "");
        CHECK(Counted::alive == 1);
    }
    CHECK(Counted::alive == 0);
}

TEST_CASE("what finalizers make while the state closes is destroyed with it, whatever they are older than")
{
    const char* const finalizer = "setmetatable({}, { __gc = function()\n"
                                  "  if make then kept = make() gone = make() gone = nil end\n"
                                  "  for i = 0, 5 do if throw then pcall(throw, i) end end\n"
                                  "  if use then coroutine.resume(coroutine.create(use), kept) end\n"
                                  "end })";
    for (const bool older : {false, true}) {
        CAPTURE(older);
        {
            State L;
            if (older) CHECK(error_of(L, finalizer) == "");
            make_class<Counted>(L, {});
            lua_register(L, "make", make_box);
            lua_register(L, "use", use_box);
            lua_register(L, "throw", throw_by_number);
            CHECK(error_of(L, "kept = make()") == "");
            if (!older) CHECK(error_of(L, finalizer) == "");
            CHECK(Counted::alive == 1);
        }
        CHECK(Counted::alive == 0);
    }
}

TEST_CASE("what is no box of the class is refused by name")
{
    State L;
    make_class<Counted>(L, {});
    lua_register(L, "use", use_box);
    for (const char* wrong : {"nil", "1", "{}", "io.stdout", "print"}) {
        const std::string message = error_of(L, (std::string("use(") + wrong + ")").c_str());
        CAPTURE(wrong);
        CHECK(message.find("Counted") != std::string::npos);
    }
}

TEST_CASE("the module opens in any number of states at once, each with its own classes")
{
    State first, second;
    for (lua_State* L : {first.lua, second.lua, first.lua}) {
        luaL_requiref(L, "lacuna", luaopen_lacuna, 1);
        lua_settop(L, 0);
        CHECK(error_of(L, "assert(#lacuna.synthetic.barrel():faces() == 3)") == "");
    }
    lua_close(first.lua);
    first.lua = nullptr;
    CHECK(error_of(second, "assert(#lacuna.synthetic.barrel():faces() == 3)") == "");
}

TEST_CASE("the host's cancel flag stops kernel work, and a cleared one lets it go on")
{
    CancellableState L;
    const char* const chunk =
        "local m = lacuna.synthetic.prism { sides = 4, drop = 'walls' }\n"
        "m:open_volume({ source = 'source', target = 'target' }):sweep { layers = 4, size = 0.2 }";
    L.cancel = true;
    CHECK(error_of(L.lua, chunk).find("[core.cancelled]") != std::string::npos);
    L.cancel = false;
    CHECK(error_of(L.lua, chunk) == "");
}

TEST_CASE("finding roles, matching and closing stop on the host's cancel flag")
{
    CancellableState L;
    REQUIRE(error_of(L.lua, "m = lacuna.synthetic.prism { sides = 4, drop = 'walls' }\n"
                            "roles = { source = 'source', target = 'target' }\n"
                            "v = m:open_volume(roles)") == "");
    const char* const calls[] = {"m:open_volume(roles)", "m:open_volume()", "v:match()", "v:close()"};
    for (const char* const chunk : calls) {
        CAPTURE(chunk);
        L.cancel = true;
        CHECK(error_of(L.lua, chunk).find("[core.cancelled]") != std::string::npos);
        L.cancel = false;
        CHECK(error_of(L.lua, chunk) == "");
    }
}

} // namespace lacuna::lua
