// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lacuna/cad_protocol/shared/messages.h>

namespace lacuna::cad_worker {

/// Fill shells of triangles with tetrahedra of about the size of the triangles. The given points are kept.
/// @throw NotSweepable  two points coincide ("cad.skin_crosses").
/// @throw BackendError  an error of Gmsh.
cad_protocol::FillSkinReply fill_skin(const cad_protocol::FillSkinRequest& skin);

} // namespace lacuna::cad_worker
