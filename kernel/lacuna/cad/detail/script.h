// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace lacuna::cad {

/// A file a Gmsh script asks for.
struct ScriptFile {
    std::string name;
    int line = 0;
};

/// A command of a Gmsh script that makes no geometry: bytes [begin, end) of the text.
struct SkippedCommand {
    std::string word;
    int line = 0;
    std::size_t begin = 0, end = 0;
};

/// What a Gmsh script is beside its geometry.
struct ScriptContent {
    std::vector<ScriptFile> files;
    std::vector<SkippedCommand> skipped; ///< write files, run plugins, mesh; in order
};

/// Look through a Gmsh script before it is run: the files it includes or merges, each by its name alone, and
/// the commands to leave out.
///
/// The CAD process could not do what is refused or left out here, whatever the text; this is for a message
/// that names the line, and for scripts whose geometry is all that is wanted.
/// @throw InvalidInput  "cad.script": it runs programs, ends the process, or names a file in another folder
///                      or by an expression.
ScriptContent look_through_script(const std::string& path, std::string_view text);

} // namespace lacuna::cad
