// SPDX-License-Identifier: MIT
#include <lacuna/io/detail/rounding.h>

#include <lacuna/core/shared/constants.h>
#include <lacuna/core/shared/criteria.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

namespace lacuna::io {
namespace {

/// Numbers with fewer significant digits are taken as exact. Fields of eight columns, the narrowest of all
/// formats, hold five digits of a number with sign, point and leading zero.
constexpr int kFewestDigits = 5;

/// Significant digits that tell all numbers of single precision apart.
constexpr int kDigitsOfSingle = std::numeric_limits<float>::max_digits10;

/// The fewest significant digits that identify a number among those of its type.
struct Digits {
    int count = 0;
    int exponent = 0; ///< of the first digit
};

template <class Real>
Digits digits_of(Real x)
{
    std::array<char, 32> text;
    const auto end =
        std::to_chars(text.data(), text.data() + text.size(), std::abs(x), std::chars_format::scientific).ptr;
    const std::string_view all(text.data(), static_cast<std::size_t>(end - text.data()));
    const std::size_t e = all.find('e');
    Digits digits{static_cast<int>(e == 1 ? 1 : e - 1)};
    std::from_chars(all.data() + e + (all[e + 1] == '+' ? 2 : 1), end, digits.exponent);
    return digits;
}

/// The unit of the last digit of a deck's coordinates: the largest of those with the most digits.
double last_unit(const Deck& deck)
{
    Digits most;
    double largest = 0;
    bool single = true; // all numbers so far are of single precision
    for (const Vec3& p : deck.points) {
        for (const double x : p) {
            largest = std::max(largest, std::abs(x));
            const bool own = static_cast<double>(static_cast<float>(x)) == x;
            single = single && own;
            const Digits digits = own ? digits_of(static_cast<float>(x)) : digits_of(x);
            if (digits.count > kDigitsOfSingle) return 0;
            if (digits.count > most.count || (digits.count == most.count && digits.exponent > most.exponent))
                most = digits;
        }
    }
    if (single) return largest * std::numeric_limits<float>::epsilon();
    return most.count < kFewestDigits ? 0 : std::pow(10, most.exponent - most.count + 1);
}

} // namespace

double rounding_of(const Deck& deck)
{
    // A rounded point is off by at most √3/2 units, and so are those that it is compared with.
    const double rounding = 2 * last_unit(deck);
    if (!(rounding > 0)) return 0;
    double shortest = kInfinity;
    for (const DeckBlock& block : deck.blocks) {
        for (std::size_t e = 0; e < block.count(); ++e) {
            std::vector<Vec3> corners;
            for (const Index node : block.element(e))
                if (node >= 0) corners.push_back(deck.points[index(node)]);
            for (std::size_t a = 0; a < corners.size(); ++a) {
                for (std::size_t b = 0; b < a; ++b)
                    if (corners[a] != corners[b])
                        shortest = std::min(shortest, (corners[a] - corners[b]).norm());
            }
        }
    }
    return std::min(rounding, kAlikeSizes * shortest);
}

} // namespace lacuna::io
