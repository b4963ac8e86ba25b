// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/steps.h>
#include <lacuna/core/run_context.h>
#include <lacuna/geometry/newell.h>
#include <lacuna/topology/open_volume.h>

#include <optional>
#include <string>
#include <vector>

namespace lacuna::closure {

/// A face between two pieces.
struct Partition {
    FaceId face;
    /// Its rim as the skin of the piece behind it uses the edges; the skin of the other uses them the other
    /// way. Void edges across gaps of the skin are left out.
    std::vector<topology::EdgeUse> behind;
};

/// A volume's faces, split, and the faces that part it.
struct PartedModel {
    topology::Model model;
    std::vector<topology::Role> role; ///< of each face; partitions: wall
    std::vector<Partition> partitions;
    bool turned_round = false;              ///< as the volume's
    std::optional<geometry::Plane> plane{}; ///< of all partitions, where it is one
};

/// The pieces a model falls into along its partitions, with roles as `cut_by_plane()` says. Loops are those
/// of `build_loops()`.
/// @param what  cut, for messages: "the plane".
/// @throw NotSweepable "closure.cut_apart"  both sides of a partition are of one piece.
std::vector<StepPiece> pieces_of(const PartedModel& parted, const std::string& what,
                                 const RunContext& context);

/// Loops that lie in a plane, each by its points, as regions: an outer loop first, then its holes.
std::vector<std::vector<std::size_t>> regions_of(const std::vector<std::vector<Vec2>>& loops);

/// Add a flat partition within loops of edges (the outer first), named `cut_1` or by the next number.
FaceId add_partition(topology::Model& model, const std::vector<std::vector<topology::EdgeUse>>& loops,
                     const geometry::Plane& plane, const RunContext& context);
/// The next free name of a partition.
std::string partition_name(const topology::Model& model);

} // namespace lacuna::closure
