// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/deck.h>

#include <span>

/// Exodus's elements and their sides. Internal to this folder.
///
/// Exodus II: dimensions and arrays by agreed names in a netCDF file of the classic format
/// (https://docs.unidata.ucar.edu/nug/current/file_format_specifications.html). Read and written here: the
/// library of Debian 12 (exodusii 6.02) needs fifty others, HDF5 and curl among them, and takes paths alone.
namespace lacuna::io {

/// Where Exodus has the nodes of a shape, in the order of DeckShape; empty: in the same places. Middles of
/// upright sides come before those above, the middle of a hexahedron before those of its faces. Nastran has
/// its shapes alike.
std::span<const std::uint8_t> exodus_places(DeckShape shape);

/// Exodus's number of a side, from Abaqus's: that has the faces below and above first, Exodus has them last;
/// tetrahedra and pyramids have one below.
int exodus_side(DeckShape shape, int side);
/// And back. @return false  there is no such side
bool abaqus_side(DeckShape shape, int exodus, int& side);

} // namespace lacuna::io
