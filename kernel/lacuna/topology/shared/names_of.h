// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/shared/list_text.h>
#include <lacuna/topology/model.h>

#include <string>
#include <vector>

namespace lacuna::topology {

/// "face 3 \"lid\", face 4 and 2 more": names of faces, edges or vertices for a message, six at most.
template <class Ids>
std::string names_of(const Model& model, const Ids& ids)
{
    return short_list(ids, [&](const auto id) { return name_of(model, id); });
}

/// Faces, edges or vertices for a message.
template <class Ids>
std::vector<NamedEntity> entities_of(const Model& model, const Ids& ids)
{
    std::vector<NamedEntity> entities;
    for (const auto id : ids) entities.push_back(entity_of(model, id));
    return entities;
}

} // namespace lacuna::topology
