// SPDX-License-Identifier: MIT
#include "bindings/options.h"

#include <lacuna/core/shared/constants.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdarg>
#include <cstring>
#include <limits>
#include <string_view>

namespace lacuna::lua {

namespace {

/// Push "a, b, c".
const char* push_list(lua_State* L, const char* const* words, std::size_t count)
{
    luaL_Buffer buffer;
    luaL_buffinit(L, &buffer);
    for (std::size_t i = 0; i < count; ++i) {
        if (i > 0) luaL_addstring(&buffer, ", ");
        luaL_addstring(&buffer, words[i]);
    }
    luaL_pushresult(&buffer);
    return lua_tostring(L, -1);
}

bool is_finite(lua_State* L, int index)
{
    return lua_type(L, index) == LUA_TNUMBER && std::isfinite(lua_tonumber(L, index));
}

} // namespace

const char* push_subject(lua_State* L, const Where& where)
{
    if (!where.key) return lua_pushfstring(L, "%s: the argument", where.call);
    if (*where.key == '[') return lua_pushfstring(L, "%s: the argument's value %s", where.call, where.key);
    return lua_pushfstring(L, "%s: option '%s'", where.call, where.key);
}

void fail_value(lua_State* L, const Where& where, const char* expected, int index)
{
    index = lua_absindex(L, index);
    const char* found = push_found(L, index);
    const char* subject = push_subject(L, where);
    fail_as(L, "lua.bad_value", "%s must be %s, found %s", subject, expected, found);
}

void fail_option(lua_State* L, const Where& where, const char* format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    const char* what = lua_pushvfstring(L, format, arguments);
    va_end(arguments);
    const char* subject = push_subject(L, where);
    fail_as(L, "lua.bad_value", "%s %s", subject, what);
}

double read_number(lua_State* L, int index, const Where& where)
{
    if (!is_finite(L, index)) fail_value(L, where, "a number", index);
    return lua_tonumber(L, index);
}

double read_positive(lua_State* L, int index, const Where& where)
{
    if (!is_finite(L, index) || lua_tonumber(L, index) <= 0) fail_value(L, where, "a positive number", index);
    return lua_tonumber(L, index);
}

double read_degrees(lua_State* L, int index, const Where& where)
{
    const double degrees = read_positive(L, index, where);
    if (degrees > 180) fail_value(L, where, "degrees in (0, 180]", index);
    return degrees;
}

int read_whole(lua_State* L, int index, const Where& where, int smallest)
{
    int whole = 0;
    lua_Integer value = 0;
    if (lua_type(L, index) == LUA_TNUMBER) value = lua_tointegerx(L, index, &whole);
    if (!whole || value < smallest || value > std::numeric_limits<int>::max()) {
        const char* expected = smallest == 1 ? "a positive whole number"
                                             : lua_pushfstring(L, "a whole number of at least %d", smallest);
        if (smallest == std::numeric_limits<int>::min()) expected = "a whole number";
        fail_value(L, where, expected, index);
    }
    return static_cast<int>(value);
}

bool read_boolean(lua_State* L, int index, const Where& where)
{
    if (lua_type(L, index) != LUA_TBOOLEAN) fail_value(L, where, "true or false", index);
    return lua_toboolean(L, index) != 0;
}

const char* read_string(lua_State* L, int index, const Where& where)
{
    if (lua_type(L, index) != LUA_TSTRING || lua_rawlen(L, index) == 0)
        fail_value(L, where, "a word in quotes", index);
    return lua_tostring(L, index);
}

const char* read_plain_name(lua_State* L, int index, const Where& where)
{
    const char* const name = read_string(L, index, where);
    for (const char c : std::string_view(name, lua_rawlen(L, index)))
        if (std::iscntrl(static_cast<unsigned char>(c)) != 0 || c == '"')
            fail_value(L, where, "a name without quotes and control characters", index);
    return name;
}

Vec3 read_vector(lua_State* L, int index, const Where& where)
{
    if (array_length(L, index) != 3) fail_value(L, where, "three numbers, { x, y, z }", index);
    Vec3 vector;
    for (int i = 0; i < 3; ++i) {
        vector[i] = read_number(L, push_element(L, index, i + 1), where);
        lua_pop(L, 1);
    }
    return vector;
}

Turn read_turn(lua_State* L, int index, const Where& where)
{
    if (array_length(L, index) != 3) fail_value(L, where, "{ point, direction, angle in degrees }", index);
    const Turn turn{read_vector(L, push_element(L, index, 1), where),
                    read_vector(L, push_element(L, index, 2), where),
                    read_number(L, push_element(L, index, 3), where) * kDegree};
    if (!(turn.direction.stableNorm() > 0)) fail_option(L, where, "has a direction of length 0");
    lua_pop(L, 3);
    return turn;
}

std::size_t array_length(lua_State* L, int index)
{
    return lua_type(L, index) == LUA_TTABLE ? lua_rawlen(L, index) : 0;
}

int push_element(lua_State* L, int index, int place)
{
    lua_rawgeti(L, index, place);
    return lua_gettop(L);
}

std::size_t read_word(lua_State* L, int index, const Where& where, const char* const* words,
                      std::size_t count)
{
    const char* known = push_list(L, words, count);
    if (lua_type(L, index) != LUA_TSTRING)
        fail_value(L, where, lua_pushfstring(L, "one of %s", known), index);
    const char* word = lua_tostring(L, index);
    for (std::size_t i = 0; i < count; ++i)
        if (std::strcmp(words[i], word) == 0) {
            lua_pop(L, 1);
            return i;
        }
    fail_option(L, where, "must be one of %s; found \"%s\", did you mean \"%s\"?", known, word,
                words[nearest_word(word, {words, count})]);
}

bool has_options(lua_State* L, int index, const char* call)
{
    if (lua_isnoneornil(L, index)) return false;
    if (lua_type(L, index) != LUA_TTABLE) {
        const char* found = push_found(L, index);
        fail_as(L, "lua.bad_value", "%s: the options must be a table { key = value, ... }, found %s", call,
                found);
    }
    return true;
}

void check_keys(lua_State* L, int index, const char* call, const char* const* keys, std::size_t count)
{
    index = lua_absindex(L, index);
    for (lua_pushnil(L); lua_next(L, index); lua_pop(L, 1)) {
        if (lua_type(L, -2) != LUA_TSTRING) {
            const char* found = push_found(L, -1);
            fail_as(L, "lua.unknown_option",
                    "%s: the option %s is without a name; write key = value. The keys are: %s", call, found,
                    push_list(L, keys, count));
        }
        const char* key = lua_tostring(L, -2);
        const auto is_key = [key](const char* known) { return std::strcmp(known, key) == 0; };
        if (std::none_of(keys, keys + count, is_key))
            fail_as(L, "lua.unknown_option", "%s: unknown option '%s'; the nearest is '%s'. The keys are: %s",
                    call, key, keys[nearest_word(key, {keys, count})], push_list(L, keys, count));
    }
}

const char* nearest_in_table(lua_State* L, int index, const char* word)
{
    index = lua_absindex(L, index);
    const char* best = "";
    const auto count = static_cast<lua_Integer>(lua_rawlen(L, index));
    for (lua_Integer i = 1; i <= count; ++i) {
        lua_rawgeti(L, index, i); // the array keeps the string alive after the pop
        const char* name = lua_tostring(L, -1);
        lua_pop(L, 1);
        const std::size_t here = edit_distance(word, name), there = edit_distance(word, best);
        if (*best == '\0' || here < there || (here == there && std::strcmp(name, best) < 0)) best = name;
    }
    return best;
}

} // namespace lacuna::lua
