// SPDX-License-Identifier: GPL-2.0-or-later
#include "saddle_face.h"

#include <lacuna/cad_worker/session.h>
#include <lacuna/geometry/shared/facet_tree.h>
#include <lacuna/mesh/quad_mesh.h>
#include <lacuna/quads/shared/measure_plane.h>

#include <gmsh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <unordered_map>

namespace lacuna::bench {

namespace {

class Meter {
public:
    Meter(const SurfaceQuads& mesh, const topology::Model& model, FaceId face, double size)
        : points_(mesh.points), quads_(mesh.quads), asked_(size)
    {
        const std::vector<Triangle>& facets = model[face].triangles;
        const geometry::FacetTree tree(model.points, facets);
        for (const Vec3& p : points_) {
            const Triangle& t = facets[static_cast<std::size_t>(tree.closest(p).triangle)];
            normals_.push_back(
                (model.at(t[1]) - model.at(t[0])).cross(model.at(t[2]) - model.at(t[0])).normalized());
        }
        // Gmsh's quads may look the other way.
        double sum = 0;
        for (const Quad& q : quads_)
            sum += (at(q[2]) - at(q[0])).cross(at(q[3]) - at(q[1])).dot(normal(q[0]));
        if (sum < 0) {
            for (Quad& quad : quads_) std::reverse(quad.begin(), quad.end());
        }
        opposite_ = mesh::opposite_sides(quads_, static_cast<Index>(points_.size()));
    }

    quads::PlaneQuality measure()
    {
        rim_angles_.clear();
        quads::PlaneQuality result;
        result.quads = quads_.size();
        result.points = points_.size();
        std::vector<Index> valence(points_.size(), 0);
        std::vector<double> turn(points_.size(), 0);
        std::vector<char> rim(points_.size(), 0);
        double jacobians = 0, ratios = 0;
        for (const Quad& quad : quads_) {
            for (std::size_t k = 0; k < 4; ++k) {
                const auto p = static_cast<std::size_t>(quad[k]);
                ++valence[p];
                turn[p] += angle(quad, k);
            }
        }
        const auto wanted = [&](Index p) {
            return quads::row_corner(turn[static_cast<std::size_t>(p)], valence[static_cast<std::size_t>(p)]);
        };
        const auto possible = [&](Index p) { return quads::may_be_good(turn[static_cast<std::size_t>(p)]); };
        for (std::size_t q = 0; q < quads_.size(); ++q) {
            double least = 1;
            for (std::size_t k = 0; k < 4; ++k) {
                const auto p = static_cast<std::size_t>(quads_[q][k]);
                least = std::min(least, sine(quads_[q], k));
                const Index other = opposite_[4 * q + k];
                if (other >= 0 && static_cast<std::size_t>(other) < 4 * q + k) continue;
                const double length = side(quads_[q], k).norm();
                ++result.edges;
                ratios += length / asked_;
                if (length >= quads::kShortestOfSize * asked_ && length <= quads::kLongestOfSize * asked_)
                    ++result.edges_of_size;
                if (other != mesh::kRimSide) continue;
                rim[p] = 1;
                ++result.rows;
                if (possible(quads_[q][k]) && possible(quads_[q][(k + 1) % 4])) ++result.possible_rows;
                if (stands_well(quads_[q], k, wanted(quads_[q][k]), wanted(quads_[q][(k + 1) % 4])))
                    ++result.good_rows;
            }
            jacobians += least;
            result.min_scaled_jacobian = std::min(result.min_scaled_jacobian, least);
        }
        for (std::size_t p = 0; p < points_.size(); ++p) {
            if (rim[p] != 0) {
                rim_angles_.push_back(turn[p]);
                const double fitting = std::max(1.0, std::round(turn[p] / (std::numbers::pi / 2)));
                if (valence[p] != static_cast<Index>(fitting)) ++result.boundary_irregular;
                continue;
            }
            ++result.interior;
            if (valence[p] != 4) ++result.irregular;
        }
        result.mean_scaled_jacobian = jacobians / static_cast<double>(std::max<std::size_t>(1, result.quads));
        result.mean_edge_ratio = ratios / static_cast<double>(std::max<std::size_t>(1, result.edges));
        return result;
    }

    /// Nodes that are not on the rim, where the exact edges are off the surface by what the CAD system bears.
    [[nodiscard]] std::vector<Vec3> inside() const
    {
        std::vector<char> rim(points_.size(), 0);
        for (std::size_t s = 0; s < opposite_.size(); ++s) {
            if (opposite_[s] != mesh::kRimSide) continue;
            rim[static_cast<std::size_t>(quads_[s / 4][s % 4])] = 1;
        }
        std::vector<Vec3> nodes;
        for (std::size_t p = 0; p < points_.size(); ++p) {
            if (rim[p] == 0) nodes.push_back(points_[p]);
        }
        return nodes;
    }

    /// @pre  `measure()` was asked
    [[nodiscard]] int least_irregular(std::size_t loops) const
    {
        return bench::least_irregular(rim_angles_, 2 - static_cast<int>(loops));
    }
    [[nodiscard]] std::size_t rim_sides() const
    {
        return static_cast<std::size_t>(std::count(opposite_.begin(), opposite_.end(), mesh::kRimSide));
    }

    /// Closed walks along the rim.
    [[nodiscard]] std::size_t rim_loops() const
    {
        std::unordered_map<Index, Index> next;
        for (std::size_t s = 0; s < opposite_.size(); ++s) {
            if (opposite_[s] == mesh::kRimSide) next[quads_[s / 4][s % 4]] = quads_[s / 4][(s + 1) % 4];
        }
        std::size_t loops = 0;
        for (; !next.empty(); ++loops) {
            for (auto at = next.begin(); at != next.end();) {
                const Index to = at->second;
                next.erase(at);
                at = next.find(to);
            }
        }
        return loops;
    }

    std::string find_fault(std::size_t rim_sides, std::size_t loops, double least)
    {
        const auto rims = std::count(opposite_.begin(), opposite_.end(), mesh::kRimSide);
        if (std::count(opposite_.begin(), opposite_.end(), mesh::kBadSide) > 0)
            return "a side is used by more than two quads or twice in one direction";
        if (rims != static_cast<std::ptrdiff_t>(rim_sides))
            return std::to_string(rims) + " boundary sides instead of " + std::to_string(rim_sides);
        const auto edges = (static_cast<long>(opposite_.size()) + rims) / 2;
        if (static_cast<long>(points_.size() + quads_.size()) - edges != 2 - static_cast<long>(loops))
            return "the mesh comes apart or is pinched";
        if (!(least > 0)) return "a corner is not positive";
        return {};
    }

private:
    [[nodiscard]] const Vec3& at(Index p) const { return points_[static_cast<std::size_t>(p)]; }
    [[nodiscard]] const Vec3& normal(Index p) const { return normals_[static_cast<std::size_t>(p)]; }
    [[nodiscard]] Vec3 side(const Quad& quad, std::size_t k) const
    {
        return at(quad[(k + 1) % 4]) - at(quad[k]);
    }
    [[nodiscard]] double sine(const Quad& quad, std::size_t k) const
    {
        const Vec3 a = side(quad, k), b = -side(quad, (k + 3) % 4), cross = a.cross(b);
        const double both = a.norm() * b.norm();
        return both > 0 ? std::copysign(cross.norm() / both, cross.dot(normal(quad[k]))) : 0;
    }
    [[nodiscard]] double angle(const Quad& quad, std::size_t k) const
    {
        const Vec3 a = side(quad, k), b = -side(quad, (k + 3) % 4), cross = a.cross(b);
        const double turn = std::atan2(cross.norm(), a.dot(b));
        return cross.dot(normal(quad[k])) >= 0 ? turn : 2 * std::numbers::pi - turn;
    }
    [[nodiscard]] bool stands_well(const Quad& quad, std::size_t k, double first, double second) const
    {
        const std::array<double, 4> wanted{first, second, std::numbers::pi - second,
                                           std::numbers::pi - first};
        for (std::size_t i = 0; i < 4; ++i) {
            if (std::abs(angle(quad, (k + i) % 4) - wanted[i]) > quads::kRowOffRight) return false;
        }
        const Vec3 across = (normal(quad[k]) + normal(quad[(k + 1) % 4])).cross(side(quad, k)).normalized();
        for (const std::size_t far : {k + 2, k + 3}) {
            const double above = (at(quad[far % 4]) - at(quad[k])).dot(across);
            if (std::abs(above - asked_) > quads::kRowOffHeight * asked_) return false;
        }
        return true;
    }

    const std::vector<Vec3>& points_;
    std::vector<Quad> quads_;
    std::vector<Vec3> normals_;
    std::vector<Index> opposite_;
    std::vector<double> rim_angles_;
    double asked_;
};

/// The farthest from the exact surface, by Gmsh's own search, of at most so many nodes: it takes its time.
double off_surface(const std::vector<Vec3>& points, const std::string& file)
{
    constexpr std::size_t kMost = 20000;
    const cad_worker::Gmsh gmsh_of_ours;
    cad_worker::Session session(file);
    const cad_worker::GmshModel model(session);
    return session.run([&] {
        gmsh::vectorpair shapes;
        gmsh::model::occ::importShapes(file, shapes, false);
        gmsh::model::occ::synchronize();
        gmsh::model::getEntities(shapes, 2);
        std::vector<double> coordinates, closest, parameters;
        const std::size_t step = points.size() / kMost + 1;
        for (std::size_t p = 0; p < points.size(); p += step)
            coordinates.insert(coordinates.end(), {points[p].x(), points[p].y(), points[p].z()});
        gmsh::model::getClosestPoint(2, shapes.front().second, coordinates, closest, parameters);
        double most = 0;
        for (std::size_t i = 0; i + 2 < coordinates.size(); i += 3)
            most = std::max(most, Vec3(coordinates[i] - closest[i], coordinates[i + 1] - closest[i + 1],
                                       coordinates[i + 2] - closest[i + 2])
                                      .norm());
        return most;
    });
}

} // namespace

SurfaceQuality measure_surface(const SurfaceQuads& mesh, const SeededFace& seeded)
{
    Meter meter(mesh, seeded.model, seeded.face, seeded.size);
    SurfaceQuality result;
    result.quads = meter.measure();
    result.least_irregular = meter.least_irregular(seeded.loops.size());
    result.off_surface = off_surface(meter.inside(), seeded.file);
    result.fault = meter.find_fault(seeded.rim.size(), seeded.loops.size(), result.quads.min_scaled_jacobian);
    return result;
}

SurfaceQuality measure_face(const SurfaceQuads& mesh, const topology::Model& model, FaceId face, double size)
{
    Meter meter(mesh, model, face, size);
    SurfaceQuality result;
    result.quads = meter.measure();
    // A seam makes one loop of two, so the loops are those of the quads.
    const std::size_t loops = meter.rim_loops();
    result.least_irregular = meter.least_irregular(loops);
    result.fault = meter.find_fault(meter.rim_sides(), loops, result.quads.min_scaled_jacobian);
    return result;
}

} // namespace lacuna::bench
