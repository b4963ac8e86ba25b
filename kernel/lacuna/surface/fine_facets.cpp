// SPDX-License-Identifier: MIT
#include <lacuna/surface/detail/fine_facets.h>

#include <lacuna/core/shared/edge_key.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <cstdint>
#include <unordered_map>

namespace lacuna::surface {

using namespace topology;

namespace {

/// The face with its original facets.
FineFacets copy_of(const Model& model, FaceId face)
{
    FineFacets fine;
    fine.uv = model[face].uv;
    fine.surface = model[face].surface;
    std::map<Index, Index> local; // local index of each point of the model
    for (const Triangle& t : model[face].triangles) {
        for (const Index p : t) local[p] = -1;
    }
    for (auto& [point, own] : local) {
        own = static_cast<Index>(fine.points.size());
        fine.points.push_back(model.at(point));
    }
    const auto own = [&](Index p) { return local.at(p); };
    for (const Triangle& t : model[face].triangles)
        fine.triangles.push_back({own(t[0]), own(t[1]), own(t[2])});
    for (const EdgeUse& use : uses_of(model[face])) {
        auto [found, fresh] = fine.edges.try_emplace(use.edge);
        if (!fresh) continue;
        const std::vector<Index>& chain = model[use.edge].points;
        for (std::size_t i = 0; i < chain.size(); ++i)
            found->second.push_back({static_cast<double>(i), own(chain[i])});
    }
    return fine;
}

/// A side of facets and its midpoint on the exact face.
struct FacetSide {
    Index a, b;
    Vec3 middle;
    Vec2 uv = Vec2::Zero(); ///< initial guess for the projection
    bool on_edge = false;
    bool halved = false;
    Index point = -1; ///< index of the midpoint once it is added
};

/// Corners of the facets into which a facet is split. Corners 0, 1 and 2 are the facet's own. Corners 3, 4
/// and 5 are the midpoints of the sides that start at 0, 1 and 2.
std::vector<std::array<std::size_t, 3>> parts(const std::array<bool, 3>& halved)
{
    const auto count = std::ranges::count(halved, true);
    if (count == 0) return {{0, 1, 2}};
    if (count == 3) return {{0, 3, 5}, {1, 4, 3}, {2, 5, 4}, {3, 4, 5}};
    const auto k = static_cast<std::size_t>(std::ranges::find(halved, true) - halved.begin());
    return {{k, 3 + k, (k + 2) % 3}, {3 + k, (k + 1) % 3, (k + 2) % 3}};
}

/// Bisects sides, one round at a time.
class Halving {
public:
    Halving(const Model& model, FineFacets& fine, const SizeField& size, double off)
        : model_(model), fine_(fine), size_(size), off_(off)
    {
    }

    /// @return  false if no side needs bisection, or if a facet would fold. In both cases nothing is changed.
    bool round()
    {
        collect();
        find_middles();
        bool any = false;
        for (FacetSide& side : sides_) {
            if (settled_.contains(edge_key(side.a, side.b))) continue;
            const Vec3 chord = (fine_.points[index(side.a)] + fine_.points[index(side.b)]) / 2;
            side.halved = (side.middle - chord).norm() > off_ * size_(side.middle);
            any = any || side.halved;
            if (!side.halved) settled_.emplace(edge_key(side.a, side.b), side.middle);
        }
        if (!any) return false;
        FineFacets before = fine_;
        spread();
        make_points();
        if (cut()) return true;
        fine_ = std::move(before);
        return false;
    }

    /// Distance from the midpoint of each side of each facet to the exact face.
    std::vector<std::array<Vec3, 3>> bulges()
    {
        collect();
        find_middles();
        std::vector<std::array<Vec3, 3>> result;
        for (std::size_t i = 0; i < fine_.triangles.size(); ++i) {
            std::array<Vec3, 3>& bulge = result.emplace_back();
            for (std::size_t k = 0; k < 3; ++k) {
                const FacetSide& at = side(i, k);
                bulge[k] = at.middle - (fine_.points[index(at.a)] + fine_.points[index(at.b)]) / 2;
            }
        }
        return result;
    }

private:
    /// The side from corner k of a facet to the next corner.
    [[nodiscard]] FacetSide& side(std::size_t facet, std::size_t k) { return sides_[side_of_[facet][k]]; }

    void collect()
    {
        sides_.clear();
        number_.clear();
        number_.reserve(2 * fine_.triangles.size());
        side_of_.resize(fine_.triangles.size());
        for (std::size_t i = 0; i < fine_.triangles.size(); ++i) {
            const Triangle& t = fine_.triangles[i];
            for (std::size_t k = 0; k < 3; ++k) {
                const Index a = t[k], b = t[(k + 1) % 3];
                const auto [found, fresh] = number_.try_emplace(edge_key(a, b), sides_.size());
                side_of_[i][k] = found->second;
                if (!fresh) continue;
                sides_.push_back({a, b, (fine_.points[index(a)] + fine_.points[index(b)]) / 2});
                if (!fine_.uv.empty()) sides_.back().uv = (fine_.uv[i][k] + fine_.uv[i][(k + 1) % 3]) / 2;
            }
        }
    }

    /// Project the midpoints of all sides onto the exact edges and the exact surface, in one call for each
    /// edge and for the surface. Results of earlier rounds are reused.
    void find_middles()
    {
        for (const auto& [edge, chain] : fine_.edges) {
            std::vector<double> params;
            std::vector<std::size_t> which;
            for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
                const auto found = number_.find(edge_key(chain[i].point, chain[i + 1].point));
                if (found == number_.end()) continue;
                sides_[found->second].on_edge = true;
                if (model_[edge].curve == nullptr) continue;
                params.push_back(parameter(model_[edge], (chain[i].at + chain[i + 1].at) / 2));
                which.push_back(found->second);
            }
            if (params.empty()) continue;
            std::vector<Vec3> exact(params.size());
            model_[edge].curve->evaluate(params, exact);
            for (std::size_t i = 0; i < which.size(); ++i) sides_[which[i]].middle = exact[i];
        }
        std::vector<std::size_t> inside;
        for (std::size_t s = 0; s < sides_.size(); ++s) {
            const auto known = settled_.find(edge_key(sides_[s].a, sides_[s].b));
            if (known != settled_.end())
                sides_[s].middle = known->second;
            else if (!sides_[s].on_edge)
                inside.push_back(s);
        }
        if (inside.empty()) return;
        std::vector<Vec3> points;
        std::vector<Vec2> uv;
        for (const std::size_t s : inside) {
            points.push_back(sides_[s].middle);
            uv.push_back(sides_[s].uv);
        }
        fine_.surface->project(points, uv);
        for (std::size_t i = 0; i < inside.size(); ++i) sides_[inside[i]].middle = points[i];
    }

    static double parameter(const Edge& edge, double where)
    {
        const std::size_t segment = std::min(static_cast<std::size_t>(where), edge.points.size() - 2);
        const double share = where - static_cast<double>(segment);
        return (1 - share) * edge.params[segment] + share * edge.params[segment + 1];
    }

    /// If two sides of a facet are bisected, bisect the third as well to keep the facet's shape.
    void spread()
    {
        for (bool again = true; again;) {
            again = false;
            for (std::size_t i = 0; i < fine_.triangles.size(); ++i) {
                int halved = 0;
                for (std::size_t k = 0; k < 3; ++k) halved += side(i, k).halved ? 1 : 0;
                if (halved != 2) continue;
                again = true;
                for (std::size_t k = 0; k < 3; ++k) side(i, k).halved = true;
            }
        }
    }

    void make_points()
    {
        for (FacetSide& side : sides_) {
            if (!side.halved) continue;
            side.point = static_cast<Index>(fine_.points.size());
            fine_.points.push_back(side.middle);
        }
        for (auto& [edge, chain] : fine_.edges) {
            std::vector<FineFacets::OnEdge> longer;
            for (std::size_t i = 0; i < chain.size(); ++i) {
                longer.push_back(chain[i]);
                if (i + 1 == chain.size()) break;
                const auto found = number_.find(edge_key(chain[i].point, chain[i + 1].point));
                if (found == number_.end() || !sides_[found->second].halved) continue;
                longer.push_back({(chain[i].at + chain[i + 1].at) / 2, sides_[found->second].point});
            }
            chain = std::move(longer);
        }
    }

    /// @return false if a facet folds.
    bool cut()
    {
        std::vector<Triangle> triangles;
        std::vector<std::array<Vec2, 3>> uv;
        bool upright = true;
        for (std::size_t i = 0; i < fine_.triangles.size(); ++i) {
            const Triangle& t = fine_.triangles[i];
            std::array<Index, 6> point{t[0], t[1], t[2], -1, -1, -1};
            std::array<Vec2, 6> place;
            place.fill(Vec2::Zero());
            for (std::size_t k = 0; k < 3; ++k) {
                if (side(i, k).halved) point[3 + k] = side(i, k).point;
                if (fine_.uv.empty()) continue;
                place[k] = fine_.uv[i][k];
                place[3 + k] = (fine_.uv[i][k] + fine_.uv[i][(k + 1) % 3]) / 2;
            }
            const auto area = [&](const Triangle& c) -> Vec3 {
                const Vec3& from = fine_.points[index(c[0])];
                return (fine_.points[index(c[1])] - from).cross(fine_.points[index(c[2])] - from);
            };
            const Vec3 whole = area(t);
            for (const auto& [a, b, c] : parts({point[3] >= 0, point[4] >= 0, point[5] >= 0})) {
                triangles.push_back({point[a], point[b], point[c]});
                upright = upright && area(triangles.back()).dot(whole) >= 0;
                if (!fine_.uv.empty()) uv.push_back({place[a], place[b], place[c]});
            }
        }
        fine_.triangles = std::move(triangles);
        fine_.uv = std::move(uv);
        return upright;
    }

    const Model& model_;
    FineFacets& fine_;
    const SizeField& size_;
    double off_;
    std::vector<FacetSide> sides_;
    /// For each facet, the indices of its sides; side k starts at corner k.
    std::vector<std::array<std::size_t, 3>> side_of_;
    std::unordered_map<std::uint64_t, std::size_t> number_; ///< index of each side, by its end points
    std::unordered_map<std::uint64_t, Vec3> settled_;       ///< midpoints of sides that need no bisection
};

} // namespace

FineFacets fine_facets(const Model& model, FaceId face, const SizeField& size, bool bulges)
{
    FineFacets fine = copy_of(model, face);
    if (fine.surface == nullptr) return fine;
    Halving halving(model, fine, size, 0.05);
    for (int i = 0; i < 8 && fine.triangles.size() < 100'000 && halving.round(); ++i) {}
    if (bulges) fine.bulge = halving.bulges();
    return fine;
}

} // namespace lacuna::surface
