// SPDX-License-Identifier: MIT
#include <lacuna/io/shared/deck_facets.h>

#include <lacuna/core/shared/constants.h>
#include <lacuna/core/shared/criteria.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lacuna::io {
namespace {

/// Significant digits of numbers that count as rounded. Fields of eight columns, the narrowest of all
/// formats, hold five digits with sign, point and leading zero; nine tell all numbers of single precision
/// apart.
constexpr int kFewestDigits = 5, kMostDigits = 9;

/// The unit of the last digit of a deck's coordinates: the largest of those with the most digits; of single
/// precision that of the largest coordinate. 0: they are exact or of double precision.
double last_unit(const Deck& deck)
{
    int most = kFewestDigits;
    double unit = 0, largest = 0;
    bool single = true;
    for (const Vec3& p : deck.points)
        for (const double x : p) {
            largest = std::max(largest, std::abs(x));
            single = single && static_cast<double>(static_cast<float>(x)) == x;
            if (single || x == 0) continue;
            const double first = std::floor(std::log10(std::abs(x))); // exponent of the first digit
            const auto is_whole = [&](int digits) {
                const double scaled = x * std::pow(10, digits - 1 - first);
                return std::abs(scaled - std::round(scaled)) < kFileAccuracy;
            };
            int digits = most - 1;
            while (digits <= kMostDigits && !is_whole(digits)) ++digits;
            if (digits > kMostDigits) return 0;
            if (digits < most) continue;
            unit = std::max(digits > most ? 0 : unit, std::pow(10, first - digits + 1));
            most = digits;
        }
    return single ? largest * std::numeric_limits<float>::epsilon() : unit;
}

} // namespace

double least_tolerance(const Deck& deck)
{
    double shortest = kInfinity; // squared
    for (const DeckBlock& block : deck.blocks) {
        for (std::size_t e = 0; e < block.count(); ++e) {
            for (const Index a : block.element(e)) {
                for (const Index b : block.element(e)) {
                    if (a < 0 || b <= a) continue;
                    const double squared = (deck.points[index(a)] - deck.points[index(b)]).squaredNorm();
                    if (squared > 0) shortest = std::min(shortest, squared);
                }
            }
        }
    }
    if (shortest == kInfinity) return 0;
    const double side = std::sqrt(shortest);
    // A rounded point is off by at most √3/2 units, and so are those that it is compared with.
    return std::clamp(2 * last_unit(deck), kVisible * side, kAlikeSizes * side);
}

} // namespace lacuna::io
