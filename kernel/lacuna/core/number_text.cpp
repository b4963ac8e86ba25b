// SPDX-License-Identifier: MIT
#include <lacuna/core/shared/number_text.h>

#include <charconv>

namespace lacuna {

std::string with_digits(double value, int digits)
{
    char text[64];
    const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::general, digits);
    return {text, end.ptr};
}

std::string with_decimals(double value, int decimals)
{
    char text[400]; // the largest number has 309 digits before the point
    const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::fixed, decimals);
    return {text, end.ptr};
}

std::string place_with_digits(const Vec3& place, int digits)
{
    return "(" + with_digits(place.x(), digits) + ", " + with_digits(place.y(), digits) + ", " +
           with_digits(place.z(), digits) + ")";
}

} // namespace lacuna
