// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace lacuna::view {

std::string base64(std::string_view bytes);

/// Compact text for integers with regular patterns: differences from a prediction as zigzag varints (seven
/// bits a byte), deflated, in base 64.
///
/// Number i is predicted from the numbers a = i - stride and b = i - 2 · stride: as a, or with `linear` as
/// 2 a - b. The first numbers are predicted as the number before. `page/numbers.js` decodes it.
std::string pack(std::span<const Index> numbers, std::size_t stride, bool linear = false);

} // namespace lacuna::view
