// SPDX-License-Identifier: MIT
#include <lacuna/surface/detail/graded_points.h>

#include <algorithm>
#include <utility>

namespace lacuna::surface {

GradedPoints::GradedPoints(std::vector<PointSize> points, double grading)
    : points_(std::move(points)), grading_(grading)
{
    if (!points_.empty()) build(0, points_.size());
}

std::size_t GradedPoints::build(std::size_t begin, std::size_t end)
{
    constexpr std::size_t kLeaf = 8; // points per leaf; heuristic
    const std::size_t number = nodes_.size();
    Node node;
    node.begin = begin;
    node.end = end;
    node.least = points_[begin].size;
    for (std::size_t i = begin; i < end; ++i) {
        node.box.extend(points_[i].point);
        node.least = std::min(node.least, points_[i].size);
    }
    nodes_.push_back(node);
    if (end - begin <= kLeaf) return number;
    Eigen::Index axis = 0;
    node.box.sizes().maxCoeff(&axis);
    const std::size_t middle = begin + (end - begin) / 2;
    const auto at = [&](std::size_t i) { return points_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(begin), at(middle), at(end),
                     [&](const PointSize& a, const PointSize& b) { return a.point[axis] < b.point[axis]; });
    build(begin, middle);
    nodes_[number].right = build(middle, end);
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
        for (std::size_t i = node.begin; i < node.end; ++i)
            least = std::min(least, points_[i].size + grading_ * (points_[i].point - place).norm());
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
