// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <string>
#include <vector>

namespace lacuna::test {

/// A box of 3 × 2 × 1 squares, its sides labelled 1 to 6: x, y, z at their least, then at their most.
struct FacetBox {
    std::vector<Vec3> points;
    std::vector<Quad> quads; ///< seen from outside
    std::vector<int> side;   ///< of each quad
};
FacetBox facet_box();

/// A file of the box.
struct FacetSample {
    std::string name; ///< with its ending
    std::string bytes;
    bool text = true;
    bool quads = true;      ///< false: every quad is two triangles
    int labels = 6;         ///< how many the format keeps
    std::string label_name; ///< what stands before a side's number; empty: labels have no names
};

/// The box in every format read, in every variant of it.
std::vector<FacetSample> facet_samples();

} // namespace lacuna::test
