// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/detail/region_loops.h>

namespace lacuna::quads::paving {

/// Edge lengths to aim for: what a region asks for, limited near the boundary by the lengths of its given
/// sides.
///
/// At distance d from a boundary node with sides of length l it lies between l − 0.3 d and l + 0.3 d, which
/// keeps neighbouring edges within 1.3 of each other. Where the sides have about the length asked, that
/// changes nothing and the region's own size is handed back. A region without a size has its mean boundary
/// side.
struct BoundarySizes {
    SizeField usual;
    /// The same where sides differ by a little more from what is asked. Those of a ring may be 1 / 0.6 times
    /// as long, or as short, and rows still of the size asked: what rings are laid out with and all meshes
    /// judged by.
    SizeField ring;
};
BoundarySizes sizes_with_boundary(const PlanarRegion& region);

/// About how many quads a region gets: its area over that of a square on a mean boundary side.
double quads_within(const PlanarRegion& region);

/// Whether a mesh has as many quads as asked for, a quarter more or less: what is promised.
bool has_quads_asked(const PlanarQuads& mesh, const SizeField& size);

} // namespace lacuna::quads::paving
