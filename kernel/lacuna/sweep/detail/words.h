// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <string>

/// Positions and suggestions in messages. Internal to this folder.
namespace lacuna::sweep {

/// A position as text, in numbers of two significant digits: "(1.2, 0, 3)".
std::string place_in_short(const Vec3& p);

/// A note on poor cells, with suggestions.
std::string poor_in_words(double least);

/// Sizes are suggested a tenth smaller than an estimate requires, because side lengths vary.
inline constexpr double kSuggestedShare = 0.9;

} // namespace lacuna::sweep
