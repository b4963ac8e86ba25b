// SPDX-License-Identifier: MIT
#include "bindings/io_paths.h"

#include "bindings/lacuna_lua.h"

#include <lacuna/io/load_facets.h>

#include <cstring>
#include <optional>

namespace lacuna::lua {

io::OutputPath output_path(const Host& host, const std::string& path)
{
    if (!host.sandboxed) return path;
    if (!host.output_folder)
        throw InvalidInput(Message("sandbox.no_output", "the sandbox does not write files")
                               .remedy("allow it with --output-dir FOLDER"));
    return io::OutputPath::below(host.output_folder, path);
}

void check_input_path(const Host& host, const std::string& path)
{
    if (!host.sandboxed) return;
    // A .geo file is a program, and the sandbox runs no program but the recipe.
    const std::string ending = io::ending_of(path);
    if (ending == ".geo" || ending == ".geo_unrolled")
        throw InvalidInput("sandbox.script",
                           "the sandbox does not read {}: it is a script, not a file of shapes", path);
}

const io::OutputPath& push_output_path(lua_State* L, int index, const char* call)
{
    if (lua_type(L, index) != LUA_TSTRING || lua_rawlen(L, index) == 0)
        fail_value(L, {call, nullptr}, "the path of a file to write", index);
    const char* path = lua_tostring(L, index);
    if (std::strlen(path) != lua_rawlen(L, index)) fail(L, "%s: the path has a zero byte in it", call);
    const Host& lent = host(L);
    auto& place = temporary<std::optional<io::OutputPath>>(L);
    guard(L, [&] { place = output_path(lent, path); });
    return *place;
}

} // namespace lacuna::lua
