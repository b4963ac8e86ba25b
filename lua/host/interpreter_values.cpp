// SPDX-License-Identifier: MIT
// Values that the host reads and writes by their path. As in interpreter.cpp, code that may raise a Lua error
// runs in a protected call and owns no objects with destructors.
#include "host/interpreter_state.h"

#include "bindings/bind_buffer.h"
#include "bindings/box.h"
#include "bindings/push.h"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <span>

namespace lacuna {

namespace {

/// Push the value of a path. With `owner`, push the table that contains the last part, and the last part as a
/// key. May raise a Lua error.
void push_path(lua_State* L, const char* path, bool owner)
{
    lua_pushglobaltable(L);
    for (const char* at = path;;) {
        const char* const end = at + std::strcspn(at, ".");
        if (end == at) lua::fail_as(L, "lua.no_value", "the path '%s' has an empty part", path);
        lua_Integer number = 0;
        const auto [read, error] = std::from_chars(at, end, number);
        if (error == std::errc() && read == end)
            lua_pushinteger(L, number);
        else
            lua_pushlstring(L, at, static_cast<std::size_t>(end - at));
        if (*end == '\0' && owner) return;
        lua_gettable(L, -2);
        lua_remove(L, -2);
        if (*end == '\0') return;
        if (!lua_istable(L, -1)) {
            if (luaL_getmetafield(L, -1, "__index") == LUA_TNIL) {
                const char* found = lua::push_found(L, -1);
                lua::fail_as(L, "lua.no_value", "'%s' in the path '%s' is %s, which has no fields",
                             lua_pushlstring(L, path, static_cast<std::size_t>(end - path)), path, found);
            }
            lua_pop(L, 1);
        }
        at = end + 1;
    }
}

} // namespace

void Interpreter::set(const std::string& path, const Value& value)
{
    const State::Visit self(*state_);
    self->protect([&](lua_State* L) {
        push_path(L, path.c_str(), true);
        std::visit([L](const auto& held) { lua::push(L, held); }, value);
        lua_settable(L, -3);
    });
}

void Interpreter::set_numbers(const std::string& path, const double* numbers, std::size_t count)
{
    const State::Visit self(*state_);
    self->protect([&](lua_State* L) {
        push_path(L, path.c_str(), true);
        lua::push(L, std::span(numbers, count));
        lua_settable(L, -3);
    });
}

void Interpreter::set_function(const std::string& path, HostFunction function, void* user)
{
    const State::Visit self(*state_);
    self->protect([&](lua_State* L) {
        push_path(L, path.c_str(), true);
        lua_pushlightuserdata(L, reinterpret_cast<void*>(function));
        lua_pushlightuserdata(L, user);
        lua_pushstring(L, path.c_str());
        lua_pushcclosure(L, State::call_host, 3);
        lua_settable(L, -3);
    });
}

Value Interpreter::get(const std::string& path)
{
    const State::Visit self(*state_);
    self->protect([&](lua_State* L) { push_path(L, path.c_str(), false); });
    return self->value_at(-1);
}

std::string Interpreter::type_of(const std::string& path)
{
    const State::Visit self(*state_);
    self->protect([&](lua_State* L) {
        push_path(L, path.c_str(), false);
        if (luaL_getmetafield(L, -1, "__name") != LUA_TSTRING) lua_pushstring(L, luaL_typename(L, 1));
    });
    return text_at(self->lua, -1);
}

BufferView Interpreter::buffer(const std::string& path)
{
    const State::Visit self(*state_);
    BufferView view;
    self->protect([&](lua_State* L) {
        push_path(L, path.c_str(), false);
        const auto* box = lua::test_box<lua::BufferState>(L, -1);
        if (!box || !*box)
            lua::fail_as(L, "lua.no_value", "'%s' must be a Buffer, found %s", path.c_str(),
                         lua::push_found(L, -1));
        const lua::BufferState& found = **box;
        view.type = found.is_real() ? BufferView::Type::float64 : BufferView::Type::int32;
        view.data = found.data();
        view.rows = found.rows();
        view.columns = found.columns;
    });
    return view;
}

std::vector<double> Interpreter::get_numbers(const std::string& path)
{
    if (type_of(path) == "Buffer") {
        const BufferView view = buffer(path);
        std::vector<double> numbers(view.rows * view.columns);
        if (view.type == BufferView::Type::float64)
            std::copy_n(static_cast<const double*>(view.data), numbers.size(), numbers.begin());
        else
            std::copy_n(static_cast<const std::int32_t*>(view.data), numbers.size(), numbers.begin());
        return numbers;
    }
    const State::Visit self(*state_);
    std::size_t count = 0;
    self->protect([&](lua_State* L) {
        push_path(L, path.c_str(), false);
        if (!lua_istable(L, -1))
            lua::fail_as(L, "lua.no_value", "'%s' must be an array of numbers or a Buffer, found %s",
                         path.c_str(), lua::push_found(L, -1));
        count = lua_rawlen(L, -1);
    });
    std::vector<double> numbers(count);
    self->protect([&](lua_State* L) {
        push_path(L, path.c_str(), false);
        for (std::size_t i = 0; i < count; ++i) {
            if (lua_rawgeti(L, 1, static_cast<lua_Integer>(i) + 1) != LUA_TNUMBER)
                lua::fail_as(L, "lua.no_value", "'%s' must be an array of numbers, found %s at %I",
                             path.c_str(), lua::push_found(L, -1), static_cast<lua_Integer>(i) + 1);
            numbers[i] = lua_tonumber(L, -1);
            lua_settop(L, 1);
        }
    });
    return numbers;
}

} // namespace lacuna
