// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lacuna/cad_worker/solid_builder.h>

namespace lacuna::cad_worker {

/// Set Gmsh's options to import shapes unchanged except for the factor `scale`.
void set_plain_import(Session& session, double scale);

/// Sew faces of the current model into one solid, write it, and read it back.
/// @throw BackendError  the faces do not form a solid, or the file reads back as a different one.
cad_protocol::MakeSolidReply write_solid(Session& session, const std::vector<int>& faces,
                                         const cad_protocol::MakeSolidRequest& request,
                                         const SolidFiles& files);

} // namespace lacuna::cad_worker
