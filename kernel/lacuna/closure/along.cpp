// SPDX-License-Identifier: MIT
#include <lacuna/closure/shared/along.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/number_text.h>
#include <lacuna/geometry/shared/facet_tree.h>
#include <lacuna/geometry/shared/segment.h>
#include <lacuna/geometry/shared/swept_surface.h>
#include <lacuna/topology/shared/face_parts.h>
#include <lacuna/topology/shared/face_plane.h>
#include <lacuna/topology/shared/hollows.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <utility>

namespace lacuna::closure {

using namespace topology;

namespace {

/// For each edge of `moved`: the names of the sets that contain the corresponding edge of the source.
/// @param moved  the source, moved halfway along the motion.
std::map<EdgeId, std::vector<std::string>> sets_above(const SweptSource& swept, const Model& moved)
{
    std::map<EdgeId, std::vector<std::string>> sets;
    const Eigen::Affine3d map = swept.motion->map(0.5);
    for (const auto& [edge, names] : swept.sets) {
        const std::vector<Vec3> own = places_at(swept.source.model, swept.source.model[edge].points);
        for (std::size_t e = 0; e < moved.edges.size(); ++e) {
            const std::vector<Vec3> there = places_at(moved, moved.edges[e].points);
            const bool same = there.size() == own.size() &&
                              (there.front() - map * own.front()).norm() <= moved.tolerance &&
                              (there.back() - map * own.back()).norm() <= moved.tolerance &&
                              (there[1] - map * own[1]).norm() <= moved.tolerance;
            if (same) sets[EdgeId(e)] = names;
        }
    }
    return sets;
}

/// Builds the skin of a swept source.
class AlongCloser {
public:
    AlongCloser(const SweptSource& swept, const RunContext& context)
        : swept_(swept),
          given_(swept.source.model),
          motion_(swept.motion),
          rows_(motion_->rows),
          context_(context),
          builder_(swept.source.model),
          source_points_(given_.points.size(), false)
    {
        for (const Face& face : given_.faces)
            for (const Index p : corners_of(face)) source_points_[index(p)] = true;
        for (std::size_t i = 0; i < given_.points.size(); ++i)
            if (source_points_[i]) used_.push_back(static_cast<Index>(i));
        reach_.resize(given_.points.size());
        for (const Index p : used_)
            if (motion_->reach) reach_[index(p)] = motion_->reach(given_.at(p));
    }

    Closed run()
    {
        place_points();
        for (std::size_t e = 0; e < given_.edges.size(); ++e) {
            if (!swept_.full_turn) edge_at(EdgeId(e), last());
            if (is_rim(EdgeId(e))) add_walls(EdgeId(e));
        }
        if (!swept_.full_turn) add_targets();
        builder_.build_loops(context_);
        Closed closed;
        closed.volume = swept_.source;
        closed.volume.model = std::move(builder_).finish();
        closed.volume.role.resize(closed.volume.model.faces.size(), Role::target);
        for (const FaceId wall : walls_) closed.volume.role[wall.index()] = Role::wall;
        if (swept_.full_turn) {
            closed.volume.model = extract(closed.volume.model, walls_);
            closed.volume.role.assign(walls_.size(), Role::wall);
            closed.volume.full_turn = true;
        }
        orient_skin(closed.volume.model, context_);
        check_crossings(closed.volume.model);
        Closure& closure = closed.closure;
        closure.value = VolumeClass::zero;
        closure.algorithms = {"sweep along a path"};
        list_void(closed);
        return closed;
    }

private:
    [[nodiscard]] bool is_rim(EdgeId edge) const { return given_.uses_of_edge(edge).size() == 1; }
    [[nodiscard]] std::size_t last() const { return rows_.size() - 1; }
    /// The points of the source, moved to a row of the motion.
    [[nodiscard]] std::vector<Vec3> section(std::size_t row) const
    {
        std::vector<Vec3> places = given_.points;
        const Eigen::Affine3d map = motion_->map(rows_[row]);
        for (const Index p : used_)
            places[index(p)] = motion_->reach ? Vec3(given_.at(p) + rows_[row] * reach_[index(p)])
                                              : Vec3(map * given_.at(p));
        return places;
    }

    /// Indices of the rows at a level (a break of the motion) and at the next level.
    [[nodiscard]] std::pair<std::size_t, std::size_t> rows_between(std::size_t level) const
    {
        const auto row = [&](double height) {
            return static_cast<std::size_t>(std::ranges::lower_bound(rows_, height) - rows_.begin());
        };
        return {row(motion_->levels[level]), row(motion_->levels[level + 1])};
    }

    // --- checks -------------------------------------------------------------------------------------------

    /// Check that from row to row all facets of the source move to the same side, along their normals or
    /// against them. If the sign changes, a layer folds.
    void check_advance(const std::vector<Vec3>& low, const std::vector<Vec3>& high, std::size_t row)
    {
        for (const FaceId face : all_faces(given_)) {
            for (const Triangle& t : given_[face].triangles) {
                for (const std::vector<Vec3>* section : {&low, &high}) {
                    const auto at = [&](std::size_t i) { return (*section)[index(t[i])]; };
                    const Vec3 normal = (at(1) - at(0)).cross(at(2) - at(0));
                    for (const Index p : t) {
                        const double advance = normal.dot(high[index(p)] - low[index(p)]);
                        if (sense_ == 0) sense_ = advance;
                        if (!(advance * sense_ > 0)) refuse_fold(face, low[index(p)], row);
                    }
                }
            }
        }
    }

    [[noreturn]] void refuse_fold(FaceId face, const Vec3& at, std::size_t row) const
    {
        if (motion_->reach)
            throw NotClosed(
                Message("closure.along_folds",
                        "the layers over {} would fold at {}: at most {:.3g} of the thickness fits",
                        entity_of(given_, face), place_with_digits(at, 4), found(largest_share()))
                    .remedy("use a smaller thickness"));
        Message message("closure.along_folds",
                        "the layers over {} fold at {}, at {:.3g} of the length of the path: the path bends "
                        "too sharply there for the width of the source, or runs along the source",
                        entity_of(given_, face), place_with_digits(at, 4), found(rows_[row]));
        throw NotClosed(std::move(message).remedy("use a wider bend, or a smaller source"));
    }

    /// Largest share of the requested thickness at which no facet folds, rounded down to a whole percent.
    [[nodiscard]] double largest_share() const
    {
        double share = 1;
        for (const FaceId face : all_faces(given_)) {
            for (const Triangle& t : given_[face].triangles) {
                const auto side = [&](std::size_t i) -> Vec3 { return given_.at(t[i]) - given_.at(t[0]); };
                const auto more = [&](std::size_t i) -> Vec3 {
                    return reach_[index(t[i])] - reach_[index(t[0])];
                };
                // The area at the height h, seen along the given normal, is a + b h + c h².
                const Vec3 normal = side(1).cross(side(2));
                const double a = normal.squaredNorm(), c = normal.dot(more(1).cross(more(2)));
                const double b = normal.dot(side(1).cross(more(2)) + more(1).cross(side(2)));
                const double root = b * b - 4 * a * c;
                const double falls = std::sqrt(std::max(root, 0.0)) - b; // 2 a / h at the first zero
                if (root >= 0 && falls > 0) share = std::min(share, 2 * a / falls);
            }
        }
        return std::floor(100 * share) / 100;
    }

    /// @throw NotClosed  the skin crosses itself.
    void check_crossings(const Model& model) const
    {
        const std::vector<Triangle> facets = facets_of(model, all_faces(model));
        const geometry::FacetTree tree(model.points, facets, context_);
        std::size_t given_facets = 0; // facets of the source; they come first in `facets`
        for (const Face& face : model.faces)
            given_facets += face.origin == Origin::given ? face.triangles.size() : 0;
        const auto corners = [&](const Triangle& t) {
            return std::array<Vec3, 3>{model.at(t[0]), model.at(t[1]), model.at(t[2])};
        };
        tree.overlaps(
            tree,
            [&](Index a, Index b) {
                const Triangle &one = facets[index(a)], &other = facets[index(b)];
                if (index(a) < given_facets && index(b) < given_facets) return true;
                const auto shared = std::ranges::count_if(
                    one, [&](Index p) { return std::ranges::find(other, p) != other.end(); });
                if (shared >= 2) return true; // adjacent facets can only fold; check_advance() finds folds
                if (!geometry::triangles_cross(corners(one), corners(other), model.tolerance)) return true;
                const Vec3 middle = (model.at(one[0]) + model.at(one[1]) + model.at(one[2])) / 3;
                throw NotClosed(Message("closure.along_crosses",
                                        "the volume along this path crosses itself at {}",
                                        place_with_digits(middle, 4))
                                    .remedy("use another path, or a smaller source"));
            },
            0, context_);
    }

    // --- points and edges ----------------------------------------------------------------------------------

    /// Add the points of all rows. A rim point has an image in every row, any other point only in the last
    /// row, on the target.
    void place_points()
    {
        at_row_.assign(rows_.size(), std::vector<Index>(given_.points.size(), -1));
        std::vector<char> on_rim(given_.points.size(), 0);
        for (std::size_t e = 0; e < given_.edges.size(); ++e)
            if (is_rim(EdgeId(e)))
                for (const Index p : given_.edges[e].points) on_rim[index(p)] = 1;
        std::vector<Vec3> below = given_.points;
        for (std::size_t row = 0; row <= last(); ++row) {
            check_cancelled(context_);
            const std::vector<Vec3> places = section(row);
            if (row > 0) check_advance(below, places, row - 1);
            for (const Index p : used_) {
                Index& at = at_row_[row][index(p)];
                if (row == 0 || (row == last() && swept_.full_turn)) {
                    at = p;
                } else if (row == last() || on_rim[index(p)] != 0) {
                    at = static_cast<Index>(builder_.points.size());
                    builder_.points.push_back(places[index(p)]);
                }
            }
            below = places;
        }
    }

    [[nodiscard]] std::vector<Index> moved(const std::vector<Index>& points, std::size_t row) const
    {
        std::vector<Index> result;
        for (const Index p : points) result.push_back(at_row_[row][index(p)]);
        return result;
    }

    /// The image of a source vertex in a row.
    VertexId vertex_at(VertexId vertex, std::size_t row)
    {
        if (row == 0 || (row == last() && swept_.full_turn)) return vertex;
        const auto known = vertices_.try_emplace({vertex, row});
        if (known.second)
            known.first->second = builder_.add_void_vertex(at_row_[row][index(given_[vertex].point)]);
        return known.first->second;
    }

    /// Add the image of a source edge in a row.
    EdgeId edge_at(EdgeId edge, std::size_t row)
    {
        const Edge& own = given_[edge];
        const EdgeId made = builder_.add_void_edge(vertex_at(own.from, row), vertex_at(own.to, row),
                                                   moved(own.points, row));
        if (own.curve) {
            builder_[made].curve = std::make_shared<geometry::MovedCurve>(motion_, rows_[row], own.curve);
            builder_[made].params = own.params;
        }
        return made;
    }

    /// Add the void edge that a source vertex sweeps from a level to the next, unless the edge exists
    /// already.
    void add_path_edge(VertexId vertex, std::size_t level)
    {
        if (!paths_.insert({vertex, level}).second) return;
        const auto [low, high] = rows_between(level);
        std::vector<Index> points;
        for (std::size_t row = low; row <= high; ++row)
            points.push_back(at_row_[row][index(given_[vertex].point)]);
        const EdgeId made = builder_.add_void_edge(vertex_at(vertex, low), vertex_at(vertex, high),
                                                   std::move(points));
        if (high == low + 1) return; // straight
        builder_[made].curve = std::make_shared<geometry::PointPath>(motion_,
                                                                     given_.at(given_[vertex].point));
        builder_[made].params.assign(rows_.begin() + std::ptrdiff_t(low),
                                     rows_.begin() + std::ptrdiff_t(high) + 1);
    }

    // --- faces ---------------------------------------------------------------------------------------------

    /// Add the walls that an edge of the rim sweeps, one for each pair of consecutive levels.
    void add_walls(EdgeId edge)
    {
        const FaceUse use = given_.uses_of_edge(edge).front();
        const Edge& own = given_[edge];
        geometry::SweptEdge line{own.curve, {}, own.params};
        for (const Index p : own.points) line.points.push_back(given_.at(p));
        if (!own.curve) {
            line.params.resize(own.points.size());
            std::iota(line.params.begin(), line.params.end(), 0.0);
        }
        for (std::size_t level = 0; level + 1 < motion_->levels.size(); ++level) {
            check_cancelled(context_);
            add_path_edge(own.from, level);
            add_path_edge(own.to, level);
            if (level + 2 < motion_->levels.size()) edge_at(edge, rows_between(level).second);
            const auto [low, high] = rows_between(level);
            const FaceId made = builder_.add_void_face(Geometry::transfinite);
            Face& wall = builder_[made];
            if (const auto sets = swept_.sets.find(edge); sets != swept_.sets.end()) {
                wall.groups = sets->second;
                wall.name = wall.groups.front();
            }
            for (std::size_t row = low; row < high; ++row) {
                for (std::size_t i = 0; i + 1 < own.points.size(); ++i) {
                    // In the direction of the use, the source lies on the left of the edge. The wall is
                    // oriented so that it lies on the right.
                    const std::size_t a = use.reversed ? i : i + 1, b = use.reversed ? i + 1 : i;
                    const auto corner = [&](std::size_t at, std::size_t up) {
                        return std::pair(at_row_[up][index(own.points[at])],
                                         Vec2(line.params[at], rows_[up]));
                    };
                    const std::array quad{corner(a, row), corner(b, row), corner(b, row + 1),
                                          corner(a, row + 1)};
                    for (const auto& [p, q, r] : {std::array{0, 1, 2}, std::array{0, 2, 3}}) {
                        const auto &x = quad[index(p)], &y = quad[index(q)], &z = quad[index(r)];
                        wall.triangles.push_back({x.first, y.first, z.first});
                        wall.uv.push_back({x.second, y.second, z.second});
                    }
                }
            }
            if (plane_of(builder_, made)) {
                wall.geometry = Geometry::newell;
                wall.kind = "plane";
            }
            wall.surface = std::make_shared<geometry::SweptSurface>(motion_, line, rows_[low], rows_[high]);
            walls_.push_back(made);
        }
    }

    void add_targets()
    {
        for (std::size_t f = 0; f < given_.faces.size(); ++f) {
            const FaceId made = builder_.add_void_face(Geometry::parallel);
            const Face& source = given_.faces[f];
            Face& target = builder_[made];
            const bool exact = source.surface && !motion_->reach;
            if (exact) target.surface = std::make_shared<geometry::MovedSurface>(motion_, 1, source.surface);
            for (std::size_t t = 0; t < source.triangles.size(); ++t) {
                const Triangle& own = source.triangles[t];
                const std::vector<Index>& at = at_row_[last()];
                target.triangles.push_back({at[index(own[0])], at[index(own[2])], at[index(own[1])]});
                if (exact) target.uv.push_back({source.uv[t][0], source.uv[t][2], source.uv[t][1]});
            }
            if (!plane_of(builder_, made)) continue;
            target.kind = "plane";
            target.surface.reset();
            target.uv.clear();
        }
    }

    const SweptSource& swept_;
    const Model& given_;
    geometry::MotionPointer motion_;
    const std::vector<double>& rows_;
    const RunContext& context_;
    ModelBuilder builder_;
    std::vector<bool> source_points_;
    std::vector<Index> used_;                ///< points of the source's facets
    std::vector<std::vector<Index>> at_row_; ///< by row and point of the source: index of the point's image
                                             ///< in that row; -1: none
    std::map<std::pair<VertexId, std::size_t>, VertexId> vertices_;
    std::set<std::pair<VertexId, std::size_t>> paths_; ///< the source vertices and levels for which the void
                                                       ///< edge along the path exists
    std::vector<FaceId> walls_;
    std::vector<Vec3> reach_; ///< by source point: its displacement from source to target; used if the motion
                              ///< moves each point separately (`Motion::reach`)
    double sense_ = 0;        ///< advance of the first facet along its normal; only the sign is used
};

} // namespace

void list_void(Closed& closed)
{
    const Model& model = closed.volume.model;
    Closure& closure = closed.closure;
    closure.void_edges.clear();
    closure.void_faces.clear();
    for (std::size_t e = 0; e < model.edges.size(); ++e)
        if (model.edges[e].origin == Origin::made_void) closure.void_edges.emplace_back(e);
    for (const FaceId face : all_faces(model))
        if (model[face].origin == Origin::made_void) closure.void_faces.push_back(face);
    closure.watertight = is_watertight(closed.volume);
}

Closed close_along(const SweptSource& swept, const CloseOptions& options, const RunContext& context)
{
    const char* const unused = !options.void_edges.empty()                  ? "void_edges"
                               : options.cap != Cap::automatic              ? "cap"
                               : options.edge_shape != EdgeShape::automatic ? "edge_shape"
                               : options.holes != Holes::automatic          ? "holes"
                                                                            : nullptr;
    if (unused)
        throw InvalidInput(
            Message("closure.along_options",
                    "close: '{}' cannot be used with 'along', which determines all missing faces", unused)
                .remedy("leave it out"));
    refuse_edges_on_axis(swept);
    return AlongCloser(swept, context).run();
}

std::vector<StepPiece> halves_along(const SweptSource& swept, const RunContext& context)
{
    refuse_edges_on_axis(swept);
    constexpr double kHalf = 0.5;
    SweptSource half{swept.source, geometry::part_of_motion(swept.motion, 0, kHalf), false, swept.sets};
    StepPiece first{.volume = close_along(half, {}, context).volume, .turn_to = kHalf};
    const Model& model = first.volume.model;
    // The target of the first half is the source of the second half. `extract()` renumbers the edges, so the
    // sets of the edges are found by place.
    half.source.model = extract(model, first.volume.faces(Role::target));
    half.source.role.assign(half.source.model.faces.size(), Role::source);
    half.motion = geometry::part_of_motion(swept.motion, kHalf, 1);
    half.sets = sets_above(swept, half.source.model);
    StepPiece second{.volume = close_along(half, {}, context).volume, .turn_from = kHalf};
    return {std::move(first), std::move(second)};
}

} // namespace lacuna::closure
