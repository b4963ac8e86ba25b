// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

// In: requests from a socket, with descriptors of files; out: replies on the socket, and solids in these
// files.
//
// Where to change things:
//   start and end of the program        main.cpp
//   a request and its reply             serve.cpp
//   what the process may do             confine.cpp
//   Gmsh's options and errors           session.cpp
//   steps of reading a file             import_cad.cpp
//   edges and their points              cad_curves.cpp; narrow faces: narrow_sides.cpp
//   facets of a face                    cad_facets.cpp, face_grid.cpp
//   kinds of surfaces                   surface_kind.cpp
//   projection, points of curves        exact_geometry.cpp
//   a solid: faces; sewing and writing  solid_builder.cpp, write_solid.cpp
//   tetrahedra; quads by Gmsh           fill_skin.cpp, recombine.cpp

#include <lacuna/cad_protocol/shared/channel.h>

#include <string>

namespace lacuna::cad_worker {

/// Answer requests until the connection is closed or broken.
/// @param missing  protection that the kernel lacks, as `confine()` returns it; sent with the greeting.
/// @pre   a `Gmsh` object exists.
void serve(cad_protocol::Channel& channel, const std::string& missing);

} // namespace lacuna::cad_worker
