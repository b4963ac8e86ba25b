// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace lacuna::test {

/// A regular polygon with so many edges on each side; `corners` are the positions of its corners.
inline std::vector<Vec2> outline(const std::vector<int>& sides, std::vector<std::size_t>& corners)
{
    std::vector<Vec2> loop;
    corners.clear();
    const double turn = 2 * std::numbers::pi / static_cast<double>(sides.size());
    const auto corner = [&](std::size_t i) {
        return Vec2(std::cos(turn * static_cast<double>(i)), std::sin(turn * static_cast<double>(i)));
    };
    for (std::size_t i = 0; i < sides.size(); ++i) {
        corners.push_back(loop.size());
        for (int k = 0; k < sides[i]; ++k)
            loop.push_back(corner(i) + (corner(i + 1) - corner(i)) * k / sides[i]);
    }
    return loop;
}

} // namespace lacuna::test
