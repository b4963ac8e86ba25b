// SPDX-License-Identifier: MIT
#include "bindings/lacuna_lua.h"

namespace lacuna::lua {

namespace {
const char kHostKey = 0; // its address is the registry's key
const Host kNobody{};
} // namespace

void set_host(lua_State* L, const Host* host)
{
    lua_pushlightuserdata(L, const_cast<Host*>(host));
    lua_rawsetp(L, LUA_REGISTRYINDEX, &kHostKey);
}

const Host& host(lua_State* L)
{
    lua_rawgetp(L, LUA_REGISTRYINDEX, &kHostKey);
    const auto* lent = static_cast<const Host*>(lua_touserdata(L, -1));
    lua_pop(L, 1);
    return lent ? *lent : kNobody;
}

} // namespace lacuna::lua
