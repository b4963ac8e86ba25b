// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <string>

namespace lacuna {

/// A number in a message, with so many significant digits at most: "0.034", "1.2e-07". The host's locale does
/// not matter.
std::string with_digits(double value, int digits);

/// The same with so many digits behind the point: "0.034", "-1.00".
std::string with_decimals(double value, int decimals);

/// A place in a message: "(0.5, 1.25, -3)", each with so many significant digits at most.
std::string place_with_digits(const Vec3& place, int digits);

} // namespace lacuna
