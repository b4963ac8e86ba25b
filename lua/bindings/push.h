// SPDX-License-Identifier: MIT
#pragma once

// Values of C++ as values of Lua.

#include <lua.hpp>

#include <lacuna/core/types.h>

#include <array>
#include <concepts>
#include <cstddef>
#include <string_view>
#include <variant>

namespace lacuna::lua {

/// Lua numbers from 1, the kernel from 0; only these functions convert.
inline lua_Integer to_lua(std::size_t index) { return static_cast<lua_Integer>(index) + 1; }
inline lua_Integer to_lua(Index index) { return static_cast<lua_Integer>(index) + 1; }
inline std::size_t from_lua(lua_Integer number) { return static_cast<std::size_t>(number - 1); }

/// Push an array of the values that `push_item` leaves on the stack, one for each item. Items are read one at
/// a time, because a finalizer may replace them.
template <class Items, class Push>
void push_array(lua_State* L, const Items& items, const Push& push_item)
{
    lua_createtable(L, static_cast<int>(items.size()), 0);
    for (std::size_t i = 0; i < items.size(); ++i) {
        push_item(items[i]);
        lua_rawseti(L, -2, to_lua(i));
    }
}

/// Push nil, a boolean, a number, a string of any bytes, a vector {x, y, z}, or an array of such values.
template <class T>
void push(lua_State* L, const T& value)
{
    if constexpr (std::same_as<T, std::monostate>) {
        lua_pushnil(L);
    } else if constexpr (std::same_as<T, bool>) {
        lua_pushboolean(L, value);
    } else if constexpr (std::integral<T>) {
        lua_pushinteger(L, static_cast<lua_Integer>(value));
    } else if constexpr (std::floating_point<T>) {
        lua_pushnumber(L, value);
    } else if constexpr (std::convertible_to<const T&, std::string_view>) {
        const std::string_view text = value;
        lua_pushlstring(L, text.data(), text.size());
    } else if constexpr (std::same_as<T, Vec3>) {
        push(L, std::array{value.x(), value.y(), value.z()});
    } else {
        push_array(L, value, [L](const auto& item) { push(L, item); });
    }
}
/// Push the result of a Lua function. @return  the number of results
template <class T>
int give(lua_State* L, const T& value)
{
    push(L, value);
    return 1;
}

/// Set a field of the table on top.
template <class T>
void set_field(lua_State* L, const char* key, const T& value)
{
    push(L, value);
    lua_setfield(L, -2, key);
}
/// Set a field of the table on top to an array, as push_array() makes it.
template <class Items, class Push>
void set_array(lua_State* L, const char* key, const Items& items, const Push& push_item)
{
    push_array(L, items, push_item);
    lua_setfield(L, -2, key);
}

} // namespace lacuna::lua
