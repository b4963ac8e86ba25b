// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/healing/split_facets.h>
#include <lacuna/topology/model.h>

#include <cstddef>
#include <vector>

namespace lacuna::healing {

/// What is left of a soup once it is welded and cut: quads as two facets each.
struct Facets {
    std::vector<Vec3> points;
    std::vector<Triangle> corner;
    std::vector<int> label;
    std::vector<Index> quad; ///< the quad each is half of, in `quads`; -1
    std::vector<Quad> quads;
    double tolerance = 0, diagonal = 0;
    std::size_t repeated = 0; ///< facets left out, since an earlier one is the same
    std::size_t shrunk = 0;   ///< given cells left out, since their corners were not the same and are now

    [[nodiscard]] std::size_t count() const { return corner.size(); }
};

/// Area times unit normal of a facet.
Vec3 area_vector(const std::vector<Vec3>& points, const Triangle& facet);

/// Weld the points of a soup, leave out what shrank and what a label lists twice, and cut facets where
/// points lie on their free sides. Halves of quads are not cut.
/// @param tolerance  points closer than this are one [model length]; 0: 1e-6 × the diagonal.
/// @throw InvalidInput  no facets, or ones that use points that are not there or not finite; with a tolerance
/// of 0, more of them shrunk than are left. Cancelled.
Facets facets_of(const FacetSoup& soup, double tolerance, const RunContext& context);

} // namespace lacuna::healing
