// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/model.h>

namespace lacuna::topology {

/// Area vector of a facet: normal to the facet. Its length is the facet's area [model length²].
inline Vec3 facet_area_vector(const Model& model, const Triangle& t)
{
    return (model.at(t[1]) - model.at(t[0])).cross(model.at(t[2]) - model.at(t[0])) / 2;
}

} // namespace lacuna::topology
