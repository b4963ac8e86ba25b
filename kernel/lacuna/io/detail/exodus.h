// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/deck.h>

/// Elements of Exodus and their sides. Internal to this folder.
///
/// Exodus II: dimensions and arrays with agreed names in a netCDF file of the classic format
/// (https://docs.unidata.ucar.edu/nug/current/file_format_specifications.html). Reader and writer are our
/// own: the library of Debian 12 (exodusii 6.02) depends on fifty others, including HDF5 and curl, and
/// accepts only paths.
namespace lacuna::io {

/// The property of blocks that holds the id of the first block of their region: a block has one shape, a
/// region may have several. It is written if one has.
inline constexpr const char* kRegionProperty = "REGION";

/// Number of a side in Exodus, from that in Abaqus, which has the bottom and top faces first; Exodus has them
/// last. Tetrahedra and pyramids have only a bottom face.
int exodus_side(DeckShape shape, int side);
/// The inverse. @return  false: there is no such side
bool abaqus_side(DeckShape shape, int exodus, int& side);

} // namespace lacuna::io
