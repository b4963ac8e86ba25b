// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/shared/steps.h>
#include <lacuna/closure/shared/void_geometry.h>
#include <lacuna/core/run_context.h>
#include <lacuna/geometry/newell.h>
#include <lacuna/topology/open_volume.h>
#include <lacuna/topology/shared/section.h>

#include <Eigen/Geometry>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace lacuna::closure {

/// A face between two pieces.
struct Partition {
    FaceId face;
    /// The edges of the face's rim, in the directions in which the skin of the piece behind the face uses
    /// them (behind a cutting plane: on the side opposite to its normal). The piece in front uses them
    /// reversed. Void edges across gaps of the skin are excluded.
    std::vector<topology::EdgeUse> behind;
};

/// A volume with split faces, and the partitions between its pieces.
struct PartedVolume {
    topology::OpenVolume volume; ///< partitions have the role of walls
    std::vector<Partition> partitions{};
    std::optional<geometry::Plane> plane{}; ///< common plane of all partitions, if there is one
    bool stacked = false; ///< whether pieces get levels: 0 if no piece is in front, otherwise one more than
                          ///< the pieces in front
};

/// Split the faces of a volume along the lines where a plane crosses them. The parts of a face keep its role.
topology::WalkImprint imprint(topology::OpenVolume& volume, const std::vector<topology::SectionWalk>& walks,
                              const geometry::Plane& plane, const RunContext& context);

/// The pieces separated by the partitions, with roles as described at `cut_by_plane()`.
/// @pre  the loops are set, as by `with_loops()`.
/// @param tool  the cutting plane or face, for messages: "the plane".
/// @throw NotSweepable "closure.cut_apart"  both sides of a partition belong to one piece.
std::vector<StepPiece> pieces_of(const PartedVolume& parted, const Subject& tool, const RunContext& context);

/// Cut every piece that a plane crosses. A piece for which `cut` throws "closure.cut_misses" stays as it is.
/// @param reach  pieces outside this box stay as they are; null: none is left out.
/// @throw  the errors of `cut`, except "closure.cut_misses".
/// @note  O(points) for each piece that the plane does not cross.
std::vector<StepPiece> cut_each(std::vector<StepPiece> pieces, const geometry::Plane& plane,
                                const std::function<std::vector<StepPiece>(const topology::OpenVolume&)>& cut,
                                const Eigen::AlignedBox3d* reach = nullptr);

/// Sort planar loops, given by their points, into regions: an outer loop first, then its holes.
std::vector<std::vector<std::size_t>> regions_of(const std::vector<std::vector<Vec2>>& loops);

/// Add a flat partition bounded by loops of edges, the outer loop first.
FaceId add_partition(topology::Model& model, const std::vector<std::vector<topology::EdgeUse>>& loops,
                     const geometry::Plane& plane, const std::string& name, const RunContext& context);
/// The next free name of a partition: `cut_1`, `cut_2` and so on.
std::string partition_name(const topology::Model& model);

} // namespace lacuna::closure
