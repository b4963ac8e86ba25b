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
    /// @param volume  referred to, not copied: must outlive the climber.
    explicit Climber(const topology::OpenVolume& volume);

    /// The edges from a rim vertex as far up as they go; the last may end on the other rim.
    [[nodiscard]] std::vector<topology::EdgeUse> climb(VertexId start) const;

    /// Whether one way along a free loop, and one alone, leads from one vertex to another past no end: then
    /// the walls' own rim is the side line there. Both ways do round a hole in the walls.
    [[nodiscard]] bool joined(VertexId from, VertexId to, const std::vector<topology::Rim>& loops) const;

private:
    /// The mean way of the wall edges that leave a rim vertex.
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
