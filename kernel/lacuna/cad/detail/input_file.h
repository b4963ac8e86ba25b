// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/cad_protocol/shared/channel.h>
#include <lacuna/core/message.h>
#include <lacuna/core/run_context.h>

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lacuna::cad {

/// A CAD file as it is sent to the CAD process: a copy in memory, so that the bytes that were checked are the
/// bytes that are read.
struct InputFile {
    cad_protocol::LoadFile file;                       ///< its format, and the names of its contents
    std::vector<cad_protocol::Descriptor> descriptors; ///< descriptors of its contents
    std::vector<std::uint64_t> digests;                ///< hashes of names and contents
    std::uint64_t bytes = 0;                           ///< size of all contents
    std::vector<Message> notes;                        ///< which script commands are skipped
};

/// The first bytes of a file, `most` at most.
std::string text_of(const cad_protocol::Descriptor& file, std::size_t most);

/// FNV-1a hash over words of eight bytes; `before` is the hash of the preceding bytes.
std::uint64_t digest_of(std::span<const char> bytes, std::uint64_t before);
std::uint64_t digest_of(std::uint64_t word, std::uint64_t before);

/// Open a CAD file and check that its contents agree with its ending. A script is parsed: files in the same
/// folder that it includes or merges are copied too; commands that write files or mesh are removed from the
/// copy; any other command outside Gmsh's geometry is an error.
/// @throw InvalidInput  not a regular file, not of the format, or a script with a forbidden command; names
///                      file and line.
/// @throw BackendError  it cannot be read. Cancelled.
InputFile open_input(const std::string& path, const RunContext& context);

} // namespace lacuna::cad
