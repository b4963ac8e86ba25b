// SPDX-License-Identifier: MIT
#include <lacuna/mesh/shared/orientation.h>

#include <lacuna/core/shared/criteria.h>

#include <cmath>

#include <Eigen/Geometry>

namespace lacuna::mesh {

namespace {

/// The motion from one level of nodes to the next, if it is rigid (a translation or a screw). Otherwise the
/// class uses straight lines between the levels.
class Step {
public:
    Step(const HexMesh& mesh, std::size_t layer)
    {
        const auto row = static_cast<Eigen::Index>(mesh.nodes_per_layer);
        const Vec3* const first = mesh.nodes.data() + layer * index(mesh.nodes_per_layer);
        const Eigen::Map<const Eigen::Matrix3Xd> low(first->data(), 3, row),
            high((first + row)->data(), 3, row);
        const Eigen::Isometry3d motion(Eigen::umeyama(low, high, false));
        const double off =
            ((motion.linear() * low).colwise() + motion.translation() - high).cwiseAbs().maxCoeff();
        const double size = (low.colwise() - low.rowwise().mean().eval()).cwiseAbs().maxCoeff();
        if (!(off <= kSamePlace * size)) return;
        const Eigen::AngleAxisd turn(motion.linear());
        if (!(turn.angle() > kSamePlace)) return; // for a translation, tangents are chords
        axis_ = turn.axis();
        stretch_ = turn.angle() / 2 / std::sin(turn.angle() / 2);
        const Eigen::Matrix3d half = Eigen::AngleAxisd(turn.angle() / 2, axis_).toRotationMatrix();
        half_.linear() = half;
        half_.translation() = (Eigen::Matrix3d::Identity() + half).inverse() * motion.translation();
        turns_ = true;
    }

    /// The point half way along the motion from `low` to `high`. `direction()` returns the tangent there.
    [[nodiscard]] Vec3 middle(const Vec3& low, const Vec3& high) const
    {
        return turns_ ? Vec3(half_ * low) : Vec3((low + high) / 2);
    }
    [[nodiscard]] Vec3 direction(const Vec3& low, const Vec3& high) const
    {
        const Vec3 chord = high - low, along = axis_ * axis_.dot(chord);
        return (along + stretch_ * (chord - along)).normalized();
    }

private:
    bool turns_ = false;
    Vec3 axis_ = Vec3::Zero();
    double stretch_ = 1; ///< length of the tangent over that of the chord, both taken normal to the axis
    Eigen::Isometry3d half_ = Eigen::Isometry3d::Identity();
};

Vec3 centre(const HexMesh& mesh, std::size_t layer, const Quad& quad)
{
    const std::size_t low = layer * index(mesh.nodes_per_layer), corners = corner_count(quad);
    Vec3 sum = Vec3::Zero();
    for (std::size_t k = 0; k < corners; ++k) sum += mesh.nodes[low + index(quad[k])];
    return sum / static_cast<double>(corners);
}

/// The centroid of the quads at a level.
Vec3 centroid(const HexMesh& mesh, std::size_t level)
{
    const Vec3* const node = mesh.nodes.data() + level * index(mesh.nodes_per_layer);
    Vec3 normal = Vec3::Zero();
    const auto area = [&](const Quad& q, std::size_t k) { // area vector of triangle 0, k, k + 1
        const Vec3& from = node[q[0]];
        return Vec3((node[q[k]] - from).cross(node[q[k + 1]] - from) / 2);
    };
    for (const Quad& q : mesh.quads) normal += area(q, 1) + area(q, 2);
    normal.normalize();
    Vec3 sum = Vec3::Zero();
    double all = 0;
    const Vec3 origin = node[0]; // differences are more accurate far from the origin
    for (const Quad& q : mesh.quads)
        for (const std::size_t k : {std::size_t(1), std::size_t(2)}) {
            const double own = normal.dot(area(q, k));
            sum += own * ((node[q[0]] - origin) + (node[q[k]] - origin) + (node[q[k + 1]] - origin)) / 3;
            all += own;
        }
    return origin + sum / all;
}

/// The component of a vector normal to a direction, scaled to length 1. If the vector is parallel to the
/// direction, any normal direction is returned.
Vec3 across(const Vec3& vector, const Vec3& direction, double size)
{
    const Vec3 part = vector - direction * direction.dot(vector);
    if (part.norm() > kSamePlace * size) return part.normalized();
    return direction.unitOrthogonal();
}

} // namespace

std::array<Vec3, 3> CellFrame::material() const
{
    const Vec3 second = across(radial, column, 1);
    return {column, second, column.cross(second)};
}

std::vector<CellFrame> cell_frames(const HexMesh& mesh)
{
    std::vector<CellFrame> frames;
    frames.reserve(mesh.cell_count());
    Vec3 low = centroid(mesh, 0);
    for (std::size_t layer = 0; layer < static_cast<std::size_t>(mesh.layers); ++layer) {
        const Step step(mesh, layer);
        const Vec3 high = centroid(mesh, layer + 1);
        const Vec3 axis = step.direction(low, high), middle = step.middle(low, high);
        for (const Quad& quad : mesh.quads) {
            const Vec3 from = centre(mesh, layer, quad), to = centre(mesh, layer + 1, quad);
            CellFrame& frame = frames.emplace_back();
            frame.column = step.direction(from, to);
            frame.axis = axis;
            frame.radial = across(step.middle(from, to) - middle, axis, (high - low).norm());
            frame.tangential = axis.cross(frame.radial);
        }
        low = high;
    }
    return frames;
}

} // namespace lacuna::mesh
