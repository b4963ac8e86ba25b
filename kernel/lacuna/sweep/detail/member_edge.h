// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/model.h>

#include <cstddef>

#include <Eigen/Geometry>

/// Edges of members of an assembly. Internal to this folder.
namespace lacuna::sweep {

/// An edge of a member.
struct MemberEdge {
    std::size_t member = 0;
    EdgeId edge;
    double length = 0;
    Vec3 from = Vec3::Zero(), middle = Vec3::Zero(), to = Vec3::Zero();
    Vec3 centre = Vec3::Zero(); ///< mean point of the edge
    double sag = 0;             ///< maximum distance of the curve from its chain of points
    Eigen::AlignedBox3d box;
    bool closed = false;
    /// Moves the edge onto the edge that represents it and its images on periodic faces.
    Eigen::Isometry3d home = Eigen::Isometry3d::Identity();
};

/// @param by  motion that is applied to the edge first
MemberEdge member_edge(const topology::Model& model, std::size_t member, EdgeId edge,
                       const Eigen::Isometry3d& by = Eigen::Isometry3d::Identity());

/// Whether two edges are the same curve between the same ends, in either direction.
bool is_same(const MemberEdge& a, const MemberEdge& b, double tolerance);

} // namespace lacuna::sweep
