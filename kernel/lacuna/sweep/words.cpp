// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/words.h>

#include <charconv>
#include <cstdio>

namespace lacuna::sweep {

std::string in_short(double value)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.2g", value);
    return text;
}

std::string place_in_short(const Vec3& p)
{
    return "(" + in_short(p.x()) + ", " + in_short(p.y()) + ", " + in_short(p.z()) + ")";
}

std::string in_full(double value)
{
    char text[32];
    const auto end = std::to_chars(text, text + sizeof text, value);
    return {text, end.ptr};
}

} // namespace lacuna::sweep
