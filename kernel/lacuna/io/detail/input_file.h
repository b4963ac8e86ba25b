// SPDX-License-Identifier: MIT
#pragma once

#include <string>

/// Input files. Internal to this folder.
namespace lacuna::io {

/// Check that a path names a regular file that is not empty, without waiting for a pipe.
/// @throw InvalidInput  "io.no_file", "io.not_a_file" (a folder, pipe or device), "io.empty_file".
void check_file(const std::string& path);

/// All bytes of a file.
/// @throw InvalidInput  as check_file(). @throw BackendError  reading failed.
std::string read_file(const std::string& path);

} // namespace lacuna::io
