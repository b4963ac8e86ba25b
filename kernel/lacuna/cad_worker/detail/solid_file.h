// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lacuna/cad_worker/solid_builder.h>

namespace lacuna::cad_worker {

/// Gmsh's options for bringing in shapes as they are, `scale` times as large.
void set_plain_import(Session& session, double scale);

/// Sew faces of the current model to one solid, write it, and read it back.
/// @throw BackendError  the faces make no solid, or the file does not read back as the same one.
cad_protocol::MakeSolidReply write_solid(Session& session, const std::vector<int>& faces,
                                         const cad_protocol::MakeSolidRequest& request,
                                         const SolidFiles& files);

} // namespace lacuna::cad_worker
