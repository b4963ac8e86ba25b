// SPDX-License-Identifier: MIT
#pragma once

/// Patches of quads that can be refilled.

#include <lacuna/quads/detail/clean_mesh.h>
#include <lacuna/quads/detail/marks.h>

#include <vector>

namespace lacuna::quads::cleaning {

/// Quads with one outline.
struct QuadPatch {
    std::vector<Index> quads;
    std::vector<Index> touched;       ///< points, in the order they came in
    std::vector<Index> loop;          ///< points around it, the patch on the left
    std::vector<std::size_t> corners; ///< places in the loop
    int irregular = 0;                ///< points inside, and on the mesh's boundary, that a filling changes
};

/// Whether a template may fill a patch.
enum class PatchState { fine, hopeless, too_large };

/// Grows one patch after the other, each from an irregular point over others near it.
class PatchGrower {
public:
    /// @param mesh  kept by reference; it may change between `start()`s
    explicit PatchGrower(const CleanMesh& mesh) : mesh_(mesh) {}

    /// Start with the star of an irregular point, and look for so many others near it.
    void start(Index seed, std::size_t others);
    /// Irregular points near the seed, the nearest first.
    [[nodiscard]] const std::vector<Index>& others() const { return others_; }
    /// All points near the seed that were looked at.
    [[nodiscard]] const std::vector<Index>& seen_points() const { return seen_points_; }
    /// Add the stars of the points from `other` to the seed. @return false where it was inside already
    bool grow_to(Index other);
    /// Add quads until no point of the outline is concave and none is passed twice.
    /// @return hopeless where the patch has a hole, or a point of the mesh's boundary that should have three
    ///         quads or more; too large where it takes more than `largest` quads.
    PatchState close(std::size_t largest);
    /// Quads around the patch, in so many rings.
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
    Numbers count_;         ///< quads of the patch at each point
    Numbers parent_;        ///< of points seen: the next on the way back to the seed
    Numbers next_;          ///< of points on the outline
    Index start_ = -1;      ///< a point on the outline
    std::size_t sides_ = 0; ///< of the outline
    std::vector<Index> seen_points_, others_, rings_, front_;
};

} // namespace lacuna::quads::cleaning
