// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/words.h>

#include <lacuna/core/shared/number_text.h>

#include <charconv>

namespace lacuna::sweep {

std::string in_short(double value) { return with_digits(value, 2); }

std::string place_in_short(const Vec3& p) { return place_with_digits(p, 2); }

std::string in_full(double value)
{
    char text[32];
    const auto end = std::to_chars(text, text + sizeof text, value);
    return {text, end.ptr};
}

} // namespace lacuna::sweep
