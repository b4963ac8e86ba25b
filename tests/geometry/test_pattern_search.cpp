// SPDX-License-Identifier: MIT
#include <lacuna/geometry/shared/pattern_search.h>

#include <doctest/doctest.h>

#include <limits>

using namespace lacuna;
using namespace lacuna::geometry;

TEST_CASE("a pattern search ends for every scale and never makes the value smaller")
{
    const Vec2 highest(0.3, -0.2);
    const auto value = [&](const Vec2& p, double) { return -(p - highest).norm(); };
    const double tiny = std::numeric_limits<double>::denorm_min();
    for (const double scale : {0.0, tiny, std::numeric_limits<double>::min(), 1e-3, 1.0}) {
        Vec2 x(0, 0);
        const double before = value(x, 0), after = pattern_search(x, before, {scale}, value);
        CHECK(after >= before);
        CHECK(after == value(x, 0));
        if (scale == 1) CHECK((x - highest).norm() < 0.02);
    }
}
