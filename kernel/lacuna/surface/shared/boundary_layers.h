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

/// Heights of the rows over the face, rising [model length].
std::vector<double> row_heights(const BoundaryLayer& layer);

/// Faces of a volume that are named.
/// @throw InvalidInput "surface.no_such_face"  a tag or a name that no face of the volume has.
std::vector<FaceId> faces_named(const topology::OpenVolume& volume, const FaceNames& names,
                                const std::string& option);

/// The wall beside an edge; invalid if there is none.
FaceId wall_on(const topology::OpenVolume& volume, EdgeId edge);

/// Whether a face of the volume has a tag, or one of the names of `FaceNames`.
bool has_face(const topology::OpenVolume& volume, int tag);
bool has_face(const topology::OpenVolume& volume, const std::string& name);

/// The boundary layers on the faces of one volume.
struct LayerTables {
    std::vector<std::vector<double>> heights; ///< for each table
    std::map<FaceId, int> of;                 ///< table of each face that has one

    [[nodiscard]] int at(FaceId face) const
    {
        const auto found = of.find(face);
        return found == of.end() ? -1 : found->second;
    }
};

/// @throw InvalidInput "surface.two_layers"  a face in two tables; names it.
LayerTables layer_tables(const topology::OpenVolume& volume, std::span<const BoundaryLayer> layers);

/// Rows along the rims of the source: those of the adjacent walls.
struct RimRows {
    std::vector<std::vector<double>> heights; ///< for each table [model length]
    /// Of each edge of the source's rim: parts of its length, as it runs, and their tables.
    struct Part {
        double from = 0, to = 1; ///< fractions of the edge's length
        int table = -1;
        FaceId wall; ///< the wall that the table belongs to
    };
    std::map<EdgeId, std::vector<Part>> parts;
    /// The end of an edge in a face's loop, for rows along the next edge of the loop.
    struct End {
        int table = -1;
        FaceId wall;
        EdgeId along; ///< the edge that the rows run along
        Vec3 inward;  ///< perpendicular to it, in the face
        VertexId corner;
    };
    /// Rows that end on an edge, by the edge and whether they end at its end (true) or its start.
    std::map<std::pair<EdgeId, bool>, End> ends;

    [[nodiscard]] bool empty() const { return heights.empty(); }
    /// Table of an edge at a fraction of its length.
    [[nodiscard]] const Part* part_at(EdgeId edge, double fraction) const;
};

/// Find the parts of the source's rim with rows from the linking surfaces, and where the rows end.
///
/// A wall that touches only the target's rim applies to the part of the source's rim that is swept there.
/// @throw NotSweepable "surface.layers_unreached"  a wall with a table that touches neither end.
///        "surface.layers_meet"  an edge on which rows of two tables end at one corner.
RimRows rim_rows(const topology::OpenVolume& volume, std::span<const LinkingSurface> links,
                 const LayerTables& tables);

/// Positions of rows on the edge where they end: fractions of the edge's length in its direction, increasing.
/// There are fewer positions than heights if the edge is too short.
/// @param at_end   whether the rows end at the edge's end; otherwise at its start.
/// @param heights  of the rows, over the edge they run along, rising [model length].
std::vector<double> row_places(const topology::Model& model, EdgeId edge, bool at_end,
                               const RimRows::End& end, std::span<const double> heights);

} // namespace lacuna::surface
