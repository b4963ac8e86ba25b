// SPDX-License-Identifier: MIT
#pragma once

#include <string>

/// Files to be read. Internal to this folder.
namespace lacuna::io {

/// See that a path names a plain file with something in it; a pipe is not waited for.
/// @throw InvalidInput  "io.no_file", "io.not_a_file" (a folder, pipe or device), "io.empty_file".
void check_file(const std::string& path);

/// All bytes of a file.
/// @throw InvalidInput  as check_file(). @throw BackendError  reading failed.
std::string read_file(const std::string& path);

} // namespace lacuna::io
