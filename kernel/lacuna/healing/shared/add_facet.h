// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/healing/split_facets.h>

#include <span>

namespace lacuna::healing {

/// Add a triangle or a quad to a soup, by its corners.
void add_facet(FacetSoup& soup, std::span<const Index> corners, int label);

} // namespace lacuna::healing
