// SPDX-License-Identifier: MIT
#include "support/measure_sources.h"

#include <lacuna/mesh/quad_mesh.h>
#include <lacuna/quads/shared/measure_plane.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

namespace lacuna::test {

namespace {

/// Corners within this of half way between two numbers of quads have either [right angles].
constexpr double kEither = 0.15;

class UnionMeter {
public:
    UnionMeter(const surface::SourceMesh& mesh, double size)
        : nodes_(mesh.quads.nodes), quads_(mesh.quads.quads), face_(mesh.quads.face), size_(size)
    {
        for (std::size_t q = 0; q < quads_.size(); ++q) {
            for (std::size_t k = 0; k < 4; ++k) {
                const Quad& quad = quads_[q];
                const auto found = normal_.try_emplace({face_[q], quad[k]}, Vec3::Zero()).first;
                found->second += side(quad, k).cross(-side(quad, (k + 3) % 4));
            }
        }
        for (auto& [at, normal] : normal_) normal.stableNormalize();
        for (std::size_t q = 0; q < quads_.size(); ++q) {
            for (std::size_t k = 0; k < 4; ++k) {
                Corner& corner = corner_[{face_[q], quads_[q][k]}];
                corner.angle += angle(q, k);
                ++corner.quads;
            }
        }
        opposite_ = mesh::opposite_sides(quads_, static_cast<Index>(nodes_.size()));
    }

    UnionQuality measure()
    {
        UnionQuality result;
        std::vector<int> valence(nodes_.size(), 0);
        std::vector<double> turn(nodes_.size(), 0);
        std::vector<char> rim(nodes_.size(), 0), shared(nodes_.size(), 0);
        double sum = 0;
        for (std::size_t q = 0; q < quads_.size(); ++q) {
            const Quad& quad = quads_[q];
            if (mesh::is_triangle(quad)) {
                ++result.triangles;
                continue;
            }
            ++result.quads;
            double least = 1;
            for (std::size_t k = 0; k < 4; ++k) {
                const auto p = static_cast<std::size_t>(quad[k]);
                least = std::min(least, std::sin(angle(q, k)));
                ++valence[p];
                turn[p] += angle(q, k);
                const Index other = opposite_[4 * q + k];
                const bool on_shared = other >= 0 && face_[static_cast<std::size_t>(other) / 4] != face_[q];
                if (on_shared) {
                    shared[p] = shared[static_cast<std::size_t>(quad[(k + 1) % 4])] = 1;
                    ++result.shared_rows;
                    if (stands_well(q, k)) ++result.good_shared_rows;
                }
                if (other == mesh::kRimSide) {
                    rim[p] = 1;
                    ++result.rows;
                    if (stands_well(q, k)) ++result.good_rows;
                }
                if (other >= 0 && static_cast<std::size_t>(other) < 4 * q + k) continue;
                const double length = side(quad, k).norm();
                ++result.edges;
                if (length >= quads::kShortestOfSize * size_ && length <= quads::kLongestOfSize * size_)
                    ++result.edges_of_size;
            }
            sum += least;
            result.min_scaled_jacobian = std::min(result.min_scaled_jacobian, least);
        }
        result.bad_sides = static_cast<std::size_t>(
            std::count(opposite_.begin(), opposite_.end(), mesh::kBadSide));
        result.mean_scaled_jacobian = sum / double(std::max<std::size_t>(1, result.quads));
        std::vector<double> angles;
        for (std::size_t p = 0; p < nodes_.size(); ++p) {
            if (valence[p] == 0) continue;
            if (rim[p] != 0) {
                angles.push_back(turn[p]);
                continue;
            }
            ++result.interior;
            if (valence[p] == 4) continue;
            ++result.irregular;
            result.irregular_shared += shared[p] != 0 ? 1 : 0;
        }
        const long edges = static_cast<long>(opposite_.size() + result.rows) / 2;
        const long used = std::count_if(valence.begin(), valence.end(), [](int v) { return v > 0; });
        const long euler = used - edges + static_cast<long>(quads_.size());
        result.least_irregular = quads::least_irregular(angles, static_cast<int>(euler), kEither);
        return result;
    }

private:
    [[nodiscard]] const Vec3& at(Index p) const { return nodes_[static_cast<std::size_t>(p)]; }
    [[nodiscard]] Vec3 side(const Quad& quad, std::size_t k) const
    {
        return at(quad[(k + 1) % 4]) - at(quad[k]);
    }
    [[nodiscard]] double angle(std::size_t q, std::size_t k) const
    {
        const Quad& quad = quads_[q];
        const Vec3 a = side(quad, k), b = -side(quad, (k + 3) % 4), cross = a.cross(b);
        const double turn = std::atan2(cross.norm(), a.dot(b));
        return cross.dot(normal_.at({face_[q], quad[k]})) >= 0 ? turn : 2 * std::numbers::pi - turn;
    }
    /// By the rule of `quads::measure_plane()`, for the face that the quad is of.
    [[nodiscard]] double wanted(std::size_t q, std::size_t k) const
    {
        const Corner& corner = corner_.at({face_[q], quads_[q][k]});
        return quads::row_corner(corner.angle, corner.quads);
    }
    [[nodiscard]] bool stands_well(std::size_t q, std::size_t k) const
    {
        const Quad& quad = quads_[q];
        const double first = wanted(q, k), second = wanted(q, (k + 1) % 4), straight = std::numbers::pi;
        const std::array<double, 4> corners{first, second, straight - second, straight - first};
        for (std::size_t i = 0; i < 4; ++i) {
            if (std::abs(angle(q, (k + i) % 4) - corners[i]) > quads::kRowOffRight) return false;
        }
        const Vec3 across = (normal_.at({face_[q], quad[k]}) + normal_.at({face_[q], quad[(k + 1) % 4]}))
                                .cross(side(quad, k))
                                .normalized();
        for (const std::size_t far : {k + 2, k + 3}) {
            const double above = (at(quad[far % 4]) - at(quad[k])).dot(across);
            if (std::abs(above - size_) > quads::kRowOffHeight * size_) return false;
        }
        return true;
    }

    /// Of a face, at a node.
    struct Corner {
        double angle = 0; ///< [radian]
        Index quads = 0;
    };

    const std::vector<Vec3>& nodes_;
    const std::vector<Quad>& quads_;
    const std::vector<Index>& face_;
    double size_;
    std::map<std::pair<Index, Index>, Vec3> normal_; ///< of each face at each node
    std::map<std::pair<Index, Index>, Corner> corner_;
    std::vector<Index> opposite_;
};

} // namespace

UnionQuality measure_union(const surface::SourceMesh& mesh, double size)
{
    return UnionMeter(mesh, size).measure();
}

} // namespace lacuna::test
