// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace lacuna {

/// A number in a message, with so many significant digits at most: "0.034", "1.2e-07". The host's locale does
/// not matter.
std::string with_digits(double value, int digits);

} // namespace lacuna
