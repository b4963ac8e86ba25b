// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>
#include <lacuna/quality/quality.h>

#include <string>

/// Formatting of text for people, independent of the locale. Internal to this folder.
namespace lacuna::quality {

/// A number with up to six significant digits.
std::string number(double value);

/// "1.5 0 -2"
std::string place(const Vec3& point);

/// "layer 3 of 8, at 1.5 0 -2"; numbers for people start at 1.
std::string place_in_mesh(const WorstCell& cell, int layers);

} // namespace lacuna::quality
