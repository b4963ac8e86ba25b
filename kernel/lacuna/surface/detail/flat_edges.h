// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/ids.h>
#include <lacuna/core/shared/constants.h>
#include <lacuna/core/types.h>

#include <optional>
#include <vector>

/// Edges of both ends in one plane. Internal to this folder.
namespace lacuna::surface {

/// An edge mapped to the plane, with its cuts. Cut: a position at which the edge has a node.
struct FlatEdge {
    EdgeId edge;
    std::vector<Vec2> line;
    std::vector<double> at; ///< fraction of the edge's length of each point of `line`
    struct Cut {
        double at;
        std::size_t node;
    };
    std::vector<Cut> cuts; ///< in any order; the ends of the edge are included
};

/// The point of a polyline closest to a point.
struct Closest {
    double distance = kInfinity;
    double at = 0; ///< share of the edge's length
    Vec2 place = Vec2::Zero();
};
Closest closest_on(const std::vector<Vec2>& line, const std::vector<double>& at, const Vec2& p);

/// The crossing of two segments, as shares of both; empty if they are parallel or do not meet.
std::optional<Vec2> crossing(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d);

} // namespace lacuna::surface
