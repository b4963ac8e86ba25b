// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace lacuna::view {

std::string base64(std::string_view bytes);

/// Encode integers with regular patterns as a short text. Each number is predicted from earlier ones. The
/// differences from the predictions are written as zigzag varints (seven bits per byte), deflated, and
/// encoded in base 64.
///
/// The prediction of number i is a or, with `linear`, 2 a - b, where a is number i - stride and b is number
/// i - 2 · stride. Without b, the prediction is a; without a, it is number i - 1, and 0 for the first number.
/// `page/numbers.js` decodes the text.
std::string pack(std::span<const Index> numbers, std::size_t stride, bool linear = false);

} // namespace lacuna::view
