// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace lacuna::view {

std::string base64(std::string_view bytes);

/// Whole numbers as text, small where they follow a pattern: what a prediction misses, as varints (zigzag,
/// seven bits a byte), deflated, in base 64.
///
/// Number i is predicted from those `stride` and twice `stride` places before: as the first and once more
/// what lies between (`linear`), or as the first alone. Where there is none of them, as the number before.
/// `page/numbers.js` reads it.
std::string pack(std::span<const Index> numbers, std::size_t stride, bool linear = false);

} // namespace lacuna::view
