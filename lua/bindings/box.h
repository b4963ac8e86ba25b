// SPDX-License-Identifier: MIT
#pragma once

// Lua is compiled as C: it raises errors by longjmp, which skips destructors, and no C++ exception may pass
// through its frames. So every binding takes the same four steps:
//
//   1. read the arguments     may raise. An object with a destructor lives in a temporary(), which Lua
//                             collects. lua_settop() comes first, so that no pushed value is taken for an
//                             argument. hold() keeps the object of the method alive, because any step of Lua
//                             may run a finalizer that closes it
//   2. make the userdata      may raise
//   3. guard(L, [&] {...})    kernel code, no Lua inside; an exception becomes a Lua error
//   4. push the results       may raise; nothing to destroy

#include <lua.hpp>

#include <lacuna/core/error.h>
#include <lacuna/core/message.h>

#include <exception>
#include <initializer_list>
#include <memory>
#include <new>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace lacuna::lua {

/// Name of a class as Lua sees it; specialised beside each class (`Model`, `Volume`, …).
template <class T>
inline constexpr const char* kClassName = nullptr;

// --- raising ----------------------------------------------------------------------------------------

// Every error of the bindings is a table { message, code, entities, attempts, file, line }. It prints as one
// line and has the methods of strings, so that recipes can use it like a text.

/// Raise the message on top of the stack, a string, with the recipe's file and line.
[[noreturn]] void raise(lua_State* L, const char* code);
/// Raise a message formatted as by lua_pushfstring, with the code "lua.invalid_input".
[[noreturn]] void fail(lua_State* L, const char* format, ...);
/// fail() with the given code.
[[noreturn]] void fail_as(lua_State* L, const char* code, const char* format, ...);
/// Push a description of the value at `index` for messages: `-3`, `"abc"`, `a table`, `a Face`, `nothing`.
const char* push_found(lua_State* L, int index);

// --- values of C++ inside userdata --------------------------------------------------------------------

/// A value that Lua collects, linked into the ring of all such values of a state. Lua does not call `__gc`
/// for objects that a finalizer makes while the state closes. The ring destroys those objects after all
/// finalizers of the bindings have run.
struct Living {
    Living* before = this;
    Living* after = this;
    void (*destroy)(Living&) noexcept = nullptr;

    Living() = default;
    Living(const Living&) = delete;
    Living& operator=(const Living&) = delete;
    ~Living() = default;

    /// Destroy the value, once.
    void release() noexcept;
};

/// The state's ring, made at its first use, before any object of the bindings that Lua finalizes. Raises an
/// error once the ring has been emptied; then only finalizers that were set before the first use still run.
Living& ring(lua_State* L);
void put_in(Living& ring, Living& value) noexcept;

/// `__gc` and `__close` of every Living.
int release_living(lua_State* L);
/// Push the metatable of values that belong to no class; with `closes` it also has `__close`.
void push_release_table(lua_State* L, bool closes);

template <class T>
struct Held : Living {
    T value{};
};

template <class T>
using Box = std::shared_ptr<T>;

template <class T>
void release(T& value) noexcept
{
    value.~T();
}
template <class T>
void release(Box<T>& box) noexcept // a released box may still be read
{
    box.reset();
}

/// Replace the metatable on top of the stack by a new T that has it. The T is destroyed with the state at the
/// latest.
template <class T>
T& push_held(lua_State* L)
{
    static_assert(alignof(Held<T>) <= alignof(lua_Number), "Lua aligns userdata no further");
    Living& living = ring(L);
    auto* held = new (lua_newuserdatauv(L, sizeof(Held<T>), 0)) Held<T>();
    // Nothing raises from here on: a value in the ring has its metatable, and leaves when it is collected.
    lua_insert(L, -2);
    lua_setmetatable(L, -2);
    held->destroy = [](Living& value) noexcept { release(static_cast<Held<T>&>(value).value); };
    put_in(living, *held);
    return held->value;
}

/// Push a default-constructed T, which Lua destroys when it collects it.
template <class T>
T& temporary(lua_State* L)
{
    static_assert(alignof(T) <= alignof(lua_Number), "Lua aligns userdata no further");
    if constexpr (std::is_trivially_destructible_v<T>) {
        return *new (lua_newuserdatauv(L, sizeof(T), 0)) T();
    } else {
        push_release_table(L, false);
        return push_held<T>(L);
    }
}

/// The temporary at `index`. @pre there is one, of this T.
template <class T>
T& temporary_at(lua_State* L, int index)
{
    if constexpr (std::is_trivially_destructible_v<T>)
        return *static_cast<T*>(lua_touserdata(L, index));
    else
        return static_cast<Held<T>*>(lua_touserdata(L, index))->value;
}

// --- the guard --------------------------------------------------------------------------------------

/// Thrown through kernel code if a Lua function that it called has failed; the registry keeps the Lua error.
struct CallbackFailed {};

/// The error of a guarded call. It is a temporary(), so that a longjmp cannot skip its destructor.
struct Failure {
    std::string message, code, remedy;
    std::vector<NamedEntity> entities; ///< that the message names
    std::vector<MessageValue> found, needed;
    std::vector<MessageParts> attempts; ///< failed attempts, each with its whole text
    bool from_callback = false;
    /// @param said  the message of a kernel error; null: none
    void keep(const char* its_code, const char* what, const Message* said = nullptr) noexcept;
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
        failure.keep(error.code().c_str(), error.what(), &error.message());
    } catch (const std::bad_alloc&) {
        failure.keep("core.memory", "not enough memory");
    } catch (const std::exception& error) {
        failure.keep("core.unexpected", error.what());
    } catch (...) {
        failure.keep("core.unexpected", "an unknown error inside the kernel");
    }
    return false;
}

/// Tell the host that the stage reported last is over, if the host asked for that.
void end_stage(lua_State* L);

/// Run kernel code; its exceptions become Lua errors. @pre no Lua call inside that may raise.
template <class Body>
void guard(lua_State* L, Body&& body)
{
    static_assert(std::is_trivially_destructible_v<std::remove_reference_t<Body>>, "capture by reference");
    Failure& failure = temporary<Failure>(L);
    const bool done = run_guarded(failure, body);
    end_stage(L);
    if (!done) raise(L, failure);
    lua_pop(L, 1);
}

/// Push the string that `make` returns. @return  it, as Lua holds it
template <class Make>
const char* push_text(lua_State* L, Make&& make)
{
    std::string& text = temporary<std::string>(L);
    guard(L, [&] { text = make(); });
    lua_pushlstring(L, text.data(), text.size());
    lua_remove(L, -2);
    return lua_tostring(L, -1);
}

// --- boxes: userdata that share a kernel object -------------------------------------------------------

using Functions = std::initializer_list<luaL_Reg>;

/// Set functions in the table on top of the stack.
void set_functions(lua_State* L, Functions functions);
/// Make a class with metamethods (`__tostring`, …) and fields, which are read as `object.name`: their
/// functions push one value.
void make_class(lua_State* L, const char* name, Functions meta, Functions fields);
/// Add methods to an existing class; each kernel folder adds its own.
void add_methods(lua_State* L, const char* class_name, Functions methods);

template <class T>
void make_class(lua_State* L, Functions meta, Functions fields = {})
{
    make_class(L, kClassName<T>, meta, fields);
}
template <class T>
void add_methods(lua_State* L, Functions methods)
{
    add_methods(L, kClassName<T>, methods);
}

/// Push an empty box, to be filled inside a guard.
template <class T>
Box<T>& new_box(lua_State* L)
{
    luaL_getmetatable(L, kClassName<T>);
    return push_held<Box<T>>(L);
}

/// Push a box of what `make` returns. @return  the number of results
template <class T, class Make>
int give_new(lua_State* L, const Make& make)
{
    Box<T>& box = new_box<T>(L);
    guard(L, [&] { box = std::make_shared<T>(make()); });
    return 1;
}

/// The box at `index`; null if there is something else.
template <class T>
Box<T>* test_box(lua_State* L, int index)
{
    auto* held = static_cast<Held<Box<T>>*>(luaL_testudata(L, index, kClassName<T>));
    return held ? &held->value : nullptr;
}

[[noreturn]] void fail_self(lua_State* L, int index, const char* class_name, bool released);

/// The box at `index`; raises an error if there is something else, or a released box.
template <class T>
Box<T>& check_box(lua_State* L, int index)
{
    Box<T>* box = test_box<T>(L, index);
    if (!box || !*box) fail_self(L, index, kClassName<T>, box != nullptr);
    return *box;
}

/// The object of the box at `index`, for use before Lua runs again: any allocation by Lua may run a
/// finalizer, and any function of the recipe may close the box. For longer use, hold() it.
template <class T>
T& check(lua_State* L, int index)
{
    return *check_box<T>(L, index);
}

/// A shared pointer to the object of the box at `index`, on the stack until the call ends. It keeps the
/// object alive even if the box is closed, collected or replaced meanwhile.
template <class T>
const Box<T>& hold_box(lua_State* L, int index)
{
    index = lua_absindex(L, index);
    push_release_table(L, true);
    auto& share = push_held<Box<T>>(L);
    lua_toclose(L, -1); // given back when the call ends, not when Lua next collects
    share = check_box<T>(L, index);
    return share;
}

template <class T>
T& hold(lua_State* L, int index)
{
    return *hold_box<T>(L, index);
}

} // namespace lacuna::lua
