// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/surface/linking_surface.h>
#include <lacuna/surface/seeds.h>
#include <lacuna/topology/open_volume.h>

#include <span>

/// Where nodes stand on the sides of mapped faces. Internal to this folder.
namespace lacuna::surface {

/// Move the nodes on the sides of mapped faces along their edges, so that the lines between opposite sides
/// meet them at right angles as far as even spacing allows.
///
/// Evenly spread over both sides of a flat half ring, nodes face each other obliquely where it bends most.
/// A Gauss-Newton method finds the places u, counted in sides as the edge has them now, of least
///   Σ (u(k+1) − u(k) − 1)² + Σ cos²
/// over the sides of all edges and, at both ends of each line, over the angles between line and edge. Where
/// both ends of a line lie on rims and lines are straight, the second sum is the mean over five sections of
/// the volume, since what is shifted below is sheared above: the walls are meshed with few layers to know
/// them. Where a side would become too long or too short, evenness counts for more, and nodes then go as far
/// back towards square lines as they may. At the ends of an edge, where a side is as high as a row along what
/// meets it there, evenness counts twice. Lines of a grid leave a curved side as the neighbouring sides do
/// (Coons).
/// Where sections are unlike, as in a flat tube that becomes round, nodes then get places of their own on the
/// target's rim: columns run straight from one place to the other, and the cosines of their lean count too.
/// Faces that share edges are solved together. They keep what they have unless the worst angle gets better.
/// Given and asked nodes stay, and so do those of edges on which boundary layers end.
/// @post  counts are unchanged; what is symmetric stays so, to rounding.
/// @note  Deterministic. O(nodes on the sides), and one mesh of the walls where some lines are oblique.
void square_mapped_lines(Seeds& seeds, const topology::OpenVolume& volume,
                         std::span<const LinkingSurface> links, const RunContext& context);

} // namespace lacuna::surface
