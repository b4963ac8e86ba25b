// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <cstddef>
#include <set>
#include <span>
#include <utility>
#include <vector>

namespace lacuna::geometry {

/// Cost of a triangulation of a polygon in space, compared by the number of
/// degenerate triangles, then by the sum.
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

/// A closed polygon. It may run along bridges in both directions: points then occur twice.
struct CoverPolygon {
    std::vector<Vec3> place;                  ///< position of each corner
    std::vector<Index> point;                 ///< point number of each corner; may repeat
    std::set<std::pair<Index, Index>> barred; ///< pairs of points, smaller first, without diagonal
};

struct CoverOptions {
    double bend = 0;
    double shape = 0;
    std::size_t exact_limit = 250;
};

struct Cover {
    std::vector<Triangle> triangles; ///< corner numbers, in the direction of the polygon
    CoverCost cost;                  ///< of the parts that were solved exactly
    bool found = false;              ///< false: there is no triangulation without barred diagonals
};

/// Triangulate a polygon at the least cost; see `minimal_area()`.
Cover cover_polygon(const CoverPolygon& polygon, const CoverOptions& options);

} // namespace lacuna::geometry
