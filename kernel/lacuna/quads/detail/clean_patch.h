// SPDX-License-Identifier: MIT
#pragma once

/// Patches of quads that can be refilled.

#include <lacuna/quads/detail/clean_mesh.h>
#include <lacuna/quads/detail/marks.h>

#include <vector>

namespace lacuna::quads::cleaning {

/// Number of rings of quads around a changed place whose points move with it, so that they can adapt. More
/// rings improve the worst quad only slightly.
inline constexpr int kRings = 2;

/// A patch of quads with a single outline.
struct QuadPatch {
    std::vector<Index> quads;
    std::vector<Index> touched;       ///< points of these quads, in the order in which they were added
    std::vector<Index> loop;          ///< points of the outline; the patch is on the left
    std::vector<std::size_t> corners; ///< positions in the loop
    /// Number of irregular points that a filling may change: those inside the patch, and those of its outline
    /// that are on the mesh's boundary.
    int irregular = 0;
};

/// Whether a template can fill a patch: `fine`, yes; `hopeless`, no; `too_large`, not within the maximum
/// number of quads.
enum class PatchState { fine, hopeless, too_large };

/// Grows patches one at a time, each from an irregular point to others nearby.
class PatchGrower {
public:
    /// @param mesh  kept by reference; it may change between calls of `start()`
    explicit PatchGrower(const CleanMesh& mesh) : mesh_(mesh) {}

    /// Start with the star of an irregular point and search for up to `others` further irregular points
    /// nearby.
    void start(Index seed, std::size_t others);
    /// Irregular points near the seed, the nearest first.
    [[nodiscard]] const std::vector<Index>& others() const { return others_; }
    /// All points near the seed that the search visited.
    [[nodiscard]] const std::vector<Index>& seen_points() const { return seen_points_; }
    /// Add the stars of all points on the path from `other` to the seed. @return false if `other` is already
    /// inside
    bool grow_to(Index other);
    /// Add quads until no point of the outline is concave and none occurs twice.
    /// @return `too_large` if this needs more than `largest` quads. `hopeless` if the patch
    ///         - has a hole,
    ///         - touches itself at a boundary point of the mesh, or
    ///         - contains a boundary point whose ideal number of quads is three or more.
    PatchState close(std::size_t largest);
    /// The quads around the patch, within `layers` rings.
    const std::vector<Index>& rings(int layers);

    [[nodiscard]] const QuadPatch& patch() const { return patch_; }

private:
    void look_for_others(Index seed, std::size_t most);
    void add_star(Index p);
    bool fill_notches(std::size_t largest);
    Index link_sides();
    bool walk_outline();

    const CleanMesh& mesh_;
    QuadPatch patch_;
    Marks in_patch_, in_rings_, passed_;
    Numbers count_;         ///< number of the patch's quads at each point
    Numbers parent_;        ///< for each visited point, the next point on the path to the seed
    Numbers next_;          ///< for each point of the outline, its successor
    Index start_ = -1;      ///< a point on the outline
    std::size_t sides_ = 0; ///< number of sides of the outline
    std::vector<Index> seen_points_, others_, rings_, front_;
};

} // namespace lacuna::quads::cleaning
