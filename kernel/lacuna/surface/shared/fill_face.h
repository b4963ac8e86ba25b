// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/quads/shared/boundary_rows.h>
#include <lacuna/surface/size_field.h>
#include <lacuna/topology/model.h>

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace lacuna::surface {

/// A node on the boundary of a face.
struct RimNode {
    Vec3 point;          ///< position on the exact edge
    EdgeId edge;         ///< edge of the face
    double fraction = 0; ///< fraction of the edge's length, in the direction of the edge
};

/// Quads over a face.
struct FaceQuads {
    std::vector<Vec3> points; ///< nodes of the rim first, then inner nodes, which lie on the exact surface
    std::vector<Quad> quads;  ///< counter-clockwise if seen from outside
    std::string how{};        ///< method, as reported by the planar mesher
    /// Reason why requested rows do not fit; there are then no quads.
    std::optional<quads::RowsFinding> finding{};
};

/// Fill a face with quads inside given boundary nodes.
///
/// A planar face is filled in its plane. For any other face:
/// 1. Its facets are refined for the size (`fine_facets()`) and flattened, together with the rim nodes.
/// 2. The flat image is filled; the size is corrected for the distortion by the flattening.
/// 3. New nodes are mapped back to their facets, and from these to the exact surface.
/// @param rim    nodes of the boundary, kept in this order.
/// @param loops  cycles of indices in `rim`, with the face on the left.
/// @param rows   rows along sides of the rim, with heights on the face; null: none.
/// @throw NotSweepable "surface.not_flat"  the face or its rim folds when flattened; or an error of `mesher`.
/// @throw InvalidInput "surface.not_flat"  a curved face consists of several parts, is closed or has a
///         handle.
FaceQuads fill_face(const topology::Model& model, FaceId face, std::span<const RimNode> rim,
                    const std::vector<std::vector<Index>>& loops, const SizeFields& sizes,
                    const quads::PlanarQuadMesher& mesher, const quads::BoundaryRows* rows = nullptr,
                    const RunContext& context = {});

} // namespace lacuna::surface
