// SPDX-License-Identifier: MIT
#pragma once

// The one way to read options: every call has a table with each key and the reader of its value. An unknown
// key is an error that names the nearest known key. A value of the wrong kind is an error that names the
// call, the option, what the value must be and what was found.

#include "bindings/box.h"

#include <lacuna/core/shared/nearest_word.h>
#include <lacuna/core/types.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lacuna::lua {

/// The source of a value, for messages: the call, and the option's name (null for an argument that is no
/// option).
struct Where {
    const char* call;
    const char* key;
};

/// Push "sweep: option 'layers'", or "sweep: the argument" if there is no key.
const char* push_subject(lua_State* L, const Where& where);
/// "sweep: option 'layers' must be a positive whole number, found -3".
[[noreturn]] void fail_value(lua_State* L, const Where& where, const char* expected, int index);
/// "sweep: option 'layers' <what>"; `format` as by lua_pushfstring.
[[noreturn]] void fail_option(lua_State* L, const Where& where, const char* format, ...);

// --- readers of one value ---------------------------------------------------------------------------

double read_number(lua_State* L, int index, const Where& where);           ///< finite
double read_positive(lua_State* L, int index, const Where& where);         ///< finite and > 0
double read_degrees(lua_State* L, int index, const Where& where);          ///< in (0, 180]
int read_whole(lua_State* L, int index, const Where& where, int smallest); ///< a whole number >= smallest
bool read_boolean(lua_State* L, int index, const Where& where);
const char* read_string(lua_State* L, int index, const Where& where); ///< not empty; Lua's own copy
/// A name that files can hold: not empty, without quotes and control characters.
const char* read_plain_name(lua_State* L, int index, const Where& where);
Vec3 read_vector(lua_State* L, int index, const Where& where); ///< {x, y, z}
/// A turn { point, direction, degrees }, whose direction is not 0.
struct Turn {
    Vec3 point, direction;
    double angle; ///< [rad]
};
Turn read_turn(lua_State* L, int index, const Where& where);

/// The length of the array at `index`; 0 for other values.
std::size_t array_length(lua_State* L, int index);
/// Push element `place` of the array at `index`. @return  its index
int push_element(lua_State* L, int index, int place);

template <class Value>
struct Word {
    const char* word;
    Value value;
};

/// Index of the word at `index` among `words`; for another word, raises an error that names the nearest one.
std::size_t read_word(lua_State* L, int index, const Where& where, const char* const* words,
                      std::size_t count);

template <class Value, std::size_t N>
Value read_word(lua_State* L, int index, const Where& where, const Word<Value> (&words)[N])
{
    const char* names[N];
    for (std::size_t i = 0; i < N; ++i) names[i] = words[i].word;
    return words[read_word(L, index, where, names, N)].value;
}

/// Call `read(element index on the stack, element's Where)` for each element of the array at `index`.
template <class Read>
void read_array(lua_State* L, int index, const Where& where, const char* expected, Read&& read)
{
    if (lua_type(L, index) != LUA_TTABLE) fail_value(L, where, expected, index);
    index = lua_absindex(L, index);
    const auto count = static_cast<lua_Integer>(lua_rawlen(L, index));
    for (lua_Integer i = 1; i <= count; ++i) {
        luaL_checkstack(L, 8, "array nested too deep");
        const int top = lua_gettop(L);
        const char* key = lua_pushfstring(L, "%s[%I]", where.key ? where.key : "", i);
        lua_rawgeti(L, index, i);
        read(top + 2, Where{where.call, key});
        lua_settop(L, top);
    }
}

/// Read the array at `index` into `items`: one item for each element, as `read` returns it.
template <class T, class Read>
void read_items(lua_State* L, int index, const Where& where, const char* expected, std::vector<T>& items,
                const Read& read)
{
    const std::size_t count = array_length(L, index);
    guard(L, [&] { items.resize(count); });
    std::size_t next = 0;
    read_array(L, index, where, expected,
               [&](int element, const Where& at) { items[next++] = read(L, element, at); });
}

/// Read a value, or each element of an array.
template <class Read>
void read_each(lua_State* L, int index, const Where& where, Read&& read)
{
    if (array_length(L, index) > 0)
        read_array(L, index, where, "", read);
    else
        read(index, where);
}

// --- tables of options ------------------------------------------------------------------------------

template <class Options>
struct Option {
    const char* key;
    void (*read)(lua_State* L, int index, const Where& where, Options& options);
};

/// @pre the value at `index` is a table. Raises for a key that is not one of `keys`.
void check_keys(lua_State* L, int index, const char* call, const char* const* keys, std::size_t count);
/// False if there are no options; raises an error if they are not a table.
bool has_options(lua_State* L, int index, const char* call);

/// @param left_out  keys of the table that this call does not know
template <class Options, std::size_t N>
void read_options(lua_State* L, int index, const char* call, const Option<Options> (&table)[N],
                  Options& options, std::span<const std::string_view> left_out = {})
{
    if (!has_options(L, index, call)) return;
    index = lua_absindex(L, index);
    const char* keys[N];
    std::size_t count = 0;
    for (const Option<Options>& option : table)
        if (std::ranges::find(left_out, option.key) == left_out.end()) keys[count++] = option.key;
    check_keys(L, index, call, keys, count);
    for (const Option<Options>& option : table) {
        const int top = lua_gettop(L);
        if (lua_getfield(L, index, option.key) != LUA_TNIL)
            option.read(L, top + 1, {call, option.key}, options);
        lua_settop(L, top);
    }
}

/// The member of a member: `member<&LoadArguments::load, &io::LoadOptions::scale>(arguments)`.
template <auto Member, auto... Inner, class Options>
auto& member(Options& o)
{
    if constexpr (sizeof...(Inner) == 0)
        return o.*Member;
    else
        return member<Inner...>(o.*Member);
}

// Readers straight into a member: `{"scale", positive<&LoadOptions::scale>}`.
template <auto... Member, class Options>
void number(lua_State* L, int i, const Where& where, Options& o)
{
    member<Member...>(o) = read_number(L, i, where);
}
template <auto... Member, class Options>
void positive(lua_State* L, int i, const Where& where, Options& o)
{
    member<Member...>(o) = read_positive(L, i, where);
}
template <auto... Member, class Options>
void count(lua_State* L, int i, const Where& where, Options& o)
{
    member<Member...>(o) = read_whole(L, i, where, 1);
}
template <auto... Member, class Options>
void degrees(lua_State* L, int i, const Where& where, Options& o)
{
    member<Member...>(o) = read_degrees(L, i, where);
}
template <auto Member, const auto& Words, class Options>
void word(lua_State* L, int i, const Where& where, Options& o)
{
    o.*Member = read_word(L, i, where, Words);
}
template <auto... Member, class Options>
void text(lua_State* L, int i, const Where& where, Options& o)
{
    const char* const read = read_string(L, i, where);
    guard(L, [&] { member<Member...>(o) = read; });
}
template <auto... Member, class Options>
void capitals(lua_State* L, int i, const Where& where, Options& o)
{
    text<Member...>(L, i, where, o);
    for (char& c : member<Member...>(o)) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
}
template <auto... Member, class Options>
void plain_name(lua_State* L, int i, const Where& where, Options& o)
{
    const char* const read = read_plain_name(L, i, where);
    guard(L, [&] { member<Member...>(o) = read; });
}
template <auto... Member, class Options>
void boolean(lua_State* L, int i, const Where& where, Options& o)
{
    member<Member...>(o) = read_boolean(L, i, where);
}
template <auto... Member, class Options>
void vector(lua_State* L, int i, const Where& where, Options& o)
{
    member<Member...>(o) = read_vector(L, i, where);
}

// --- nearest names ----------------------------------------------------------------------------------

/// The string nearest to `word` in the array at `index`; of equally near ones the first in alphabetical
/// order.
const char* nearest_in_table(lua_State* L, int index, const char* word);

} // namespace lacuna::lua
