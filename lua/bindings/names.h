// SPDX-License-Identifier: MIT
#pragma once

#include "bindings/options.h"

#include <cctype>
#include <string_view>

namespace lacuna::lua {

/// Read a name that files can hold: not empty, without quotes and control characters. Lua owns the text.
inline const char* read_plain_name(lua_State* L, int index, const Where& where)
{
    const char* const name = read_string(L, index, where);
    for (const char c : std::string_view(name, lua_rawlen(L, index)))
        if (std::iscntrl(static_cast<unsigned char>(c)) != 0 || c == '"')
            fail_value(L, where, "a name without quotes and control characters", index);
    return name;
}

} // namespace lacuna::lua
