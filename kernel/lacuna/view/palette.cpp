// SPDX-License-Identifier: MIT
#include <lacuna/view/detail/palette.h>

#include <algorithm>
#include <cmath>
#include <vector>

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

std::span<const Colour> kind_colours()
{
    static const std::vector<Colour> colours = [] {
        std::vector<Colour> all{{0x4e, 0x79, 0xa7}, {0xf2, 0x8e, 0x2b}, {0x59, 0xa1, 0x4f},
                                {0xe1, 0x57, 0x59}, {0x76, 0xb7, 0xb2}, {0xed, 0xc9, 0x48},
                                {0xb0, 0x7a, 0xa1}, {0xff, 0x9d, 0xa7}, {0x9c, 0x75, 0x5f},
                                {0xba, 0xb0, 0xac}};
        const std::size_t base = all.size();
        for (const Colour towards : {Colour{255, 255, 255}, Colour{0, 0, 0}})
            for (std::size_t i = 0; i < base; ++i) all.push_back(mixed(all[i], towards, 0.5));
        return all;
    }();
    return colours;
}

} // namespace lacuna::view
