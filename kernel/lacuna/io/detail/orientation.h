// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/detail/deck_view.h>

#include <span>

namespace lacuna::io {

/// Add the directions of cells to a view of swept meshes that store their nodes. They become
/// `MeshView::frames` and, with `fields`, the fields "column", "axis", "radial" and "tangential" with three
/// components each.
/// @param parts  in the order of the view's cells; cells after these have no directions.
void add_orientation(std::span<const BulkPart> parts, bool fields, mesh::MeshView& view);

} // namespace lacuna::io
