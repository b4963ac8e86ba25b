// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/open_volume.h>

#include <map>
#include <optional>
#include <set>
#include <vector>

namespace lacuna::closure {

/// Walks up wall edges from a rim.
class Climber {
public:
    /// @param volume  is referenced and must outlive the climber.
    explicit Climber(const topology::OpenVolume& volume);

    /// The chain of wall edges upward from a rim vertex, until it reaches an end or no edge continues it.
    [[nodiscard]] std::vector<topology::EdgeUse> climb(VertexId start) const;

    /// Whether exactly one of the two paths along a free loop joins two vertices without passing a vertex of
    /// an end. That path is then the side line between them, along the rim of the walls. Around a hole in the
    /// walls both paths join the vertices, and neither is a side line.
    [[nodiscard]] bool joined(VertexId from, VertexId to,
                              const std::vector<const topology::Rim*>& loops) const;

private:
    /// The mean direction of the wall edges that leave a rim vertex.
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
