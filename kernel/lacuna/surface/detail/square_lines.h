// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/surface/shared/linking_surface.h>
#include <lacuna/surface/shared/seeds.h>
#include <lacuna/topology/open_volume.h>

#include <span>

/// Positions of nodes on the sides of mapped faces. Internal to this folder.
namespace lacuna::surface {

/// Move the nodes on the sides of mapped faces along their edges, so that the grid lines between opposite
/// sides meet the edges at angles close to 90°. The spacing of the nodes stays nearly even.
///
/// Example: if nodes are evenly spaced on both long sides of a flat half ring, the lines between opposite
/// nodes are oblique where the ring bends most.
///
/// A Gauss-Newton method minimizes
///   Σ (u(k+1) − u(k) − 1)² + Σ cos²
/// where u(k) is the position of node k in units of the original sides. The first sum (evenness) runs over
/// the sides of all edges. The second sum runs over the angles between line and edge at both ends of each
/// line.
/// - The sides at both ends of an edge count twice in the first sum, because such a side is the height of a
///   row along the adjacent edge.
/// - At a curved side, the direction of a line is that of a Coons patch: it follows the adjacent sides.
/// - If a side becomes too long or too short, the first sum gets a higher weight.
/// - Lines that are straight and have both ends on rims: their cosines are means over five sections of the
///   volume, because moving the nodes on the source shears the mesh above. To find these sections, the
///   function meshes the walls with few layers.
/// - If sections differ, as in a flat tube that becomes round, a node may get one position on the source's
///   rim and another on the target's rim. Its column then runs straight from one to the other, and the
///   objective also contains the slopes of the columns along the edges.
///
/// Faces that share edges are solved together. The result is discarded unless the worst angle improves. Given
/// and requested nodes do not move, nor do nodes on edges on which boundary layers end.
/// @post  the numbers of sides are unchanged; symmetries are preserved up to rounding.
/// @note  Deterministic. O(nodes on the sides), plus one mesh of the walls if some lines are oblique.
void square_mapped_lines(Seeds& seeds, const topology::OpenVolume& volume,
                         std::span<const LinkingSurface> links, const RunContext& context);

} // namespace lacuna::surface
