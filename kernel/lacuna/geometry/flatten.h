// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>
#include <lacuna/geometry/facet_tree.h>

#include <span>
#include <vector>

namespace lacuna::geometry {

/// How the facets were laid flat; the further down, the more they are stretched.
enum class FlatMap {
    plane,     ///< they lie in a plane: an isometry
    ring,      ///< a tube as a ring, nearly conformal
    rigid,     ///< as rigid as possible
    injective, ///< least symmetric Dirichlet energy, no facet turned over
    conformal, ///< least squares conformal
    convex,    ///< harmonic onto a disc: one to one whatever the shape
};

/// Options of `flatten()`.
struct FlattenOptions {
    double planar_tolerance =
        0;                    ///< points this near a plane lie in it [model length]; 0: 1e-9 × their extent
    int max_iterations = 200; ///< of each of the iterative maps, >= 1
    double settled = 1e-6;    ///< relative fall of the energy at which they stop
};

/// Facets laid in the plane.
struct Flattened {
    std::vector<Index> used;         ///< the given points that the triangles use, rising
    std::vector<Vec2> position;      ///< where each of `used` lies in the plane [model length]
    std::vector<Triangle> triangles; ///< the given ones, in the given order, counting in `used`
    FlatMap map = FlatMap::plane;
    double max_stretch = 1; ///< largest of length ratios and their inverses over all triangles, >= 1
    Index flips = 0;        ///< triangles turned over, or flattened to no area
    bool overlaps = false;  ///< a boundary crosses itself or another
    bool folded = false;    ///< flips or overlaps: not one to one
};

/// Lay connected facets, which may have holes, in the plane; triangles stay counter-clockwise.
///
/// Facets in a plane are taken as they lie there. A tube, which closes round between two loops, becomes a
/// ring: no map of it is near rigid, and looking for the least stretched one would take a hundred times as
/// long. Others start from the least squares conformal map
/// (Lévy et al. 2002) and are relaxed to as rigid as possible by local and global steps (Liu et al. 2008).
/// Should that turn a triangle over or a boundary cross, maps that cannot turn triangles over come in: least
/// symmetric Dirichlet energy by reweighted steps (Rabinovich et al. 2017), at worst the harmonic map onto a
/// disc. The first that is one to one is given; if none is, the one with the fewest flips, and `folded` says
/// so.
/// Curved facets come out with the area they have in space, turned to agree best with their Newell plane.
///
/// @param points     the whole model's may be given.
/// @param triangles  oriented alike.
/// @throw InvalidInput "geometry.not_flattenable"  no triangles; or curved facets that are not a connected,
///        consistently oriented manifold, have no boundary, or have a handle.
/// @note  Deterministic. About as dear as a sparse factorisation and some dozens of solves, of a tube two
///        factorisations.
Flattened flatten(std::span<const Vec3> points, std::span<const Triangle> triangles,
                  const FlattenOptions& options = {});

/// Finds the triangle over a place of the plane, to lift it back. A few comparisons inside the triangles,
/// O(log triangles) outside; parallel-safe, allocates nothing; a value of its own.
class PlanarLocator {
public:
    PlanarLocator() = default;
    explicit PlanarLocator(const Flattened& flat);
    PlanarLocator(std::span<const Vec2> points, std::span<const Triangle> triangles);

    struct FacetPosition {
        Index triangle = -1;             ///< -1 only where there are none
        Vec3 barycentric = Vec3::Zero(); ///< in [0, 1], sum 1
        double distance = 0;             ///< from the triangle; 0 to rounding inside the facets
    };
    /// The triangle at a place; outside all of them the closest place of the closest one.
    [[nodiscard]] FacetPosition locate(const Vec2& place) const;

private:
    /// Two of the weights of a triangle's corners, which are linear in the place.
    struct Weights {
        Vec2 corner, first, second; ///< first and second weight: these times (place - corner)
    };
    [[nodiscard]] FacetPosition in_bins(const Vec2& place) const;

    FacetTree tree_;
    // Square bins over all triangles: bin b may meet triangles listed_[start_[b]...start_[b + 1]).
    Vec2 low_ = Vec2::Zero();
    double bin_ = 1;
    Index across_ = 0, up_ = 0;
    std::vector<Index> start_, listed_;
    std::vector<Weights> weights_;
};

} // namespace lacuna::geometry
