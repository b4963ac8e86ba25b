// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/shared/list_text.h>
#include <lacuna/topology/model.h>

#include <string>

namespace lacuna::topology {

/// "face 3 \"lid\", face 4 and 2 more": names of faces, edges or vertices for a message, six at most.
template <class Ids>
std::string names_of(const Model& model, const Ids& ids)
{
    return short_list(ids, [&](const auto id) { return name_of(model, id); });
}

} // namespace lacuna::topology
