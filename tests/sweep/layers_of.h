// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/sweep/sweep.h>

namespace lacuna::test {

/// Options for so many layers, of one size everywhere [model length].
inline sweep::SweepOptions layers_of(int count, double size)
{
    sweep::SweepOptions options;
    options.layers.count = count;
    options.size = [size](const Vec3&) { return size; };
    return options;
}

} // namespace lacuna::test
