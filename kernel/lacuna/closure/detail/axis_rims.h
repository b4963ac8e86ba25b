// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/geometry/newell.h>
#include <lacuna/topology/open_volume.h>

#include <cstddef>
#include <optional>
#include <set>
#include <vector>

/// Rims and chains that run round an axis, which is the normal of a plane through its origin.
namespace lacuna::closure {

/// A rim that runs once round an axis at one distance.
struct RoundRim {
    std::size_t loop = 0;
    geometry::Plane base; ///< plane normal to the axis, through the centre of the rim
    double radius = 0;
    double slope = 0;        ///< of the wall at the rim: increase of its radius with the height above `base`
    bool flat = false;       ///< whether the rim is planar
    bool needs_wall = false; ///< whether no face inside the rim can close it
    std::set<FaceId> beside; ///< the given faces at the rim
    double along = 0;        ///< position on the common axis of the rims
};

/// The circle that some places in one plane lie on.
struct Circle {
    geometry::Plane base; ///< plane of the circle, with its origin at the centre
    double radius = 0;
};

/// Consecutive sides of a rim, each with both of its ends.
using Sides = std::vector<std::vector<Vec3>>;

/// Angle of a place round the axis [radian].
double angle_at(const geometry::Plane& base, const Vec3& place);

/// The angle from `a` to `b`, in (-π, π].
double turn_between(double a, double b);

/// The turn of an open chain round the axis.
double turn_along(const geometry::Plane& base, const std::vector<Vec3>& places);

/// The turn of a closed chain round the axis: ±2π if the chain runs round the axis once.
double turn_round(const geometry::Plane& base, const std::vector<Vec3>& places);

double distance_to_axis(const geometry::Plane& base, const Vec3& place);

/// Radius of the round wall through a rim at a height above its base.
double wall_radius(const RoundRim& rim, double height);

/// Whether all places are on the round wall through a rim.
bool is_on_wall(const RoundRim& rim, const std::vector<Vec3>& places);

/// Whether a given face at a rim is a part of the round wall through the rim.
bool is_of_wall(const topology::Model& model, const RoundRim& rim, FaceId face);

bool is_one_line(const std::vector<Vec3>& side);

/// The circles across the axes that a round wall along some sides may have: that of each side that is an arc
/// about the axis, and those about the directions of the straight sides.
std::vector<Circle> circles_across(const Sides& sides, const std::vector<Vec3>& places);

/// A rim that runs once round its own axis, or round the axis of a circle at its radius; empty for any other
/// rim.
/// @param loop  its number, which is kept
std::optional<RoundRim> round_rim(const topology::Model& model, const topology::Rim& rim, std::size_t loop);
std::optional<RoundRim> round_rim(const topology::Model& model, const topology::Rim& rim, std::size_t loop,
                                  const Circle& circle);

/// A rim that is not flat and runs once round the axis of one of its arcs; empty for any other rim.
std::optional<RoundRim> round_rim_along_arc(const topology::Model& model, const topology::Rim& rim,
                                            std::size_t loop);

/// Radius of a rim that is a circle; empty for any other rim.
std::optional<double> radius_of_circle(const topology::Model& model, const topology::Rim& rim);

} // namespace lacuna::closure
