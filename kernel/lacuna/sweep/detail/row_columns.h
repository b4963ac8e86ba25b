// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/shared/boundary_layers.h>
#include <lacuna/surface/shared/source_mesh.h>
#include <lacuna/surface/shared/walls.h>
#include <lacuna/sweep/detail/morph_ends.h>

#include <array>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

namespace lacuna::sweep {

/// Inputs for placing the layers of a sweep.
struct SweptParts {
    const topology::OpenVolume& volume;
    std::span<const surface::LinkingSurface> links;
    const surface::SourceMesh& source;
    std::span<const surface::WallMesh> walls;
    const EndFaces& ends;
    int layers = 1;
    /// For each edge inside the source, the target edge that it is swept to.
    std::map<EdgeId, EdgeId> target_edges{};
    std::set<FaceId> kept{};   ///< faces of the source with given quads, which must not move
    bool target_stays = false; ///< whether the nodes of the target are given and must not move
    /// Whether given nodes come from neighbours with the same rows. The walls of these may lean
    /// otherwise, so the thickness there is reported but not checked.
    bool shared_rows = false;

    [[nodiscard]] std::size_t size_of(std::size_t link) const { return source.links[link].source_at.size(); }
    /// Source node for node `i` of a linking surface, cyclic.
    [[nodiscard]] std::size_t rim_node(std::size_t link, std::size_t i) const
    {
        return index(source.first[link]) + i % size_of(link);
    }
    /// The wall over a side of the rim.
    [[nodiscard]] FaceId wall_at(std::size_t link, std::size_t layer, std::size_t side) const
    {
        return walls[link].face[layer * size_of(link) + side % size_of(link)];
    }
};

/// The nodes of all rows over one rim node, on the source.
struct RowColumn {
    std::size_t link, node;
    bool before = false, after = false; ///< whether the sides before and after the node have rows
    int table = -1;
    std::vector<Index> nodes; ///< source node of each row, from the rim inward
    std::vector<double> lean; ///< tangential offset of each node from the base node, on the source [model
                              ///< length]

    /// Unit direction along the rim at the base. @param at  returns the position of a node
    template <class At>
    [[nodiscard]] Vec3 tangent(const SweptParts& parts, const At& at) const
    {
        const std::size_t n = parts.size_of(link);
        const Vec3& foot = at(parts.rim_node(link, node));
        Vec3 along = Vec3::Zero();
        if (before) along += (foot - at(parts.rim_node(link, node + n - 1))).normalized();
        if (after) along += (at(parts.rim_node(link, node + 1)) - foot).normalized();
        return along.stableNormalized();
    }
};

/// The rows over the rim sides of walls with boundary layers, found by walking over opposite sides of quads.
/// A side uses the table of the wall that it lies on at the source or, without one, at the target.
/// @throw NotSweepable "sweep.layers_rows"  the quads have fewer rows than the table; names the wall.
std::vector<RowColumn> row_columns(const SweptParts& parts, const surface::LayerTables& tables);

// --- positions along a line of nodes, in units of its sides -----------------------------------------

/// The first position at which a line reaches a height above its start, measured along a normal; empty if it
/// does not reach it.
std::optional<double> place_at(const std::vector<Vec3>& line, const Vec3& normal, double height);

/// Positions of nodes on a line, by their index.
using LinePlaces = std::map<std::size_t, double>;

/// Required heights at one end of a line of nodes; null: none.
struct HeightsOver {
    const std::vector<double>* heights = nullptr;
    Vec3 normal = Vec3::Zero();
};

/// Positions on a line of three kinds of nodes: both ends, the nodes in `still`, and nodes with required
/// heights over either end. Empty if there is not enough room; the final check of the thickness then reports
/// the misfit.
std::optional<LinePlaces> places_at(const std::vector<Vec3>& line, const std::array<HeightsOver, 2>& ends,
                                    const std::set<std::size_t>& still = {});

/// The point at a position.
Vec3 point_at(const std::vector<Vec3>& line, double place);

/// Whether a vertex of a chain lies at a running length.
bool is_vertex(const surface::Chain& chain, double at);

/// The point of a chain closest to `p`. It is found on the chain's polyline and then improved by iteration on
/// the exact curve.
Vec3 nearest_on(const topology::Model& model, const surface::Chain& chain, const Vec3& p);

/// New positions of the inner nodes of a line, by index. Given nodes have the given positions; the others
/// divide the length between the nearest given ones in their original proportion.
/// @pre  the positions of both ends are given.
std::vector<std::pair<std::size_t, double>> places_along(const std::vector<Vec3>& line,
                                                         const LinePlaces& place);

} // namespace lacuna::sweep
