// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/open_volume.h>

#include <vector>

namespace lacuna::topology {

/// Faces, edges or vertices for a message.
template <class Ids>
std::vector<NamedEntity> entities_of(const Model& model, const Ids& ids)
{
    std::vector<NamedEntity> entities;
    for (const auto id : ids) entities.push_back(entity_of(model, id));
    return entities;
}

} // namespace lacuna::topology
