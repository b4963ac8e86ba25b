// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/open_volume.h>

namespace lacuna::sweep {

/// The sealed volume with source and target exchanged; groups keep the original names.
topology::OpenVolume turned_round(topology::OpenVolume volume);

} // namespace lacuna::sweep
