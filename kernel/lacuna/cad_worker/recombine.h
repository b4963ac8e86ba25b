// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lacuna/cad_protocol/shared/messages.h>

namespace lacuna::cad_worker {

/// Fill a planar region with quads by Gmsh's recombination; boundary nodes are kept.
/// @throw NotSweepable  triangles remain ("cad.recombine").
cad_protocol::RecombineReply recombine(const cad_protocol::RecombineRequest& region);

} // namespace lacuna::cad_worker
