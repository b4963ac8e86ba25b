// SPDX-License-Identifier: MIT
#include <lacuna/matching/detail/assignment.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

using namespace lacuna;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Best {
    int pairs = 0;
    double cost = kInfinity;
};

/// Most pairs first, least cost then, over all permutations.
Best brute_force(const Eigen::MatrixXd& cost)
{
    std::vector<int> order(static_cast<std::size_t>(cost.rows()));
    std::iota(order.begin(), order.end(), 0);
    Best best{-1, kInfinity};
    do {
        Best now{0, 0};
        for (std::size_t i = 0; i < order.size(); ++i) {
            const double c = cost(static_cast<Eigen::Index>(i), order[i]);
            if (!std::isfinite(c)) continue;
            ++now.pairs;
            now.cost += c;
        }
        if (now.pairs > best.pairs || (now.pairs == best.pairs && now.cost < best.cost)) best = now;
    } while (std::next_permutation(order.begin(), order.end()));
    return best;
}

/// The assignment of a square matrix.
std::vector<int> assigned(const Eigen::MatrixXd& cost)
{
    std::vector<std::size_t> cheapest;
    for (Eigen::Index row = 0; row < cost.rows(); ++row) {
        Eigen::Index at = 0;
        cost.row(row).minCoeff(&at);
        cheapest.push_back(static_cast<std::size_t>(at));
    }
    const auto of = [&](std::size_t i, std::size_t j) {
        return cost(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
    };
    return matching::assign(of, cheapest);
}

} // namespace

TEST_CASE("the assignment is the cheapest of all permutations, and keeps as many pairs as can be")
{
    std::mt19937 dice(3);
    std::uniform_real_distribution<double> value(-1, 5);
    int combinations = 0;
    for (int n = 0; n <= 7; ++n) {
        for (int trial = 0; trial < (n == 7 ? 20 : 120); ++trial) {
            const int forbidden = trial % 4; // of four entries
            const bool whole = trial % 3 == 0;
            Eigen::MatrixXd cost(n, n);
            for (Eigen::Index i = 0; i < cost.size(); ++i) {
                const double c = whole ? std::round(value(dice)) : value(dice);
                cost(i) = static_cast<int>(dice() % 4) < forbidden ? kInfinity : c;
            }
            const std::vector<int> columns = assigned(cost);
            REQUIRE(columns.size() == static_cast<std::size_t>(n));
            Best found{0, 0};
            std::vector<bool> taken(static_cast<std::size_t>(n), false);
            for (std::size_t i = 0; i < columns.size(); ++i) {
                if (columns[i] < 0) continue;
                REQUIRE(columns[i] < n);
                CHECK(!taken[static_cast<std::size_t>(columns[i])]);
                taken[static_cast<std::size_t>(columns[i])] = true;
                const double c = cost(static_cast<Eigen::Index>(i), columns[i]);
                CHECK(std::isfinite(c));
                ++found.pairs;
                found.cost += c;
            }
            const Best wanted = brute_force(cost);
            CHECK(found.pairs == wanted.pairs);
            CHECK(found.cost == doctest::Approx(wanted.cost));
            ++combinations;
        }
    }
    MESSAGE(combinations << " cost matrices");
}

TEST_CASE("a permutation that costs nothing is found among hundreds")
{
    std::mt19937 dice(5);
    const int n = 300;
    std::vector<int> order(n);
    std::iota(order.begin(), order.end(), 0);
    std::shuffle(order.begin(), order.end(), dice);
    Eigen::MatrixXd cost = Eigen::MatrixXd::Ones(n, n);
    for (int i = 0; i < n; ++i) cost(i, order[static_cast<std::size_t>(i)]) = 0;
    CHECK(assigned(cost) == order);
}
