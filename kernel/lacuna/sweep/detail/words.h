// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <string>

/// Positions in messages. Internal to this folder.
namespace lacuna::sweep {

/// A position as text, in numbers of two significant digits: "(1.2, 0, 3)".
std::string place_in_short(const Vec3& p);

} // namespace lacuna::sweep
