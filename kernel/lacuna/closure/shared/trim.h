// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/geometry/newell.h>
#include <lacuna/topology/model.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace lacuna::closure {

/// Faces without their parts in front of a plane.
struct Trimmed {
    topology::Model model;
    std::vector<FaceId> parent; ///< for each face of `model`, the face that it was part of
    std::vector<FaceId> cut;    ///< faces that lost a part
    std::vector<FaceId> gone;   ///< faces that lie wholly in front of the plane, or in it
    /// Number of separate voids behind the plane if a flat face closes each of its regions; 0 if no rim lies
    /// in the plane.
    std::size_t voids = 0;
};

/// Cut the parts in front of a plane off some faces, before the volume is closed. The rims that remain in the
/// plane determine a flat missing face.
/// @param faces    the faces of the volume.
/// @param crossed  those of them that are cut; the others stay whole.
/// @return  empty if the plane crosses a missing face: then only the closed volume tells where it is cut.
/// @throw InvalidInput  the errors of `topology::imprint_walks()`.
/// @note  O(facets).
std::optional<Trimmed> trim(const topology::Model& model, const std::vector<FaceId>& faces,
                            const std::vector<FaceId>& crossed, const geometry::Plane& plane,
                            const RunContext& context = {});

/// Faces that stick out of a flat rim of other faces, or lie in its plane.
struct Overhang {
    geometry::Plane plane; ///< of the rim; its normal points out of the volume
    /// All faces of each part that crosses the plane inside the rim, and of other parts those in the plane.
    std::vector<FaceId> faces;
    FaceId beside; ///< a face beside the rim
};

/// The first flat rim of a part of a volume's faces out of which other parts stick, such as a shaft that is
/// longer than its sleeve, or in whose plane they end with a face, which does not bound the volume. The part
/// with the rim lies behind the plane. Parts with given quads that cross the plane do not count.
/// The rim is no such rim in these cases:
/// - A part lies in front of the plane, or crosses it and has a rim in it: the volume continues there, and
///   faces at a step are missing.
/// - A part that crosses the plane has such a rim in front of the plane or behind it, or in front of it a
///   rim that is wider than the part in the plane: the wall between both rims is missing.
/// - A face in the plane reaches across the rim: it closes the rim.
/// - Another rim lies in the plane around it: a face between both rims is missing.
/// - The rim belongs to a closed solid of the model that fills it: faces of that solid are missing.
/// @note  O(facets) for each plane of a rim.
std::optional<Overhang> find_overhang(const topology::Model& model, const std::vector<FaceId>& faces);

} // namespace lacuna::closure
