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
    int edges_split = 0;        ///< edges split at a T-junction
    int edges_collapsed = 0;    ///< edges no longer than the tolerance
    int faces_left_out = 0;     ///< faces listed twice, or no wider than the tolerance
    std::vector<Message> notes; ///< faces and meshes that were dropped, and gaps that remain

    [[nodiscard]] bool changed() const
    {
        return vertices_merged + edges_merged + edges_split + edges_collapsed + faces_left_out > 0;
    }
    /// One line with the counts; empty if nothing changed.
    [[nodiscard]] std::string summary() const;
};

/// Gap that `stitch()` closes by default, as a share of the shorter edge. Rule of thumb: surfaces exported
/// one by one differ by less, slits drawn on purpose by more.
inline constexpr double kSewnShare = 0.01;

/// Join faces that meet without sharing edges.
///
/// - Vertices closer than the tolerance merge, also in chains. An edge no longer than the tolerance collapses
///   to a vertex.
/// - A vertex on the inside of an edge splits it (a T-junction) if the edge, or an edge at the vertex, has
///   only one face; seams are not split. A closed polyline whose vertex is arbitrary starts at the new vertex
///   instead.
/// - Edges with the same ends merge if they stay within the tolerance of each other, measured on their exact
///   curves where they have them. The merged edge has the points of both, and the facets on all sides are cut
///   to match; on an exact curve, points closer than a quarter of a side merge. Edges further apart are kept,
///   with a note if they look like a gap.
/// - Two free edges with exact curves merge, with a note, if no other edge has their ends and their distance
///   is at most `share` of the shorter one's length.
/// - Of coincident faces one is kept, with a note; two are kept where other faces are connected to both, as
///   where two solids touch.
///
/// Kept entities keep their tags; a split edge gives its tag to its first part, the other parts get new tags.
/// Nodes of given quads do not move, and no points are added between them. If the merged facets would be no
/// manifold surface, the model is unchanged, with a note.
///
/// @param tolerance  [model length], > 0.
/// @param share      [-], >= 0.
/// @pre   the loops are set, or `with_loops()` would succeed.
/// @post  loops are those of `with_loops()`; if gaps are well below the tolerance, a second call changes
///         nothing.
/// @throw Cancelled  the model is then unchanged.
/// @note  O(n log n) in points; deterministic.
StitchReport stitch(topology::Model& model, double tolerance, const RunContext& context = {},
                    double share = 0);

} // namespace lacuna::healing
