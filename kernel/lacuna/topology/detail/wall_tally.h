// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/detail/patches.h>

#include <span>
#include <utility>
#include <vector>

/// What walls add up to when patches become ends. Internal to this folder.
namespace lacuna::topology {

/// The patches of a model as readings of it see them.
struct PatchMap {
    static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

    std::vector<SmoothPatch> patches;
    std::vector<std::size_t> of_use;            ///< `kNone` for a use that no face makes
    std::vector<EdgeUse> next;                  ///< of each use in its face's loop
    std::vector<std::vector<std::size_t>> at{}; ///< of each vertex
};

inline std::size_t number_of(EdgeUse use) { return 2 * use.edge.index() + (use.reversed ? 1 : 0); }

/// Rules out ends by Euler numbers, from a few counts of each patch.
///
/// Walls that join ends have no tunnels: the Euler number of each part is 2 less its rims. What they add up
/// to without one patch or two lies between two sums.
class WallTally {
public:
    /// @param free_loops  of all patches.
    /// @pre   no use is that of two faces.
    /// @note  near linear in the edges of patches.
    WallTally(const PatchMap& map, std::size_t free_loops);

    /// Parts of the patches that hang together over edges.
    [[nodiscard]] std::size_t parts() const { return parts_; }
    [[nodiscard]] bool hang_together(std::size_t a, std::size_t b) const
    {
        return taken_[a].part == taken_[b].part;
    }
    /// How much a patch leaves to the walls, as `can_hold()` adds up.
    [[nodiscard]] long at_most(std::size_t p) const;
    /// Whether walls may join two ends that have no vertex in common.
    [[nodiscard]] bool can_hold(std::size_t a, std::size_t b) const;
    /// The same for one end, whose walls are rings.
    [[nodiscard]] bool can_hold(std::size_t p) const;

private:
    /// What the walls lose when a patch becomes an end, and rims that they may get for it; see `can_hold()`.
    struct Taken {
        long fans = 0;        ///< by which runs of patches round vertices become fewer
        long vertices = 0;    ///< where no other patch is
        long edges = 0;       ///< that no other patch has
        long contacts = 0;    ///< uses of its edges opposite to another patch's
        std::size_t part = 0; ///< the patches it hangs together with, over edges
    };

    void count_fans();
    [[nodiscard]] std::pair<long, long> euler_without(std::size_t p) const;

    const PatchMap& map_;
    std::vector<Taken> taken_; ///< by each patch as an end
    Taken whole_;              ///< what all patches have of that; free loops as contacts
    long euler_ = 0;           ///< what all patches have within
    std::size_t parts_ = 0;
};

} // namespace lacuna::topology
