// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <vector>

namespace lacuna::surface {

/// Faces as a person names them. All of them count, each by any of the three.
struct FaceNames {
    std::vector<int> tags;          ///< of given faces
    std::vector<std::string> names; ///< of given faces; "void:<n>": the void face n; "walls": all walls
};

/// Rows of cells along chosen faces, thin at the face.
struct BoundaryLayer {
    FaceNames walls;   ///< walls, and ends too
    double first = 0;  ///< thickness of the cells at the face, square to it, > 0 [model length]
    double growth = 1; ///< of each row over the one before, > 0 [-]
    int count = 1;     ///< rows, >= 1
};

/// A number of sides of quads that a person asks for.
struct Interval {
    /// On what: an edge by its tag, the edge between two vertices by theirs, the rim of walls, the sweep.
    enum class Of { edge, vertices, wall, sweep };
    Of of = Of::sweep;
    int edge = 0;
    std::array<int, 2> vertices{};
    FaceNames walls; ///< the sides over all of them: as many columns of quads
    int count = 1;   ///< >= 1
    /// Last over first length, > 0 [-]: as the edge runs, from the first vertex to the second, from source to
    /// target; of walls 1.
    double bias = 1;
};

} // namespace lacuna::surface
