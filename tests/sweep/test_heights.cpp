// SPDX-License-Identifier: MIT
#include <lacuna/core/error.h>
#include <lacuna/core/shared/constants.h>
#include <lacuna/sweep/sweep.h>

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <vector>

using namespace lacuna;
using sweep::layer_heights;
using sweep::LayerSpec;
using sweep::Spacing;

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

LayerSpec spec_of(int count, double bias = 1, Spacing spacing = Spacing::geometric)
{
    LayerSpec spec;
    spec.count = count;
    spec.bias = bias;
    spec.spacing = spacing;
    return spec;
}

LayerSpec given(std::vector<double> heights)
{
    LayerSpec spec;
    spec.heights = std::move(heights);
    return spec;
}

} // namespace

TEST_CASE("heights are layers + 1 numbers that rise from 0 to 1 exactly")
{
    for (const Spacing spacing : {Spacing::geometric, Spacing::bell, Spacing::both_ends}) {
        for (const int count : {1, 2, 3, 4, 7, 26, 1000}) {
            for (const double bias : {0.05, 0.5, 1.0, 3.0, 20.0}) {
                CAPTURE(count);
                CAPTURE(bias);
                const auto heights = layer_heights(spec_of(count, bias, spacing));
                REQUIRE(heights.size() == static_cast<std::size_t>(count) + 1);
                CHECK(heights.front() == 0);
                CHECK(heights.back() == 1);
                for (std::size_t i = 1; i < heights.size(); ++i) CHECK(heights[i] > heights[i - 1]);
            }
        }
    }
}

TEST_CASE("the bias is the ratio it says it is")
{
    for (const int count : {3, 4, 7, 26}) {
        for (const double bias : {0.1, 0.5, 1.0, 4.0}) {
            CAPTURE(count);
            CAPTURE(bias);
            const auto step = [](const std::vector<double>& h, int i) {
                return h[static_cast<std::size_t>(i) + 1] - h[static_cast<std::size_t>(i)];
            };
            const auto rising = layer_heights(spec_of(count, bias));
            CHECK(step(rising, count - 1) / step(rising, 0) == doctest::Approx(bias));
            for (int i = 2; i < count; ++i) {
                CHECK(step(rising, i) / step(rising, i - 1) ==
                      doctest::Approx(step(rising, 1) / step(rising, 0)));
            }
            const auto bell = layer_heights(spec_of(count, bias, Spacing::bell));
            const auto ends = layer_heights(spec_of(count, bias, Spacing::both_ends));
            CHECK(step(bell, (count - 1) / 2) / step(bell, 0) == doctest::Approx(bias));
            CHECK(step(ends, 0) / step(ends, (count - 1) / 2) == doctest::Approx(bias));
            for (int i = 0; i < count; ++i) {
                CHECK(step(bell, i) == doctest::Approx(step(bell, count - 1 - i)));
                CHECK(step(ends, i) == doctest::Approx(step(ends, count - 1 - i)));
            }
        }
    }
}

TEST_CASE("given heights are kept, and a last one that is 1 up to rounding becomes 1")
{
    CHECK(layer_heights(given({0.1, 0.5, 1})) == std::vector<double>{0, 0.1, 0.5, 1});
    std::vector<double> sums;
    for (int i = 1; i <= 10; ++i) sums.push_back((sums.empty() ? 0.0 : sums.back()) + 0.1);
    REQUIRE(sums.back() != 1);
    CHECK(layer_heights(given(sums)).back() == 1);
}

TEST_CASE("what cannot be layer heights is refused with its own code")
{
    for (const int count : {0, -1, -100}) CHECK_THROWS_AS(layer_heights(spec_of(count)), InvalidInput);
    for (const double bias : {0.0, -1.0, kNan, kInfinity, -kInfinity}) {
        CHECK_THROWS_AS(layer_heights(spec_of(4, bias)), InvalidInput);
    }
    CHECK_THROWS_AS(layer_heights(spec_of(100, 1e-300)), InvalidInput);
    for (const auto& heights : std::vector<std::vector<double>>{{0.0, 1.0},
                                                                {-0.5, 1.0},
                                                                {0.5, 0.5, 1.0},
                                                                {0.6, 0.5, 1.0},
                                                                {0.5},
                                                                {0.5, 0.999},
                                                                {0.5, 1.5},
                                                                {0.5, 1.0, 1.0},
                                                                {kNan, 1.0},
                                                                {0.5, kNan},
                                                                {0.5, kInfinity},
                                                                {kNan}}) {
        CHECK_THROWS_AS(layer_heights(given(heights)), InvalidInput);
    }
    auto both = given({0.5, 1});
    both.count = 3;
    CHECK_THROWS_AS(layer_heights(both), InvalidInput);
    try {
        layer_heights(spec_of(0));
        FAIL("a count of 0 was taken");
    } catch (const InvalidInput& error) {
        CHECK(error.code() == "sweep.layers");
    }
}
