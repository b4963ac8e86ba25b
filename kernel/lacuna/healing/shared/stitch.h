// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/topology/model.h>

#include <string>
#include <vector>

namespace lacuna::healing {

/// Changes that `stitch()` made.
struct StitchReport {
    int vertices_merged = 0;    ///< vertices merged into another
    int edges_merged = 0;       ///< edges merged into another
    int edges_split = 0;        ///< edges split at T-junctions
    int edges_collapsed = 0;    ///< edges removed because they were no longer than the tolerance
    int faces_left_out = 0;     ///< faces removed because they were duplicates or no wider than the tolerance
    std::vector<Message> notes; ///< faces and meshes that were dropped, and gaps that remain

    [[nodiscard]] bool changed() const
    {
        return vertices_merged + edges_merged + edges_split + edges_collapsed + faces_left_out > 0;
    }
    /// One line with the counts; empty if nothing changed.
    [[nodiscard]] std::string summary() const;
};

/// Value of `share` in `stitch()` for files that are loaded without a tolerance. Rule of thumb: gaps between
/// surfaces that were exported one by one are smaller, slits that were drawn on purpose are larger.
inline constexpr double kSewnShare = 0.01;

/// Join faces that meet without sharing edges.
///
/// - Vertices closer than the tolerance merge; in a chain of such vertices, all merge into one. An edge no
///   longer than the tolerance collapses to a vertex.
/// - T-junctions: a vertex in the interior of an edge splits the edge if the edge, or an edge at the vertex,
///   has only one face. Seams are not split. If the edge is a closed polyline whose own vertex belongs to no
///   other edge, the edge starts at the new vertex instead.
/// - Edges with the same ends merge if they stay within the tolerance of each other. If edges have exact
///   curves, the curves are compared. The merged edge has the points of both, and the facets of its faces are
///   cut to match. On an exact curve, points closer than a quarter of a facet side merge. Edges further apart
///   than the tolerance are kept; a note reports them if the gap between them is small compared with their
///   length.
/// - Two free edges with exact curves and the same ends also merge, with a note, if their distance is at most
///   `share` times the length of the shorter one and no other free edge with an exact curve has these ends.
/// - Of several coincident faces one is kept, with a note. Two are kept if other faces are connected to each
///   of them, for example where two solids touch.
///
/// Entities that stay keep their tags. The first part of a split edge keeps the edge's tag, the other parts
/// get new tags. Nodes of given quads do not move, and no points are added between them. If the merged facets
/// would not be a manifold surface, the model is unchanged, and the report has a note.
///
/// @param tolerance  largest distance at which entities merge [model length], > 0.
/// @param share  largest gap between two free edges that merge, relative to the length of the shorter one
///         [-], >= 0.
/// @pre  the loops are set, or `with_loops()` would succeed.
/// @post  the loops are those that `with_loops()` gives. If gaps are well below the tolerance, a second call
///        changes nothing.
/// @throw Cancelled  the model is then unchanged.
/// @note  O(n log n) in points; deterministic.
StitchReport stitch(topology::Model& model, double tolerance, const RunContext& context = {},
                    double share = 0);

/// Add the points and entities of another model to `model`, with their tags, for `stitch()`.
void append(topology::ModelBuilder& model, topology::Model more);

} // namespace lacuna::healing
