// SPDX-License-Identifier: MIT
#include "support/random_sources.h"
#include "support/plan_prism.h"

#include <lacuna/geometry/shared/union_find.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace lacuna::test {

namespace {

/// Cells of a board between uneven lines.
class Board {
public:
    explicit Board(std::mt19937& random) : random_(random), nx_(between(2, 4)), ny_(between(1, 3))
    {
        x_ = lines(nx_);
        y_ = lines(ny_);
        there_.assign(static_cast<std::size_t>(nx_ * ny_), 1);
        holed_.assign(there_.size(), 0);
        notch();
        join();
        for (std::size_t c = 0; c < holed_.size(); ++c) holed_[c] = there_[c] != 0 && between(0, 5) == 0;
    }

    [[nodiscard]] std::vector<PlanPatch> patches() const
    {
        std::vector<PlanPatch> patches;
        for (int j = 0; j < ny_; ++j) {
            for (int i = 0; i < nx_; ++i) {
                if (is_there(i, j)) add_cell(i, j, patches);
            }
        }
        return patches;
    }

    /// From the board's middle, its longer half 1.
    [[nodiscard]] Vec2 scaled(const Vec2& p) const
    {
        const double half = std::max(x_.back(), y_.back()) / 2;
        return (p - Vec2(x_.back(), y_.back()) / 2) / half;
    }

private:
    int between(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }

    std::vector<double> lines(int cells)
    {
        std::vector<double> at{0};
        for (int i = 0; i < cells; ++i) at.push_back(at.back() + 0.2 * between(2, 9));
        return at;
    }

    [[nodiscard]] static int cell(int i, int j, int nx) { return j * nx + i; }
    [[nodiscard]] bool is_there(int i, int j) const
    {
        return i >= 0 && j >= 0 && i < nx_ && j < ny_ &&
               there_[static_cast<std::size_t>(cell(i, j, nx_))] != 0;
    }

    /// Cells of the last row go, from either end.
    void notch()
    {
        if (ny_ < 2) return;
        const int left = between(0, nx_ - 1), right = between(0, nx_ - 1 - left);
        for (int i = 0; i < nx_; ++i) {
            if (i < left || i >= nx_ - right) there_[static_cast<std::size_t>(cell(i, ny_ - 1, nx_))] = 0;
        }
    }

    /// Neighbours at random make one face.
    void join()
    {
        geometry::UnionFind sets(there_.size());
        for (int j = 0; j < ny_; ++j) {
            for (int i = 0; i < nx_; ++i) {
                const auto one = static_cast<std::size_t>(cell(i, j, nx_));
                if (!is_there(i, j)) continue;
                if (is_there(i + 1, j) && between(0, 2) == 0) sets.unite_least(one, one + 1);
                if (is_there(i, j + 1) && between(0, 2) == 0)
                    sets.unite_least(one, one + static_cast<std::size_t>(nx_));
            }
        }
        for (std::size_t c = 0; c < there_.size(); ++c) face_.push_back(static_cast<int>(sets.find(c)));
    }

    /// One number for each straight run of the rim.
    [[nodiscard]] int wall(int i, int j, int side) const
    {
        const int di = side == 1 ? 1 : side == 3 ? -1 : 0, dj = side == 2 ? 1 : side == 0 ? -1 : 0;
        if (is_there(i + di, j + dj)) return 0;
        const int back_i = dj != 0 ? 1 : 0, back_j = di != 0 ? 1 : 0;
        while (is_there(i - back_i, j - back_j) && !is_there(i - back_i + di, j - back_j + dj)) {
            i -= back_i;
            j -= back_j;
        }
        return 1 + 4 * cell(i, j, nx_) + side;
    }

    /// In quarters, or as the eight parts between a round hole and the halves of the cell's sides.
    void add_cell(int i, int j, std::vector<PlanPatch>& patches) const
    {
        const auto c = static_cast<std::size_t>(cell(i, j, nx_));
        const auto at = [](const std::vector<double>& lines, int k) {
            return lines[static_cast<std::size_t>(k)];
        };
        const Vec2 low(at(x_, i), at(y_, j)), high(at(x_, i + 1), at(y_, j + 1)), middle = (low + high) / 2;
        const std::array<int, 4> own{wall(i, j, 0), wall(i, j, 1), wall(i, j, 2), wall(i, j, 3)};
        if (holed_[c] == 0) {
            patches.push_back(
                {face_[c], rectangle(low.x(), low.y(), middle.x(), middle.y()), {own[0], 0, 0, own[3]}});
            patches.push_back(
                {face_[c], rectangle(middle.x(), low.y(), high.x(), middle.y()), {own[0], own[1], 0, 0}});
            patches.push_back(
                {face_[c], rectangle(middle.x(), middle.y(), high.x(), high.y()), {0, own[1], own[2], 0}});
            patches.push_back(
                {face_[c], rectangle(low.x(), middle.y(), middle.x(), high.y()), {0, 0, own[2], own[3]}});
            return;
        }
        const std::array<Vec2, 8> rim{
            Vec2(high.x(), middle.y()), high, Vec2(middle.x(), high.y()), Vec2(low.x(), high.y()),
            Vec2(low.x(), middle.y()),  low,  Vec2(middle.x(), low.y()),  Vec2(high.x(), low.y())};
        const double radius = 0.3 * (high - low).minCoeff();
        const int hole = 1000 + static_cast<int>(c);
        for (std::size_t k = 0; k < 8; ++k) {
            const Vec2 a = rim[k], b = rim[(k + 1) % 8];
            const PlanMap part = [=](double s, double t) {
                const double angle = (static_cast<double>(k) + t) * std::numbers::pi / 4;
                const Vec2 in = middle + radius * Vec2(std::cos(angle), std::sin(angle));
                return Vec2((1 - s) * in + s * ((1 - t) * a + t * b));
            };
            const std::size_t side = k < 1 || k == 7 ? 1 : k < 3 ? 2 : k < 5 ? 3 : 0;
            patches.push_back({face_[c], part, {0, own[side], 0, hole}});
        }
    }

    std::mt19937& random_;
    int nx_, ny_;
    std::vector<double> x_, y_;
    std::vector<char> there_, holed_;
    std::vector<int> face_;
};

Vec3 bent(const Vec2& p, int shape)
{
    switch (shape) {
    case 1: // a cylinder about y
        return {std::sin(1.2 * p.x()) / 1.2, p.y(), std::cos(1.2 * p.x()) / 1.2};
    case 2: // a dome
        return {p.x(), p.y(), -0.5 * p.squaredNorm()};
    case 3: // a saddle
        return {p.x(), p.y(), 0.6 * p.x() * p.y() + 0.2 * p.x() * p.x()};
    case 4: // a wave
        return {p.x(), p.y(), 0.2 * std::sin(2.5 * p.x() + p.y())};
    default:
        return {p.x(), p.y(), 0};
    }
}

} // namespace

FamilySource random_source(std::uint32_t seed, int number, int facets)
{
    std::mt19937 random(seed + 7919U * static_cast<std::uint32_t>(number));
    const Board board(random);
    const int shape = number % 5;
    const SpaceMap map = [&](const Vec2& p, double height) {
        return Vec3(bent(board.scaled(p), shape) + Vec3(0, 0, height));
    };
    return {"random:" + std::to_string(seed) + ":" + std::to_string(number),
            prism_over(board.patches(), map, facets), -1, shape == 0, false};
}

} // namespace lacuna::test
