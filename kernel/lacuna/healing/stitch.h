// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/topology/model.h>

#include <string>
#include <vector>

namespace lacuna::healing {

/// What `stitch()` did.
struct StitchReport {
    int vertices_merged = 0;        ///< that were there and are no more
    int edges_merged = 0;           ///< that became another
    int edges_split = 0;            ///< at a vertex on their inside
    int edges_collapsed = 0;        ///< no longer than the tolerance
    int faces_left_out = 0;         ///< listed twice, or no wider than the tolerance
    std::vector<std::string> notes; ///< what was left out or left apart: sentences, entities by their tags
    std::vector<std::string> sewn; ///< of the notes those of edges that were further apart than the tolerance

    [[nodiscard]] bool changed() const
    {
        return vertices_merged + edges_merged + edges_split + edges_collapsed + faces_left_out > 0;
    }
    /// One line of the counts; empty where nothing changed.
    [[nodiscard]] std::string summary() const;
};

/// The share of `stitch()` that a user need not ask for. A choice, not a measurement: surfaces that were
/// exported one by one part by less, and slits that are drawn by more.
inline constexpr double kSewnShare = 0.01;

/// Join faces that meet without sharing edges.
///
/// - Vertices closer than the tolerance, in a chain too, become one. An edge no longer than the tolerance
///   becomes its vertex.
/// - A vertex on the inside of an edge splits it (a T-junction), where the edge, or an edge at the vertex,
///   has one face alone; no seam. A closed polyline with a vertex of no meaning begins at the one found
///   instead.
/// - Edges with the same ends that stay within the tolerance of each other, by their exact curves where they
///   have them, become one. It has the points of all, and so have the facets on all its sides; points a
///   quarter of a side apart on an exact curve become one. Edges further apart stay, with a note where
///   they look like a gap.
/// - Two free edges with exact curves that alone have the same two ends become one, with a note, where they
///   are no further apart than `share` of the shorter one's length.
/// - Of faces that lie on each other everywhere one stays, with a note; two stay where other faces go on from
///   both, as where two solids touch.
///
/// What stays keeps its tag; the parts of a split edge after the first count on. Nodes of given quads stay
/// where they are and get no others between them. Where the facets joined would be no surface, the model
/// stays as it was, with a note.
///
/// @param tolerance  [model length], > 0.
/// @param share      [-], >= 0.
/// @pre   build_loops() has run, or can.
/// @post  loops are those of build_loops(); where gaps are well below the tolerance, a second call changes
///         nothing.
/// @throw Cancelled  the model is then as it was.
/// @note  O(n log n) in points; deterministic.
StitchReport stitch(topology::Model& model, double tolerance, const RunContext& context = {},
                    double share = 0);

} // namespace lacuna::healing
