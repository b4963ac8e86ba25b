// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/deck.h>

/// Elements of Exodus and their sides. Internal to this folder.
///
/// Exodus II is a netCDF file of the classic format in which dimensions and arrays have agreed names
/// (https://docs.unidata.ucar.edu/nug/current/file_format_specifications.html). Reader and writer are our
/// own: the library of Debian 12 (exodusii 6.02) accepts only paths, and depends on fifty others, including
/// HDF5 and curl.
namespace lacuna::io {

/// Exodus property that gives, for each block, the id of the first block of its region. The property is
/// written if some region has several blocks, one for each shape of its cells.
inline constexpr const char* kRegionProperty = "REGION";

/// Convert the number of a side from Abaqus to Exodus. Abaqus numbers the bottom and top faces first, Exodus
/// last. Tetrahedra and pyramids have only a bottom face.
int exodus_side(DeckShape shape, int side);
/// Convert the number of a side from Exodus to Abaqus. @return  false if the element has no such side
bool abaqus_side(DeckShape shape, int exodus, int& side);

} // namespace lacuna::io
