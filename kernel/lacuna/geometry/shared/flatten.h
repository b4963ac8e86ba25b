// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/shared/incidence.h>
#include <lacuna/core/types.h>
#include <lacuna/geometry/shared/facet_tree.h>

#include <span>
#include <vector>

namespace lacuna::geometry {

/// How facets were flattened, ordered by increasing distortion.
enum class FlatMap {
    plane,     ///< planar facets: an isometry
    ring,      ///< a tube mapped to a ring, nearly conformal
    rigid,     ///< as rigid as possible
    injective, ///< least symmetric Dirichlet energy, no flipped triangles unless the first map has some
    disc,      ///< harmonic, with a circle as outline
};

/// Options of `flatten()`.
struct FlattenOptions {
    double settled = 1e-6; ///< relative decrease of the energy at which iterations stop
    bool disc = false;     ///< map the outline to a circle, harmonically, whatever the distortion
};

/// Facets mapped to the plane.
struct Flattened {
    std::vector<Index> used;         ///< the given points that the triangles use, ascending
    std::vector<Vec2> position;      ///< plane coordinates of each point in `used` [model length]
    std::vector<Triangle> triangles; ///< the given triangles in the given order, as indices into `used`
    FlatMap map = FlatMap::plane;
    double max_stretch = 1; ///< largest factor by which a length grows or shrinks, >= 1
    Index flips = 0;        ///< number of triangles flipped or collapsed
    bool overlaps = false;  ///< the boundary intersects itself
    bool folded = false;    ///< has flips or overlaps: the map is not one-to-one
};

/// Map connected facets, which may have holes, to the plane; triangles stay counter-clockwise.
///
/// Planar facets are mapped isometrically. For curved facets, maps are computed in this order, and the first
/// one-to-one map is returned:
/// 1. For a tube (facets between two loops, such as the side of a cylinder): a ring. A tube has no nearly
///    rigid map, and minimising its distortion would take a hundred times as long.
/// 2. The least squares conformal map (Lévy et al. 2002), made as rigid as possible by local and global steps
///    (Liu et al. 2008).
/// 3. The map of least symmetric Dirichlet energy, by reweighted steps (Rabinovich et al. 2017) from the
///    conformal map. If that map has flipped triangles, it is not changed.
/// 4. As 3, from the harmonic map to a disc.
///
/// If no map is one-to-one, the one with the fewest flips is returned, and `folded` is set. The result has
/// the area of the facets in space, and is rotated to agree best with their Newell plane.
///
/// @param points     may be all points of a model.
/// @param triangles  consistently oriented.
/// @throw InvalidInput "geometry.not_flattenable"  no triangles; or curved facets that are not a connected,
///        consistently oriented manifold, have no boundary, or have a handle.
/// @note  Deterministic. Costs about one sparse factorisation and some dozens of solves; two factorisations
///        for a tube.
Flattened flatten(std::span<const Vec3> points, std::span<const Triangle> triangles,
                  const FlattenOptions& options = {});

/// Finds the triangle at a point of the plane, to map the point back to space. O(1) inside the triangles,
/// O(log triangles) outside; thread-safe, does not allocate, independent of the `Flattened`.
class PlanarLocator {
public:
    PlanarLocator() = default;
    explicit PlanarLocator(const Flattened& flat);
    PlanarLocator(std::span<const Vec2> points, std::span<const Triangle> triangles);

    struct FacetPosition {
        Index triangle = -1;             ///< -1 only if there are no triangles
        Vec3 barycentric = Vec3::Zero(); ///< in [0, 1], sum 1
        double distance = 0;             ///< distance of the point from the triangle; zero up to rounding
                                         ///< inside the facets
    };
    /// The triangle at a point; outside all triangles, the closest point of the closest triangle.
    [[nodiscard]] FacetPosition locate(const Vec2& place) const;

private:
    /// Two of the barycentric weights of a triangle, as linear functions of the point.
    struct Weights {
        Vec2 corner, first, second; ///< `first` and `second` times (point - corner) are the two weights
    };
    [[nodiscard]] FacetPosition in_bins(const Vec2& place) const;

    FacetTree tree_;
    // Square bins that cover all triangles. Each bin lists the triangles that it may intersect.
    Vec2 low_ = Vec2::Zero();
    double bin_ = 1;
    Index across_ = 0, up_ = 0;
    Incidence bins_;
    std::vector<Weights> weights_;
};

} // namespace lacuna::geometry
