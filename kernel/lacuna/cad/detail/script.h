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

/// Look through a Gmsh script before it is run: the files it includes or merges, each by its name alone.
///
/// The CAD process could not do what is refused here, whatever the text; this is for a message that names
/// the line.
/// @throw InvalidInput  "cad.script": it runs commands, writes files, ends the process, or names a file in
///                      another folder or by an expression.
std::vector<ScriptFile> files_of_script(const std::string& path, std::string_view text);

} // namespace lacuna::cad
