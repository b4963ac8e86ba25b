// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/sweep/second_order.h>

#include <cstdint>
#include <vector>

/// What placing middle nodes shares. Internal to this folder.
namespace lacuna::sweep {

/// What is known of a middle node.
enum class Middle : std::uint8_t {
    inside,  ///< not on the skin
    open,    ///< on the skin, place not known yet
    loose,   ///< on the skin, blended; no geometry holds it
    settled, ///< on the skin, where geometry or a given mesh puts it
};

/// Of each place in `MiddleNodes::nodes`.
using MiddleStates = std::vector<Middle>;

/// A frame of a side: bends are told in it, over the side's length, so that they can be taken elsewhere.
struct SideFrame {
    Vec3 along, across, normal;
    double length = 0;

    /// @param hint  a direction that the side does not run in.
    SideFrame(const Vec3& from, const Vec3& to, const Vec3& hint);
    [[nodiscard]] Vec3 local(const Vec3& bend) const;
    [[nodiscard]] Vec3 world(const Vec3& local) const;
};

/// Blends the bends of a level's sides along chords.
class LevelBlend {
public:
    explicit LevelBlend(const mesh::HexMesh& mesh);

    /// Bends of all sides on a level whose `known` is not set, from those whose is.
    /// @param nodes  of the level.
    /// @param bend   of each side, in and out [model length].
    /// @param extra  of each side, local: added to what is blended; empty: none.
    void blend(const Vec3* nodes, const std::vector<std::uint8_t>& known, std::vector<Vec3>& bend,
               const std::vector<Vec3>& extra = {}) const;
    /// What the bends of a level are beyond their blend from the `known` ones, local.
    [[nodiscard]] std::vector<Vec3> beyond(const Vec3* nodes, const std::vector<std::uint8_t>& known,
                                           const std::vector<Vec3>& bend) const;

private:
    struct Step {
        Index from, to, side;
    };
    struct Chord {
        std::size_t begin, end; ///< of `steps_`
        bool closed;
    };
    template <class Take>
    void each_chord(const Vec3* nodes, const std::vector<std::uint8_t>& known, const std::vector<Vec3>& bend,
                    const Take& take) const;

    std::vector<Step> steps_;
    std::vector<Chord> chords_;
};

/// How a column of nodes runs past the middle of an upright side, less the straight side: a cubic through
/// four nodes, over running lengths; fewer where there are fewer. No more than a fifth of the side.
Vec3 column_bend(const mesh::HexMesh& mesh, Index node, int layer);

/// Place the middle nodes of the skin. @return  how many were given, on exact geometry, on facets
struct SkinCounts {
    std::size_t given = 0, exact = 0, facets = 0;
};
SkinCounts place_skin(const topology::OpenVolume& volume, mesh::HexMesh& mesh,
                      const std::vector<FaceId>& faces, const LevelBlend& blend,
                      const SecondOrderOptions& options, MiddleStates& states, const RunContext& context);
/// Put the middles of the skin's quads where they are given, and project the others where their faces say so.
/// @return  how many were given
std::size_t place_skin_centres(const topology::OpenVolume& volume, mesh::HexMesh& mesh,
                               const std::vector<FaceId>& faces, const SecondOrderOptions& options,
                               MiddleStates& states, const RunContext& context);

/// Middles of the faces of a cell and of the cell: they follow from those of the sides, but for settled ones.
void place_centres(mesh::HexMesh& mesh, const MiddleStates& states, std::size_t cell);

/// Move middle nodes until every cell is valid. @return  how many cells were not. @throw as `elevate()`
std::size_t repair_middles(const topology::OpenVolume& volume, mesh::HexMesh& mesh,
                           const std::vector<FaceId>& faces, const MiddleStates& states,
                           const RunContext& context);

} // namespace lacuna::sweep
