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
    int faces_left_out = 0;     ///< duplicate faces, and faces no wider than the tolerance
    std::vector<Message> notes; ///< faces and meshes that were dropped, and gaps that remain

    [[nodiscard]] bool changed() const
    {
        return vertices_merged + edges_merged + edges_split + edges_collapsed + faces_left_out > 0;
    }
    /// One line with the counts; empty if nothing changed.
    [[nodiscard]] std::string summary() const;
};

/// Gap that `stitch()` closes by default, relative to the length of the shorter edge. Rule of thumb: gaps
/// between surfaces that were exported one by one are smaller, slits that were drawn on purpose are larger.
inline constexpr double kSewnShare = 0.01;

/// Join faces that meet without sharing edges.
///
/// - Vertices closer than the tolerance merge, also in chains. An edge no longer than the tolerance collapses
///   to a vertex.
/// - A vertex in the interior of an edge splits the edge (a T-junction) if the edge, or an edge at the
///   vertex, has only one face. Seams are not split. A closed polyline whose own vertex is arbitrary is not
///   split: it starts at the new vertex instead.
/// - Edges with the same ends merge if they stay within the tolerance of each other; exact curves are
///   compared where edges have them. The merged edge has the points of both, and the facets of all its faces
///   are cut to match. On an exact curve, points closer than a quarter of a side merge. Edges further apart
///   than the tolerance are kept, with a note if they look like a gap.
/// - Two free edges with exact curves also merge, with a note, if their distance is at most `share` of the
///   length of the shorter one and no other edge has their ends.
/// - One of several coincident faces is kept, with a note. Two are kept if other faces are connected to both,
///   as where two solids touch.
///
/// Kept entities keep their tags; a split edge gives its tag to its first part, the other parts get new tags.
/// Nodes of given quads do not move, and no points are added between them. If the merged facets would not be
/// a manifold surface, the model is unchanged, with a note.
///
/// @param tolerance  [model length], > 0.
/// @param share  [-], >= 0.
/// @pre  the loops are set, or `with_loops()` would succeed.
/// @post  the loops are those that `with_loops()` gives. If gaps are well below the tolerance, a second call
///        changes nothing.
/// @throw Cancelled  the model is then unchanged.
/// @note  O(n log n) in points; deterministic.
StitchReport stitch(topology::Model& model, double tolerance, const RunContext& context = {},
                    double share = 0);

} // namespace lacuna::healing
