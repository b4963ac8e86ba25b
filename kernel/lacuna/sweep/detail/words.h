// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <string>

/// Numbers and positions in messages. Internal to this folder.
namespace lacuna::sweep {

/// Two significant digits: "0.034", for reports.
std::string in_short(double value);

/// A place in such numbers: "(1.2, 0, 3)".
std::string place_in_short(const Vec3& p);

/// The shortest digits that read back as the same number: "0.1", for errors.
std::string in_full(double value);

} // namespace lacuna::sweep
