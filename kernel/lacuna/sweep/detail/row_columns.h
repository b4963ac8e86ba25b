// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/shared/boundary_layers.h>
#include <lacuna/surface/shared/source_mesh.h>
#include <lacuna/surface/shared/walls.h>
#include <lacuna/sweep/detail/morph_ends.h>

#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace lacuna::sweep {

/// The inputs of the layers of a sweep.
struct SweptParts {
    const topology::OpenVolume& volume;
    std::span<const surface::LinkingSurface> links;
    const surface::SourceMesh& source;
    std::span<const surface::WallMesh> walls;
    const EndFaces& ends;
    int layers = 1;
    /// For edges inside the source, the target edge that each is swept to.
    std::map<EdgeId, EdgeId> target_edges{};
    bool source_stays = false, target_stays = false; ///< whether their nodes are given and must not move

    [[nodiscard]] std::size_t size_of(std::size_t link) const { return source.links[link].source_at.size(); }
    /// Source node of a node of a linking surface, cyclic.
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

/// A column of row nodes of the source, over a node of the source's rim.
struct RowColumn {
    std::size_t link, node;
    bool before = false, after = false; ///< whether the sides before and after the node have rows
    int table = -1;
    std::vector<Index> nodes; ///< one per row
    std::vector<double> lean; ///< tangential offset of each node from the base node, on the source [model
                              ///< length]

    /// Unit directions along the rim at the base, from the positions of nodes.
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

/// The rows over the rim sides of a wall with a table, found by walking over opposite sides of quads. The
/// table of a side is that of the wall at its source or target end.
/// @throw NotSweepable "sweep.layers_rows"  fewer rows than the table has; names the wall.
std::vector<RowColumn> row_columns(const SweptParts& parts, const surface::LayerTables& tables);

// --- positions along a line of nodes, in units of its sides -----------------------------------------

/// The first position at which a line reaches a height above its start, along a normal; nothing if it does
/// not.
std::optional<double> place_at(const std::vector<Vec3>& line, const Vec3& normal, double height);

/// The point at a place.
Vec3 point_at(const std::vector<Vec3>& line, double place);

/// The point of a chain closest to another: on its polyline, then by iteration on the exact curve.
Vec3 nearest_on(const topology::Model& model, const surface::Chain& chain, const Vec3& p);

/// New positions of all nodes of a line: the given ones, and the others in proportion between them.
/// @pre  positions of both ends.
std::vector<std::pair<std::size_t, double>> places_along(const std::vector<Vec3>& line,
                                                         const std::map<std::size_t, double>& place);

} // namespace lacuna::sweep
