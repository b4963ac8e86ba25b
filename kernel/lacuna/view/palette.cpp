// SPDX-License-Identifier: MIT
#include <lacuna/view/detail/palette.h>

#include <algorithm>
#include <cmath>

namespace lacuna::view {

Colour on_ramp(std::span<const Colour> ramp, double at)
{
    const double place = std::clamp(at, 0.0, 1.0) * static_cast<double>(ramp.size() - 1);
    const std::size_t low = std::min(static_cast<std::size_t>(place), ramp.size() - 2);
    const double share = place - static_cast<double>(low);
    return mixed(ramp[low], ramp[low + 1], share);
}

Colour mixed(const Colour& a, const Colour& b, double share)
{
    Colour colour{};
    for (std::size_t k = 0; k < 3; ++k)
        colour[k] = static_cast<std::uint8_t>(std::lround(a[k] * (1 - share) + b[k] * share));
    return colour;
}

} // namespace lacuna::view
