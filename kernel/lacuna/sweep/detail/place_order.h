// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <algorithm>

/// An order of positions, to find equal ones by sorting. Internal to this folder.
namespace lacuna::sweep {

/// By x, then y, then z; positions that are bit-identical, up to signs of zero, are equivalent.
inline bool before(const Vec3& a, const Vec3& b)
{
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

} // namespace lacuna::sweep
