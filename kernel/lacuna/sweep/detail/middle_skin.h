// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/shared/constants.h>
#include <lacuna/mesh/layered_nodes.h>
#include <lacuna/sweep/detail/second_order.h>
#include <lacuna/sweep/shared/side_middles.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

/// Data shared by the steps that place middle nodes. Bend of a side: the vector from its straight midpoint to
/// its middle node. Internal to this folder.
namespace lacuna::sweep {

/// State of a middle node.
enum class Middle : std::uint8_t {
    inside,  ///< not on the skin
    open,    ///< on the skin, not placed yet
    loose,   ///< on the skin; blended from other nodes, without geometry
    settled, ///< on the skin; placed on geometry, or given
};

/// Indices of the skin's middle nodes in a compact array.
class SkinPlaces {
public:
    /// @param mesh  a mesh whose sides are numbered
    explicit SkinPlaces(const mesh::HexMesh& mesh);
    /// Compact index of a middle node, from its index among all; `kNoIndex`: not on the skin.
    [[nodiscard]] std::size_t of(std::size_t place) const
    {
        const std::size_t level = place / period_, slot = place % period_;
        if (slot < on_level_ && level == 0) return slot;
        if (slot < on_level_ && level == layers_) return on_level_ + slot;
        return rank_[slot] < 0 ? kNoIndex : 2 * on_level_ + level * ring_ + index(rank_[slot]);
    }
    [[nodiscard]] std::size_t count() const { return 2 * on_level_ + layers_ * ring_; }

private:
    std::size_t period_, on_level_, layers_;
    std::size_t ring_ = 0;    ///< number of middle nodes on a level and in the layer above it
    std::vector<Index> rank_; ///< compact index of each middle node of a level and of the layer above it; -1:
                              ///< inside
};

/// The middle nodes of a mesh's skin, by their index among all middle nodes.
class SkinMiddles {
public:
    explicit SkinMiddles(const mesh::HexMesh& mesh)
        : places_(mesh), nodes_(places_.count(), Vec3::Zero()), states_(places_.count(), Middle::open)
    {
    }
    [[nodiscard]] Vec3& node(std::size_t place) { return nodes_[places_.of(place)]; }
    [[nodiscard]] const Vec3& node(std::size_t place) const { return nodes_[places_.of(place)]; }
    void set(std::size_t place, Middle state) { states_[places_.of(place)] = state; }
    /// State of any middle node, by its index among all.
    [[nodiscard]] Middle state(std::size_t place) const
    {
        const std::size_t at = places_.of(place);
        return at == kNoIndex ? Middle::inside : states_[at];
    }
    /// The nodes in the order of the compact indices of `SkinPlaces`.
    [[nodiscard]] const std::vector<Vec3>& nodes() const { return nodes_; }

private:
    SkinPlaces places_;
    std::vector<Vec3> nodes_;
    std::vector<Middle> states_;
};

/// A local frame of a side. Bends are stored in this frame, relative to the side's length, so that they can
/// be transferred to other sides.
struct SideFrame {
    Vec3 along, across, normal;
    double length = 0;

    /// @param hint  a direction that is not parallel to the side.
    SideFrame(const Vec3& from, const Vec3& to, const Vec3& hint);
    [[nodiscard]] Vec3 local(const Vec3& bend) const;
    [[nodiscard]] Vec3 world(const Vec3& local) const;
};

/// Blends the bends of a level's sides along chords of quads, which run from side to opposite side.
class LevelBlend {
public:
    explicit LevelBlend(const mesh::HexMesh& mesh);

    /// Compute the bends of the sides on a level that are not `known`, from the bends of those that are.
    /// @param nodes  nodes of the level.
    /// @param bend   bend of each side [model length]; known ones are read, the others are written.
    /// @param extra  added to the blended bend of each side, in local coordinates; empty: none.
    void blend(const Vec3* nodes, const std::vector<std::uint8_t>& known, std::vector<Vec3>& bend,
               const std::vector<Vec3>& extra = {}) const;
    /// The bends of a level's sides minus their blend from the `known` ones, in local coordinates.
    [[nodiscard]] std::vector<Vec3> beyond(const Vec3* nodes, const std::vector<std::uint8_t>& known,
                                           const std::vector<Vec3>& bend) const;

private:
    struct Step {
        Index from, to, side;
    };
    struct Chord {
        std::size_t begin, end; ///< range in `steps_`
        bool closed;
    };
    template <class Take>
    void each_chord(const Vec3* nodes, const std::vector<std::uint8_t>& known, const std::vector<Vec3>& bend,
                    const Take& take) const;

    std::vector<Step> steps_;
    std::vector<Chord> chords_;
};

/// The levels whose nodes determine the bend of a column in the middle of a layer.
struct ColumnWindow {
    static constexpr int kMost = 4; ///< four nodes define a cubic

    int first, count;
};
ColumnWindow column_window(int layers, int layer);

/// Bend of a column of nodes at the middle of a side between two layers: a cubic through four nodes (or
/// through all, if there are fewer) over running lengths, minus the straight side. Limited to a fifth of the
/// side.
/// @param column  its nodes on the levels of a `column_window()`.
/// @param low     index of the node below the side.
Vec3 column_bend(std::span<const Vec3> column, std::size_t low);

/// As `column_bend()`, for a column of the rim.
Vec3 rim_bend(const mesh::SkinNodes& corners, Index node, int layer);

/// The middle of a quad, by transfinite interpolation of its corners and the middles of its sides.
inline Vec3 middle_of_quad(const std::array<Vec3, 4>& sides, const std::array<Vec3, 4>& corners)
{
    return (sides[0] + sides[1] + sides[2] + sides[3]) / 2 -
           (corners[0] + corners[1] + corners[2] + corners[3]) / 4;
}

/// The middle of a cell, by transfinite interpolation of its corners and the middles of its faces and sides.
inline Vec3 middle_of_cell(const std::array<Vec3, 6>& faces, const std::array<Vec3, 12>& sides,
                           const std::array<Vec3, 8>& corners)
{
    const auto sum = [](const auto& nodes) {
        Vec3 all = Vec3::Zero();
        for (const Vec3& node : nodes) all += node;
        return all;
    };
    return sum(faces) / 2 - sum(sides) / 4 + sum(corners) / 8;
}

/// The middle nodes of a mesh's skin.
struct PlacedSkin {
    SkinMiddles middles;
    SkinCounts counts;
};
/// Place the middle nodes of the skin. If the mesh has nodes in its quads (hex27), they are included.
/// @param corners  corner nodes of a mesh whose sides are numbered
PlacedSkin place_skin(const topology::OpenVolume& volume, const mesh::SkinNodes& corners,
                      const std::vector<FaceId>& faces, const SecondOrderOptions& options,
                      const RunContext& context);

/// Refuse a mesh of order 2 because of an invalid cell. The error names the most bent side of the cell, of
/// those whose middle nodes the skin fixes.
/// @param count  number of invalid cells
/// @throw NotSweepable "sweep.second_order"
[[noreturn]] void refuse_middles(const topology::OpenVolume& volume, const mesh::HexMesh& mesh,
                                 const std::vector<FaceId>& faces, const SkinMiddles& skin, std::size_t cell,
                                 std::size_t count);

} // namespace lacuna::sweep
