// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/mesh/tet_mesh.h>
#include <lacuna/quality/quality.h>
#include <lacuna/sweep/second_order_options.h>
#include <lacuna/sweep/shared/shared_middles.h>
#include <lacuna/topology/model.h>

#include <string>
#include <vector>

namespace lacuna::fill {

/// The result of adding middle nodes to pyramids and tetrahedra.
struct ElevatedTets {
    quality::Quality quality; ///< of the cells of order 2
    std::string report;       ///< one line of the report
};

/// Add middle nodes to pyramids and tetrahedra of order 1, which makes them cells of order 2.
///
/// On the skin, middle nodes of neighbours and given middle nodes are kept bit for bit. Other middle nodes of
/// the skin lie on the exact curve or surface of their side, or on its facets. Sides inside the volume are
/// straight. If the Bézier bounds do not prove a cell valid, the sides of this cell are made straight, except
/// those whose middle nodes are given.
/// @param faces  face of each patch of the skin
/// @param known  middle nodes of the neighbours' meshes
/// @param region  name of the region, for messages
/// @throw NotSweepable "fill.second_order"  a cell stays invalid because of middle nodes that a neighbour or
///         the file gives.
/// @throw Cancelled
/// @note  Deterministic for any number of threads. O(n log n) in the sides of the skin, O(n) in cells.
ElevatedTets elevate(const topology::Model& model, mesh::TetPart& mesh, const std::vector<FaceId>& faces,
                     const sweep::SharedMiddles& known, const sweep::SecondOrderOptions& options,
                     const std::string& region, const RunContext& context);

} // namespace lacuna::fill
