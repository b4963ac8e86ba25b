// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/shared/marks.h>
#include <lacuna/topology/detail/wall_tally.h>

#include <cstddef>
#include <vector>

namespace lacuna::topology {

/// Connected walls of one candidate.
struct WallPart {
    long euler = 0;
    std::size_t rims = 0;
    std::size_t source_rim = kNoIndex, target_rim = kNoIndex; ///< the rim of each end that it touches
    bool several = false;                                     ///< it touches several rims of one end
};

/// Traces the walls that are left between the ends of a candidate.
class WallParts {
public:
    /// @param map, free  patches, and uses whose edge has no other use; both are read at each call.
    WallParts(const PatchMap& map, const std::vector<EdgeUse>& free);

    /// Number of free loops if all patches are walls.
    [[nodiscard]] std::size_t free_loops();
    /// The connected parts of the walls between two ends.
    /// @param target  `kNoIndex` if this end is missing.
    [[nodiscard]] std::vector<WallPart> between(std::size_t source, std::size_t target);
    /// Number of windows of the walls last traced: rims whose edges are all free.
    [[nodiscard]] std::size_t windows() const { return windows_; }

private:
    /// Whether a wall uses an edge in this direction.
    [[nodiscard]] bool on_wall(EdgeUse use) const;
    /// Assign the part number to every patch connected to `start`. @return the Euler number of the part.
    long flood(std::size_t start, std::size_t unseen);
    /// Count the rim that contains a wall's use; each rim counts once. The rim is traced as in `rims()`. A
    /// rim whose edges are all free is a window, unless the other end is missing there.
    void count_rim(EdgeUse use, std::vector<WallPart>& parts);
    /// Record which rims of an end the parts touch, and count the parts' rims there.
    void touch(std::size_t end, std::size_t WallPart::*rim, std::vector<WallPart>& parts);

    const PatchMap& map_;
    const std::vector<EdgeUse>& free_;
    std::vector<std::size_t> part_of_; ///< part of each patch; `kNoIndex`: an end
    std::size_t windows_ = 0;
    Marks vertex_seen_, edge_seen_, use_seen_;
};

} // namespace lacuna::topology
