// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <iterator>

namespace lacuna::lua {

/// A Lua source that is embedded in the binary; see lua/embed.cmake.
struct EmbeddedChunk {
    const char* name; ///< file name without its ending
    const char* source;
};

/// Chunks of the module, run in this order when it is opened.
extern const EmbeddedChunk kEmbeddedChunks[];
extern const std::size_t kEmbeddedChunkCount;
/// Chunks of the program only: its commands, its prompt, and the stub, which `help` reads.
extern const EmbeddedChunk kProgramChunks[];
extern const std::size_t kProgramChunkCount;

} // namespace lacuna::lua
