// SPDX-License-Identifier: MIT
#include "program/command_line.h"
#include "program/interpreter.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <string>
#include <vector>

namespace {

using namespace lacuna::program;

const char* const kVersion = R"lua(
local lacuna = require "lacuna"
print(("lacuna %s (%s, Gmsh %s)"):format(lacuna.version, _VERSION, lacuna.gmsh_version))
)lua";

const char* const kInfo = R"lua(
local lacuna = require "lacuna"
local model = lacuna.load((...))
print(model:describe())
local found, volume = pcall(model.open_volume, model)
if found then
  print(volume:describe())
else
  print("roles: none found: " .. volume)
end
)lua";

const char* const kCheck = R"lua(
local lacuna = require "lacuna"
local quality = lacuna.check((...))
print(quality)
if not quality.certified then
  local cells = quality.hexes + quality.wedges
  error(("%s: %d of %d cells are invalid"):format(..., quality.uncertified, cells), 0)
end
)lua";

const char* const kView = R"lua(
local lacuna = require "lacuna"
local file = ...
local page = file:match("[^/]*$"):gsub("%.[^.]*$", "") .. ".view.html"
lacuna.view(file, page)
print("wrote " .. page .. "; open it in a browser")
)lua";

Exit run(const CommandLine& line)
{
    Interpreter interpreter(line);
    switch (line.action) {
    case Action::run:
        return interpreter.run_file(line.file, line.words);
    case Action::prompt:
        return run_prompt(interpreter);
    case Action::info:
        return interpreter.run_text(kInfo, line.file);
    case Action::check:
        return interpreter.run_text(kCheck, line.file);
    case Action::view:
        return interpreter.run_text(kView, line.file);
    case Action::version:
        return interpreter.run_text(kVersion, "");
    case Action::help:
        break;
    }
    std::fputs(kHelp, stdout);
    return Exit::done;
}

/// Whether all that was printed arrived; a full disk behind standard output is an error as any other.
bool flushed()
{
    errno = 0;
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return true;
    std::fprintf(stderr, "lacuna: cannot write to standard output: %s\n",
                 errno != 0 ? std::strerror(errno) : "some of it was lost");
    return false;
}

} // namespace

int main(int argc, char** argv)
{
    try {
        const Exit result = run(parse(std::vector<std::string>(argv + 1, argv + argc)));
        return static_cast<int>(flushed() || result != Exit::done ? result : Exit::failed);
    } catch (const BadUsage& error) {
        std::fprintf(stderr, "lacuna: %s\n`lacuna --help` says what there is\n", error.what());
        return static_cast<int>(Exit::bad_usage);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "lacuna: %s\n", error.what());
        return static_cast<int>(Exit::failed);
    }
}
