// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/cad_protocol/channel.h>
#include <lacuna/core/run_context.h>

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lacuna::cad {

/// A CAD file as it is handed to the CAD process: a copy in memory, so that what was looked at is what is
/// read.
struct InputFile {
    cad_protocol::LoadFile file;                       ///< what it is, and the names of its contents
    std::vector<cad_protocol::Descriptor> descriptors; ///< of the contents
    std::vector<std::uint64_t> digests;                ///< of names and contents
    std::uint64_t bytes = 0;                           ///< of all contents
    std::vector<std::string> notes;                    ///< commands of scripts that are left out
};

/// A number that stands for bytes read after `before`: the hash FNV-1a, over words of eight bytes.
std::uint64_t digest_of(std::span<const char> bytes, std::uint64_t before);
std::uint64_t digest_of(std::uint64_t word, std::uint64_t before);

/// Open a CAD file and look whether it is what its ending promises. A script's text is looked through: it
/// may include and merge files that lie beside it, which come along. Commands that write files or mesh are
/// left out of the copy; nothing else may leave Gmsh's geometry.
/// @throw InvalidInput  not a regular file, no file of its kind, a script that asks for more; names file
///                      and line.
/// @throw BackendError  it cannot be read. Cancelled.
InputFile open_input(const std::string& path, const RunContext& context);

} // namespace lacuna::cad
