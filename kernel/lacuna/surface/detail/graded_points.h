// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/shared/constants.h>
#include <lacuna/core/types.h>

#include <cstddef>
#include <span>
#include <vector>

namespace lacuna::surface {

/// A size at a point.
struct PointSize {
    Vec3 point;
    double size; ///< [model length]
};

/// A size field that grows with the distance from given points: the minimum of (size at the point) + grading
/// · distance over all points. The points are in a tree of boxes; a query is O(log points) if they are not
/// all close to each other.
class GradedPoints {
public:
    GradedPoints(std::vector<PointSize> points, double grading);

    /// The minimum at a position, at most `most`.
    [[nodiscard]] double at(const Vec3& place, double most) const;

private:
    struct Node {
        Eigen::AlignedBox3d box;
        double least = kInfinity; ///< minimum size of its points
        std::size_t right = 0;    ///< index of the second child (the first one follows its parent); 0: a leaf
    };
    std::size_t build(std::span<PointSize> points);
    void search(std::size_t node, const Vec3& place, double& least) const;
    [[nodiscard]] double bound(const Node& node, const Vec3& place) const;

    std::vector<Node> nodes_;
    double grading_;
};

} // namespace lacuna::surface
