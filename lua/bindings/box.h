// SPDX-License-Identifier: MIT
#pragma once

// Lua is compiled as C: it raises by longjmp, which skips destructors, and no C++ exception may pass through
// its frames. So every binding goes through the same four steps:
//
//   1. read the arguments     may raise; what needs a destructor lives in a temporary(), which Lua collects;
//                             lua_settop() first, so that what is pushed never looks like an argument left
//                             out; hold() what is worked on: any step of Lua may run a finalizer that closes
//                             it
//   2. make the userdata      may raise
//   3. guard(L, [&] {...})    kernel code, no Lua inside; an exception becomes a Lua error
//   4. push the results       may raise; nothing to destroy

#include <lua.hpp>

#include <lacuna/core/error.h>

#include <exception>
#include <memory>
#include <new>
#include <string>
#include <type_traits>
#include <utility>

namespace lacuna::lua {

/// Name of a class as Lua sees it; specialised beside each class (`Model`, `Volume`, …).
template <class T>
inline constexpr const char* kClassName = nullptr;

// --- raising ----------------------------------------------------------------------------------------

/// Raise the message on top of the stack, with the recipe's file and line before it.
[[noreturn]] void raise(lua_State* L);
/// Raise a message put together as by lua_pushfstring.
[[noreturn]] void fail(lua_State* L, const char* format, ...);
/// Push the words for "what was found": `-3`, `"abc"`, `a table`, `a Face`, `nothing`.
const char* push_found(lua_State* L, int index);

// --- temporaries ------------------------------------------------------------------------------------

/// Push the metatable by which Lua lets go of a userdata of type T, made at first need: `release` is its
/// `__gc`, and with `closes` its `__close` as well.
template <class T>
void push_release_table(lua_State* L, lua_CFunction release, bool closes)
{
    static const char key = 0; // its address is the registry's key
    if (lua_rawgetp(L, LUA_REGISTRYINDEX, &key) == LUA_TTABLE) return;
    lua_pop(L, 1);
    lua_createtable(L, 0, 2);
    lua_pushcfunction(L, release);
    lua_setfield(L, -2, "__gc");
    if (closes) {
        lua_pushcfunction(L, release);
        lua_setfield(L, -2, "__close");
    }
    lua_pushvalue(L, -1);
    lua_rawsetp(L, LUA_REGISTRYINDEX, &key);
}

/// A default-made T on the stack that Lua destroys when it collects it.
template <class T>
T& temporary(lua_State* L)
{
    static_assert(alignof(T) <= alignof(lua_Number), "Lua aligns userdata no further");
    if constexpr (!std::is_trivially_destructible_v<T>) {
        // Before the value is made: making the metatable may raise, and would leave a value without its
        // destructor.
        push_release_table<T>(
            L,
            [](lua_State* state) {
                static_cast<T*>(lua_touserdata(state, 1))->~T();
                return 0;
            },
            false);
    }
    T* value = new (lua_newuserdatauv(L, sizeof(T), 0)) T();
    if constexpr (!std::is_trivially_destructible_v<T>) {
        lua_insert(L, -2);
        lua_setmetatable(L, -2);
    }
    return *value;
}

// --- the guard --------------------------------------------------------------------------------------

/// Thrown out of kernel code by a Lua function it called back; the Lua error waits in the registry.
struct CallbackFailed {};

/// What went wrong inside a guard, kept where no longjmp can lose it.
struct Failure {
    std::string message;
    bool from_callback = false;
    void note(const Error& error);
    void note(const char* what);
};

[[noreturn]] void raise(lua_State* L, const Failure& failure);
/// Keep the Lua error on top of the stack for raise(), and pop it. Raises nothing itself.
void keep_callback_error(lua_State* L);

template <class Body>
bool run_guarded(Failure& failure, Body& body) noexcept
{
    try {
        body();
        return true;
    } catch (const CallbackFailed&) {
        failure.from_callback = true;
    } catch (const Error& error) {
        failure.note(error);
    } catch (const std::bad_alloc&) {
        failure.note("not enough memory");
    } catch (const std::exception& error) {
        failure.note(error.what());
    } catch (...) {
        failure.note("an unknown error inside the kernel");
    }
    return false;
}

/// Run kernel code; its exceptions become Lua errors. @pre no Lua call inside that may raise.
template <class Body>
void guard(lua_State* L, Body&& body)
{
    static_assert(std::is_trivially_destructible_v<std::remove_reference_t<Body>>, "capture by reference");
    Failure& failure = temporary<Failure>(L);
    if (!run_guarded(failure, body)) raise(L, failure);
    lua_pop(L, 1);
}

/// Push the string `make` returns.
template <class Make>
void push_text(lua_State* L, Make&& make)
{
    std::string& text = temporary<std::string>(L);
    guard(L, [&] { text = make(); });
    lua_pushlstring(L, text.data(), text.size());
    lua_remove(L, -2);
}

// --- boxes: userdata that share a kernel object -------------------------------------------------------

/// Something a class shows as `object.name`; pushes one value, the object is at index 1.
struct Field {
    const char* name;
    lua_CFunction get;
};

/// Make the class: its fields, and what Lua calls by itself (`__tostring`, …). Lists end with a null name.
void make_class(lua_State* L, const char* name, const Field* fields, const luaL_Reg* meta,
                lua_CFunction release);
/// Give a class that was made more methods; each kernel folder adds its own.
void add_methods(lua_State* L, const char* class_name, const luaL_Reg* methods);

template <class T>
using Box = std::shared_ptr<T>;

template <class T>
int release_box(lua_State* L) // __gc and __close: a box may be released twice
{
    static_cast<Box<T>*>(lua_touserdata(L, 1))->reset();
    return 0;
}

template <class T>
void make_class(lua_State* L, const Field* fields, const luaL_Reg* meta)
{
    make_class(L, kClassName<T>, fields, meta, release_box<T>);
}

/// Push an empty box, to be filled inside a guard.
template <class T>
Box<T>& new_box(lua_State* L)
{
    auto* box = new (lua_newuserdatauv(L, sizeof(Box<T>), 0)) Box<T>();
    luaL_setmetatable(L, kClassName<T>);
    return *box;
}

/// The box at `index`, null where there is something else.
template <class T>
Box<T>* test_box(lua_State* L, int index)
{
    return static_cast<Box<T>*>(luaL_testudata(L, index, kClassName<T>));
}

[[noreturn]] void fail_self(lua_State* L, int index, const char* class_name, bool released);

/// The box at `index`; raises where there is something else, or a released one.
template <class T>
Box<T>& check_box(lua_State* L, int index)
{
    Box<T>* box = test_box<T>(L, index);
    if (!box || !*box) fail_self(L, index, kClassName<T>, box != nullptr);
    return *box;
}

/// The object of the box at `index`, for use before Lua runs again: any allocation of Lua's may run a
/// finalizer, and any function of the recipe may close it. What lives longer is held.
template <class T>
T& check(lua_State* L, int index)
{
    return *check_box<T>(L, index);
}

/// A share in the object of the box at `index`, on the stack until the call ends: whatever closes, collects
/// or replaces the box meanwhile, the object lives.
template <class T>
const Box<T>& hold_box(lua_State* L, int index)
{
    struct Share {
        Box<T> object;
    };
    index = lua_absindex(L, index);
    push_release_table<Share>(
        L,
        [](lua_State* state) {
            static_cast<Share*>(lua_touserdata(state, 1))->object.reset();
            return 0;
        },
        true);
    auto* share = new (lua_newuserdatauv(L, sizeof(Share), 0)) Share();
    lua_insert(L, -2);
    lua_setmetatable(L, -2);
    lua_toclose(L, -1); // given back when the call ends, not when Lua next collects
    share->object = check_box<T>(L, index);
    return share->object;
}

template <class T>
T& hold(lua_State* L, int index)
{
    return *hold_box<T>(L, index);
}

} // namespace lacuna::lua
