// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <iterator>

namespace lacuna::lua {

/// A Lua source that travels inside the binary; see lua/embed.cmake.
struct EmbeddedChunk {
    const char* name; ///< file name without its ending
    const char* source;
};

extern const EmbeddedChunk kEmbeddedChunks[];
extern const std::size_t kEmbeddedChunkCount;

} // namespace lacuna::lua
