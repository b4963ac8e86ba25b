// SPDX-License-Identifier: MIT
#include <lacuna/surface/detail/mapped_face.h>

#include <lacuna/core/shared/limits.h>
#include <lacuna/geometry/shared/facet_tree.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/geometry/shared/transfinite.h>
#include <lacuna/quads/shared/measure_plane.h>
#include <lacuna/surface/shared/edge_nodes.h>
#include <lacuna/topology/open_volume.h>
#include <lacuna/topology/shared/face_plane.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <cmath>

namespace lacuna::surface {

using namespace topology;

namespace {

/// Points at even steps of running length on a side of the face.
std::vector<Vec3> side_points(const Model& model, const Loop& loop, std::size_t from, std::size_t to)
{
    std::vector<EdgeUse> side;
    for (std::size_t i = from; i != to; i = (i + 1) % loop.uses.size()) side.push_back(loop.uses[i]);
    return geometry::even_places(use_places(model, side), kChords);
}

} // namespace

MappedFace::MappedFace(const Model& model, FaceId face, const std::vector<std::size_t>& corners)
{
    const Loop& loop = model[face].loops[0];
    std::array<std::vector<Vec3>, 4> side;
    for (std::size_t s = 0; s < 4; ++s) side[s] = side_points(model, loop, corners[s], corners[(s + 1) % 4]);
    std::ranges::reverse(side[2]);
    std::ranges::reverse(side[3]);
    points_ = geometry::transfinite(side[0], side[1], side[2], side[3]);
    if (model[face].kind == "plane" || plane_of(model, face)) return;
    // Facets are accurate enough for sizes and angles.
    const geometry::FacetTree tree(model.points, model[face].triangles);
    for (std::size_t j = 1; j < kChords; ++j) {
        for (std::size_t i = 1; i < kChords; ++i) {
            Vec3& p = points_[j * (kChords + 1) + i];
            p = tree.closest(p).point;
        }
    }
}

const Vec3& MappedFace::at(std::size_t i, std::size_t j) const { return points_[j * (kChords + 1) + i]; }

double MappedFace::sides_between(const Vec3& a, const Vec3& b, const SizeField& size) const
{
    return (b - a).norm() / size((a + b) / 2);
}

std::array<std::vector<double>, 2> MappedFace::wanted_inside(const SizeField& size) const
{
    std::array<std::vector<double>, 2> wanted;
    for (std::size_t line = 1; line < kSamplesPerSide; ++line) {
        const std::size_t k = line * kChords / kSamplesPerSide;
        std::array<double, 2> sum{};
        for (std::size_t i = 0; i < kChords; ++i) {
            sum[0] += sides_between(at(i, k), at(i + 1, k), size);
            sum[1] += sides_between(at(k, i), at(k, i + 1), size);
        }
        for (std::size_t way = 0; way < 2; ++way) wanted[way].push_back(sum[way]);
    }
    return wanted;
}

MappedFace::Shape MappedFace::shape(const SizeField& size) const
{
    Shape shape;
    double jacobians = 0;
    // For each direction, the number of sides that the size requires along each grid side.
    std::array<std::vector<double>, 2> sides;
    for (std::size_t j = 0; j < kChords; ++j) {
        for (std::size_t i = 0; i < kChords; ++i) {
            const std::array<Vec3, 4> quad{at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)};
            const Vec3 normal = (quad[2] - quad[0]).cross(quad[3] - quad[1]);
            double least = 1;
            for (std::size_t k = 0; k < 4; ++k) {
                const Vec3 a = quad[(k + 1) % 4] - quad[k], b = quad[(k + 3) % 4] - quad[k],
                           cross = a.cross(b);
                const double both = a.norm() * b.norm();
                least = std::min(least, both > 0 ? std::copysign(cross.norm() / both, cross.dot(normal)) : 0);
            }
            jacobians += least;
            sides[0].push_back(sides_between(quad[0], quad[1], size));
            sides[1].push_back(sides_between(quad[0], quad[3], size));
        }
    }
    shape.mean_scaled_jacobian = jacobians / (kChords * kChords);
    for (const std::vector<double>& own : sides) {
        double squares = 0;
        for (const double s : own) squares += s * s;
        const double mean = std::sqrt(squares / static_cast<double>(own.size()));
        const auto good = std::ranges::count_if(own, [&](double s) {
            return s >= quads::kShortestOfSize * mean && s <= quads::kLongestOfSize * mean;
        });
        shape.even_share = std::min(shape.even_share,
                                    static_cast<double>(good) / static_cast<double>(own.size()));
    }
    return shape;
}

} // namespace lacuna::surface
