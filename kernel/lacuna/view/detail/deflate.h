// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace lacuna::view {

/// Compress bytes to a zlib stream (RFC 1950).
std::string deflated(std::string_view bytes);

/// CRC-32 as PNG uses it (ISO 3309). O(bytes).
std::uint32_t crc32(std::string_view bytes);

} // namespace lacuna::view
