// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/fill/filled.h>
#include <lacuna/fill/volume.h>
#include <lacuna/io/deck.h>
#include <lacuna/topology/model.h>

#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace lacuna::fill {

/// For each edge on the rim of a source: the names of the deck sets that contain all sides of the edge.
/// Considered are sets and regions of line elements, and surfaces made of shell edges. Edges are split where
/// a set begins or ends.
/// @param scale  model coordinates / coordinates of the decks.
std::map<EdgeId, std::vector<std::string>> edge_sets(topology::Model& model,
                                                     std::span<const std::shared_ptr<const io::Deck>> decks,
                                                     double scale);

/// If a volume is swept from a source alone: the node sets of its decks that contain nodes of the source.
/// Each set becomes the set of all mesh nodes in the columns over these nodes. Empty for any other volume.
std::vector<io::ColumnSet> column_sets(const Volume& volume, const sweep::Swept& swept);

} // namespace lacuna::fill
