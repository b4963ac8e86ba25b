// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/shared/incidence.h>

namespace lacuna::mesh {

using lacuna::incidence;
using lacuna::Incidence;

/// The quads around each node, ascending. @pre every corner lies in [0, node_count)
Incidence quads_at_nodes(std::span<const Quad> quads, std::size_t node_count);

} // namespace lacuna::mesh
