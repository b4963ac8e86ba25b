// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

/// zlib. Internal to this folder.
namespace lacuna::io {

/// What bytes compressed by zlib were. @param size  bytes of it, which must be right; no more are taken.
/// @return nothing  the bytes are damaged, or are another number.
std::optional<std::string> inflate(std::string_view bytes, std::uint64_t size);

} // namespace lacuna::io
