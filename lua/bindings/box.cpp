// SPDX-License-Identifier: MIT
#include "bindings/box.h"

#include "bindings/lacuna_lua.h"
#include "bindings/options.h"
#include "bindings/push.h"
#include "bindings/unexpected.h"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstring>
#include <functional>
#include <utility>
#include <variant>
#include <vector>

#include <lacuna/core/shared/list_text.h>

namespace lacuna::lua {

namespace {

const char kCallbackErrorKey = 0; // the addresses of these are keys of the registry
const char kRingKey = 0;
const char kTemporaryKey = 0;
const char kShareKey = 0;

/// The ring's `__gc`. Lua finalizes objects in the reverse order of their creation, so all other objects of
/// the bindings were finalized before. Objects that their finalizers made are still in the ring and are
/// destroyed here.
int empty_ring(lua_State* L)
{
    auto& ring = *static_cast<Living*>(lua_touserdata(L, 1));
    while (ring.after != &ring) ring.after->release();
    lua_pushboolean(L, 0);
    lua_rawsetp(L, LUA_REGISTRYINDEX, &kRingKey); // the key exists: no allocation
    return 0;
}

// --- errors -------------------------------------------------------------------------------------------

const char kErrorMeta[] = "lacuna.Error";

/// Set the fields `file` and `line` of the error on top: the innermost frame of the user's own Lua.
void set_where(lua_State* L)
{
    lua_Debug frame;
    for (int level = 1; lua_getstack(L, level, &frame); ++level) {
        lua_getinfo(L, "Sl", &frame);
        if (frame.currentline > 0 && std::strcmp(frame.source, kEmbeddedSource) != 0) {
            set_field(L, "file", frame.short_src);
            set_field(L, "line", frame.currentline);
            return;
        }
    }
}

/// "recipe.lua:7: message [code]": the code last, in brackets, as compilers name their warnings.
int error_to_string(lua_State* L)
{
    lua_settop(L, 1);
    luaL_checktype(L, 1, LUA_TTABLE);
    for (const char* field : {"file", "line", "message", "code"}) {
        lua_pushstring(L, field);
        lua_rawget(L, 1);
        luaL_tolstring(L, -1, nullptr); // a recipe may have put anything there
        lua_remove(L, -2);
    }
    lua_pushstring(L, "file");
    const bool has_place = lua_rawget(L, 1) != LUA_TNIL;
    if (has_place)
        lua_pushfstring(L, "%s:%s: ", lua_tostring(L, 2), lua_tostring(L, 3));
    else
        lua_pushliteral(L, "");
    lua_pushfstring(L, "%s%s [%s]", lua_tostring(L, -1), lua_tostring(L, 4), lua_tostring(L, 5));
    return 1;
}

/// A method of strings, called on an error. Upvalue: the function.
int call_on_text(lua_State* L)
{
    if (lua_istable(L, 1)) {
        luaL_tolstring(L, 1, nullptr);
        lua_replace(L, 1);
    }
    lua_pushvalue(L, lua_upvalueindex(1));
    lua_insert(L, 1);
    lua_call(L, lua_gettop(L) - 1, LUA_MULTRET);
    return lua_gettop(L);
}

/// Lets recipes call methods of strings, such as error:find(...), on an error, which then acts as its text.
/// Upvalue: the table `string`.
int error_index(lua_State* L)
{
    lua_settop(L, 2);
    if (!lua_istable(L, lua_upvalueindex(1))) return 0;
    lua_pushvalue(L, 2);
    if (lua_rawget(L, lua_upvalueindex(1)) != LUA_TFUNCTION) return 0;
    lua_pushcclosure(L, call_on_text, 1);
    return 1;
}

int error_concat(lua_State* L)
{
    lua_settop(L, 2);
    luaL_tolstring(L, 1, nullptr);
    luaL_tolstring(L, 2, nullptr);
    lua_concat(L, 2);
    return 1;
}

int error_length(lua_State* L)
{
    luaL_tolstring(L, 1, nullptr);
    lua_pushinteger(L, static_cast<lua_Integer>(lua_rawlen(L, -1)));
    return 1;
}

/// Push the metatable of errors.
void push_error_meta(lua_State* L)
{
    if (luaL_newmetatable(L, kErrorMeta) == 0) return;
    set_functions(L, {{"__tostring", error_to_string}, {"__concat", error_concat}, {"__len", error_length}});
    luaL_getsubtable(L, LUA_REGISTRYINDEX, LUA_LOADED_TABLE);
    lua_getfield(L, -1, LUA_STRLIBNAME);
    lua_remove(L, -2);
    lua_pushcclosure(L, error_index, 1);
    lua_setfield(L, -2, "__index");
    set_field(L, "__metatable", "an error of lacuna");
}

/// Push { message =, code =, entities = { { kind =, tag = }, ... } }.
void push_words(lua_State* L, const std::string& message, const std::string& code,
                const std::vector<NamedEntity>& entities)
{
    lua_createtable(L, 0, 9);
    set_field(L, "message", message);
    set_field(L, "code", code);
    set_array(L, "entities", entities, [L](const NamedEntity& entity) {
        lua_createtable(L, 0, 2);
        set_field(L, "kind", entity.kind);
        set_field(L, "tag", entity.tag);
    });
}

/// Set a field to an array of numbers and texts.
void set_values(lua_State* L, const char* key, const std::vector<MessageValue>& values)
{
    set_array(L, key, values, [L](const MessageValue& value) {
        std::visit([L](const auto& held) { push(L, held); }, value);
    });
}

// --- classes ------------------------------------------------------------------------------------------

/// Push the strings of the array at `index`, in alphabetical order, with commas between them.
const char* push_sorted_names(lua_State* L, int index)
{
    auto& names = temporary<std::vector<std::string>>(L);
    const std::size_t count = lua_rawlen(L, index);
    for (std::size_t i = 1; i <= count; ++i) {
        lua_rawgeti(L, index, static_cast<lua_Integer>(i));
        const char* name = lua_tostring(L, -1); // the array keeps it alive after the pop
        lua_pop(L, 1);
        if (std::strncmp(name, "__", 2) != 0) guard(L, [&] { names.emplace_back(name); });
    }
    return push_text(L, [&] {
        std::sort(names.begin(), names.end());
        return full_list(names, std::identity());
    });
}

/// Upvalues: 1 the class name, 2 its methods, 3 its fields.
int index_class(lua_State* L)
{
    lua_pushvalue(L, 2);
    if (lua_rawget(L, lua_upvalueindex(2)) != LUA_TNIL) return 1;
    lua_pop(L, 1);
    lua_pushvalue(L, 2);
    if (lua_rawget(L, lua_upvalueindex(3)) != LUA_TNIL) {
        lua_pushvalue(L, 1);
        lua_call(L, 1, 1);
        return 1;
    }
    lua_settop(L, 2);
    if (lua_type(L, 2) != LUA_TSTRING)
        fail_as(L, "lua.unknown_field", "a %s is not an array", lua_tostring(L, lua_upvalueindex(1)));
    // Collect the names of methods and fields, to find the nearest one.
    lua_newtable(L);
    for (int list : {lua_upvalueindex(2), lua_upvalueindex(3)}) {
        for (lua_pushnil(L); lua_next(L, list); lua_pop(L, 1)) {
            lua_pushvalue(L, -2);
            lua_rawseti(L, 3, static_cast<lua_Integer>(lua_rawlen(L, 3)) + 1);
        }
    }
    const char* nearest = nearest_in_table(L, 3, lua_tostring(L, 2));
    fail_as(L, "lua.unknown_field", "a %s has no field or method '%s'; the nearest is '%s'. It has: %s",
            lua_tostring(L, lua_upvalueindex(1)), lua_tostring(L, 2), nearest, push_sorted_names(L, 3));
}

} // namespace

void raise(lua_State* L, const char* code)
{
    const char* message = lua_tostring(L, -1); // stays on the stack
    guard(L, [&] { throw InvalidInput(code, "{}", message); });
    __builtin_unreachable();
}

void end_stage(lua_State* L)
{
    const Host& lent = host(L);
    if (!lent.in_stage) return;
    lent.in_stage = false;
    if (lent.ended) lent.ended();
}

void fail(lua_State* L, const char* format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    lua_pushvfstring(L, format, arguments);
    va_end(arguments);
    raise(L, "lua.invalid_input");
}

void fail_as(lua_State* L, const char* code, const char* format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    lua_pushvfstring(L, format, arguments);
    va_end(arguments);
    raise(L, code);
}

const char* push_found(lua_State* L, int index)
{
    index = lua_absindex(L, index);
    switch (lua_type(L, index)) {
    case LUA_TNONE:
    case LUA_TNIL:
        return lua_pushliteral(L, "nothing");
    case LUA_TNUMBER: {
        const lua_Number value = lua_tonumber(L, index);
        if (std::isnan(value)) return lua_pushliteral(L, "not-a-number (0/0)");
        if (std::isinf(value)) return lua_pushliteral(L, "an infinite number");
        lua_pushvalue(L, index); // a copy: lua_tostring turns the value itself into a string
        return lua_tostring(L, -1);
    }
    case LUA_TBOOLEAN:
        return lua_pushstring(L, lua_toboolean(L, index) ? "true" : "false");
    case LUA_TSTRING:
        return lua_pushfstring(L, "\"%s\"", lua_tostring(L, index));
    case LUA_TTABLE:
        return lua_pushstring(L, lua_rawlen(L, index) > 0 ? "an array" : "a table");
    default:
        break;
    }
    if (luaL_getmetafield(L, index, "__name") == LUA_TSTRING) {
        lua_pushfstring(L, "a %s", lua_tostring(L, -1));
        lua_remove(L, -2);
        return lua_tostring(L, -1);
    }
    return lua_pushfstring(L, "a %s", luaL_typename(L, index));
}

void Living::release() noexcept
{
    if (!destroy) return;
    before->after = after;
    after->before = before;
    before = after = this;
    std::exchange(destroy, nullptr)(*this);
}

void put_in(Living& ring, Living& value) noexcept
{
    value.before = &ring;
    value.after = ring.after;
    ring.after->before = &value;
    ring.after = &value;
}

Living& ring(lua_State* L)
{
    const int found = lua_rawgetp(L, LUA_REGISTRYINDEX, &kRingKey);
    if (found == LUA_TUSERDATA) {
        auto& ring = *static_cast<Living*>(lua_touserdata(L, -1));
        lua_pop(L, 1); // the registry keeps it
        return ring;
    }
    constexpr int kUnfinished = 1; // the key exists but the ring does not: its creation failed before
    if (found == LUA_TBOOLEAN && lua_toboolean(L, -1) != kUnfinished)
        luaL_error(L, "lacuna: the Lua state is being closed"); // an error of ours would need the ring
    lua_pop(L, 1);
    lua_pushboolean(L, kUnfinished);
    lua_rawsetp(L, LUA_REGISTRYINDEX, &kRingKey);
    auto& ring = *new (lua_newuserdatauv(L, sizeof(Living), 0)) Living();
    lua_createtable(L, 0, 1);
    set_functions(L, {{"__gc", empty_ring}});
    lua_setmetatable(L, -2); // nothing raises from here on
    lua_rawsetp(L, LUA_REGISTRYINDEX, &kRingKey);
    return ring;
}

int release_living(lua_State* L)
{
    static_cast<Living*>(lua_touserdata(L, 1))->release();
    return 0;
}

void push_release_table(lua_State* L, bool closes)
{
    const char* const key = closes ? &kShareKey : &kTemporaryKey;
    if (lua_rawgetp(L, LUA_REGISTRYINDEX, key) == LUA_TTABLE) return;
    lua_pop(L, 1);
    lua_createtable(L, 0, 2);
    set_functions(L, {{"__gc", release_living}});
    if (closes) set_functions(L, {{"__close", release_living}});
    lua_pushvalue(L, -1);
    lua_rawsetp(L, LUA_REGISTRYINDEX, key);
}

std::string unexpected_text(std::string_view what)
{
    return "unexpected error inside Lacuna " LACUNA_VERSION " (" + std::string(what) +
           "): this is a fault of Lacuna, please report it with the recipe and its input";
}

void Failure::keep(const char* its_code, const char* what, const Message* said) noexcept
{
    try {
        code = its_code;
        message = code == "core.unexpected" ? unexpected_text(what) : what;
        if (said == nullptr) return;
        remedy = said->remedy();
        entities = said->entities();
        found = said->found();
        needed = said->needed();
        for (const Message& attempt : said->attempts())
            attempts.push_back({attempt.code(), attempt.text(), "", attempt.entities()});
    } catch (const std::bad_alloc&) {
        message = "out of memory"; // short enough to be kept without memory
        code = "core.memory";
        entities.clear();
        attempts.clear();
    }
}

void raise(lua_State* L, const Failure& failure)
{
    if (failure.from_callback) {
        lua_rawgetp(L, LUA_REGISTRYINDEX, &kCallbackErrorKey);
        lua_pushnil(L);
        lua_rawsetp(L, LUA_REGISTRYINDEX, &kCallbackErrorKey);
        lua_error(L);
    }
    push_words(L, failure.message, failure.code, failure.entities);
    set_array(L, "attempts", failure.attempts, [L](const MessageParts& attempt) {
        push_words(L, attempt.text, attempt.code, attempt.entities);
    });
    set_values(L, "found", failure.found);
    set_values(L, "needed", failure.needed);
    if (!failure.remedy.empty()) set_field(L, "remedy", failure.remedy);
    set_where(L);
    push_error_meta(L);
    lua_setmetatable(L, -2);
    lua_error(L);
    __builtin_unreachable();
}

void keep_callback_error(lua_State* L)
{
    lua_rawsetp(L, LUA_REGISTRYINDEX, &kCallbackErrorKey); // the slot was made by make_class: no allocation
}

void set_functions(lua_State* L, Functions functions)
{
    for (const luaL_Reg& function : functions) {
        lua_pushcfunction(L, function.func);
        lua_setfield(L, -2, function.name);
    }
}

void make_class(lua_State* L, const char* name, Functions meta, Functions fields)
{
    ring(L);
    lua_pushboolean(L, 0);
    lua_rawsetp(L, LUA_REGISTRYINDEX, &kCallbackErrorKey);

    luaL_newmetatable(L, name);
    set_functions(L, meta);
    set_functions(L, {{"__gc", release_living}, {"__close", release_living}});
    set_field(L, "__metatable", "a class of lacuna");

    lua_pushstring(L, name);
    lua_newtable(L);
    lua_pushvalue(L, -1);
    lua_setfield(L, -4, "methods");
    lua_newtable(L);
    set_functions(L, fields);
    lua_pushvalue(L, -1);
    lua_setfield(L, -5, "fields");
    lua_pushcclosure(L, index_class, 3);
    lua_setfield(L, -2, "__index");
    lua_pop(L, 1);
}

void add_methods(lua_State* L, const char* class_name, Functions methods)
{
    luaL_getmetatable(L, class_name);
    lua_getfield(L, -1, "methods");
    set_functions(L, methods);
    lua_pop(L, 2);
}

void fail_self(lua_State* L, int index, const char* class_name, bool released)
{
    if (released)
        fail_as(L, "lua.released", "this %s has been released (its <close> variable went out of scope)",
                class_name);
    const char* found = push_found(L, index);
    if (index == 1)
        fail_as(L, "lua.wrong_object",
                "a method of %s was called on %s; call it with a colon, as object:method(...)", class_name,
                found);
    fail_as(L, "lua.wrong_object", "expected a %s, found %s", class_name, found);
}

} // namespace lacuna::lua
