// SPDX-License-Identifier: MIT
#include <lacuna/surface/detail/raise_quads.h>

#include <lacuna/core/shared/constants.h>
#include <lacuna/geometry/shared/facet_tree.h>
#include <lacuna/geometry/shared/pattern_search.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/mesh/shared/incidence.h>
#include <lacuna/surface/shared/edge_nodes.h>
#include <lacuna/surface/shared/projector.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

namespace lacuna::surface {

using namespace topology;

namespace {

/// Quads with a smaller scaled Jacobian are improved. Even coarse meshes reach this value, unless corners
/// prevent it.
constexpr double kGoodEnough = 0.6;
/// Maximum number of passes over the nodes. A pass without a gain is the last.
constexpr int kRounds = 20;
/// Step sizes of the search relative to the shortest side at the node, and the minimum gain of a step, as in
/// quads/smooth_plane.cpp. Heuristic.
constexpr double kFirst = 1.0 / 4, kLast = 1.0 / 300, kLeastGain = 1e-3;
/// A node whose total gain is smaller is moved back. Next to a sharp corner, tiny gains degrade the
/// surrounding quads: in one case the minimum rose by 0.0001, while the mean fell from 0.943 to 0.927.
/// Heuristic.
constexpr double kWorthIt = 0.02;
/// Minimum distance of a node from its neighbours on an edge, as a share of their distance. Heuristic.
constexpr double kApart = 0.1;
/// No side at a node becomes shorter than this share of the shortest original side there. Without this bound,
/// maximizing sines shrinks quads to needles. Heuristic.
constexpr double kShortest = 0.5;

class Raiser {
public:
    Raiser(mesh::QuadMesh& mesh, const Model& model, const NodeFreedom& freedom, const RunContext& context)
        : mesh_(mesh), nodes_(mesh.nodes), model_(model), freedom_(freedom), context_(context)
    {
    }

    std::map<EdgeId, std::vector<double>> run()
    {

        home_.resize(nodes_.size());
        for (std::size_t e = 0; e < freedom_.edges.size(); ++e) {
            const NodeFreedom::OnEdge& own = freedom_.edges[e];
            at_.push_back(own.at);
            for (std::size_t i = 1; i + 1 < own.nodes.size(); ++i)
                home_[index(own.nodes[i])] = {Home::Kind::edge, e, i};
        }
        for (std::size_t f = 0; f < freedom_.faces.size(); ++f) {
            for (Index p = freedom_.faces[f].first; p < freedom_.faces[f].last; ++p)
                home_[index(p)] = {Home::Kind::face, f, 0};
        }
        lines_.resize(freedom_.edges.size());
        grounds_.resize(freedom_.faces.size());
        quads_at_ = mesh::quads_at_nodes(mesh_.quads, nodes_.size());
        restless_.assign(nodes_.size(), 1);
        for (std::size_t p = 0; p < nodes_.size(); ++p) least_side_.push_back(kShortest * shortest_side(p));
        const std::vector<Vec3> before = nodes_;
        for (int round = 0; round < kRounds; ++round) {
            check_cancelled(context_);
            if (!raise_round()) break;
        }
        return settle(before);
    }

private:
    struct Home {
        enum class Kind { fixed, edge, face } kind = Kind::fixed;
        std::size_t number = 0; ///< index in the edges or faces of `NodeFreedom`
        std::size_t place = 0;  ///< position on the edge
    };
    struct Line {
        std::vector<Vec3> points;
        std::vector<double> arc;
    };
    /// The facets on which a node of a face moves; none for a plane.
    using Ground = std::optional<geometry::FacetTree>;

    [[nodiscard]] Vec3 area_of(std::size_t q) const
    {
        const Quad& quad = mesh_.quads[q];
        return (nodes_[index(quad[2])] - nodes_[index(quad[0])])
            .cross(nodes_[index(quad[3])] - nodes_[index(quad[1])]);
    }

    /// The sine of a corner, negative if it is inverted.
    [[nodiscard]] double sine(const Quad& quad, std::size_t k, const Vec3& normal) const
    {
        const Vec3& p = nodes_[index(quad[k])];
        const Vec3 a = nodes_[index(quad[(k + 1) % 4])] - p, b = nodes_[index(quad[(k + 3) % 4])] - p;
        const Vec3 cross = a.cross(b);
        const double both = std::sqrt(a.squaredNorm() * b.squaredNorm());
        return both > 0 ? std::copysign(cross.norm() / both, cross.dot(normal)) : -1;
    }

    [[nodiscard]] double least_sine(std::size_t q, const Vec3& normal) const
    {
        double least = 1;
        for (std::size_t k = 0; k < 4; ++k) least = std::min(least, sine(mesh_.quads[q], k, normal));
        return least;
    }

    [[nodiscard]] bool is_poor(std::size_t q) const
    {
        return !mesh::is_triangle(mesh_.quads[q]) && least_sine(q, area_of(q)) < kGoodEnough;
    }

    /// The quads at a node, each with the face normal there.
    struct Star {
        std::vector<std::size_t> quads;
        std::vector<Vec3> normals;
        double shortest = 0; ///< shortest side at the node
    };

    /// The shortest of the sides at a node.
    [[nodiscard]] double shortest_side(std::size_t p) const
    {
        double shortest = kInfinity;
        for (const Index q : quads_at_.of(p)) {
            const Quad& quad = mesh_.quads[index(q)];
            const auto k = static_cast<std::size_t>(std::ranges::find(quad, static_cast<Index>(p)) -
                                                    quad.begin());
            for (const std::size_t next : {(k + 1) % 4, (k + 3) % 4})
                shortest = std::min(shortest, (nodes_[index(quad[next])] - nodes_[p]).norm());
        }
        return shortest;
    }

    [[nodiscard]] std::optional<Star> star_of(std::size_t p) const
    {
        Star star;
        star.shortest = shortest_side(p);
        std::map<Index, Vec3> of_face;
        for (const Index q : quads_at_.of(p)) {
            const Quad& quad = mesh_.quads[index(q)];
            if (mesh::is_triangle(quad)) return {};
            star.quads.push_back(index(q));
            of_face.try_emplace(mesh_.face[index(q)], Vec3::Zero()).first->second += area_of(index(q));
        }
        for (const std::size_t q : star.quads) star.normals.push_back(of_face.at(mesh_.face[q]));
        return star;
    }

    [[nodiscard]] double worst_of(const Star& star) const
    {
        double worst = 1;
        for (std::size_t i = 0; i < star.quads.size(); ++i)
            worst = std::min(worst, least_sine(star.quads[i], star.normals[i]));
        return worst;
    }

    /// Whether a node keeps its minimum distance from its neighbours.
    [[nodiscard]] bool keeps_apart(std::size_t p) const { return shortest_side(p) >= least_side_[p]; }

    bool raise_round()
    {
        std::set<std::size_t> poor;
        for (std::size_t q = 0; q < mesh_.quads.size(); ++q) {
            if (!is_poor(q)) continue;
            for (const Index p : mesh_.quads[q]) {
                if (home_[index(p)].kind != Home::Kind::fixed && restless_[index(p)] != 0)
                    poor.insert(index(p));
            }
        }
        bool moved = false;
        for (const std::size_t p : poor) {
            restless_[p] = 0;
            const std::optional<Star> star = star_of(p);
            if (!star || !(star->shortest > 0)) continue;
            const bool better = home_[p].kind == Home::Kind::edge ? slide(p, *star) : move(p, *star);
            if (!better) continue;
            moved = true;
            for (const std::size_t q : star->quads) {
                for (const Index n : mesh_.quads[q]) restless_[index(n)] = 1;
            }
        }
        return moved;
    }

    [[nodiscard]] const Line& line_of(std::size_t e)
    {
        if (lines_[e].points.empty()) {
            lines_[e].points = edge_line(model_, freedom_.edges[e].edge);
            lines_[e].arc = geometry::arc_lengths(lines_[e].points);
        }
        return lines_[e];
    }

    /// Move a node to a position where the worst quad around it is better. @return  whether it moved
    /// @param place  moves the node by an offset from its original position [model length]. It returns false
    ///         if the node may not be there.
    template <class Place>
    bool search(std::size_t p, const Star& star, std::span<const Vec2> directions, const Place& place)
    {
        const double before = worst_of(star);
        const auto value = [&](const Vec2& to, double /*floor*/) {
            return place(to) && keeps_apart(p) ? worst_of(star) : -kInfinity;
        };
        Vec2 at(0, 0);
        const geometry::PatternSteps steps{star.shortest, kFirst, kLast, kLeastGain};
        const bool better = geometry::pattern_search(at, before, steps, value, directions) >
                            before + kWorthIt;
        place(better ? at : Vec2::Zero());
        return better;
    }

    /// Move a node along its edge. @return whether it moved
    bool slide(std::size_t p, const Star& star)
    {
        static const std::array<Vec2, 2> kBothWays{Vec2(-1, 0), Vec2(1, 0)};
        const Line& line = line_of(home_[p].number);
        std::vector<double>& at = at_[home_[p].number];
        const std::size_t i = home_[p].place;
        const double start = at[i], low = at[i - 1] + kApart * (start - at[i - 1]),
                     high = at[i + 1] - kApart * (at[i + 1] - start), length = line.arc.back();
        const Vec3 old = nodes_[p];
        return search(p, star, kBothWays, [&](const Vec2& to) {
            at[i] = start + to.x() / length;
            nodes_[p] = to.x() == 0 ? old : geometry::point_at(line.points, line.arc, at[i] * length);
            return at[i] >= low && at[i] <= high;
        });
    }

    [[nodiscard]] const Ground& ground_of(std::size_t f)
    {
        Ground& ground = grounds_[f];
        const Face& face = model_[freedom_.faces[f].face];
        if (face.kind != "plane" && !ground) ground.emplace(model_.points, face.triangles);
        return ground;
    }

    /// Move a node on its face. @return whether it moved
    bool move(std::size_t p, const Star& star)
    {
        const Ground& ground = ground_of(home_[p].number);
        const Vec3 normal = star.normals.front().stableNormalized();
        if (!(normal.squaredNorm() > 0)) return false;
        const Vec3 u = normal.unitOrthogonal(), v = normal.cross(u), start = nodes_[p];
        return search(p, star, geometry::all_around(), [&](const Vec2& to) {
            nodes_[p] = start + to.x() * u + to.y() * v;
            if (ground && to != Vec2::Zero()) nodes_[p] = ground->closest(nodes_[p]).point;
            return true;
        });
    }

    /// Project the moved nodes onto the exact edges and faces. If the worst quad around them is then worse
    /// than at the beginning, undo all moves.
    std::map<EdgeId, std::vector<double>> settle(const std::vector<Vec3>& before)
    {
        std::map<EdgeId, std::vector<double>> moved;
        for (std::size_t e = 0; e < freedom_.edges.size(); ++e) {
            const NodeFreedom::OnEdge& own = freedom_.edges[e];
            if (at_[e] == own.at) continue;
            const std::vector<Vec3> points = edge_points(model_, own.edge, at_[e]);
            for (std::size_t i = 1; i + 1 < own.nodes.size(); ++i) {
                if (at_[e][i] != own.at[i]) nodes_[index(own.nodes[i])] = points[i];
            }
            moved[own.edge] = at_[e];
        }
        for (const NodeFreedom::OnFace& own : freedom_.faces) {
            if (model_[own.face].surface == nullptr || model_[own.face].kind == "plane") continue;
            std::vector<Index> which;
            std::vector<Vec3> points;
            for (Index p = own.first; p < own.last; ++p) {
                if (nodes_[index(p)] == before[index(p)]) continue;
                which.push_back(p);
                points.push_back(nodes_[index(p)]);
            }
            if (points.empty()) continue;
            Projector(model_, {own.face}).project(points, context_);
            for (std::size_t i = 0; i < which.size(); ++i) nodes_[index(which[i])] = points[i];
        }
        const std::vector<Vec3> after = nodes_;
        const double now = worst_moved(before, after);
        nodes_ = before;
        const double was = worst_moved(before, after);
        if (now < was) return {};
        nodes_ = after;
        return moved;
    }

    /// The smallest sine in quads with a moved node, at the current positions.
    [[nodiscard]] double worst_moved(const std::vector<Vec3>& before, const std::vector<Vec3>& after) const
    {
        double worst = 1;
        for (std::size_t q = 0; q < mesh_.quads.size(); ++q) {
            const Quad& quad = mesh_.quads[q];
            if (mesh::is_triangle(quad) ||
                std::ranges::none_of(quad, [&](Index p) { return before[index(p)] != after[index(p)]; }))
                continue;
            worst = std::min(worst, least_sine(q, area_of(q)));
        }
        return worst;
    }

    mesh::QuadMesh& mesh_;
    std::vector<Vec3>& nodes_;
    const Model& model_;
    const NodeFreedom& freedom_;
    const RunContext& context_;
    std::vector<Home> home_;
    std::vector<std::vector<double>> at_; ///< positions of the nodes on each edge, as fractions
    std::vector<Line> lines_;
    std::vector<Ground> grounds_;
    mesh::Incidence quads_at_;
    std::vector<char> restless_;     ///< nodes to be visited again
    std::vector<double> least_side_; ///< lower bound of the sides at each node
};

} // namespace

std::map<EdgeId, std::vector<double>> raise_poor_quads(mesh::QuadMesh& mesh, const Model& model,
                                                       const NodeFreedom& freedom, const RunContext& context)
{
    return Raiser(mesh, model, freedom, context).run();
}

} // namespace lacuna::surface
