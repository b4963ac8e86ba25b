// SPDX-License-Identifier: MIT
#include <lacuna/view/detail/palette.h>

#include <algorithm>
#include <cmath>

namespace lacuna::view {

namespace {

constexpr Colour kQualityRamp[] = {{0xd7, 0x30, 0x27}, {0xfc, 0x8d, 0x59}, {0xfe, 0xe0, 0x90},
                                   {0xe0, 0xf3, 0xf8}, {0x91, 0xbf, 0xdb}, {0x45, 0x75, 0xb4}};
constexpr Colour kOrderRamp[] = {{0x44, 0x01, 0x54}, {0x41, 0x44, 0x87}, {0x2a, 0x78, 0x8e},
                                 {0x22, 0xa8, 0x84}, {0x7a, 0xd1, 0x51}, {0xfd, 0xe7, 0x25}};
constexpr Colour kKindColours[] = {
    {0x4e, 0x79, 0xa7}, {0xf2, 0x8e, 0x2b}, {0x59, 0xa1, 0x4f}, {0xe1, 0x57, 0x59}, {0x76, 0xb7, 0xb2},
    {0xed, 0xc9, 0x48}, {0xb0, 0x7a, 0xa1}, {0xff, 0x9d, 0xa7}, {0x9c, 0x75, 0x5f}, {0xba, 0xb0, 0xac}};

} // namespace

std::span<const Colour> quality_ramp() { return kQualityRamp; }
std::span<const Colour> order_ramp() { return kOrderRamp; }
std::span<const Colour> kind_colours() { return kKindColours; }

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
