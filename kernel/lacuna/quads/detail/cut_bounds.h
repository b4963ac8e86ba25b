// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/detail/partial_mesh.h>

#include <cstddef>
#include <vector>

namespace lacuna::quads::paving {

/// Places of a loop that lines may start and end at, side by side for the processor: single precision is
/// enough for bounds.
struct CutPlaces {
    std::vector<float> x, y;    ///< from the loop's first node
    std::vector<float> arc;     ///< along the loop
    std::vector<float> heading; ///< of the side that leaves [radians]
    std::vector<float> angle;   ///< inside the region [radians]
    std::vector<float> gain;    ///< what a line gains by ending there
    std::vector<float> firm;    ///< how much the angles there count

    [[nodiscard]] std::size_t size() const { return x.size(); }
    void reserve(std::size_t n)
    {
        for (std::vector<float>* list : {&x, &y, &arc, &heading, &angle, &gain, &firm}) list->reserve(n);
    }
};

/// A line between two places, and what it costs at least.
struct CutBound {
    float cost = 0;
    std::uint32_t from = 0, to = 0; ///< places, the first one the smaller
};

/// Lower bounds of what lines cost by their length and the angles at their ends, but for those that run too
/// near the outline there, or are longer than `longest` times what they cut off.
///
/// The bounds are less than a hundredth below the two terms, but where the number of quads at an end is in
/// doubt.
/// @param least  angle between a line and the outline [radians]
/// @param whole  length of the loop
std::vector<CutBound> bound_cuts(const CutPlaces& places, const CutWeights& weights, double longest,
                                 double least, double whole);

} // namespace lacuna::quads::paving
