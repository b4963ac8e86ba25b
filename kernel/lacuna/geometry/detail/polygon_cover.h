// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <cstddef>
#include <set>
#include <span>
#include <utility>
#include <vector>

namespace lacuna::geometry {

/// What a triangulation of a polygon in space costs: triangles that are none first, then the sum.
struct CoverCost {
    int degenerate = 0;
    double sum = 0;

    friend bool operator<(const CoverCost& a, const CoverCost& b)
    {
        return a.degenerate != b.degenerate ? a.degenerate < b.degenerate : a.sum < b.sum;
    }
    friend CoverCost operator+(const CoverCost& a, const CoverCost& b)
    {
        return {a.degenerate + b.degenerate, a.sum + b.sum};
    }
};

/// A closed polygon, perhaps one that runs along bridges both ways: then points come twice.
struct CoverPolygon {
    std::vector<Vec3> place;                  ///< of each corner
    std::vector<Index> point;                 ///< number of each corner's point; equal where it comes twice
    std::set<std::pair<Index, Index>> barred; ///< pairs of points (lesser first) no diagonal may join
};

struct CoverOptions {
    double bend = 0;
    double shape = 0;
    std::size_t exact_limit = 250;
};

struct Cover {
    std::vector<Triangle> triangles; ///< corners of the polygon, running as it does
    CoverCost cost;                  ///< within the parts that were solved exactly
    bool found = false;              ///< false: what is barred leaves no way
};

/// Triangulate a polygon at the least cost; see `minimal_area()`.
Cover cover_polygon(const CoverPolygon& polygon, const CoverOptions& options);

} // namespace lacuna::geometry
