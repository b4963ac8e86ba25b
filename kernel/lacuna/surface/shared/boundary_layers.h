// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/requests.h>
#include <lacuna/surface/shared/linking_surface.h>
#include <lacuna/topology/open_volume.h>

#include <map>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace lacuna::surface {

/// For each row, the distance of its upper side from the face, increasing [model length].
std::vector<double> row_heights(const BoundaryLayer& layer);

/// The faces of a volume that have the given tags and names.
/// @throw InvalidInput "surface.no_such_face"  no face of the volume has the tag or name.
std::vector<FaceId> faces_named(const topology::OpenVolume& volume, const FaceNames& names,
                                const std::string& option);

/// The wall next to an edge; invalid if no wall has the edge.
FaceId wall_on(const topology::OpenVolume& volume, EdgeId edge);

/// Whether some face of the volume has the given tag or the given name (see `FaceNames`).
bool has_face(const topology::OpenVolume& volume, int tag);
bool has_face(const topology::OpenVolume& volume, const std::string& name);

/// The boundary layers of a volume as tables of row heights, and the faces to which they apply.
struct LayerTables {
    /// For each table, the result of `row_heights()` [model length].
    std::vector<std::vector<double>> heights;
    std::map<FaceId, int> of; ///< for each face with boundary layers, the index of its table

    /// The index of a face's table; -1: the face has no boundary layers.

    [[nodiscard]] int at(FaceId face) const
    {
        const auto found = of.find(face);
        return found == of.end() ? -1 : found->second;
    }
};

/// @throw InvalidInput "surface.two_layers"  a face is in two tables; names it.
LayerTables layer_tables(const topology::OpenVolume& volume, std::span<const BoundaryLayer> layers);

/// Rows of quads on the source along its rims, caused by the boundary layers of the adjacent walls.
struct RimRows {
    std::vector<std::vector<double>> heights; ///< for each table, the heights of its rows [model length]
    /// A part of an edge of the source's rim, in the direction of the edge, and its table.
    struct Part {
        double from = 0, to = 1; ///< fractions of the edge's length
        int table = -1;
        FaceId wall; ///< the wall that the table belongs to
    };
    std::map<EdgeId, std::vector<Part>> parts;
    /// An end of an edge at which rows end. The rows run along the adjacent edge of the loop.
    struct End {
        int table = -1;
        FaceId wall;
        EdgeId along; ///< the edge that the rows run along
        Vec3 inward;  ///< perpendicular to `along`, in the face
        Vec3 over;    ///< inward normal of the wall at the corner
        VertexId corner;
    };
    /// The ends of edges at which rows end. Key: the edge, and whether the rows are at its end (true) or at
    /// its start (false).
    std::map<std::pair<EdgeId, bool>, End> ends;

    [[nodiscard]] bool empty() const { return heights.empty(); }
    /// The part of an edge that contains a fraction of its length; null: the edge has no rows.
    [[nodiscard]] const Part* part_at(EdgeId edge, double fraction) const;
};

/// Find the parts of the source's rim that have rows, and the edges on which the rows end.
///
/// If a wall with a table touches only the target's rim, its table applies to the part of the source's rim
/// that is swept to that wall.
/// @throw NotSweepable "surface.layers_unreached"  a wall with a table touches neither end;
///         "surface.layers_meet"  rows of two tables end on one edge at the same corner.
RimRows rim_rows(const topology::OpenVolume& volume, std::span<const LinkingSurface> links,
                 const LayerTables& tables);

/// Positions of the rows' upper sides on the edge on which the rows end: increasing fractions of the edge's
/// length, in the direction of the edge. If the edge is too short for all rows, there are fewer positions
/// than heights.
/// @param edge     the edge on which the rows end.
/// @param at_end   whether the rows are at the end of this edge; false: at its start.
/// @param heights  heights of the rows over the edge along which they run, increasing [model length].
std::vector<double> row_places(const topology::Model& model, EdgeId edge, bool at_end,
                               const RimRows::End& end, std::span<const double> heights);

} // namespace lacuna::surface
