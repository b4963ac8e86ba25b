// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/deck.h>
#include <lacuna/topology/model.h>

#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace lacuna::fill {

/// The sets of decks that hold all sides of an edge on the rim of a source: sets and regions of line
/// elements, and surfaces of the edges of shells. Edges are split where a set begins or ends.
/// @param scale  model coordinates / coordinates of the decks.
std::map<EdgeId, std::vector<std::string>> edge_sets(topology::Model& model,
                                                     std::span<const std::shared_ptr<const io::Deck>> decks,
                                                     double scale);

} // namespace lacuna::fill
