// SPDX-License-Identifier: MIT
#include <lacuna/closure/shared/round_rims.h>

#include <lacuna/closure/detail/pieces.h>
#include <lacuna/closure/detail/turns.h>
#include <lacuna/closure/shared/piece_ends.h>
#include <lacuna/core/shared/constants.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/newell.h>
#include <lacuna/geometry/shared/union_find.h>
#include <lacuna/topology/shared/face_parts.h>
#include <lacuna/topology/shared/joined_faces.h>
#include <lacuna/topology/shared/names_of.h>
#include <lacuna/topology/shared/patches.h>
#include <lacuna/topology/shared/section.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <vector>

namespace lacuna::closure {

using namespace topology;

namespace {

/// Inclination of a facet to an end, and height of the facet along a direction `way`.
struct Slope {
    double cosine = 0; ///< 1 where the facet is parallel to the end, 0 where it is normal to the end
    double height = 0; ///< height of its centre along `way` [model length]
};

Slope slope_of(const Model& model, const Triangle& t, const Vec3& out, const Vec3& way)
{
    const Vec3 &a = model.at(t[0]), &b = model.at(t[1]), &c = model.at(t[2]);
    return {(b - a).cross(c - a).stableNormalized().dot(out), (a + b + c).dot(way) / 3};
}

/// Finds and divides the rounds at the rim of one part of an end.
class RoundRims {
public:
    RoundRims(OpenVolume& volume, const std::vector<FaceId>& part, const std::vector<double>& turns,
              RoundsOf of, const RunContext& context)
        : volume_(volume),
          part_(part),
          turns_(turns),
          of_(of),
          context_(context),
          end_(volume.role[part.front().index()]),
          out_(area_vector_of(volume.model, part).stableNormalized())
    {
    }

    [[nodiscard]] bool has_rounds() const { return !rounds_at_rim().empty(); }

    /// @return  whether a round was divided
    bool run()
    {
        bool divided = false;
        for (const std::vector<FaceId>& rounds : rounds_at_rim()) divided = divide(rounds) || divided;
        return divided;
    }

private:
    bool divide(const std::vector<FaceId>& rounds)
    {
        // `way` points from the end to the rounds. Rounds of a product in a box lie on the side of the end to
        // which `out_` points; rounds of a body lie on the other side.
        const Vec3 from_end = centroid_of(volume_.model, rounds) - centroid_of(volume_.model, part_);
        const Vec3 way = from_end.dot(out_) < -volume_.model.tolerance ? Vec3(-out_) : out_;
        const std::optional<double> height = halfway_height(rounds, way);
        if (!height) return false;
        const geometry::Plane plane = geometry::plane_across(*height * way, way);
        const std::vector<SectionWalk> walks = section_walks(volume_.model, rounds, plane,
                                                             volume_.model.tolerance);
        if (walks.empty() || !std::ranges::all_of(walks, &SectionWalk::closed)) return false;
        const WalkImprint made = imprint(volume_, walks, plane, context_);
        const std::set<FaceId> divided(rounds.begin(), rounds.end());
        for (std::size_t f = 0; f < made.parent.size(); ++f)
            if (divided.contains(made.parent[f]))
                volume_.role[f] = face_centroid(volume_.model, FaceId(f)).dot(way) < *height ? end_
                                                                                             : Role::wall;
        return true;
    }

    /// Connected sets of rounds. In each set, a round belongs to this part of the end or meets it smoothly.
    std::vector<std::vector<FaceId>> rounds_at_rim() const
    {
        const std::set<FaceId> own(part_.begin(), part_.end());
        const auto may_be_own = [&](FaceId face) {
            return of_ == RoundsOf::ends_and_walls && own.contains(face);
        };
        const auto neighbours = [&](FaceId face, double largest_turn) {
            std::vector<FaceId> found;
            for (const EdgeUse& use : uses_of(volume_.model[face]))
                if (std::abs(turns_[use.edge.index()]) <= largest_turn)
                    for (const FaceUse& user : volume_.model.uses_of_edge(use.edge))
                        if ((may_be_own(user.face) || volume_.role[user.face.index()] == Role::wall) &&
                            is_round(user.face))
                            found.push_back(user.face);
            return found;
        };
        std::vector<std::vector<FaceId>> sets;
        std::set<FaceId> seen;
        for (const FaceId face : part_) {
            std::vector<FaceId> seeds = neighbours(face, kCreaseAngle);
            if (may_be_own(face) && is_round(face)) seeds.push_back(face);
            for (const FaceId seed : seeds) {
                if (!seen.insert(seed).second) continue;
                std::vector<FaceId> set{seed};
                for (std::size_t i = 0; i < set.size(); ++i)
                    for (const FaceId next : neighbours(set[i], 180)) // rounds may meet at a mitre
                        if (seen.insert(next).second) set.push_back(next);
                sets.push_back(std::move(set));
            }
        }
        return sets;
    }

    /// Whether a face is inclined to the end by less than 45° in places and by more in others. Faces with
    /// given quads, and parts of faces that were divided before, do not count.
    [[nodiscard]] bool is_round(FaceId face) const
    {
        const Face& own = volume_.model[face];
        double least = 1, most = -1;
        for (const Triangle& t : own.triangles) {
            const double cosine = slope_of(volume_.model, t, out_, out_).cosine;
            least = std::min(least, cosine);
            most = std::max(most, cosine);
        }
        const auto is_part = [&](const Face& other) {
            return other.tag == own.tag && other.origin == own.origin;
        };
        return least < kContinues && most > kContinues && own.given_quads.empty() &&
               std::ranges::count_if(volume_.model.faces, is_part) == 1;
    }

    /// The height that best separates flat facets from steep ones: below it, facets should be inclined to the
    /// end by less than 45°, above it by more. Facets for which this does not hold are exceptions. Empty if
    /// no height has fewer exceptions than a division below all facets.
    [[nodiscard]] std::optional<double> halfway_height(const std::vector<FaceId>& rounds,
                                                       const Vec3& way) const
    {
        std::vector<Slope> all;
        for (const FaceId face : rounds)
            for (const Triangle& t : volume_.model[face].triangles)
                all.push_back(slope_of(volume_.model, t, out_, way));
        std::ranges::sort(all, {}, &Slope::height);
        std::ptrdiff_t wrong = std::ranges::count_if(all,
                                                     [](const Slope& s) { return s.cosine > kContinues; });
        std::ptrdiff_t least = wrong;
        std::optional<double> height;
        for (std::size_t i = 0; i + 1 < all.size(); ++i) {
            wrong += all[i].cosine > kContinues ? -1 : 1;
            if (wrong >= least || !(all[i + 1].height > all[i].height)) continue;
            least = wrong;
            height = (all[i].height + all[i + 1].height) / 2;
        }
        return height;
    }

    OpenVolume& volume_;
    const std::vector<FaceId>& part_;
    const std::vector<double>& turns_;
    RoundsOf of_;
    const RunContext& context_;
    Role end_;
    Vec3 out_; ///< away from the opposite end
};

/// The connected parts of an end, also divided at edges where a face rises steeply from its neighbour. The
/// rounded edges of each part are then searched at the part's own rim. Example: a product stands on a floor,
/// and the product's skin is one smooth face.
std::vector<std::vector<FaceId>> parts_of_end(const OpenVolume& volume, Role end,
                                              const std::vector<double>& turns)
{
    const std::vector<FaceId> faces = volume.faces(end);
    geometry::UnionFind joined(volume.model.faces.size());
    for (const FaceId face : faces)
        for (const EdgeUse& use : uses_of(volume.model[face]))
            for (const FaceUse& user : volume.model.uses_of_edge(use.edge))
                if (volume.role[user.face.index()] == end && turns[use.edge.index()] > kCreaseAngle - 90)
                    joined.unite_least(face.index(), user.face.index());
    std::map<std::size_t, std::vector<FaceId>> by_first;
    for (const FaceId face : faces) by_first[joined.find(face.index())].push_back(face);
    std::vector<std::vector<FaceId>> parts;
    for (auto& [first, part] : by_first) parts.push_back(std::move(part));
    return parts;
}

/// Smooth edges between walls, where two or more of them start at the same vertex of an end's rim.
std::vector<EdgeId> smooth_fans(const OpenVolume& volume, const RunContext& context)
{
    const Model& model = volume.model;
    std::set<VertexId> at_rim;
    for (const Role end : {Role::source, Role::target})
        for (const EdgeUse& use : rim_uses(model, volume.faces(end)))
            at_rim.insert({model[use.edge].from, model[use.edge].to});
    std::map<VertexId, std::vector<EdgeId>> leaving;
    for (std::size_t e = 0; e < model.edges.size(); ++e) {
        const std::span<const FaceUse> uses = model.uses_of_edge(EdgeId(e));
        const bool between_walls = uses.size() == 2 && uses[0].face != uses[1].face &&
                                   std::ranges::all_of(uses, [&](const FaceUse& use) {
                                       return volume.role[use.face.index()] == Role::wall;
                                   });
        if (!between_walls || model.edges[e].keeps_nodes) continue;
        for (const VertexId vertex : {model.edges[e].from, model.edges[e].to})
            if (at_rim.contains(vertex)) leaving[vertex].push_back(EdgeId(e));
    }
    std::erase_if(leaving, [](const auto& item) { return item.second.size() < 2; });
    std::vector<EdgeId> fans;
    if (leaving.empty()) return fans;
    const std::vector<double> angle = angles_across(model, context);
    for (auto& [vertex, edges] : leaving) {
        std::erase_if(edges, [&](EdgeId edge) { return angle[edge.index()] >= kCreaseAngle; });
        if (edges.size() > 1) fans.insert(fans.end(), edges.begin(), edges.end());
    }
    return fans;
}

/// Whether two walls may become one face: neither has a mesh of its own, and no name distinguishes them.
bool may_join(const Face& a, const Face& b)
{
    return a.given_quads.empty() && b.given_quads.empty() && a.origin == b.origin && are_named_alike(a, b);
}

/// Join the walls on both sides of the edges that `smooth_fans()` finds, and drop these edges. Only one
/// column of nodes starts at a vertex of the rim, so the mesh could not follow all these edges.
void join_rounds(OpenVolume& volume, const RunContext& context)
{
    const std::vector<EdgeId> fans = smooth_fans(volume, context);
    if (fans.empty()) return;
    const Model& model = volume.model;
    geometry::UnionFind joined(model.faces.size());
    bool any = false;
    for (const EdgeId edge : fans) {
        const std::span<const FaceUse> uses = model.uses_of_edge(edge);
        if (may_join(model[uses[0].face], model[uses[1].face]))
            any = joined.unite_least(uses[0].face.index(), uses[1].face.index()) || any;
    }
    if (any) join_faces(volume, std::move(joined), context);
}

} // namespace

bool is_end_with_walls(const Model& model, FaceId face, const Vec3& axis)
{
    const Vec3 net = face_area_vector(model, face);
    if (std::abs(net.dot(axis)) < std::cos(kCreaseAngle * kDegree) * net.norm() ||
        border_loops(model, face).size() != 1 || !model[face].given_quads.empty())
        return false;
    bool flat = false, upright = false;
    for (const Triangle& t : model[face].triangles) {
        const double cosine = std::abs(slope_of(model, t, axis, axis).cosine);
        flat = flat || cosine > kContinues;
        upright = upright || cosine < kFacesEnd;
    }
    return flat && upright;
}

void split_round_rims(OpenVolume& volume, RoundsOf of, const RunContext& context)
{
    // Here all edges count as smooth: to compute their turns would cost more than to find that there are no
    // rounds.
    const std::vector<double> smooth(volume.model.edges.size(), 0);
    const auto has_rounds = [&](Role end) {
        return std::ranges::any_of(parts_of_end(volume, end, smooth), [&](const std::vector<FaceId>& part) {
            return RoundRims(volume, part, smooth, of, context).has_rounds();
        });
    };
    if (has_rounds(Role::source) || has_rounds(Role::target)) {
        face_away(volume, context);
        std::vector<double> turns = concave_turns(volume, context);
        for (const Role end : {Role::source, Role::target})
            for (const std::vector<FaceId>& part : parts_of_end(volume, end, turns))
                if (RoundRims(volume, part, turns, of, context).run()) turns = concave_turns(volume, context);
    }
    join_rounds(volume, context);
}

} // namespace lacuna::closure
