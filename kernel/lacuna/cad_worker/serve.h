// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lacuna/cad_protocol/shared/channel.h>

#include <string>

namespace lacuna::cad_worker {

/// Answer requests until the connection is closed or broken.
/// @param missing  protection that the kernel lacks, as `confine()` returns it; sent with the greeting.
/// @pre   a `Gmsh` object exists.
void serve(cad_protocol::Channel& channel, const std::string& missing);

} // namespace lacuna::cad_worker
