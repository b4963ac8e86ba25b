// SPDX-License-Identifier: MIT
#include <lacuna/core/error.h>
#include <lacuna/geometry/shared/harmonic.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

using namespace lacuna;
using namespace lacuna::geometry;

namespace {

/// A square of n × n cells, each cut along one of its diagonals at random, with a few points to spare.
struct Sheet {
    std::vector<Vec3> points;
    std::vector<Triangle> triangles;
    std::vector<Index> rim;
    std::vector<Vec2> rim_place; ///< on the unit square
    int n = 0;
};

Sheet sheet(unsigned seed, int n, double jitter, double bumps)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> any(-1, 1);
    Sheet result;
    result.n = n;
    result.points = {Vec3(9, 9, 9), Vec3(8, 8, 8)}; // used by no triangle
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i) {
            const Vec2 place(double(i) / n, double(j) / n);
            result.points.emplace_back(place.x() + jitter * any(random) / n,
                                       place.y() + jitter * any(random) / n, bumps * any(random));
            if (i == 0 || j == 0 || i == n || j == n) {
                result.rim.push_back(static_cast<Index>(result.points.size() - 1));
                result.rim_place.push_back(place);
            }
        }
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const Index a = 2 + j * (n + 1) + i, b = a + 1, c = b + n + 1, d = a + n + 1;
            // A diagonal that cuts off a corner of the square keeps each triangle off a single side.
            const bool rising = (i == 0 && j == 0) || (i == n - 1 && j == n - 1)   ? true
                                : (i == 0 && j == n - 1) || (i == n - 1 && j == 0) ? false
                                                                                   : any(random) > 0;
            if (rising) {
                result.triangles.push_back({a, b, c});
                result.triangles.push_back({a, c, d});
            } else {
                result.triangles.push_back({a, b, d});
                result.triangles.push_back({b, c, d});
            }
        }
    return result;
}

HarmonicProblem square_problem(const Sheet& sheet)
{
    HarmonicProblem problem;
    problem.points = sheet.points;
    problem.triangles = sheet.triangles;
    problem.fixed = sheet.rim;
    problem.fixed_values.resize(Eigen::Index(sheet.rim.size()), 2);
    for (std::size_t i = 0; i < sheet.rim.size(); ++i)
        problem.fixed_values.row(Eigen::Index(i)) = sheet.rim_place[i].transpose();
    return problem;
}

double area(const Vec2& a, const Vec2& b, const Vec2& c)
{
    const Vec2 ab = b - a, ac = c - a;
    return 0.5 * (ab.x() * ac.y() - ab.y() * ac.x());
}

/// Areas of the triangles in the plane of the first two values, turns applied.
std::vector<double> mapped_areas(const HarmonicProblem& problem, const Eigen::MatrixXd& values)
{
    std::vector<double> areas;
    for (std::size_t t = 0; t < problem.triangles.size(); ++t) {
        std::array<Vec2, 3> p;
        for (std::size_t k = 0; k < 3; ++k) {
            p[k] = values.row(problem.triangles[t][k]).transpose();
            if (!problem.corner_turns.empty())
                p[k] += problem.corner_turns[t][k] * problem.period.transpose();
        }
        areas.push_back(area(p[0], p[1], p[2]));
    }
    return areas;
}

double sum(const std::vector<double>& numbers)
{
    double total = 0;
    for (const double x : numbers) total += x;
    return total;
}

} // namespace

TEST_CASE("linear functions come back on planar facets, however they lie")
{
    for (unsigned seed = 0; seed < 10; ++seed) {
        Sheet flat = sheet(seed, 9, 0.25, 0);
        const Eigen::Affine3d motion = Eigen::Translation3d(100, 20, -3) *
                                       Eigen::AngleAxisd(0.1 + seed, Vec3(1, 2, 3).normalized());
        for (Vec3& point : flat.points) point = motion * point;
        HarmonicProblem problem = square_problem(flat);
        for (std::size_t i = 0; i < flat.rim.size(); ++i) {
            const Vec3& p = flat.points[std::size_t(flat.rim[i])];
            problem.fixed_values.row(Eigen::Index(i)) << p.x() + 2 * p.y(), p.z() - 3 * p.x() + 7;
        }
        const Eigen::MatrixXd values = solve_harmonic(problem);
        for (std::size_t i = 2; i < flat.points.size(); ++i) {
            const Vec3& p = flat.points[i];
            CHECK(values(Eigen::Index(i), 0) == doctest::Approx(p.x() + 2 * p.y()).epsilon(1e-11));
            CHECK(values(Eigen::Index(i), 1) == doctest::Approx(p.z() - 3 * p.x() + 7).epsilon(1e-11));
        }
    }
}

TEST_CASE("linear functions come back from more points than are solved for directly, slender facets too")
{
    for (const double slender : {1.0, 30.0}) {
        CAPTURE(slender);
        Sheet flat = sheet(7, 180, 0.25, 0);
        for (Vec3& point : flat.points) point.x() *= slender;
        HarmonicProblem problem = square_problem(flat);
        for (std::size_t i = 0; i < flat.rim.size(); ++i) {
            const Vec3& p = flat.points[std::size_t(flat.rim[i])];
            problem.fixed_values.row(Eigen::Index(i)) << p.x() / slender + 2 * p.y(), p.y() - 7;
        }
        const Eigen::MatrixXd values = solve_harmonic(problem);
        double worst = 0;
        for (std::size_t i = 2; i < flat.points.size(); ++i) {
            const Vec3& p = flat.points[i];
            worst = std::max({worst, std::abs(values(Eigen::Index(i), 0) - p.x() / slender - 2 * p.y()),
                              std::abs(values(Eigen::Index(i), 1) - p.y() + 7)});
        }
        CHECK(worst < 1e-8);
        CHECK(solve_harmonic(problem) == values);
    }
}

TEST_CASE("values between free borders are the same in any unit, solved for directly or not")
{
    for (const int n : {20, 180}) {
        for (const double unit : {0x1p-8, 0x1p8}) {
            CAPTURE(n);
            CAPTURE(unit);
            Sheet bumpy = sheet(3, n, 0.25, 0.1 / n);
            HarmonicProblem problem = square_problem(bumpy);
            const auto is_end = [&](std::size_t i) { return std::fmod(bumpy.rim_place[i].y(), 1) == 0; };
            std::vector<double> ends;
            problem.fixed.clear();
            for (std::size_t i = 0; i < bumpy.rim.size(); ++i) {
                if (!is_end(i)) continue;
                problem.fixed.push_back(bumpy.rim[i]);
                ends.push_back(bumpy.rim_place[i].y());
            }
            problem.fixed_values = Eigen::Map<Eigen::VectorXd>(ends.data(), Eigen::Index(ends.size()));
            const Eigen::MatrixXd values = solve_harmonic(problem);
            for (Vec3& point : bumpy.points) point *= unit;
            problem.points = bumpy.points;
            CHECK(solve_harmonic(problem) == values);
        }
    }
}

TEST_CASE("a bumpy sheet maps one to one onto the unit square, its rim bit for bit")
{
    for (unsigned seed = 0; seed < 40; ++seed) {
        CAPTURE(seed);
        const Sheet bumpy = sheet(seed, 4 + int(seed % 12), 0.9, 0.02 * seed);
        const HarmonicProblem problem = square_problem(bumpy);
        const Eigen::MatrixXd values = solve_harmonic(problem);
        REQUIRE(values.rows() == Eigen::Index(bumpy.points.size()));
        CHECK(values.row(0).isZero(0));
        for (std::size_t i = 0; i < bumpy.rim.size(); ++i)
            CHECK(values.row(bumpy.rim[i]) == problem.fixed_values.row(Eigen::Index(i)));
        const auto areas = mapped_areas(problem, values);
        CHECK(*std::min_element(areas.begin(), areas.end()) > 0);
        CHECK(sum(areas) == doctest::Approx(1));
    }
}

TEST_CASE("facets of no area and needles neither break the solution nor turn facets over")
{
    std::mt19937 random(99);
    for (unsigned seed = 0; seed < 40; ++seed) {
        CAPTURE(seed);
        Sheet bad = sheet(seed, 10, 0.3, 0.05);
        // Inner points moved onto or next to a neighbour, or onto the line between two.
        const auto row = Index(bad.n + 1);
        for (int trial = 0; trial < 12; ++trial) {
            const Index i = 1 + Index(random() % unsigned(bad.n - 1)),
                        j = 1 + Index(random() % unsigned(bad.n - 1));
            const auto p = std::size_t(2 + j * row + i);
            if (trial % 3 == 0) bad.points[p] = bad.points[p + 1];
            if (trial % 3 == 1) bad.points[p] = 0.5 * (bad.points[p - 1] + bad.points[p + 1]);
            if (trial % 3 == 2) bad.points[p] = bad.points[p + 1] + 1e-12 * Vec3(1, 2, 3);
        }
        const HarmonicProblem problem = square_problem(bad);
        const Eigen::MatrixXd values = solve_harmonic(problem);
        CHECK(values.allFinite());
        CHECK(values.minCoeff() >= -1e-9);
        CHECK(values.maxCoeff() <= 1 + 1e-9);
        const auto areas = mapped_areas(problem, values);
        CHECK(*std::min_element(areas.begin(), areas.end()) > -1e-9);
        CHECK(sum(areas) == doctest::Approx(1));
    }
}

TEST_CASE("no value leaves the range of the fixed ones")
{
    std::mt19937 random(5);
    std::uniform_real_distribution<double> any(-1, 1);
    for (unsigned seed = 0; seed < 20; ++seed) {
        const Sheet bumpy = sheet(seed, 8, 2.0, 0.5);
        HarmonicProblem problem = square_problem(bumpy);
        problem.fixed = {bumpy.rim[0], bumpy.rim[5], bumpy.rim[9], Index(bumpy.points.size() / 2)};
        problem.fixed_values = Eigen::MatrixXd::NullaryExpr(4, 3, [&] { return any(random); });
        const Eigen::MatrixXd values = solve_harmonic(problem);
        for (Eigen::Index column = 0; column < 3; ++column) {
            const auto used = values.col(column).tail(values.rows() - 2);
            CHECK(used.minCoeff() >= problem.fixed_values.col(column).minCoeff() - 1e-12);
            CHECK(used.maxCoeff() <= problem.fixed_values.col(column).maxCoeff() + 1e-12);
        }
    }
}

TEST_CASE("a bumpy tube maps one to one onto the periodic strip, wherever it is cut")
{
    std::mt19937 random(6);
    std::uniform_real_distribution<double> any(-1, 1);
    for (int around = 3; around < 20; ++around) {
        CAPTURE(around);
        const int up = 6;
        std::vector<Vec3> points;
        HarmonicProblem problem;
        for (int j = 0; j <= up; ++j)
            for (int i = 0; i < around; ++i) {
                const double angle = 2 * std::numbers::pi * i / around, radius = 1 + 0.3 * any(random);
                points.emplace_back(radius * std::cos(angle), radius * std::sin(angle),
                                    j + 0.3 * any(random));
            }
        std::vector<Triangle> triangles;
        for (int j = 0; j < up; ++j)
            for (int i = 0; i < around; ++i) {
                const Index a = j * around + i, b = j * around + (i + 1) % around, c = b + around,
                            d = a + around;
                const int turn = i + 1 == around ? 1 : 0;
                triangles.push_back({a, b, c});
                problem.corner_turns.push_back({0, turn, turn});
                triangles.push_back({a, c, d});
                problem.corner_turns.push_back({0, turn, 0});
            }
        problem.points = points;
        problem.triangles = triangles;
        problem.fixed_values.resize(2 * around, 2);
        for (int i = 0; i < around; ++i) {
            problem.fixed.push_back(i);
            problem.fixed.push_back(up * around + i);
            // The upper rim is twisted against the lower one.
            problem.fixed_values.row(2 * i) << double(i) / around, 0;
            problem.fixed_values.row(2 * i + 1) << double(i) / around + 0.4, 1;
        }
        problem.period = Eigen::RowVector2d(1, 0);
        const Eigen::MatrixXd values = solve_harmonic(problem);
        const auto areas = mapped_areas(problem, values);
        CHECK(*std::min_element(areas.begin(), areas.end()) > 0);
        CHECK(sum(areas) == doctest::Approx(1));

        // Another cut: the first column is seen a turn further on.
        HarmonicProblem other = problem;
        for (std::size_t t = 0; t < triangles.size(); ++t)
            for (std::size_t k = 0; k < 3; ++k)
                if (triangles[t][k] % around == 0) --other.corner_turns[t][k];
        for (std::size_t r = 0; r < other.fixed.size(); ++r)
            if (other.fixed[r] % around == 0) other.fixed_values(Eigen::Index(r), 0) += 1;
        const Eigen::MatrixXd again = solve_harmonic(other);
        for (Eigen::Index p = 0; p < values.rows(); ++p) {
            const double moved = p % around == 0 ? 1 : 0;
            CHECK(again(p, 0) - moved == doctest::Approx(values(p, 0)).epsilon(1e-11));
            CHECK(again(p, 1) == doctest::Approx(values(p, 1)).epsilon(1e-11));
        }
    }
}

TEST_CASE("nine digits of heights are right on walls that lead straight up and on those that do not")
{
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(-1, 1);
    constexpr int kUp = 6;
    for (int around = 3; around < 20; ++around) {
        for (const double flare : {0.0, 1e-7, 0.3}) {
            CAPTURE(around);
            CAPTURE(flare);
            const Vec3 lean(any(random), any(random), 0);
            std::vector<Vec3> points;
            std::vector<Triangle> triangles;
            std::vector<double> ends;
            HarmonicProblem problem;
            for (int j = 0; j <= kUp; ++j) {
                const bool is_end = j == 0 || j == kUp;
                for (int i = 0; i < around; ++i) {
                    const double angle = 2 * std::numbers::pi * i / around;
                    const double height = j + (is_end ? 0 : 0.3 * any(random));
                    if (is_end) {
                        problem.fixed.push_back(static_cast<Index>(points.size()));
                        ends.push_back(height / kUp);
                    }
                    points.push_back((1 + flare * height) * Vec3(std::cos(angle), std::sin(angle), 0) +
                                     height * (Vec3::UnitZ() + lean));
                    if (j == kUp) continue;
                    const Index a = j * around + i, b = j * around + (i + 1) % around;
                    triangles.push_back({a, b, b + around});
                    triangles.push_back({a, b + around, a + around});
                }
            }
            problem.points = points;
            problem.triangles = triangles;
            problem.fixed_values = Eigen::Map<Eigen::VectorXd>(ends.data(), Eigen::Index(ends.size()));
            const Eigen::MatrixXd all = solve_harmonic(problem);
            problem.nine_digits = true;
            CHECK((solve_harmonic(problem) - all).cwiseAbs().maxCoeff() < 1e-9);
        }
    }
}

TEST_CASE("facets with no fixed point, and input that does not fit, are refused")
{
    const Sheet one = sheet(1, 4, 0, 0);
    Sheet two = one;
    const auto shift = Index(one.points.size());
    two.points.insert(two.points.end(), one.points.begin(), one.points.end());
    for (const Triangle& t : one.triangles)
        two.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
    HarmonicProblem problem = square_problem(two);
    CHECK_THROWS_AS(solve_harmonic(problem), BackendError);
    problem.fixed.push_back(shift + 5);
    CHECK_THROWS_AS(solve_harmonic(problem), InvalidInput);
    problem.fixed_values.conservativeResize(problem.fixed_values.rows() + 1, Eigen::NoChange);
    problem.fixed_values.bottomRows(1).setConstant(3);
    const Eigen::MatrixXd values = solve_harmonic(problem);
    for (Eigen::Index p = shift + 2; p < values.rows(); ++p) CHECK(values(p, 0) == doctest::Approx(3));
    problem.corner_turns.resize(3);
    CHECK_THROWS_AS(solve_harmonic(problem), InvalidInput);
    problem.corner_turns.clear();
    problem.fixed.back() = Index(two.points.size());
    CHECK_THROWS_AS(solve_harmonic(problem), InvalidInput);
}

TEST_CASE("points that no triangle uses change no bit of harmonic values, and errors name the caller's point")
{
    const Sheet few = sheet(1, 6, 0.3, 2);
    const HarmonicProblem problem = square_problem(few);
    Sheet many = few;
    const Index unused = 7;
    many.points.insert(many.points.begin(), unused, Vec3(100, 100, 100));
    many.points.emplace_back(-100, 0, 0);
    for (Triangle& t : many.triangles)
        for (Index& p : t) p += unused;
    HarmonicProblem other = problem;
    other.points = many.points;
    other.triangles = many.triangles;
    for (Index& p : other.fixed) p += unused;
    const Eigen::MatrixXd values = solve_harmonic(problem), shifted = solve_harmonic(other);
    CHECK(shifted.middleRows(unused, values.rows()) == values);
    CHECK(shifted.topRows(unused).isZero(0));
    CHECK(shifted.bottomRows(1).isZero(0));
    const HarmonicValues found = solve_on_facets(other);
    for (const Index p : found.points) CHECK(found.at(p) == shifted.row(p));
    other.fixed = {0};
    other.fixed_values = other.fixed_values.topRows(1).eval();
    CHECK_THROWS_WITH_AS(solve_harmonic(other), doctest::Contains("point 9 "), BackendError);
}
