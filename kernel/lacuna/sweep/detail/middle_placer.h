// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/sweep/detail/harmonic_spread.h>
#include <lacuna/sweep/detail/middle_skin.h>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace lacuna::sweep {

/// Places the middle nodes of a mesh from the middle nodes of its skin, a few layers at a time. Corner nodes
/// may be stored or generated. The constructor computes the bends of the walls once, so that any layer can
/// then be placed separately.
class MiddlePlacer {
public:
    /// @param corners  corner nodes of a mesh whose sides are numbered; must outlive this object.
    /// @param skin     middle nodes of the skin in the order of `SkinPlaces`; must outlive this object.
    MiddlePlacer(const mesh::SkinNodes& corners, std::span<const Vec3> skin, const RunContext& context = {});

    /// As `mesh::LayeredNodes::place_middles`. The result is bit-identical for any range and number of
    /// threads.
    void place(int first, int last, std::span<Vec3> out, const RunContext& context = {}) const;

    /// A middle node of the skin, by its index.
    [[nodiscard]] const Vec3& on_skin(std::size_t place) const { return skin_[at_skin_.of(place)]; }

private:
    class Corners;

    [[nodiscard]] std::vector<Vec3> bends_of_end(int level, const Vec3* nodes) const;
    void blend_ends(const RunContext& context);
    void bend_columns(const RunContext& context);
    void place_level(int level, const Corners& corners, Vec3* out) const;
    void place_columns(int layer, const Corners& corners, Vec3* out) const;
    void place_level_centres(int level, const Corners& corners, Vec3* out) const;
    void place_layer_centres(int layer, const Corners& corners, Vec3* out) const;

    mesh::SkinNodes corners_;
    const mesh::HexMesh& mesh_ = corners_.mesh;
    std::span<const Vec3> skin_;
    mesh::MiddlePlaces places_{mesh_};
    SkinPlaces at_skin_{mesh_};
    LevelBlend blend_{mesh_};
    std::vector<std::uint8_t> rim_side_; ///< for each side of the source, whether it is on the rim
    std::vector<std::uint8_t> rim_node_; ///< for each node of the source, whether it is on the rim
    /// The bends of both ends minus those blended from the rim, and the relative height of each level; empty:
    /// the difference is zero.
    std::vector<Vec3> first_, last_;
    std::vector<double> share_;
    double most_bend_ = 0; ///< largest bend of a column of the rim, as a share of its side
    std::optional<HarmonicSpread> spread_; ///< spreads `beyond_` over the inside
    /// For each layer, at the rim nodes: the bends of the walls that are not represented by cubics.
    std::vector<Vec3> beyond_;
};

} // namespace lacuna::sweep
