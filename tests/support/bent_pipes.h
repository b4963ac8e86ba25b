// SPDX-License-Identifier: MIT
#pragma once

// Axes of pipes with bends, and how far the columns of a swept mesh turn about them.
#include <lacuna/mesh/hex_mesh.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace lacuna::test {

inline constexpr double kDegree = std::numbers::pi / 180;

/// A part of a pipe's axis: straight, or an arc.
struct Leg {
    double length = 0;
    double bend = 0;    ///< [degrees]
    double towards = 0; ///< which way it bends, in the frame that was carried there [degrees]
};

/// An arc by its radius.
inline Leg arc(double radius, double bend, double towards = 0)
{
    return {radius * bend * kDegree, bend, towards};
}

/// A frame that is moved along the axis with no rotation about it.
struct Frame {
    Vec3 at = Vec3::Zero(), way = Vec3::UnitZ(), across = Vec3::UnitX();
    [[nodiscard]] Vec3 beside() const { return way.cross(across); }
};

inline Frame carried(const Frame& from, const Leg& leg, double share)
{
    Frame to = from;
    const double run = leg.length * share;
    if (leg.bend == 0) {
        to.at += run * from.way;
        return to;
    }
    const double radius = leg.length / (leg.bend * kDegree), towards = leg.towards * kDegree;
    const Vec3 in = std::cos(towards) * from.across + std::sin(towards) * from.beside();
    const Eigen::AngleAxisd turn(share * leg.bend * kDegree, from.way.cross(in));
    to.at = from.at + radius * in - radius * (turn * in);
    to.way = turn * from.way;
    to.across = turn * from.across;
    return to;
}

/// Frames closely along an axis.
inline std::vector<Frame> frames_along(const std::vector<Leg>& legs)
{
    constexpr int kClosely = 400; // of each leg
    std::vector<Frame> axis;
    Frame frame;
    for (const Leg& leg : legs) {
        for (int k = 0; k < kClosely; ++k)
            axis.push_back(carried(frame, leg, static_cast<double>(k) / kClosely));
        frame = carried(frame, leg, 1);
    }
    axis.push_back(frame);
    return axis;
}

/// Axes for a section of about radius 1: one bend and several, in one plane and in several.
inline std::vector<std::pair<std::string, std::vector<Leg>>> bent_axes()
{
    return {
        {"elbow", {{6}, arc(4, 90), {3}}},
        {"sharp elbow", {{4}, arc(1.6, 90), {4}}},
        {"bend alone", {arc(3, 150)}},
        {"S", {{3}, arc(3, 60), {2}, arc(3, 60, 180), {3}}},
        {"U", {{5}, arc(2.5, 90), {2}, arc(2.5, 90), {5}}},
        {"out of plane", {{4}, arc(3, 90), {3}, arc(3, 90, 90), {4}}},
        {"one bend after the other", {{3}, arc(3, 80), arc(3, 80, 110), arc(3, 60, 200), {3}}},
        {"far", {{20}, arc(3, 90), {20}, arc(3, 90, 60), {20}, arc(3, 45, 240), {10}}},
    };
}

/// Of a point beside the axis, in the carried frame [radian].
inline double angle_at(const std::vector<Frame>& axis, const Vec3& p)
{
    const Frame& frame = *std::ranges::min_element(axis, {},
                                                   [&](const Frame& f) { return (p - f.at).squaredNorm(); });
    const Vec3 off = p - frame.at;
    return std::atan2(off.dot(frame.beside()), off.dot(frame.across));
}

struct Drift {
    double turned = 0;  ///< of a column against the carried frame, at most [degrees]
    double crowded = 0; ///< of the angle between columns against the one on the source, at most [share]
};

inline Drift drift_of_columns(const std::vector<Frame>& axis, const mesh::HexMesh& mesh)
{
    Drift drift;
    const auto angle = [&](Index node, int layer) {
        return angle_at(axis,
                        mesh.nodes[index(node) + static_cast<std::size_t>(layer * mesh.nodes_per_layer)]);
    };
    for (const Segment& side : mesh.rim) {
        const double a0 = angle(side[0], 0), b0 = angle(side[1], 0);
        for (int layer = 1; layer <= mesh.layers; ++layer) {
            const double a = angle(side[0], layer), b = angle(side[1], layer);
            drift.turned = std::max(drift.turned,
                                    std::abs(std::remainder(a - a0, 2 * std::numbers::pi)) / kDegree);
            drift.crowded = std::max(drift.crowded,
                                     std::abs(std::remainder(b - a, 2 * std::numbers::pi) /
                                                  std::remainder(b0 - a0, 2 * std::numbers::pi) -
                                              1));
        }
    }
    return drift;
}

} // namespace lacuna::test
