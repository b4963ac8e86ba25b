// SPDX-License-Identifier: MIT
#include <lacuna/closure/detail/branch_mouths.h>

#include <lacuna/closure/detail/turns.h>
#include <lacuna/closure/shared/branches.h>
#include <lacuna/core/shared/constants.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/newell.h>
#include <lacuna/geometry/shared/affine.h>
#include <lacuna/geometry/shared/facet_tree.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/geometry/shared/union_find.h>
#include <lacuna/topology/shared/face_parts.h>
#include <lacuna/topology/shared/facet_area.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

namespace lacuna::closure {

using namespace topology;

std::vector<Vec3> places(const Model& model, const std::vector<EdgeId>& edges)
{
    std::vector<Vec3> result;
    for (const EdgeId edge : edges) {
        const std::vector<Index>& points = model[edge].points;
        for (std::size_t i = 0; i + 1 < points.size(); ++i) result.push_back(model.at(points[i]));
    }
    return result;
}

namespace {

class BranchFinder {
public:
    BranchFinder(const OpenVolume& volume, const RunContext& context)
        : volume_(volume), model_(volume.model), context_(context), ends_(volume.faces(Role::source))
    {
        std::ranges::copy(volume.faces(Role::target), std::back_inserter(ends_));
    }

    Branching run()
    {
        find_lines();
        // Remove lines that are not mouths. The regions on both sides of such a line become one.
        for (bool again = true; again;) {
            find_regions();
            while (join_hub()) find_regions();
            // A line around the main body goes first: without it, the body has both ends of the sweep.
            const auto is_no_mouth = [&](Mouth& mouth) { return !set_sides(mouth); };
            again = std::erase_if(result_.mouths,
                                  [&](Mouth& mouth) { return is_no_mouth(mouth) && is_around(mouth); }) > 0 ||
                    std::erase_if(result_.mouths, is_no_mouth) > 0;
            for (Mouth& mouth : result_.mouths) {
                if (!mouth.fillet.valid() || result_.region[mouth.fillet.index()] != mouth.host) continue;
                std::swap(mouth.edges, mouth.beyond);
                mouth.fillet = {};
                again = true;
            }
        }
        add_smooth_mouths();
        return std::move(result_);
    }

private:
    void find_lines()
    {
        auto [turns, faces_void] = skin_turns(volume_, context_);
        turns_ = std::move(turns);
        const std::set<EdgeId> at_ends = edges_of(model_, ends_);
        std::map<VertexId, std::vector<EdgeId>> at;
        geometry::UnionFind sets(model_.edges.size());
        std::vector<EdgeId> concave;
        for (std::size_t e = 0; e < model_.edges.size(); ++e) {
            if (at_ends.contains(EdgeId(e)) || turns_[e] < kCreaseAngle / 2) continue;
            concave.emplace_back(e);
            for (const VertexId v : {model_.edges[e].from, model_.edges[e].to}) {
                for (const EdgeId other : at[v]) sets.unite_least(other.index(), e);
                at[v].emplace_back(e);
            }
        }
        std::map<std::size_t, std::vector<EdgeId>> lines;
        for (const EdgeId edge : concave) lines[sets.find(edge.index())].push_back(edge);
        for (auto& [root, edges] : lines) {
            const bool closed = std::ranges::all_of(edges, [&](EdgeId edge) {
                return at.at(model_[edge].from).size() == 2 && at.at(model_[edge].to).size() == 2;
            });
            if (closed) result_.mouths.push_back({std::move(edges)});
        }
        find_fillets(faces_void, at_ends);
    }

    /// Find the rings of smooth faces that replace a mouth's line. One rim of such a ring is a whole rim of
    /// one wall.
    void find_fillets(const std::vector<bool>& faces_void, const std::set<EdgeId>& at_ends)
    {
        const auto is_smooth = [&](const EdgeUse& use) {
            return !at_ends.contains(use.edge) && std::abs(turns_[use.edge.index()]) < kCreaseAngle / 2 &&
                   model_.uses_of_edge(use.edge).size() == 2;
        };
        const auto edges_of_rim = [](const Rim& rim) {
            std::vector<EdgeId> edges;
            for (const EdgeUse& use : rim.uses) edges.push_back(use.edge);
            std::ranges::sort(edges);
            return edges;
        };
        std::set<FaceId> known;
        for (const FaceId wall : volume_.faces(Role::wall)) {
            for (const Rim& rim : rims(model_, {wall})) {
                if (!std::ranges::all_of(rim.uses, is_smooth)) continue;
                std::set<FaceId> ring;
                for (const EdgeUse& use : rim.uses)
                    for (const FaceUse& user : model_.uses_of_edge(use.edge))
                        if (user.face != wall) ring.insert(user.face);
                const std::vector<FaceId> fillet(ring.begin(), ring.end());
                std::vector<Rim> both = rims(model_, fillet);
                if (both.size() != 2 || known.contains(fillet.front())) continue;
                Mouth mouth{edges_of_rim(rim), edges_of_rim(both[0]), fillet.front()};
                if (mouth.beyond == mouth.edges) {
                    std::swap(both[0], both[1]);
                    mouth.beyond = edges_of_rim(both[0]);
                }
                if (edges_of_rim(both[1]) != mouth.edges || !std::ranges::all_of(both[0].uses, is_smooth) ||
                    mean_bend(wall, faces_void[wall.index()], mouth) < kCreaseAngle / 2)
                    continue;
                known.insert(ring.begin(), ring.end());
                result_.mouths.push_back(std::move(mouth));
            }
        }
    }

    /// A smooth line at which a tube leaves a junction of three or more tubes.
    struct SmoothLine {
        std::vector<EdgeId> edges;
        FaceId tube, junction;
        bool may_be_mouth = false; ///< tubes with ends of the sweep belong to the main body
        double length = 0;
    };

    /// The smooth lines, the shortest first. Cuts may have divided the junction.
    [[nodiscard]] std::vector<SmoothLine> smooth_lines() const
    {
        const std::set<EdgeId> at_ends = edges_of(model_, ends_);
        const auto junction_at = [&](const EdgeUse& use) {
            for (const FaceUse& user : model_.uses_of_edge(use.edge))
                if (!model_[user.face].tube && model_[user.face].origin == Origin::given &&
                    volume_.role[user.face.index()] == Role::wall &&
                    std::abs(turns_[use.edge.index()]) < kCreaseAngle / 2)
                    return user.face;
            return FaceId{};
        };
        std::vector<SmoothLine> lines;
        for (const FaceId tube : volume_.faces(Role::wall)) {
            if (!model_[tube].tube) continue;
            const std::vector<Rim> both = rims(model_, {tube});
            const bool ends = std::ranges::any_of(
                both, [&](const Rim& own) { return at_ends.contains(own.uses.front().edge); });
            for (const Rim& rim : both) {
                if (!std::ranges::all_of(rim.uses, [&](const EdgeUse& u) { return junction_at(u).valid(); }))
                    continue;
                SmoothLine line{{}, tube, junction_at(rim.uses.front()), !ends && both.size() == 2};
                for (const EdgeUse& use : rim.uses) {
                    line.edges.push_back(use.edge);
                    line.length += edge_length(model_, use.edge);
                }
                lines.push_back(std::move(line));
            }
        }
        std::ranges::sort(lines, {}, &SmoothLine::length);
        return lines;
    }

    /// Add the smooth lines that are mouths.
    void add_smooth_mouths()
    {
        const std::vector<SmoothLine> lines = smooth_lines();
        const auto sides_are_known = [&] {
            find_regions(); // numbered anew for all mouths
            return std::ranges::all_of(result_.mouths, [&](Mouth& mouth) { return set_sides(mouth); });
        };
        for (const SmoothLine& line : lines) {
            result_.mouths.push_back({line.edges});
            if (line.may_be_mouth && sides_are_known()) continue;
            result_.mouths.pop_back();
            result_.passed.emplace_back(line.junction, line.tube);
        }
        if (!lines.empty()) sides_are_known();
    }

    /// The angle by which the skin turns from one rim of a fillet to the other, on average; positive if the
    /// fillet rounds a concave edge of the void [degrees].
    [[nodiscard]] double mean_bend(FaceId wall, bool faces_void, const Mouth& mouth) const
    {
        const geometry::FacetTree facets(model_.points, model_[wall].triangles);
        const std::vector<Vec3> near = places(model_, mouth.edges), far = places(model_, mouth.beyond);
        double sum = 0;
        for (const Vec3& p : near) {
            const Triangle& t = model_[wall].triangles[facets.closest(p).triangle];
            const Vec3 normal = facet_area_vector(model_, t).stableNormalized();
            const Vec3 to = *std::ranges::min_element(far, {},
                                                      [&](const Vec3& q) { return (q - p).squaredNorm(); });
            const Vec3 way = (to - p).stableNormalized();
            // The chord of an arc leaves its tangent by half the angle of the arc.
            sum -= 2 * std::asin(std::clamp(normal.dot(way), -1.0, 1.0));
        }
        return (faces_void ? sum : -sum) / static_cast<double>(near.size()) / kDegree;
    }

    /// The faces that edges join, without `barred` edges.
    [[nodiscard]] geometry::UnionFind parts_between(const std::set<EdgeId>& barred) const
    {
        geometry::UnionFind sets(model_.faces.size());
        for (std::size_t e = 0; e < model_.edges.size(); ++e) {
            if (barred.contains(EdgeId(e))) continue;
            const std::span<const FaceUse> uses = model_.uses_of_edge(EdgeId(e));
            for (const FaceUse& use : uses) sets.unite_least(uses.front().face.index(), use.face.index());
        }
        return sets;
    }

    /// Whether a line separates the source from the target, such as the small end of a reducer.
    [[nodiscard]] bool is_around(const Mouth& mouth) const
    {
        geometry::UnionFind sets = parts_between({mouth.edges.begin(), mouth.edges.end()});
        std::set<std::size_t> at_source, at_target;
        for (const FaceId end : ends_)
            (volume_.role[end.index()] == Role::source ? at_source : at_target)
                .insert(sets.find(end.index()));
        return std::ranges::none_of(at_source, [&](std::size_t own) { return at_target.contains(own); });
    }

    void find_regions()
    {
        std::set<EdgeId> barred;
        for (const Mouth& mouth : result_.mouths) barred.insert(mouth.edges.begin(), mouth.edges.end());
        geometry::UnionFind sets = parts_between(barred);
        std::map<std::size_t, std::size_t> number;
        result_.region.clear();
        result_.faces.clear();
        for (std::size_t f = 0; f < model_.faces.size(); ++f) {
            const std::size_t own = number.try_emplace(sets.find(f), number.size()).first->second;
            result_.region.push_back(own);
            result_.faces.resize(number.size());
            result_.faces[own].emplace_back(f);
        }
        result_.ends.assign(number.size(), {});
        for (const std::vector<FaceId>& end : connected_parts(model_, ends_))
            result_.ends[result_.region[end.front().index()]].push_back(centroid_of(model_, end));
        for (const Rim& rim : free_loops(volume_)) {
            std::vector<EdgeId> edges;
            for (const EdgeUse& use : rim.uses) edges.push_back(use.edge);
            const std::size_t own = result_.region[model_.uses_of_edge(edges.front()).front().face.index()];
            result_.ends[own].push_back(geometry::mean_point(places(model_, edges)));
        }
    }

    /// The regions on the two sides of a mouth.
    [[nodiscard]] std::pair<std::size_t, std::size_t> regions_beside(const Mouth& mouth) const
    {
        const std::span<const FaceUse> users = model_.uses_of_edge(mouth.edges.front());
        return {result_.region[users[0].face.index()], result_.region[users[1].face.index()]};
    }

    /// Make one main body of a region without ends, such as the ball of a valve, and two tubes that leave it:
    /// of those with ends, the two that are most opposite to each other.
    /// @return  whether there is such a region, with three tubes or more; two mouths are removed
    bool join_hub()
    {
        for (std::size_t hub = 0; hub < result_.faces.size(); ++hub) {
            if (!result_.ends[hub].empty()) continue;
            std::size_t count = 0;
            std::vector<std::pair<std::size_t, Vec3>> tubes; // number of the mouth, direction from the hub
            const Vec3 middle = centroid_of(model_, result_.faces[hub]);
            for (std::size_t m = 0; m < result_.mouths.size(); ++m) {
                const auto [a, b] = regions_beside(result_.mouths[m]);
                if (a == b || (a != hub && b != hub)) continue;
                ++count;
                if (result_.ends[a == hub ? b : a].empty()) continue;
                const std::vector<Vec3> rim = places(model_, result_.mouths[m].edges);
                const Vec3 normal = geometry::newell_vector(rim).normalized();
                tubes.emplace_back(m, normal.dot(geometry::centre_of_ring(rim) - middle) < 0 ? Vec3(-normal)
                                                                                             : normal);
            }
            if (count < 3 || tubes.size() < 2) continue;
            std::pair<std::size_t, std::size_t> best;
            double least = 2;
            for (std::size_t j = 1; j < tubes.size(); ++j)
                for (std::size_t i = 0; i < j; ++i)
                    if (const double dot = tubes[i].second.dot(tubes[j].second); dot < least) {
                        least = dot;
                        best = {tubes[i].first, tubes[j].first};
                    }
            result_.mouths.erase(result_.mouths.begin() + static_cast<std::ptrdiff_t>(best.second));
            result_.mouths.erase(result_.mouths.begin() + static_cast<std::ptrdiff_t>(best.first));
            return true;
        }
        return false;
    }

    /// Decide which side of a mouth is the main body. @return false if the line is not a mouth.
    bool set_sides(Mouth& mouth)
    {
        std::tie(mouth.host, mouth.branch) = regions_beside(mouth);
        if (mouth.host == mouth.branch) return false;
        const auto worth = [&](std::size_t region) {
            const bool source = std::ranges::any_of(result_.faces[region], [&](FaceId face) {
                return volume_.role[face.index()] == Role::source;
            });
            return std::pair(std::min<std::size_t>(result_.ends[region].size(), 2), source);
        };
        if (worth(mouth.host) < worth(mouth.branch)) std::swap(mouth.host, mouth.branch);
        if (result_.ends[mouth.host].size() < 2) return false;
        const std::vector<Vec3> rim = places(model_, mouth.edges);
        const Vec3 centre = geometry::centre_of_ring(rim);
        const Vec3 normal = geometry::newell_vector(rim).normalized();
        // If the normal of the line is parallel to the main body's axis, the section of the body changes
        // there; the line is not a mouth.
        const std::vector<Vec3>& ends = result_.ends[mouth.host];
        const Vec3 way = ends.back() - ends.front();
        // A smooth ring may also be a shoulder of the main body. Without its axis this is not decided.
        if (ends.size() != 2 && !mouth.beyond.empty()) return false;
        if (ends.size() == 2 && way.cross(normal).norm() < kAlongAxis * way.norm()) return false;
        if (!result_.ends[mouth.branch].empty()) return true;
        // A shallow dimple counts as part of the wall.
        double width = 0, depth = 0;
        for (const Vec3& p : rim) width = std::max(width, (p - centre).norm());
        for (const FaceId face : result_.faces[mouth.branch])
            for (const Index p : corners_of(model_[face]))
                depth = std::max(depth, std::abs((model_.at(p) - centre).dot(normal)));
        return depth > width / 2;
    }

    const OpenVolume& volume_;
    const Model& model_;
    const RunContext& context_;
    std::vector<FaceId> ends_;  ///< faces of source and target
    std::vector<double> turns_; ///< `concave_turns()` of the edges
    Branching result_;
};

} // namespace

Branching find_mouths(const OpenVolume& volume, const RunContext& context)
{
    return BranchFinder(volume, context).run();
}

} // namespace lacuna::closure
