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
/// Number i is predicted as a or, with `linear`, as 2 a - b, where a and b are the numbers at i - stride and
/// i - 2 · stride. The first numbers, for which these do not exist, are predicted as the number before.
/// `page/numbers.js` decodes the text.
std::string pack(std::span<const Index> numbers, std::size_t stride, bool linear = false);

} // namespace lacuna::view
