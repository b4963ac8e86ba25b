// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/words.h>

#include <lacuna/core/shared/number_text.h>

namespace lacuna::sweep {

std::string place_in_short(const Vec3& p) { return place_with_digits(p, 2); }

std::string poor_in_words(double least)
{
    return formatted(
        "the least scaled Jacobian is {:.2g}; check the shape for a corner that sharp, try another 'size', "
        "or set 'min_scaled_jacobian' to refuse such meshes",
        least);
}

} // namespace lacuna::sweep
