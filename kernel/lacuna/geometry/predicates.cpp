// SPDX-License-Identifier: MIT
//
// An expansion is a sum of doubles that do not overlap, smallest first. It has the sign of its last term.
// Sums and products of doubles are split into a rounded double and the exact error, so that polynomials are
// evaluated without rounding (Shewchuk, Adaptive precision floating-point arithmetic, 1997). The compiler
// must neither contract a·b + c nor reorder sums; common compilers do neither in ISO mode.
#include <lacuna/geometry/shared/predicates.h>

#include <lacuna/geometry/shared/signed_area.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace lacuna::geometry {
namespace {

// Largest relative error of one rounded operation.
constexpr double kRounding = std::numeric_limits<double>::epsilon() / 2;
// Error bounds of the floating-point evaluation, relative to the sum of absolute terms: Shewchuk's "A"
// bounds.
constexpr double kOrientBound = (3 + 16 * kRounding) * kRounding;
constexpr double kIncircleBound = (10 + 96 * kRounding) * kRounding;

struct Exact {
    double high, low;
};

Exact two_sum(double a, double b)
{
    const double sum = a + b;
    const double b_part = sum - a;
    const double a_part = sum - b_part;
    return {sum, (a - a_part) + (b - b_part)};
}

Exact two_product(double a, double b)
{
    const double product = a * b;
    return {product, std::fma(a, b, -product)};
}

/// Non-overlapping terms, smallest first, without zeros.
template <std::size_t Capacity>
struct Expansion {
    std::array<double, Capacity> term;
    std::size_t count = 0;

    void push(double value)
    {
        if (value != 0) term[count++] = value;
    }
    [[nodiscard]] double sign_value() const { return count == 0 ? 0.0 : term[count - 1]; }
};

Expansion<2> difference(double a, double b)
{
    Expansion<2> result;
    const Exact exact = two_sum(a, -b);
    result.push(exact.low);
    result.push(exact.high);
    return result;
}

/// Merge by magnitude, then sum from the smallest (Shewchuk's fast expansion sum).
template <std::size_t N, std::size_t M>
Expansion<N + M> sum(const Expansion<N>& a, const Expansion<M>& b)
{
    Expansion<N + M> result;
    std::size_t i = 0;
    std::size_t j = 0;
    const auto take = [&] {
        if (j == b.count || (i < a.count && std::abs(a.term[i]) < std::abs(b.term[j]))) return a.term[i++];
        return b.term[j++];
    };
    const std::size_t total = a.count + b.count;
    if (total == 0) return result;
    double carry = take();
    for (std::size_t k = 1; k < total; ++k) {
        const Exact exact = two_sum(carry, take());
        result.push(exact.low);
        carry = exact.high;
    }
    result.push(carry);
    return result;
}

template <std::size_t N>
Expansion<N> negative(Expansion<N> a)
{
    for (std::size_t i = 0; i < a.count; ++i) a.term[i] = -a.term[i];
    return a;
}

template <std::size_t N>
Expansion<2 * N> scaled(const Expansion<N>& a, double factor)
{
    Expansion<2 * N> result;
    if (a.count == 0) return result;
    Exact product = two_product(a.term[0], factor);
    result.push(product.low);
    double carry = product.high;
    for (std::size_t i = 1; i < a.count; ++i) {
        product = two_product(a.term[i], factor);
        const Exact low = two_sum(carry, product.low);
        result.push(low.low);
        const Exact high = two_sum(product.high, low.high);
        result.push(high.low);
        carry = high.high;
    }
    result.push(carry);
    return result;
}

/// Multiply by the terms of b one after the other, so that the running sum stays within its capacity.
template <std::size_t N, std::size_t M>
Expansion<2 * N * M> product(const Expansion<N>& a, const Expansion<M>& b)
{
    if constexpr (M == 1) {
        return b.count == 0 ? Expansion<2 * N>{} : scaled(a, b.term[0]);
    } else {
        constexpr std::size_t half = M / 2;
        Expansion<half> low;
        Expansion<M - half> high;
        for (std::size_t i = 0; i < b.count; ++i) {
            if (i < half)
                low.push(b.term[i]);
            else
                high.push(b.term[i]);
        }
        return sum(product(a, low), product(a, high));
    }
}

double orient2d_exact(const Vec2& a, const Vec2& b, const Vec2& c)
{
    const auto left = product(difference(a.x(), c.x()), difference(b.y(), c.y()));
    const auto right = product(difference(a.y(), c.y()), difference(b.x(), c.x()));
    return sum(left, negative(right)).sign_value();
}

double incircle_exact(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d)
{
    const std::array<Expansion<2>, 3> x{difference(a.x(), d.x()), difference(b.x(), d.x()),
                                        difference(c.x(), d.x())};
    const std::array<Expansion<2>, 3> y{difference(a.y(), d.y()), difference(b.y(), d.y()),
                                        difference(c.y(), d.y())};
    const auto part = [&](std::size_t i, std::size_t j, std::size_t k) {
        const auto lift = sum(product(x[i], x[i]), product(y[i], y[i]));
        const auto minor = sum(product(x[j], y[k]), negative(product(x[k], y[j])));
        return product(lift, minor);
    };
    return sum(sum(part(0, 1, 2), part(1, 2, 0)), part(2, 0, 1)).sign_value();
}

} // namespace

double orient2d(const Vec2& a, const Vec2& b, const Vec2& c)
{
    const double left = (a.x() - c.x()) * (b.y() - c.y());
    const double right = (a.y() - c.y()) * (b.x() - c.x());
    const double det = left - right;
    if (std::abs(det) > kOrientBound * (std::abs(left) + std::abs(right))) return det;
    return orient2d_exact(a, b, c);
}

double incircle(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d)
{
    const double adx = a.x() - d.x(), ady = a.y() - d.y();
    const double bdx = b.x() - d.x(), bdy = b.y() - d.y();
    const double cdx = c.x() - d.x(), cdy = c.y() - d.y();
    const double a_lift = adx * adx + ady * ady;
    const double b_lift = bdx * bdx + bdy * bdy;
    const double c_lift = cdx * cdx + cdy * cdy;
    const double det = a_lift * (bdx * cdy - cdx * bdy) + b_lift * (cdx * ady - adx * cdy) +
                       c_lift * (adx * bdy - bdx * ady);
    const double size = a_lift * (std::abs(bdx * cdy) + std::abs(cdx * bdy)) +
                        b_lift * (std::abs(cdx * ady) + std::abs(adx * cdy)) +
                        c_lift * (std::abs(adx * bdy) + std::abs(bdx * ady));
    if (std::abs(det) > kIncircleBound * size) return det;
    return incircle_exact(a, b, c, d);
}

bool lies_inside(std::span<const Vec2> polygon, const Vec2& p)
{
    bool inside = false;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        if ((a.y() > p.y()) == (b.y() > p.y())) continue;
        const bool above = orient2d(a, b, p) > 0;
        if (above == (b.y() > a.y())) inside = !inside;
    }
    return inside;
}

bool encloses(std::span<const Vec2> outer, std::span<const Vec2> inner)
{
    if (std::abs(signed_area(inner)) >= std::abs(signed_area(outer))) return false;
    // Test one point inside `inner`: the middle of the first part of a horizontal line inside `inner`. The
    // line is as far from all vertices as possible. A vertex of `inner` itself cannot be tested, because it
    // may also be a vertex of `outer`, or lie on a side of it.
    std::vector<double> heights;
    for (const Vec2& p : inner) heights.push_back(p.y());
    std::ranges::sort(heights);
    double y = 0, widest = 0;
    for (std::size_t i = 1; i < heights.size(); ++i) {
        if (heights[i] - heights[i - 1] <= widest) continue;
        widest = heights[i] - heights[i - 1];
        y = heights[i - 1] + widest / 2;
    }
    std::vector<double> crossings;
    for (std::size_t i = 0; i < inner.size(); ++i) {
        const Vec2 &a = inner[i], &b = inner[(i + 1) % inner.size()];
        if ((a.y() > y) != (b.y() > y))
            crossings.push_back(a.x() + (b.x() - a.x()) * (y - a.y()) / (b.y() - a.y()));
    }
    std::ranges::sort(crossings);
    return crossings.size() >= 2 && lies_inside(outer, {(crossings[0] + crossings[1]) / 2, y});
}

} // namespace lacuna::geometry
