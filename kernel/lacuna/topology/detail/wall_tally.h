// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/shared/constants.h>
#include <lacuna/topology/shared/patches.h>

#include <span>
#include <utility>
#include <vector>

/// Bounds of the Euler number of the walls if one or two patches become ends. Internal to this folder.
namespace lacuna::topology {

/// The patches of a model, indexed for role candidates.
struct PatchMap {
    std::vector<SmoothPatch> patches;
    std::vector<std::size_t> of_use;            ///< patch of each use, at index `number_of(use)`; `kNoIndex`
                                                ///< if no face has the use
    std::vector<EdgeUse> next;                  ///< next use in the face's loop
    std::vector<std::vector<std::size_t>> at{}; ///< patches at each vertex
};

inline std::size_t number_of(EdgeUse use) { return 2 * use.edge.index() + (use.reversed ? 1 : 0); }

/// Excludes pairs of ends by Euler numbers, from a few counts of each patch.
///
/// Walls that join ends have no handles, so the Euler number of each connected part of the walls is 2 minus
/// the number of its rims. If one or two patches become ends, all other patches are the walls. The counts
/// give bounds of the walls' Euler number without tracing their rims.
class WallTally {
public:
    /// @param free_loops  number of free loops of all patches.
    /// @pre   no use belongs to two faces.
    /// @note  near linear in the edges of patches.
    WallTally(const PatchMap& map, std::size_t free_loops);

    /// Number of connected parts of the patches.
    [[nodiscard]] std::size_t parts() const { return parts_; }
    [[nodiscard]] bool hang_together(std::size_t a, std::size_t b) const
    {
        return taken_[a].part == taken_[b].part;
    }
    /// Upper bound of a patch's contribution to the sums of `can_hold()`.
    [[nodiscard]] long at_most(std::size_t p) const;
    /// Whether Euler numbers permit that walls join two ends, which have no common vertex.
    [[nodiscard]] bool can_hold(std::size_t a, std::size_t b) const;
    /// Whether Euler numbers permit that all walls of a single end are rings.
    [[nodiscard]] bool can_hold(std::size_t p) const;

private:
    /// Change of the walls' counts if a patch becomes an end; see `can_hold()`.
    struct Taken {
        long fans = 0;        ///< decrease of the number of fans; see `count_fans()`
        long vertices = 0;    ///< vertices that no other patch has
        long edges = 0;       ///< edges that no other patch has
        long contacts = 0;    ///< uses of its edges whose opposite use belongs to another patch
        std::size_t part = 0; ///< connected part of the patch
    };

    void count_fans();
    [[nodiscard]] std::pair<long, long> euler_without(std::size_t p) const;

    const PatchMap& map_;
    std::vector<Taken> taken_; ///< for each patch
    Taken whole_;              ///< totals over all patches; its `contacts` is the number of free loops
    long euler_ = 0;           ///< sum of the inner Euler numbers of all patches
    std::size_t parts_ = 0;
};

} // namespace lacuna::topology
