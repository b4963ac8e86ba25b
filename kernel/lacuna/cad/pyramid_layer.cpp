// SPDX-License-Identifier: MIT
#include <lacuna/cad/detail/pyramid_layer.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/constants.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/core/shared/number_text.h>
#include <lacuna/geometry/shared/facet_tree.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace lacuna::cad {

using mesh::ClosedSkin;

namespace {

/// Height of a pyramid divided by the side of its square base. Of 0.35, 0.4 and 0.5, measured on 24 distorted
/// blocks, 0.5 gives the fewest tetrahedra, at the same minimum scaled Jacobian.
constexpr double kHeight = 0.5;
/// Share of an angle or a gap that a pyramid may take. The pyramid on the other side and the tetrahedra
/// between the two pyramids get one third each.
constexpr double kShare = 1.0 / 3;
/// On a warped quad, a pyramid is valid only above a least height. The first height is at least this multiple
/// of the least height. With a multiple of 2, pyramids crossed other faces.
constexpr double kAboveLeast = 1.5;

struct Pyramid {
    Vec3 centre, up;   ///< `centre` of the quad; `up`: unit normal of the quad, into the volume
    double height = 0; ///< height of the apex over the quad
    double least = 0;  ///< any greater height gives a valid pyramid

    [[nodiscard]] Vec3 apex() const { return centre + height * up; }
};

[[noreturn]] void refuse_crossing(const Vec3& at)
{
    throw NotSweepable(
        Message("cad.skin_crosses",
                "faces of the skin cross or touch near {}, so it cannot be filled with tetrahedra",
                place_with_digits(at, 6))
            .remedy("use a smaller 'size'"));
}

class Layer {
public:
    Layer(const ClosedSkin& skin, const std::vector<SkinSide>& sides, const RunContext& context)
        : skin_(skin), sides_(sides), context_(context)
    {
        std::vector<Triangle> facets = skin.triangles;
        for (const Quad& q : skin.quads) {
            facets.push_back({q[0], q[1], q[2]});
            facets.push_back({q[0], q[2], q[3]});
        }
        tree_ = geometry::FacetTree(skin.points, facets, context);
    }

    [[nodiscard]] Pyramid first_height(std::size_t quad) const
    {
        const Quad& q = skin_.quads[quad];
        const Vec3 cross = (at(q[3]) - at(q[1])).cross(at(q[2]) - at(q[0]));
        Pyramid p{middle(quad), cross.normalized(), kHeight * std::sqrt(cross.norm() / 2), 0};
        for (std::size_t k = 0; k < 4; ++k) {
            const Vec3& here = at(q[k]);
            const Vec3 corner = (at(q[(k + 3) % 4]) - here).cross(at(q[(k + 1) % 4]) - here);
            const double rise = corner.dot(p.up);
            if (!(rise > 0)) {
                throw NotSweepable(
                    Message("cad.skin_quad",
                            "a quad of the skin near {} is not convex, so no pyramid fits on it",
                            place_with_digits(p.centre, 6))
                        .remedy("use a smaller 'size'"));
            }
            p.least = std::max(p.least, corner.dot(here - p.centre) / rise);
            p.height = std::min(p.height, height_beside(quad, q[k], q[(k + 1) % 4], p));
        }
        const auto own = static_cast<Index>(skin_.triangles.size() + 2 * quad);
        tree_.all_along(p.centre, p.up, [&](const geometry::FacetTree::RayHit& hit) {
            if (hit.triangle != own && hit.triangle != own + 1) p.height = std::min(p.height, kShare * hit.t);
            return true;
        });
        p.height = std::max(p.height, kAboveLeast * p.least);
        return p;
    }

private:
    [[nodiscard]] const Vec3& at(Index i) const { return skin_.points[index(i)]; }
    [[nodiscard]] Vec3 middle(std::size_t quad) const
    {
        const Quad& q = skin_.quads[quad];
        return (at(q[0]) + at(q[1]) + at(q[2]) + at(q[3])) / 4;
    }

    /// The height at which the pyramid takes its allowed share of the angle to the neighbour at a side.
    [[nodiscard]] double height_beside(std::size_t quad, Index from, Index to, const Pyramid& p) const
    {
        const Vec3 along = (at(to) - at(from)).normalized(), foot = (at(from) + at(to)) / 2;
        const auto across = [&](const Vec3& v) -> Vec3 { return v - v.dot(along) * along; };
        const Vec3 base = across(p.centre - foot);
        const Vec3 x = base.normalized(), y = x.cross(along); // x: away from the side; y: into the volume
        double angle = kFullTurn, share = kShare;
        const std::size_t triangles = skin_.triangles.size(), self = triangles + quad;
        auto side = std::lower_bound(sides_.begin(), sides_.end(), std::pair(to, from),
                                     [](const SkinSide& s, const std::pair<Index, Index>& ends) {
                                         return std::pair(s.from, s.to) < ends;
                                     });
        for (; side != sides_.end() && side->from == to && side->to == from; ++side) {
            const std::size_t face = index(side->face);
            if (face == self) continue;
            Vec3 into;
            if (face < triangles) {
                const Triangle& t = skin_.triangles[face];
                into = across(at(t[0]) + at(t[1]) + at(t[2]) - 3 * foot);
            } else {
                into = across(middle(face - triangles) - foot);
            }
            double turn = std::atan2(into.dot(y), into.dot(x));
            if (turn < 0) turn += kFullTurn;
            if (turn >= angle) continue;
            angle = turn;
            share = face < triangles ? 1.5 * kShare : kShare; // a triangle has no pyramid, so the share is
                                                              // larger
        }
        const double steep = share * angle;
        const double rise = p.up.dot(y) * std::cos(steep) - p.up.dot(x) * std::sin(steep);
        return steep < kRightAngle && rise > 0 ? base.norm() * std::sin(steep) / rise : p.height;
    }

    const ClosedSkin& skin_;
    const std::vector<SkinSide>& sides_;
    const RunContext& context_;
    geometry::FacetTree tree_;
};

/// For each face of the skin, whether the face or its pyramid crosses another face.
/// @throw NotSweepable  two faces without pyramids cross.
std::vector<bool> crossing_faces(const std::vector<Vec3>& points, const std::vector<Triangle>& facets,
                                 const std::vector<Index>& face_of, Index triangles,
                                 const RunContext& context)
{
    const geometry::FacetTree tree(points, facets, context);
    const double contact = kRoundoff * tree.bounds().diagonal().norm();
    const auto corners = [&](Index facet) {
        const Triangle& t = facets[index(facet)];
        return std::array{points[index(t[0])], points[index(t[1])], points[index(t[2])]};
    };
    std::vector<bool> crossing(index(face_of.back()) + 1, false);
    tree.overlaps(
        tree,
        [&](Index a, Index b) {
            const Triangle &s = facets[index(a)], &t = facets[index(b)];
            // Two facets with a common side can meet elsewhere only if they fold onto each other.
            if (std::ranges::count_if(s, [&](Index p) { return std::ranges::count(t, p) > 0; }) >= 2)
                return true;
            if (!geometry::triangles_cross(corners(a), corners(b), contact)) return true;
            const Index first = face_of[index(a)], second = face_of[index(b)];
            if (first < triangles && second < triangles) refuse_crossing(corners(a)[0]);
            crossing[index(first)] = crossing[index(second)] = true;
            return true;
        },
        0, context);
    return crossing;
}

} // namespace

std::vector<SkinSide> skin_sides(const ClosedSkin& skin)
{
    std::vector<SkinSide> sides;
    sides.reserve(3 * skin.triangles.size() + 4 * skin.quads.size());
    Index face = 0;
    const auto add = [&](const auto& corners) {
        for (std::size_t k = 0; k < corners.size(); ++k)
            sides.push_back({corners[k], corners[(k + 1) % corners.size()], face});
        ++face;
    };
    for (const Triangle& t : skin.triangles) add(t);
    for (const Quad& q : skin.quads) add(q);
    std::ranges::sort(sides, {}, [](const SkinSide& s) { return std::tuple(s.from, s.to, s.face); });
    return sides;
}

PyramidLayer place_pyramids(const ClosedSkin& skin, const std::vector<SkinSide>& sides,
                            const RunContext& context)
{
    const std::size_t triangles = skin.triangles.size(), given = skin.points.size();
    std::vector<Pyramid> pyramids;
    const Layer layer(skin, sides, context);
    for (std::size_t quad = 0; quad < skin.quads.size(); ++quad) {
        check_cancelled(context);
        pyramids.push_back(layer.first_height(quad));
    }

    PyramidLayer made{skin.points, {}};
    std::vector<Triangle> facets;
    std::vector<Index> face_of;
    const auto add = [&](std::vector<Triangle> face) {
        for (const Triangle& t : face) {
            facets.push_back(t);
            face_of.push_back(static_cast<Index>(made.face_sides.size()));
        }
        made.face_sides.push_back(std::move(face));
    };
    for (const Triangle& t : skin.triangles) add({t});
    for (std::size_t quad = 0; quad < skin.quads.size(); ++quad) {
        const Quad& q = skin.quads[quad];
        const auto apex = static_cast<Index>(given + quad);
        add({{q[0], q[1], apex}, {q[1], q[2], apex}, {q[2], q[3], apex}, {q[3], q[0], apex}});
    }

    for (int lowering = 0;; ++lowering) {
        made.points.resize(given);
        for (const Pyramid& p : pyramids) made.points.push_back(p.apex());
        const std::vector<bool> crossing = crossing_faces(made.points, facets, face_of,
                                                          static_cast<Index>(triangles), context);
        const auto first = std::find(crossing.begin() + static_cast<std::ptrdiff_t>(triangles),
                                     crossing.end(), true);
        if (first == crossing.end()) return made;
        if (lowering == kMostSteps)
            refuse_crossing(pyramids[static_cast<std::size_t>(first - crossing.begin()) - triangles].centre);
        for (std::size_t quad = 0; quad < pyramids.size(); ++quad) {
            Pyramid& p = pyramids[quad];
            // The part above the least height is halved.
            if (crossing[triangles + quad]) p.height = (p.height + p.least) / 2;
        }
    }
}

} // namespace lacuna::cad
