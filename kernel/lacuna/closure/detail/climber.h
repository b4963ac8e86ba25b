// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/open_volume.h>

#include <map>
#include <optional>
#include <set>
#include <vector>

namespace lacuna::closure {

/// Follows wall edges from the rim of one end towards the other end.
class Climber {
public:
    /// @param volume  not copied; must outlive the climber.
    explicit Climber(const topology::OpenVolume& volume);

    /// The chain of wall edges that leads from a rim vertex away from its end. At each vertex the straightest
    /// edge is taken. The chain stops at a vertex of an end, or where every edge turns by 45° or more.
    [[nodiscard]] std::vector<topology::EdgeUse> climb(VertexId start) const;

    /// Whether exactly one of the two paths along a free loop joins two vertices without passing a vertex of
    /// an end. This path follows the rim of the walls and is the side line between the vertices. If the loop
    /// surrounds a hole in the walls, both paths join the vertices, and neither is a side line.
    [[nodiscard]] bool joined(VertexId from, VertexId to,
                              const std::vector<const topology::Rim*>& loops) const;

private:
    /// The mean direction of the wall edges at a rim vertex, away from the vertex.
    [[nodiscard]] Vec3 off_rim(VertexId at) const;
    [[nodiscard]] Vec3 start_of(topology::EdgeUse use) const;
    [[nodiscard]] std::optional<topology::EdgeUse> straightest(VertexId at, const Vec3& onward,
                                                               double least) const;

    const topology::Model& model_;
    std::set<EdgeId> walls_;
    std::set<VertexId> on_end_;
    std::map<VertexId, std::vector<topology::EdgeUse>> leaving_;
};

} // namespace lacuna::closure
