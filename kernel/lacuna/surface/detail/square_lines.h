// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/surface/shared/linking_surface.h>
#include <lacuna/surface/shared/seeds.h>
#include <lacuna/topology/open_volume.h>

#include <span>

/// Positions of nodes on the sides of mapped faces. Internal to this folder.
namespace lacuna::surface {

/// Move the nodes on the sides of mapped faces along their edges, so that the lines between opposite sides
/// meet the edges at angles as close to 90° as nearly even spacing allows.
///
/// Example: if nodes are evenly spaced on both long sides of a flat half ring, the lines between opposite
/// nodes are oblique where the ring bends most. A Gauss-Newton method minimizes
///   Σ (u(k+1) − u(k) − 1)² + Σ cos²
/// where the u are node positions in units of the original sides. The first sum runs over the sides of all
/// edges. The second sum runs over the angles between line and edge at both ends of each line.
///
/// If a line is straight and both its ends lie on rims, its cosines are means over five sections of the
/// volume, because a shift on the source shears the mesh above it. To find these sections, the function
/// meshes the walls with few layers.
///
/// Where a side would become too long or too short, evenness gets a higher weight. Nodes then move back
/// towards square lines as far as the allowed lengths permit. The sides at both ends of an edge count twice,
/// because such a side is the height of a row along the adjacent edge. Lines of a grid leave a curved side in
/// the direction of the adjacent sides (Coons).
///
/// If sections differ, as in a flat tube that becomes round, a node may get one position on the source's rim
/// and another on the target's rim. Its column runs straight from one to the other, and the cosines of the
/// columns' inclination are added to the objective. Faces that share edges are solved together. The result is
/// discarded unless the worst angle improves. Given and requested nodes do not move, nor do nodes on edges at
/// which boundary layers end.
/// @post  the numbers of sides are unchanged; symmetries are preserved up to rounding.
/// @note  Deterministic. O(nodes on the sides), plus one mesh of the walls if some lines are oblique.
void square_mapped_lines(Seeds& seeds, const topology::OpenVolume& volume,
                         std::span<const LinkingSurface> links, const RunContext& context);

} // namespace lacuna::surface
