// SPDX-License-Identifier: MIT
#pragma once

#include "bindings/classes.h"
#include "bindings/options.h"

#include <lacuna/core/error.h>

#include <cmath>
#include <initializer_list>
#include <thread>

namespace lacuna::lua {

/// Calls a function of the recipe that is kept on the stack, in a table. Only the thread that made the object
/// may call it, because Lua is not thread-safe; the kernel samples sizes and paths on the thread that called
/// it.
struct RecipeFunction {
    lua_State* state;
    int table; ///< index of the table
    lua_Integer number;
    const char* option; ///< for messages
    std::thread::id thread = std::this_thread::get_id();

    /// Leaves `count` results on the stack.
    void call(std::initializer_list<double> arguments, int count) const
    {
        if (std::this_thread::get_id() != thread || !lua_checkstack(state, 8))
            throw Error(
                Message("lua.size_function", "the function of option '{}' cannot be called here", option)
                    .remedy("give a number"));
        lua_rawgeti(state, table, number);
        for (const double argument : arguments) lua_pushnumber(state, argument);
        if (lua_pcall(state, static_cast<int>(arguments.size()), count, 0) == LUA_OK) return;
        keep_callback_error(state);
        throw CallbackFailed{};
    }
    /// A result, or NaN if it is not a number; the kernel refuses NaN.
    [[nodiscard]] double take(int index) const
    {
        return lua_type(state, index) == LUA_TNUMBER ? lua_tonumber(state, index) : std::nan("");
    }
    [[nodiscard]] double value(std::initializer_list<double> arguments) const
    {
        call(arguments, 1);
        const double result = take(-1);
        lua_pop(state, 1);
        return result;
    }
    /// Three numbers, or a table of them.
    [[nodiscard]] Vec3 point(double at) const
    {
        call({at}, 3);
        const int top = lua_gettop(state);
        if (lua_type(state, top - 2) == LUA_TTABLE)
            for (int i = 1; i <= 3; ++i) lua_rawgeti(state, top - 2, i);
        const Vec3 result(take(-3), take(-2), take(-1));
        lua_settop(state, top - 3);
        return result;
    }
};

/// Keep the function at `index` in the table at `table`.
inline RecipeFunction keep_function(lua_State* L, int index, int table, const Where& where)
{
    const auto number = static_cast<lua_Integer>(lua_rawlen(L, table)) + 1;
    lua_pushvalue(L, index);
    lua_rawseti(L, table, number);
    return {L, table, number, where.key};
}

/// A number of a place, or a function(x, y, z) that returns it.
/// @param read  reads the number
inline void read_field(lua_State* L, int index, const Where& where, int table,
                       std::function<double(const Vec3&)>& field,
                       double (*read)(lua_State*, int, const Where&), const char* expected)
{
    if (lua_type(L, index) == LUA_TFUNCTION) {
        const RecipeFunction function = keep_function(L, index, table, where);
        guard(L, [&] {
            field = [function](const Vec3& p) { return function.value({p.x(), p.y(), p.z()}); };
        });
        return;
    }
    if (lua_type(L, index) != LUA_TNUMBER) fail_value(L, where, expected, index);
    const double number = read(L, index, where);
    guard(L, [&] { field = [number](const Vec3&) { return number; }; });
}

} // namespace lacuna::lua
