// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/detail/region_loops.h>

namespace lacuna::quads::paving {

/// Target edge lengths: the size of the region, limited near the boundary by the lengths of its given sides.
///
/// At a distance d from a boundary node with sides of length l, the size is limited to the range from
/// l − 0.3 d to l + 0.3 d. The lengths of neighbouring edges then differ by at most a factor of 1.3. If the
/// boundary sides have about the requested length, the limits have no effect and the region's own size is
/// returned. A region without a size gets the mean length of its boundary sides.
struct BoundarySizes {
    SizeField usual;
    /// As `usual`, but sides may deviate slightly more from the requested size before they limit the size.
    /// The sides of a ring may be 0.6 to 1 / 0.6 times as long as requested, while its rows keep the
    /// requested size. Rings are laid out with this size, and all meshes are judged by it.
    SizeField ring;
};
BoundarySizes sizes_with_boundary(const PlanarRegion& region);

/// Estimated number of quads of a region: its area divided by that of a square on a mean boundary side.
double quads_within(const PlanarRegion& region);

/// Whether the number of quads of a mesh differs by at most a quarter from the number that the size requires.
bool has_quads_asked(const PlanarQuads& mesh, const SizeField& size);

} // namespace lacuna::quads::paving
