// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lacuna/cad_protocol/messages.h>

namespace lacuna::cad_worker {

/// Gmsh's recombination of a planar region into quads, boundary nodes kept.
/// @throw NotSweepable  triangles are left ("cad.recombine").
cad_protocol::RecombineReply recombine(const cad_protocol::RecombineRequest& region);

} // namespace lacuna::cad_worker
