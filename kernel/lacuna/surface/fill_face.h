// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/quads/boundary_rows.h>
#include <lacuna/surface/size_field.h>
#include <lacuna/topology/model.h>

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace lacuna::surface {

/// A node on the boundary of a face.
struct RimNode {
    Vec3 point;          ///< on the exact edge
    EdgeId edge;         ///< of the face
    double fraction = 0; ///< of the edge's length, as the edge runs
};

/// Quads over a face.
struct FaceQuads {
    std::vector<Vec3> points; ///< the rim's nodes first, then those inside, on the exact surface
    std::vector<Quad> quads;  ///< counter-clockwise as the face is seen
    std::string how{};        ///< by what they were made, as the planar mesher says
    std::optional<quads::RowsFinding>
        finding{}; ///< why rows asked for cannot be laid; then there are no quads
};

/// Fill a face with quads inside given boundary nodes.
///
/// A face in a plane is filled in that plane. Another is laid flat by facets that are fine enough for the
/// size (`fine_facets()`), the nodes of its rim with its edges; the size is corrected for the stretch at each
/// place, the plane is filled, and the new nodes go back by the facets they lie on to the exact surface.
/// @param rim    nodes of the boundary; they stay, in this order.
/// @param loops  cycles of places in `rim`, the face on the left.
/// @param rows   along sides of the rim, at heights on the face; null: none.
/// @throw NotSweepable "surface.not_flat"  a face that folds in the plane; what the mesher throws.
/// @throw InvalidInput "surface.not_flat"  a curved face in several parts, closed or with a handle.
FaceQuads fill_face(const topology::Model& model, FaceId face, std::span<const RimNode> rim,
                    const std::vector<std::vector<Index>>& loops, const SizeFields& sizes,
                    const quads::PlanarQuadMesher& mesher, const quads::BoundaryRows* rows = nullptr,
                    const RunContext& context = {});

} // namespace lacuna::surface
