// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/words.h>

#include <lacuna/core/shared/number_text.h>

namespace lacuna::sweep {

std::string place_in_short(const Vec3& p) { return place_with_digits(p, 2); }

} // namespace lacuna::sweep
