// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/detail/partial_mesh.h>

#include <cstddef>
#include <vector>

namespace lacuna::quads::paving {

/// Places of a loop at which lines may start and end, stored in columns for vector code. Single precision is
/// enough for bounds.
struct CutPlaces {
    std::vector<float> x, y;    ///< from the loop's first node
    std::vector<float> arc;     ///< along the loop
    std::vector<float> heading; ///< direction of the side that leaves the place [radians]
    std::vector<float> angle;   ///< inside the region [radians]
    std::vector<float> gain;    ///< reduction of a line's cost if it ends there
    std::vector<float> firm;    ///< weight of the angles there: lower for inner nodes, which still move

    [[nodiscard]] std::size_t size() const { return x.size(); }
    void reserve(std::size_t n)
    {
        for (std::vector<float>* list : {&x, &y, &arc, &heading, &angle, &gain, &firm}) list->reserve(n);
    }
};

/// A line between two places and a lower bound on its cost.
struct CutBound {
    float cost = 0;
    std::uint32_t from = 0, to = 0; ///< places, the smaller first
};

/// Lower bounds on the costs of lines due to their length and the angles at their ends. Lines that run too
/// close to the outline at an end, or are longer than `longest` times the outline they cut off, are left out.
///
/// The bounds are less than a hundredth below these two terms, unless the number of quads at an end is in
/// doubt.
/// @param least  smallest angle between a line and the outline [radian]
/// @param whole  length of the loop
std::vector<CutBound> bound_cuts(const CutPlaces& places, const CutWeights& weights, double longest,
                                 double least, double whole);

} // namespace lacuna::quads::paving
