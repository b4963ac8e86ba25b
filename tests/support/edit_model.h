// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/model.h>

#include <utility>

namespace lacuna::test {

/// Replace a model by a changed one: `change` is called with the builder.
template <class Change>
void edit(topology::Model& model, const Change& change)
{
    topology::ModelBuilder builder(std::move(model));
    change(builder);
    model = std::move(builder).finish();
}

} // namespace lacuna::test
