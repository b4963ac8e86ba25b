// SPDX-License-Identifier: MIT
#include <lacuna/closure/detail/turning_heights.h>

#include <lacuna/core/shared/constants.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/shared/union_find.h>
#include <lacuna/topology/shared/facet_area.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace lacuna::closure {

using namespace topology;

namespace {

/// A facet beside a side.
struct Beside {
    FaceId face;
    Vec3 normal;
};

/// A smooth part of a skin.
struct SmoothPart {
    double length = 0, moment = 0; ///< of the sides of facets where the part turns over
    bool ahead = false, behind = false;
    bool crosses_rim = false; ///< whether an edge between the part and others passes that height
    [[nodiscard]] double height() const { return moment / length; }
};

/// A side of facets where a smooth part turns over.
struct TurningSide {
    FaceId face;
    double length, height;
};

} // namespace

std::vector<double> turning_heights(const Model& model, const Vec3& axis)
{
    const double smooth = std::cos(kCreaseAngle * kDegree), steep = std::sin(kCreaseAngle * kDegree);
    std::map<std::pair<Index, Index>, Beside> beside;
    geometry::UnionFind parts(model.faces.size());
    std::vector<SmoothPart> turns(model.faces.size());
    std::vector<TurningSide> sides;
    for (const FaceId face : all_faces(model))
        for (const Triangle& t : model[face].triangles) {
            const Vec3 normal = facet_area_vector(model, t).stableNormalized();
            const double along = normal.dot(axis);
            turns[face.index()].ahead |= along > steep;
            turns[face.index()].behind |= along < -steep;
            for (std::size_t k = 0; k < 3; ++k) {
                const Index a = t[k], b = t[(k + 1) % 3];
                const auto [other, is_first] = beside.try_emplace(std::minmax(a, b), Beside{face, normal});
                if (is_first || other->second.normal.dot(normal) < smooth) continue;
                parts.unite_least(face.index(), other->second.face.index());
                const auto [low, high] = std::minmax({along, other->second.normal.dot(axis)});
                if (low <= kRoundoff && high >= -kRoundoff)
                    sides.push_back({face, (model.at(a) - model.at(b)).norm(),
                                     (model.at(a) + model.at(b)).dot(axis) / 2});
            }
        }
    for (std::size_t f = 0; f < turns.size(); ++f) {
        SmoothPart& part = turns[parts.find(f)];
        part.ahead |= turns[f].ahead;
        part.behind |= turns[f].behind;
    }
    for (const TurningSide& side : sides) {
        SmoothPart& part = turns[parts.find(side.face.index())];
        part.length += side.length;
        part.moment += side.length * side.height;
    }
    for (std::size_t e = 0; e < model.edges.size(); ++e) {
        const auto height = [&](Index p) { return model.at(p).dot(axis); };
        const auto [low, high] = std::ranges::minmax(model.edges[e].points, {}, height);
        for (const FaceUse& use : model.uses_of_edge(EdgeId(e))) {
            SmoothPart& part = turns[parts.find(use.face.index())];
            const bool is_rim = std::ranges::any_of(model.uses_of_edge(EdgeId(e)), [&](const FaceUse& other) {
                return parts.find(other.face.index()) != parts.find(use.face.index());
            });
            const double at = part.height();
            part.crosses_rim |= is_rim && height(low) < at && height(high) > at;
        }
    }
    std::vector<double> heights;
    for (const SmoothPart& part : turns) {
        if (!part.ahead || !part.behind || part.crosses_rim || !(part.length > 0)) continue;
        const double height = part.height();
        if (std::ranges::none_of(
                heights, [&](double own) { return std::abs(own - height) <= kVisible * model.diagonal; }))
            heights.push_back(height);
    }
    return heights;
}

} // namespace lacuna::closure
