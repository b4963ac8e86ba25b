// SPDX-License-Identifier: GPL-2.0-or-later
#include <lacuna/cad_worker/detail/face_grid.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/shared/angle.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lacuna::cad_worker {

namespace {

/// Limit on the aspect ratio of cells. A cylinder needs no division along its rulings, but flattening does
/// not work well with long, thin facets.
constexpr double kMaxAspect = 5;
/// Least number of cells along the longer side of a face.
constexpr double kCellsAlong = 4;

/// Derivatives and normals on a regular lattice over the rectangle.
struct Lattice {
    std::size_t sides;
    std::array<std::vector<double>, 2> knots;
    std::vector<SurfaceFrame> frames; ///< frame at u index i and v index j is at i · (sides + 1) + j

    [[nodiscard]] const SurfaceFrame& at(int axis, std::size_t along, std::size_t across) const
    {
        return axis == 0 ? frames[along * (sides + 1) + across] : frames[across * (sides + 1) + along];
    }
};

Lattice sample(int tag, const ParameterBox& box, std::size_t sides)
{
    Lattice lattice{sides, {}, {}};
    for (int k = 0; k < 2; ++k) {
        for (std::size_t i = 0; i <= sides; ++i) {
            const double part = static_cast<double>(i) / static_cast<double>(sides);
            lattice.knots[static_cast<std::size_t>(k)].push_back(box.low[k] +
                                                                 part * (box.high[k] - box.low[k]));
        }
    }
    std::vector<Vec2> uv;
    for (const double u : lattice.knots[0]) {
        for (const double v : lattice.knots[1]) uv.emplace_back(u, v);
    }
    lattice.frames = surface_frames(tag, uv);
    return lattice;
}

/// Angle between the normals of two frames; zero if a frame is at a pole. The rectangle may reach beyond a
/// pole by a rounding error, and the normal is reversed there.
double turn_between(const SurfaceFrame& a, const SurfaceFrame& b)
{
    const auto vanishes = [](const Vec3& at_a, const Vec3& at_b) {
        const double la = at_a.norm(), lb = at_b.norm();
        return !(std::min(la, lb) > kVisible * std::max(la, lb));
    };
    if (vanishes(a.du, b.du) || vanishes(a.dv, b.dv)) return 0;
    const Vec3 na = a.du.cross(a.dv);
    const Vec3 nb = b.du.cross(b.dv);
    const double floor_a = kSamePlace * a.du.norm() * a.dv.norm();
    const double floor_b = kSamePlace * b.du.norm() * b.dv.norm();
    if (!(na.norm() > floor_a) || !(nb.norm() > floor_b)) return 0;
    return geometry::angle_between(na, nb);
}

/// For each interval along an axis: over all lattice lines in the direction of the axis, the greatest length
/// of the line within the interval and the largest turn of the normal along it.
struct Profile {
    std::vector<double> length, turn;
    [[nodiscard]] double total_length() const { return std::accumulate(length.begin(), length.end(), 0.0); }
};

Profile profile_along(const Lattice& lattice, int axis)
{
    Profile profile;
    const std::vector<double>& knots = lattice.knots[static_cast<std::size_t>(axis)];
    for (std::size_t i = 0; i < lattice.sides; ++i) {
        double length = 0, turn = 0;
        for (std::size_t j = 0; j <= lattice.sides; ++j) {
            const SurfaceFrame& a = lattice.at(axis, i, j);
            const SurfaceFrame& b = lattice.at(axis, i + 1, j);
            const double speed = axis == 0 ? (a.du + b.du).norm() / 2 : (a.dv + b.dv).norm() / 2;
            length = std::max(length, speed * (knots[i + 1] - knots[i]));
            turn = std::max(turn, turn_between(a, b));
        }
        profile.length.push_back(length);
        profile.turn.push_back(turn);
    }
    return profile;
}

} // namespace

GridAxis::GridAxis(std::vector<double> knots, const std::vector<double>& density, int least_cells)
    : knots_(std::move(knots)), grid_(1, 0.0)
{
    double total = std::accumulate(density.begin(), density.end(), 0.0);
    // A minimum density keeps the map strictly increasing.
    const double least = total > 0 ? 1e-3 * total / static_cast<double>(density.size()) : 1;
    for (const double d : density) grid_.push_back(grid_.back() + std::max(d, least));
    cells_ = std::max(least_cells, static_cast<int>(std::ceil(total - kFileAccuracy)));
    const double scale = cells_ / grid_.back();
    for (double& g : grid_) g *= scale;
    grid_.back() = cells_;
}

double GridAxis::through(const std::vector<double>& from, const std::vector<double>& to, double x)
{
    const auto next = std::upper_bound(from.begin() + 1, from.end() - 1, x);
    const auto i = static_cast<std::size_t>(next - from.begin());
    const double width = from[i] - from[i - 1];
    const double part = width > 0 ? (x - from[i - 1]) / width : 0;
    return to[i - 1] + part * (to[i] - to[i - 1]);
}

FaceGrid lay_grid(int tag, bool flat, const ParameterBox& box, const Fineness& fineness, double max_cells)
{
    const Lattice lattice = sample(tag, box, flat ? 2 : 32);
    const std::array<Profile, 2> profile{profile_along(lattice, 0), profile_along(lattice, 1)};
    const double longest = std::max(profile[0].total_length(), profile[1].total_length());
    const double size = std::min(fineness.max_size, longest / kCellsAlong);

    std::array<std::vector<double>, 2> density;
    std::array<double, 2> cells{}, cell_length{};
    for (std::size_t k = 0; k < 2; ++k) {
        for (std::size_t i = 0; i < lattice.sides; ++i) {
            density[k].push_back(std::max(profile[k].length[i] / size, profile[k].turn[i] / fineness.turn));
        }
        cells[k] = std::max(1.0, std::accumulate(density[k].begin(), density[k].end(), 0.0));
        cell_length[k] = profile[k].total_length() / cells[k];
    }
    std::array<double, 2> factor{1, 1};
    for (std::size_t k = 0; k < 2; ++k) {
        const double widest = kMaxAspect * cell_length[1 - k];
        if (widest > 0 && cell_length[k] > widest) factor[k] = cell_length[k] / widest;
    }
    const double count = cells[0] * factor[0] * cells[1] * factor[1];
    if (count > max_cells) {
        for (double& f : factor) f *= std::sqrt(max_cells / count);
    }
    FaceGrid grid;
    for (std::size_t k = 0; k < 2; ++k) {
        for (double& d : density[k]) d *= factor[k];
        // Around a closed surface, fewer than four cells would put facets on top of each other.
        grid.axis[k] = GridAxis(lattice.knots[k], density[k], box.closed[k] ? 4 : 1);
    }
    return grid;
}

} // namespace lacuna::cad_worker
