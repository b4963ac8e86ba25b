// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <string>

namespace lacuna {

/// A number for a message, with at most `digits` significant digits: "0.034", "1.2e-07". Independent of the
/// locale of the host.
std::string with_digits(double value, int digits);

/// A number for a message, with `decimals` digits after the decimal point: "0.034", "-1.00".
std::string with_decimals(double value, int decimals);

/// Coordinates for a message: "(0.5, 1.25, -3)", each with at most `digits` significant digits.
std::string place_with_digits(const Vec3& place, int digits);

} // namespace lacuna
