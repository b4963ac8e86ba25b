// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace lacuna::cad {

/// A file that a Gmsh script includes or merges.
struct ScriptFile {
    std::string name;
    int line = 0;
};

/// A command that is removed from a Gmsh script: bytes [begin, end) of the text.
struct SkippedCommand {
    std::string word;
    int line = 0;
    std::size_t begin = 0, end = 0;
};

/// Result of `look_through_script()`: the files that a script reads, and the commands to remove from it.
struct ScriptContent {
    std::vector<ScriptFile> files;
    /// In order: commands that write files, run plugins or generate a mesh, and everything from `Exit` on.
    std::vector<SkippedCommand> skipped;
};

/// Parse a Gmsh script before it is run. Find the files that it includes or merges, which must be in the
/// script's own folder, and the commands to remove.
///
/// The sandbox of the CAD process already blocks programs, other files and writing. Parsing first gives an
/// error that names the line. Scripts that also mesh or write files can still be read, because these commands
/// are removed.
/// @throw InvalidInput  "cad.script": the script runs programs, ends inside a condition, includes a file of
///        another folder or one whose name is an expression, or lacks the ';' after a command to remove.
ScriptContent look_through_script(const std::string& path, std::string_view text);

} // namespace lacuna::cad
