// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/ids.h>

#include <array>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <Eigen/Geometry>

namespace lacuna::surface {

/// Faces as named by the user: the union of both lists.
struct FaceNames {
    std::vector<int> tags; ///< tags of given faces
    /// Names of given faces; "void:<n>": void face n; "source", "target": the faces of an end; "walls": all
    /// walls.
    std::vector<std::string> names;
    std::set<FaceId> inner{}; ///< faces between pieces of one volume, which "walls" leaves out
};

/// Rows of thin cells along selected faces.
struct BoundaryLayer {
    FaceNames walls;   ///< the faces with these rows: walls or ends
    double first = 0;  ///< thickness of the cells at the face, normal to the face, > 0 [model length]
    double growth = 1; ///< height ratio of consecutive rows, > 0 [-]
    int count = 1;     ///< rows, >= 1
};

/// A number of sides requested by the user.
struct Interval {
    /// Where the sides are:
    /// - `edge`: on the edge with the tag `edge`;
    /// - `vertices`: on the edge between the vertices with the tags `vertices`;
    /// - `wall`: around the rim of the walls `walls`;
    /// - `sweep`: along the sweep, one side per layer.
    enum class Of { edge, vertices, wall, sweep };
    Of of = Of::sweep;
    int edge = 0;
    std::array<int, 2> vertices{};
    FaceNames walls; ///< walls that together have `count` sides, that is, `count` columns of quads
    int count = 1;   ///< number of sides, >= 1
    /// Ratio of the last to the first length, > 0 [-]. The order is the direction of the edge, from the first
    /// vertex to the second, or from source to target. For walls the ratio must be 1.
    double bias = 1;
};

/// Two groups of faces that get the same mesh, up to a motion.
struct PeriodicPair {
    FaceNames a, b;
    /// Motion that moves the faces `a` onto `b`; empty: the program determines it from the faces.
    std::optional<Eigen::Isometry3d> onto;
};

} // namespace lacuna::surface
