// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/cut_bounds.h>

#include <limits>

namespace lacuna::quads::paving {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr float kRight = kPi / 2;
/// Errors from the polynomial of `angle_of()` and from single precision: an angle is off by at most 1e-4; a
/// cost bound has four terms that change by up to 2.5 per radian.
constexpr float kSlack = 4e-3F, kAngleSlack = 1e-3F;

// The following code has no branches, so that compilers vectorise the loop over lines.

/// Select one of two numbers, both already computed.
inline float choose(bool first, float a, float b) { return first ? a : b; }

/// The direction of a vector, with an error of at most 1e-4: arctan by a polynomial of degree 7 up to 45°.
inline float angle_of(float x, float y)
{
    const float wide = std::abs(x), high = std::abs(y);
    const float t = std::min(wide, high) / std::max(std::max(wide, high), 1e-30F), s = t * t;
    const float low = ((-0.0464964749F * s + 0.15931422F) * s - 0.327622764F) * s * t + t;
    const float steep = kRight - low;
    const float quarter = choose(high > wide, steep, low);
    const float back = kPi - quarter;
    const float half = choose(x < 0, back, quarter);
    const float under = -half;
    return choose(y < 0, under, half);
}

inline float whole_turn(float angle)
{
    const float more = angle + 2 * kPi;
    const float up = choose(angle < 0, more, angle);
    const float less = up - 2 * kPi;
    return choose(up < 2 * kPi, up, less);
}

struct Fit {
    float quads;    ///< suitable number of quads for an angle
    float off;      ///< squared deviation of each resulting angle from a right angle, in half right angles
    float in_doubt; ///< 1 if rounding errors may change the number
};

inline Fit fit_of(float angle)
{
    const float turns = angle * (1 / kRight);
    const float quads = std::max(1.0F, static_cast<float>(static_cast<int>(turns + 0.5F)));
    const float off = 2 * (turns - quads);
    constexpr float kNear = 1 - 8 * kAngleSlack; // half way to the next number
    return {quads, off * off, choose(std::abs(off) > kNear, 1.0F, 0.0F)};
}

/// Lower bound on the cost of a line that divides an angle.
inline float end_bound(const Fit& whole, float angle, float part, float corners, float by_added)
{
    const Fit one = fit_of(part), other = fit_of(angle - part);
    const float doubt = whole.in_doubt + one.in_doubt + other.in_doubt;
    const float added = std::max(0.0F, std::abs(one.quads + other.quads - whole.quads) - doubt);
    return corners * ((one.off + other.off) * 0.5F + by_added * added);
}

/// The data common to all lines from one place.
struct From {
    float x, y, arc, heading, angle, gain, firm;
};

/// Compute the bounds of the lines from one place to others; infinite if no line is possible.
void bound_from(const From& from, const CutPlaces& to, std::size_t first, const CutWeights& weights,
                float most, float room, float whole, float* bound)
{
    const std::size_t n = to.size() - first;
    const float *x = to.x.data() + first, *y = to.y.data() + first, *along = to.arc.data() + first,
                *heading = to.heading.data() + first, *angle = to.angle.data() + first,
                *gain = to.gain.data() + first, *firm = to.firm.data() + first;
    const auto by_length = static_cast<float>(weights.length), corners = static_cast<float>(weights.corners),
               by_added = static_cast<float>(weights.added);
    const Fit whole_from = fit_of(from.angle);
    for (std::size_t t = 0; t < n; ++t) {
        const float arc = along[t] - from.arc, shorter = std::min(arc, whole - arc);
        const float dx = x[t] - from.x, dy = y[t] - from.y, length = std::sqrt(dx * dx + dy * dy);
        const float turn = angle_of(dx, dy);
        const float here = whole_turn(turn - from.heading), there = whole_turn(turn + kPi - heading[t]);
        const float cost = by_length * length / shorter - from.gain - gain[t] - kSlack +
                           end_bound(whole_from, from.angle, here, corners, by_added) * from.firm +
                           end_bound(fit_of(angle[t]), angle[t], there, corners, by_added) * firm[t];
        const float clear = std::min(std::min(here, from.angle - here), std::min(there, angle[t] - there));
        const float apart = choose(clear > room, cost, std::numeric_limits<float>::infinity());
        bound[t] = choose(length <= most * shorter, apart, std::numeric_limits<float>::infinity());
    }
}

} // namespace

std::vector<CutBound> bound_cuts(const CutPlaces& places, const CutWeights& weights, double longest,
                                 double least, double whole)
{
    std::vector<CutBound> found;
    const std::size_t n = places.size();
    found.reserve(n * n / 2);
    std::vector<float> bound(n);
    const float room = static_cast<float>(least) - kAngleSlack;
    const float most = static_cast<float>(std::min(longest, 1e6)) * (1 + kSlack);
    for (std::size_t s = 0; s + 1 < n; ++s) {
        const From from{places.x[s],     places.y[s],    places.arc[s], places.heading[s],
                        places.angle[s], places.gain[s], places.firm[s]};
        bound_from(from, places, s + 1, weights, most, room, static_cast<float>(whole), bound.data());
        for (std::size_t t = s + 1; t < n; ++t) {
            const float own = bound[t - s - 1];
            if (own < std::numeric_limits<float>::infinity())
                found.push_back({own, static_cast<std::uint32_t>(s), static_cast<std::uint32_t>(t)});
        }
    }
    return found;
}

} // namespace lacuna::quads::paving
