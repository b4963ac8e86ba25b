// SPDX-License-Identifier: MIT
#include <lacuna/core/number_text.h>

#include <charconv>

namespace lacuna {

std::string with_digits(double value, int digits)
{
    char text[64];
    const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::general, digits);
    return {text, end.ptr};
}

} // namespace lacuna
