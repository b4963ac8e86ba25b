// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

/// zlib. Internal to this folder.
namespace lacuna::io {

inline constexpr std::uint64_t kDeflateRatio = 1032; ///< highest compression ratio of deflate

/// Decompress zlib data. @param size  the exact size of the result; no more is decompressed.
/// @return  empty if the data are damaged or have another size.
std::optional<std::string> inflate(std::string_view bytes, std::uint64_t size);

} // namespace lacuna::io
