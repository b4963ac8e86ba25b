// SPDX-License-Identifier: MIT
//
// Meshes of millions of cells have a hundred thousand quads on their skin, each with four points to compare.
// The usual point must therefore cost only a few operations. Neighbouring quads have neighbouring numbers, so
// the facet below the last point, or an adjacent facet, is usually below the next point too (`FacetWalk`).
// Likewise, the quad nearest to one point of a facet is usually nearest to the next point. Such an answer is
// used only if it is certain; otherwise a tree is searched.
#include <lacuna/sweep/detail/compare_face.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/core/shared/parallel.h>
#include <lacuna/geometry/shared/facet_tree.h>
#include <lacuna/geometry/shared/tips.h>
#include <lacuna/mesh/shared/incidence.h>
#include <lacuna/sweep/detail/facet_walk.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace lacuna::sweep {

namespace {

/// A point of one skin and its distance from the other.
struct Sample {
    Vec3 point = Vec3::Zero();
    double area = 0;      ///< area that it represents
    double side = 0;      ///< length of the quads' sides there; the allowed distance is proportional to it
    std::size_t quad = 0; ///< index of the quad in the patch
    double distance = 0;
    bool turned = false; ///< the quad there has the opposite orientation of the face
};

/// Statistics of many samples.
struct Tally {
    double area = 0, sum = 0;
    double max_distance = -1;
    Vec3 place = Vec3::Zero();
    /// The sample that exceeds its allowed distance by the largest factor; a turned sample takes precedence.
    Sample worst;
    double allowed = 0; ///< allowed distance at that sample

    void add(const Sample& sample, double most)
    {
        add_distance(sample.area, sample.area * sample.distance, sample.distance, sample.point);
        keep_worst(sample, most);
    }
    /// Add the samples of a later block.
    void add(const Tally& later)
    {
        add_distance(later.area, later.sum, later.max_distance, later.place);
        if (later.allowed > 0) keep_worst(later.worst, later.allowed);
    }

private:
    void add_distance(double more_area, double more, double distance, const Vec3& at)
    {
        area += more_area;
        sum += more;
        if (distance <= max_distance) return;
        max_distance = distance;
        place = at;
    }
    void keep_worst(const Sample& sample, double most)
    {
        if (worst.turned) return;
        if (!sample.turned && allowed > 0 && sample.distance * allowed <= worst.distance * most) return;
        worst = sample;
        allowed = most;
    }
};

/// A quad divided into triangles.
struct QuadFacets {
    std::array<std::array<Vec3, 3>, 4> corners;
    std::size_t count = 0;
};

QuadFacets facets_of(const std::array<Vec3, 4>& c)
{
    if (c[2] == c[3]) return {{{{c[0], c[1], c[2]}}}, 1}; // a triangle
    const Vec3 one = (c[0] + c[2]) / 2, other = (c[1] + c[3]) / 2;
    if ((one - other).squaredNorm() < kVisible * kVisible * (c[2] - c[0]).squaredNorm())
        return {{{{c[0], c[1], c[2]}, {c[0], c[2], c[3]}}}, 2};
    QuadFacets facets;
    for (std::size_t k = 0; k < 4; ++k) facets.corners[k] = {c[k], c[(k + 1) % 4], (one + other) / 2};
    facets.count = 4;
    return facets;
}

/// Comparison of one face with its quads.
class Comparison {
public:
    Comparison(const mesh::HexMesh* mesh, const Skin& skin, const SkinOfFace& quads, surface::FaceShape shape,
               double sign, const DeviationLimit& limit, const RunContext& context)
        : mesh_(mesh),
          skin_(skin),
          quads_(quads.quads),
          item_(quads.item),
          side_(quads.side),
          shape_(std::move(shape)),
          face_tree_(shape_.points, shape_.triangles, context),
          sign_(sign),
          limit_(limit),
          context_(context)
    {
        result_.face = quads.face;
        result_.quads = quads_.size();
        number_nodes();
    }

    FaceFidelity run()
    {
        for (const Index p : geometry::find_tips(shape_.points, shape_.triangles))
            tips_.push_back(shape_.points[index(p)]);
        const FacetWalk walk(shape_.points, shape_.triangles);
        std::vector<Index> facet_of_centre(quads_.size(), -1);
        take(compare_nodes(walk));
        take(in_blocks(quads_.size(), [&](std::size_t q, Tally& tally) {
            facet_of_centre[q] = compare_quad(walk, q, tally);
        }));
        compare_facets(walk, facet_of_centre);
        if (result_.misfit == Misfit::cut) tell_straight_from_cut();
        return result_;
    }

private:
    /// Number the nodes of the quads from 0, in their order: the work does not grow with the whole skin.
    void number_nodes()
    {
        std::vector<Index> used;
        for (const Quad& quad : quads_) used.insert(used.end(), quad.begin(), quad.end());
        std::ranges::sort(used);
        used.erase(std::ranges::unique(used).begin(), used.end());
        for (const Index n : used) points_.push_back(skin_.points[index(n)]);
        for (Quad& quad : quads_)
            for (Index& n : quad) n = static_cast<Index>(std::ranges::lower_bound(used, n) - used.begin());
    }
    [[nodiscard]] const Vec3& node(Index n) const { return points_[index(n)]; }
    [[nodiscard]] std::array<Vec3, 4> corners(std::size_t quad) const
    {
        const Quad& q = quads_[quad];
        return {node(q[0]), node(q[1]), node(q[2]), node(q[3])};
    }

    // --- quads against the face -----------------------------------------------------------------------

    /// Compare each node once. The sample has the data of the first quad with this node.
    Tally compare_nodes(const FacetWalk& walk)
    {
        facet_of_node_.assign(points_.size(), -1);
        std::vector<std::pair<Index, Index>> first; // node, quad
        std::vector<bool> seen(points_.size(), false);
        for (std::size_t q = 0; q < quads_.size(); ++q) {
            for (const Index n : quads_[q]) {
                if (seen[index(n)]) continue;
                seen[index(n)] = true;
                first.emplace_back(n, static_cast<Index>(q));
            }
        }
        return in_blocks(first.size(), [&](std::size_t i, Tally& tally) {
            const auto [n, q] = first[i];
            const Index hint = i % kPerTask == 0 ? -1 : facet_of_node_[index(first[i - 1].first)];
            facet_of_node_[index(n)] = add_compared(walk, hint, Vec3::Zero(),
                                                    {node(n), 0, side_[index(q)], index(q)}, tally);
        });
    }

    /// Compare a quad's centre and the midpoints of its sides. A midpoint between two patches is compared in
    /// one of them only. @return  the facet nearest to the centre
    Index compare_quad(const FacetWalk& walk, std::size_t q, Tally& tally) const
    {
        const Quad& quad = quads_[q];
        const std::array<Vec3, 4> c = corners(q);
        const Vec3 across = (c[2] - c[0]).cross(c[3] - c[1]) / 2;
        const double area = across.norm();
        for (std::size_t k = 0; k < 4; ++k) {
            if (quad[k] >= quad[(k + 1) % 4]) continue;
            const Vec3 &a = c[k], &b = c[(k + 1) % 4];
            add_compared(walk, facet_of_node_[index(quad[k])], Vec3::Zero(),
                         {(a + b) / 2, area / 4, (b - a).norm(), q}, tally);
        }
        const Vec3 centre = mesh::is_triangle(quad) ? Vec3((c[0] + c[1] + c[2]) / 3)
                                                    : Vec3((c[0] + c[1] + c[2] + c[3]) / 4);
        return add_compared(walk, facet_of_node_[index(quad[0])], across, {centre, area / 2, side_[q], q},
                            tally);
    }

    /// Compare a point with the face, and add it to the statistics.
    /// @param hint    a nearby facet, or -1.
    /// @param across  area vector of the quad, if its orientation is to be checked.
    /// @return  the nearest facet.
    Index add_compared(const FacetWalk& walk, Index hint, const Vec3& across, Sample sample,
                       Tally& tally) const
    {
        std::size_t facet = 0;
        const auto foot = walk.over(sample.point, hint);
        if (foot && foot->nearest && std::abs(foot->height) < kFollowsFace * sample.side) {
            facet = index(foot->facet);
            const Vec3 bulge = shape_.bulge_at(facet, foot->barycentric);
            sample.distance = std::abs(foot->height - walk.normal(foot->facet).dot(bulge));
        } else {
            const double reach = foot ? std::abs(foot->height) : kInfinity;
            sample.distance = distance_to_face(sample.point, facet, reach);
        }
        // If the point is far from the face, as on a long quad in a bend, the nearest facet may belong to an
        // opposite part of the face. The orientation of that facet then proves nothing, so it is not checked.
        const auto found = static_cast<Index>(facet);
        sample.turned = limit_.folds && sample.distance * sample.side < kFollowsFace * across.norm() &&
                        sign_ * across.dot(walk.normal(found)) < 0;
        tally.add(sample, allowed(sample));
        return found;
    }

    /// Distance of a point from the face; `facet` becomes the nearest facet.
    /// @param reach  some facet is known to be within this distance.
    [[nodiscard]] double distance_to_face(const Vec3& point, std::size_t& facet,
                                          double reach = kInfinity) const
    {
        auto hit = face_tree_.closest(point, reach * reach);
        // The point may lie just outside the reach by rounding.
        if (hit.triangle < 0) hit = face_tree_.closest(point);
        facet = index(hit.triangle);
        // Beside a facet, the distance is to the exact edge, so the whole bulge counts, unless the point lies
        // between the facet and this edge. There, as above a facet, only the component of the bulge along the
        // normal of the facet counts.
        const Vec3 bulge = shape_.bulge_at(facet, hit.barycentric), normal = shape_.normal(facet),
                   off = point - hit.point, above = bulge.dot(normal) * normal, beside = bulge - above;
        double share = 0;
        if (hit.barycentric.minCoeff() <= 0 && beside.squaredNorm() > 0) {
            share = off.dot(beside) / beside.squaredNorm();
            if (share < 0 || share > 1) share = 1;
        }
        return (off - above - share * beside).norm();
    }

    // --- the face against the quads -------------------------------------------------------------------

    /// A point of the face for which no nearby quad is certainly the nearest one.
    struct Left {
        Vec3 point;
        double area = 0;
    };

    /// Compare the face with the quads at the corners of its facets and, on the exact face, at the midpoints
    /// of their sides and at their centres.
    void compare_facets(const FacetWalk& walk, const std::vector<Index>& facet_of_centre)
    {
        const mesh::Incidence over = mesh::incidence(walk.size(), [&](const auto& visit) {
            for (std::size_t q = 0; q < facet_of_centre.size(); ++q)
                visit(index(facet_of_centre[q]), static_cast<Index>(q));
        });
        const std::vector<Index> nearest = nearest_with_quads(walk, over);
        const mesh::Incidence round = mesh::quads_at_nodes(quads_, points_.size());
        std::vector<Index> facet_at(shape_.points.size(), -1);
        for (std::size_t i = 0; i < shape_.triangles.size(); ++i) {
            for (const Index p : shape_.triangles[i]) {
                if (facet_at[index(p)] < 0) facet_at[index(p)] = static_cast<Index>(i);
            }
        }
        std::vector<std::vector<Left>> left((walk.size() + kPerTask - 1) / kPerTask);
        take(in_blocks(walk.size(), [&](std::size_t i, Tally& tally) {
            const Triangle& t = shape_.triangles[i];
            const std::array<Vec3, 3> c{shape_.points[index(t[0])], shape_.points[index(t[1])],
                                        shape_.points[index(t[2])]};
            const std::span<const Index> near = over.of(index(nearest[i]));
            const auto compare = [&](const Vec3& point, double area) {
                const auto sample = compare_near(round, point, area, nearest_of(near, point));
                if (sample)
                    tally.add(*sample, allowed(*sample));
                else
                    left[i / kPerTask].push_back({point, area});
            };
            for (std::size_t k = 0; k < 3; ++k) {
                if (facet_at[index(t[k])] == static_cast<Index>(i)) compare(c[k], 0);
            }
            const double area = (c[1] - c[0]).cross(c[2] - c[0]).norm() / 2;
            for (const Vec3& w :
                 {Vec3(1. / 3, 1. / 3, 1. / 3), Vec3(.5, .5, 0), Vec3(0, .5, .5), Vec3(.5, 0, .5)}) {
                const Vec3 flat = w[0] * c[0] + w[1] * c[1] + w[2] * c[2];
                compare(flat + shape_.bulge_at(i, w), area / 4);
            }
        }));
        compare_left(left);
    }

    /// Compare the remaining points, using a tree of all quads.
    void compare_left(const std::vector<std::vector<Left>>& left)
    {
        std::vector<Left> rest;
        for (const std::vector<Left>& some : left) rest.insert(rest.end(), some.begin(), some.end());
        if (rest.empty()) return;
        const QuadTree tree = tree_of_quads();
        take(in_blocks(rest.size(), [&](std::size_t i, Tally& tally) {
            add_compared(tree, rest[i].point, rest[i].area, tally);
        }));
    }

    /// For each facet, the nearest facet above which there are centres of quads.
    [[nodiscard]] static std::vector<Index> nearest_with_quads(const FacetWalk& walk,
                                                               const mesh::Incidence& over)
    {
        std::vector<Index> near(walk.size(), -1), front;
        for (std::size_t i = 0; i < walk.size(); ++i) {
            if (over.of(i).empty()) continue;
            near[i] = static_cast<Index>(i);
            front.push_back(near[i]);
        }
        for (std::size_t i = 0; i < front.size(); ++i) {
            for (const Index next : walk.across(front[i])) {
                if (next < 0 || near[index(next)] >= 0) continue;
                near[index(next)] = near[index(front[i])];
                front.push_back(next);
            }
        }
        // A component of the face without quads gets any facet that has quads.
        for (Index& facet : near) facet = facet < 0 ? front.front() : facet;
        return near;
    }

    /// The quad of a list that is nearest to a point. At most `kFineChords` quads, at even steps of the list,
    /// are compared.
    [[nodiscard]] std::size_t nearest_of(std::span<const Index> quads, const Vec3& point) const
    {
        const std::size_t step = (quads.size() + kFineChords - 1) / kFineChords;
        double best = kInfinity;
        Index nearest = quads.front();
        for (std::size_t i = 0; i < quads.size(); i += step) {
            const double found = (node(quads_[index(quads[i])][0]) - point).squaredNorm();
            if (found >= best) continue;
            best = found;
            nearest = quads[i];
        }
        return index(nearest);
    }

    /// Upper bound of the distance from a point to the quads, found by walking from quad to quad. Empty if
    /// the bound is large.
    /// @param quad  the quad where the walk starts.
    [[nodiscard]] std::optional<Sample> compare_near(const mesh::Incidence& round, const Vec3& point,
                                                     double area, std::size_t quad) const
    {
        quad = walk_across(round, point, quad);
        bool over = false;
        double best = distance2_to_quad(point, quad, over);
        for (bool moved = !over && best > 0; moved;) {
            moved = false;
            for (const Index n : Quad(quads_[quad])) {
                for (const Index other : round.of(index(n))) {
                    if (index(other) == quad || distance2_to_box(point, index(other)) >= best) continue;
                    const double found = distance2_to_quad(point, index(other), over);
                    if (found >= best) continue;
                    best = found;
                    quad = index(other);
                    moved = true;
                }
            }
        }
        const Sample sample{point, area, side_[quad], quad, std::sqrt(best)};
        if (sample.distance > kFollowsFace * sample.side) return std::nullopt;
        return sample;
    }

    /// Walk to the quad below a point. Each step crosses the side beyond which the point lies farthest.
    [[nodiscard]] std::size_t walk_across(const mesh::Incidence& round, const Vec3& point,
                                          std::size_t quad) const
    {
        for (int step = 0; step < kMostRounds; ++step) {
            const Quad& q = quads_[quad];
            const std::array<Vec3, 4> c = corners(quad);
            const Vec3 across = (c[2] - c[0]).cross(c[3] - c[1]);
            double furthest = 0;
            std::size_t beyond = 4;
            for (std::size_t k = 0; k < 4; ++k) {
                const double inside = (c[(k + 1) % 4] - c[k]).cross(point - c[k]).dot(across);
                if (inside >= furthest) continue;
                furthest = inside;
                beyond = k;
            }
            if (beyond == 4) break;
            const Index from = q[beyond], to = q[(beyond + 1) % 4];
            std::size_t next = quad;
            for (const Index other : round.of(index(from))) {
                const Quad& o = quads_[index(other)];
                if (index(other) != quad && std::ranges::find(o, to) != o.end()) next = index(other);
            }
            if (next == quad) break;
            quad = next;
        }
        return quad;
    }

    [[nodiscard]] double distance2_to_box(const Vec3& point, std::size_t quad) const
    {
        Eigen::AlignedBox3d box;
        for (const Vec3& corner : corners(quad)) box.extend(corner);
        return box.squaredExteriorDistance(point);
    }

    /// @param over  output: whether the point is nearer to its foot point than the foot point is to the
    ///         quad's sides. If so, no other quad is nearer, unless the skin folds back within that distance.
    [[nodiscard]] double distance2_to_quad(const Vec3& point, std::size_t quad, bool& over) const
    {
        const std::array<Vec3, 4> c = corners(quad);
        const QuadFacets facets = facets_of(c);
        geometry::FacetTree::Hit best;
        for (std::size_t i = 0; i < facets.count; ++i) {
            const auto hit = geometry::closest_on_triangle(point, facets.corners[i]);
            if (hit.distance2 < best.distance2) best = hit;
        }
        over = true;
        for (std::size_t k = 0; k < 4; ++k) {
            const Vec3 side = c[(k + 1) % 4] - c[k];
            over = over && best.distance2 * side.squaredNorm() < side.cross(best.point - c[k]).squaredNorm();
        }
        return best.distance2;
    }

    // --- quads in a tree ------------------------------------------------------------------------------

    struct QuadTree {
        geometry::FacetTree tree;
        std::vector<std::size_t> quad; ///< quad of each triangle in the tree
    };

    [[nodiscard]] QuadTree tree_of_quads() const
    {
        std::vector<Vec3> points;
        std::vector<Triangle> triangles;
        QuadTree result;
        for (std::size_t q = 0; q < quads_.size(); ++q) {
            const QuadFacets facets = facets_of(corners(q));
            for (std::size_t i = 0; i < facets.count; ++i) {
                const auto first = static_cast<Index>(points.size());
                triangles.push_back({first, first + 1, first + 2});
                points.insert(points.end(), facets.corners[i].begin(), facets.corners[i].end());
                result.quad.push_back(q);
            }
        }
        result.tree = geometry::FacetTree(points, triangles, context_);
        return result;
    }

    void add_compared(const QuadTree& tree, const Vec3& point, double area, Tally& tally) const
    {
        const auto hit = tree.tree.closest(point);
        const std::size_t quad = tree.quad[index(hit.triangle)];
        const Sample sample{point, area, side_[quad], quad, std::sqrt(hit.distance2)};
        tally.add(sample, allowed(sample));
    }

    // --- statistics and result ------------------------------------------------------------------------

    /// Call `body(i, tally)` for all numbers `i` below `count`, in blocks. The sums of blocks are added in
    /// order, so that the result does not depend on the number of threads.
    template <class Body>
    Tally in_blocks(std::size_t count, const Body& body) const
    {
        std::vector<Tally> tallies((count + kPerTask - 1) / kPerTask);
        parallel_for(context_, count, kPerTask, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) body(i, tallies[i / kPerTask]);
        });
        Tally all;
        for (const Tally& tally : tallies) all.add(tally);
        return all;
    }

    /// Allowed distance of a sample. It is larger around a tip.
    [[nodiscard]] double allowed(const Sample& sample) const
    {
        constexpr double kReach = 2; // sides from the tip, see `DeviationLimit::share`
        const bool at_tip = limit_.length == 0 && std::ranges::any_of(tips_, [&](const Vec3& tip) {
                                return (sample.point - tip).norm() < kReach * sample.side;
                            });
        const double by_side = at_tip ? sample.side : limit_.share * sample.side;
        return (limit_.length > 0 ? limit_.length : std::max(by_side, limit_.least)) + shape_.slack;
    }

    void take(const Tally& tally)
    {
        if (tally.max_distance > result_.max_distance) {
            result_.max_distance = tally.max_distance;
            result_.place = tally.place;
        }
        if (tally.area > 0) result_.mean_distance = std::max(result_.mean_distance, tally.sum / tally.area);
        const Sample& worst = tally.worst;
        if (tally.allowed == 0 || result_.misfit == Misfit::folded) return;
        const bool worse = worst.distance * result_.allowed > result_.found * tally.allowed;
        if (!worst.turned && !worse && result_.allowed > 0) return;
        result_.found = worst.distance;
        result_.allowed = tally.allowed;
        result_.found_at = worst.point;
        result_.side = worst.side;
        worst_ = worst.quad;
        if (worst.turned)
            result_.misfit = Misfit::folded;
        else if (worst.distance > tally.allowed)
            result_.misfit = Misfit::cut;
    }

    /// Decide whether curvature or misplaced nodes cause a deviation. If the nodes of a quad lie on the face,
    /// only the curvature of the face between them can be the cause.
    void tell_straight_from_cut()
    {
        const Quad& quad = quads_[worst_];
        std::size_t facet = 0;
        double most = 0;
        for (std::size_t k = 0; k < 4; ++k) {
            const Vec3 &a = node(quad[k]), &b = node(quad[(k + 1) % 4]);
            if (distance_to_face(a, facet) > result_.allowed) return;
            const double sag = distance_to_face((a + b) / 2, facet);
            if (sag <= most) continue;
            most = sag;
            result_.side = result_.source_side = (b - a).norm();
            if (mesh_ == nullptr) continue;
            // Find the side of the mesh's quad that deviates. At order 2, the compared quad is a quarter of
            // the mesh's quad. If the deviating side of the compared quad is half of a side of the mesh's
            // quad, take that side; otherwise take the parallel side of the mesh's quad.
            const Index row = mesh_->nodes_per_layer;
            const std::size_t own = mesh_->order() == 1 ? k : (worst_ + 3 * (k % 2)) % 4;
            const Quad whole = mesh::skin_quad(*mesh_, item_[worst_]).nodes;
            const Index from = whole[own], to = whole[(own + 1) % 4];
            result_.source_side = (skin_.points[index(to % row)] - skin_.points[index(from % row)]).norm();
            result_.along_layers = from / row != to / row;
        }
        if (2 * most >= result_.found) result_.misfit = Misfit::straight;
    }

    const mesh::HexMesh* mesh_;
    const Skin& skin_;
    std::vector<Quad> quads_;  ///< corners are indices of `points_`
    std::vector<Vec3> points_; ///< the nodes of the quads
    const std::vector<std::size_t>& item_;
    const std::vector<double>& side_;
    surface::FaceShape shape_;
    geometry::FacetTree face_tree_;
    double sign_;
    DeviationLimit limit_;
    const RunContext& context_;

    std::vector<Vec3> tips_;
    std::vector<Index> facet_of_node_; ///< nearest to each node of the patch
    FaceFidelity result_;
    std::size_t worst_ = 0;
};

} // namespace

FaceFidelity compare_face(const mesh::HexMesh* mesh, const Skin& skin, const SkinOfFace& quads,
                          surface::FaceShape shape, double sign, const DeviationLimit& limit,
                          const RunContext& context)
{
    return Comparison(mesh, skin, quads, std::move(shape), sign, limit, context).run();
}

} // namespace lacuna::sweep
