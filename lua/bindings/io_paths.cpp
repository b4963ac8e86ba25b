// SPDX-License-Identifier: MIT
#include "bindings/io_paths.h"

#include "bindings/lacuna_lua.h"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <filesystem>
#include <optional>

namespace lacuna::lua {

namespace fs = std::filesystem;

io::OutputPath output_path(const Host& host, const std::string& path)
{
    if (!host.sandboxed) return path;
    if (!host.output_folder)
        throw InvalidInput("sandbox.no_output",
                           "the sandbox writes no file; allow it with --output-dir FOLDER");
    return io::OutputPath::below(host.output_folder, path);
}

void check_input_path(const Host& host, const std::string& path)
{
    if (!host.sandboxed) return;
    // A .geo is a program, and so are the options Gmsh looks for beside a file it opens.
    const std::string ending = ending_of(path);
    if (ending == ".geo" || ending == ".geo_unrolled" || ending == ".opt" || ending == ".pos" ||
        ending == ".script")
        throw InvalidInput("sandbox.script",
                           "the sandbox does not read " + path + ": Gmsh would run it as a script");
    std::error_code error;
    if (fs::exists(path + ".opt", error))
        throw InvalidInput("sandbox.script", "the sandbox does not read " + path + ": Gmsh would run " +
                                                 path + ".opt, which lies beside it");
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

std::string ending_of(const std::string& path)
{
    std::string ending = fs::path(path).extension().string();
    std::ranges::transform(ending, ending.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return ending;
}

} // namespace lacuna::lua
