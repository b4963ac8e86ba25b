// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/healing/split_facets.h>
#include <lacuna/topology/model.h>

#include <array>
#include <cstddef>
#include <vector>

namespace lacuna::healing {

/// The facets of a soup after welding and cutting. Each quad is stored as two facets.
struct Facets {
    std::vector<Vec3> points;
    std::vector<Triangle> corner;
    std::vector<int> label;
    std::vector<Index> quad; ///< by facet: index in `quads` of the quad that contains the facet; -1: none
    std::vector<Quad> quads;
    double tolerance = 0, diagonal = 0;
    double joined = 0; ///< largest distance of points that became one by the default tolerance [model length]
    std::size_t repeated = 0; ///< number of facets dropped because they repeat an earlier one
    std::size_t shrunk = 0;   ///< number of triangles and quads dropped because welding merged their corners

    [[nodiscard]] std::size_t count() const { return corner.size(); }
};

/// Area times unit normal of a facet.
Vec3 area_vector(const std::vector<Vec3>& points, const Triangle& facet);

/// Split a quad along the diagonal for which the worse of the two halves is better shaped.
std::array<Triangle, 2> halves_of(const std::vector<Vec3>& points, const Quad& q);

/// Weld the points of a soup, drop collapsed facets and duplicates within a label, and cut facets at
/// T-junctions, where a point of a free side lies on another free side. Halves of quads are not cut.
/// @param tolerance  points closer than this are merged [model length]; 0: 1e-6 × the diagonal.
/// @throw InvalidInput  there are no facets; a facet uses a point that is missing or not finite; with a
///         tolerance of 0, more facets collapse than remain.
/// @throw Cancelled
Facets facets_of(const FacetSoup& soup, double tolerance, const RunContext& context);

} // namespace lacuna::healing
