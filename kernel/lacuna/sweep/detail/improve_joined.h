// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/sweep/assembly.h>
#include <lacuna/sweep/improve.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <set>
#include <span>
#include <vector>

/// Improvement of cells across the faces between the parts of an assembly. Internal to this folder.
namespace lacuna::sweep {

/// The parts of an assembly after nodes were moved.
struct JoinedCells {
    std::vector<Swept> parts;
    Improved improved; ///< without a mesh
};

/// Places the middle nodes of the parts of order 2 whose corners have moved. @return  false: it failed
using RaiseOrder = std::function<bool(std::vector<Swept>& parts, const std::set<std::size_t>& moved)>;

/// Note volumes in pieces whose meshes together lose or gain volume, in the report and the log.
void note_lost_wholes(SweptAssembly& assembly, std::span<const AssemblyMember> members,
                      const RunContext& context);

/// Improve the poor cells of all parts together (`improve()`). A sweep cannot move the nodes between two
/// members, because the neighbour has them too, so cells where pieces of a volume meet may stay poor.
///
/// Nodes inside faces between pieces of one volume are free, because these faces are cuts. Other nodes of the
/// skin slide on their face: where a cut ends on a face of the volume, on the whole of that face. Nodes
/// between two faces slide along their common edge. Given nodes, nodes of boundary layers, nodes where more
/// than two faces meet, and nodes that the user placed on edges by `intervals` or heights stay.
/// @param raise_order  null: the parts are of order 1.
/// @return  empty if no node is moved. Also if a moved part is not valid or leaves its faces, if the least
///         scaled Jacobian of all parts would decrease, or if a whole would lose volume.
/// @pre   all nodes of the assembly are numbered.
/// @post  moved parts are proved, and their skins compared with the sealed skins.
/// @note  cost as for `improve()`, whose limits of work apply.
std::optional<JoinedCells> improve_joined(const SweptAssembly& assembly,
                                          std::span<const AssemblyMember> members,
                                          const RaiseOrder& raise_order, const RunContext& context);

} // namespace lacuna::sweep
