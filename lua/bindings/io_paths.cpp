// SPDX-License-Identifier: MIT
#include "bindings/io_paths.h"

#include "bindings/lacuna_lua.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace lacuna::lua {

namespace fs = std::filesystem;

std::string output_path(const Host& host, const std::string& path)
{
    if (!host.sandboxed) return path;
    if (host.output_dir.empty())
        throw InvalidInput("sandbox.no_output",
                           "the sandbox writes no file; allow it with --output-dir FOLDER");
    std::error_code error;
    const fs::path root = fs::canonical(host.output_dir, error);
    if (error)
        throw InvalidInput("sandbox.no_output",
                           "the output folder " + host.output_dir + " does not exist; create it first");
    // Links in the folders on the way are followed before comparing; the file itself is replaced, not followed.
    const fs::path wanted = fs::path(path).is_absolute() ? fs::path(path) : root / path;
    const fs::path folder = fs::weakly_canonical(wanted.parent_path(), error);
    const auto [end, rest] = std::mismatch(root.begin(), root.end(), folder.begin(), folder.end());
    if (error || end != root.end())
        throw InvalidInput("sandbox.outside", "the sandbox writes below " + root.string() + " alone, and " +
                                                  path + " is not there");
    return (folder / wanted.filename()).string();
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

const char* push_output_path(lua_State* L, int index, const char* call)
{
    if (lua_type(L, index) != LUA_TSTRING || lua_rawlen(L, index) == 0)
        fail_value(L, {call, nullptr}, "the path of a file to write", index);
    const char* path = lua_tostring(L, index);
    const Host& lent = host(L);
    push_text(L, [&] { return output_path(lent, path); });
    return lua_tostring(L, -1);
}

std::string ending_of(const std::string& path)
{
    std::string ending = fs::path(path).extension().string();
    std::ranges::transform(ending, ending.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return ending;
}

} // namespace lacuna::lua
