// SPDX-License-Identifier: MIT
#include <lacuna/surface/detail/graded_points.h>

#include <algorithm>
#include <utility>

namespace lacuna::surface {

GradedPoints::GradedPoints(std::vector<PointSize> points, double grading) : grading_(grading)
{
    if (!points.empty()) build(points);
}

std::size_t GradedPoints::build(std::span<PointSize> points)
{
    const std::size_t number = nodes_.size();
    Node node;
    for (const PointSize& own : points) {
        node.box.extend(own.point);
        node.least = std::min(node.least, own.size);
    }
    nodes_.push_back(node);
    if (points.size() == 1) return number;
    Eigen::Index axis = 0;
    node.box.sizes().maxCoeff(&axis);
    const std::size_t middle = points.size() / 2;
    std::ranges::nth_element(points, points.begin() + static_cast<std::ptrdiff_t>(middle), {},
                             [&](const PointSize& own) { return own.point[axis]; });
    build(points.first(middle));
    nodes_[number].right = build(points.subspan(middle));
    return number;
}

double GradedPoints::bound(const Node& node, const Vec3& place) const
{
    return node.least + grading_ * node.box.exteriorDistance(place);
}

void GradedPoints::search(std::size_t number, const Vec3& place, double& least) const
{
    const Node& node = nodes_[number];
    if (node.right == 0) {
        least = bound(node, place); // the box of a leaf is its point
        return;
    }
    std::size_t near = number + 1, far = node.right;
    double first = bound(nodes_[near], place), second = bound(nodes_[far], place);
    if (second < first) {
        std::swap(near, far);
        std::swap(first, second);
    }
    if (first < least) search(near, place, least);
    if (second < least) search(far, place, least);
}

double GradedPoints::at(const Vec3& place, double most) const
{
    double least = most;
    if (!nodes_.empty() && bound(nodes_.front(), place) < least) search(0, place, least);
    return least;
}

} // namespace lacuna::surface
