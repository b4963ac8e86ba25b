// SPDX-License-Identifier: MIT
#include <lacuna/closure/void_geometry.h>

#include <lacuna/closure/detail/four_corners.h>
#include <lacuna/core/error.h>
#include <lacuna/geometry/harmonic.h>
#include <lacuna/geometry/minimal_area.h>
#include <lacuna/geometry/newell.h>
#include <lacuna/geometry/polyline.h>
#include <lacuna/geometry/swept_patch.h>
#include <lacuna/geometry/triangulate.h>
#include <lacuna/topology/use_places.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>

namespace lacuna::closure {

using namespace topology;

namespace {

/// Boundary points of the face in the plane it is triangulated in; a seam's points stand twice.
struct Outline {
    std::vector<Index> model_point;
    std::vector<Vec2> flat;
    std::vector<std::vector<Index>> loops;
};

/// Turn a triangulation of an outline into a filling; `lift` gives the place of an added point.
template <class Lift>
VoidFilling filling_of(const Model& model, const Outline& outline, const geometry::Triangulation& flat,
                       const Lift& lift)
{
    VoidFilling result;
    const auto base = static_cast<Index>(model.points.size());
    const std::size_t rim = outline.flat.size();
    for (std::size_t i = rim; i < flat.points.size(); ++i) result.points.push_back(lift(i));
    for (const Triangle& t : flat.triangles) {
        Triangle mapped{};
        for (std::size_t i = 0; i < 3; ++i) {
            const auto p = static_cast<std::size_t>(t[i]);
            mapped[i] = p < rim ? outline.model_point[p] : base + static_cast<Index>(p - rim);
        }
        result.triangles.push_back(mapped);
    }
    return result;
}

// --- Algorithm 4: the Newell plane ------------------------------------------------------------------

struct NewellOutline {
    Outline outline;
    geometry::Plane plane;
    double bulge = 0; ///< largest height of the rim over the plane
};

NewellOutline newell_outline(const Model& model, const std::vector<Loop>& loops)
{
    NewellOutline result;
    std::vector<std::vector<Vec3>> rims;
    for (const Loop& loop : loops) rims.push_back(loop_places(model, loop.uses));
    result.plane = geometry::newell_plane(rims);
    for (std::size_t l = 0; l < loops.size(); ++l) {
        const std::vector<Index> points = loop_points(model, loops[l].uses);
        std::vector<Index>& numbers = result.outline.loops.emplace_back();
        for (std::size_t i = 0; i < points.size(); ++i) {
            numbers.push_back(static_cast<Index>(result.outline.flat.size()));
            result.outline.model_point.push_back(points[i]);
            result.outline.flat.push_back(geometry::to_plane(result.plane, rims[l][i]));
            result.bulge = std::max(result.bulge, std::abs(geometry::height(result.plane, rims[l][i])));
        }
    }
    return result;
}

/// Heights over the Newell plane, harmonic inside and `rim` at the outline's points, which come first.
std::vector<double> harmonic_heights(const geometry::Triangulation& flat, const std::vector<double>& rim,
                                     const RunContext& context)
{
    std::vector<Vec3> points;
    for (const Vec2& p : flat.points) points.emplace_back(p.x(), p.y(), 0);
    geometry::HarmonicProblem problem;
    problem.points = points;
    problem.triangles = flat.triangles;
    problem.fixed_values.resize(static_cast<Eigen::Index>(rim.size()), 1);
    for (std::size_t i = 0; i < rim.size(); ++i) {
        problem.fixed.push_back(static_cast<Index>(i));
        problem.fixed_values(static_cast<Eigen::Index>(i), 0) = rim[i];
    }
    const Eigen::MatrixXd lifted = geometry::solve_harmonic(problem, context);
    return {lifted.data(), lifted.data() + lifted.rows()};
}

std::vector<double> rim_heights(const Model& model, const NewellOutline& newell)
{
    std::vector<double> heights;
    for (const Index p : newell.outline.model_point)
        heights.push_back(geometry::height(newell.plane, model.at(p)));
    return heights;
}

/// A place as what a quadratic height is linear in.
using Quadratic = Eigen::Matrix<double, 6, 1>;

Quadratic powers_at(const Vec2& p)
{
    Quadratic powers;
    powers << 1, p.x(), p.y(), p.x() * p.x(), p.x() * p.y(), p.y() * p.y();
    return powers;
}

/// Heights over a plane, quadratic in the place.
struct QuadraticHeight {
    Vec2 centre = Vec2::Zero();
    Eigen::Matrix2d stretch = Eigen::Matrix2d::Identity(); ///< to the frame the coefficients are for
    Quadratic coefficient = Quadratic::Zero();

    [[nodiscard]] double at(const Vec2& p) const
    {
        return coefficient.dot(powers_at(stretch * (p - centre)));
    }
};

/// The quadratic height a rim lies on, as that of a mouth in a shaft does; nothing where it lies on none, or
/// on many: a conic's points leave open how high its inside is.
std::optional<QuadraticHeight> quadratic_through(const Model& model, const NewellOutline& newell)
{
    // Share of the bulge that a rim may be off. Mouths of slots in shafts and balls of 1.6 to six times their
    // reach: below 0.025; walls that are missing beside stubs of a bent prism: above 0.045.
    constexpr double kOnIt = 0.03;
    // Least eigenvalue to the largest. Ellipses: below 1e-4, slots half as long again as wide: 9e-4, longer
    // ones: up to 5e-3.
    constexpr double kManyConics = 7e-4;
    struct Sample {
        Vec2 place;
        double height, weight;
    };
    std::vector<Sample> samples; // the middle of each segment too: what is straight is to be seen as straight
    double length = 0;
    for (const std::vector<Index>& loop : newell.outline.loops) {
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const std::size_t a = index(loop[i]), b = index(loop[(i + 1) % loop.size()]);
            const Vec2 from = newell.outline.flat[a], to = newell.outline.flat[b];
            const double at_from = geometry::height(newell.plane, model.at(newell.outline.model_point[a]));
            const double at_to = geometry::height(newell.plane, model.at(newell.outline.model_point[b]));
            const double weight = (to - from).norm() / 4;
            samples.push_back({from, at_from, weight});
            samples.push_back({(from + to) / 2, (at_from + at_to) / 2, 2 * weight});
            samples.push_back({to, at_to, weight});
            length += 4 * weight;
        }
    }
    QuadraticHeight result;
    Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
    for (const Sample& s : samples) result.centre += s.weight / length * s.place;
    for (const Sample& s : samples) {
        const Vec2 off = s.place - result.centre;
        spread += s.weight / length * off * off.transpose();
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(spread);
    if (axes.eigenvalues()(0) <= 1e-12 * axes.eigenvalues()(1)) return std::nullopt; // a line
    result.stretch = axes.operatorInverseSqrt();
    Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
    Quadratic right = Quadratic::Zero();
    for (const Sample& s : samples) {
        const Quadratic powers = powers_at(result.stretch * (s.place - result.centre));
        normal += s.weight / length * powers * powers.transpose();
        right += s.weight / length * s.height * powers;
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> fit(normal);
    if (fit.eigenvalues()(0) < kManyConics * fit.eigenvalues()(5)) return std::nullopt;
    result.coefficient = normal.ldlt().solve(right);
    const bool on_it = std::all_of(samples.begin(), samples.end(), [&](const Sample& s) {
        return std::abs(result.at(s.place) - s.height) <= kOnIt * newell.bulge;
    });
    return on_it ? std::optional(result) : std::nullopt;
}

/// @param on  the quadratic height the rim lies on, if any
VoidFilling fill_on_newell_plane(const Model& model, const NewellOutline& newell,
                                 const std::optional<QuadraticHeight>& on, const RunContext& context)
{
    const Outline& outline = newell.outline;
    const geometry::Triangulation flat = geometry::triangulate(outline.flat, outline.loops, {}, context);
    std::vector<double> heights(flat.points.size(), 0);
    if (newell.bulge > model.tolerance && flat.points.size() > outline.flat.size()) {
        const QuadraticHeight bent = on.value_or(QuadraticHeight{});
        std::vector<double> left = rim_heights(model, newell);
        for (std::size_t i = 0; i < left.size(); ++i) left[i] -= bent.at(outline.flat[i]);
        heights = harmonic_heights(flat, left, context);
        for (std::size_t i = 0; i < heights.size(); ++i) heights[i] += bent.at(flat.points[i]);
    }
    VoidFilling result = filling_of(model, outline, flat, [&](std::size_t i) {
        return geometry::from_plane(newell.plane, flat.points[i], heights[i]);
    });
    result.geometry = Geometry::newell;
    result.algorithm = "Algorithm 4";
    return result;
}

/// Height of a surface over a place of a plane: where the plane's normal meets it, and beside its rim where
/// it is closest. Nothing where it is met more than once.
std::optional<double> height_of(const geometry::FacetTree& shape, const geometry::Plane& plane,
                                const Vec2& place, double tolerance)
{
    const Vec3 foot = geometry::from_plane(plane, place, 0);
    std::optional<double> height;
    bool once = true;
    for (const double way : {1.0, -1.0}) {
        shape.all_along(foot, way * plane.normal, [&](const geometry::FacetTree::RayHit& hit) {
            if (height && std::abs(*height - way * hit.t) > tolerance) once = false;
            height = way * hit.t;
            return once;
        });
    }
    if (!once) return std::nullopt;
    return height ? *height : geometry::height(plane, shape.closest(foot).point);
}

// --- Algorithms 5 and 6: the transfinite patch ------------------------------------------------------

/// A side of a patch: its points, and at which share of the side each stands.
struct PatchSide {
    std::vector<Index> chain;
    std::vector<Vec3> points;
    std::vector<double> share;

    [[nodiscard]] Vec3 at(double f) const { return geometry::point_at(points, share, f); }
};

PatchSide patch_side(const Model& model, const std::vector<EdgeUse>& uses)
{
    PatchSide side;
    side.chain = use_points(model, uses);
    side.points = places_at(model, side.chain);
    side.share = geometry::arc_lengths(side.points);
    const double total = side.share.back();
    for (double& s : side.share) s /= total;
    return side;
}

/// Stand the points of a rising side at their height on the walls, the way the follower counts it; a void
/// edge was made at even heights.
void by_height(PatchSide& side, const Follower& follower, bool rising)
{
    const std::size_t n = side.chain.size();
    for (std::size_t i = 0; i < n; ++i) {
        const double even = static_cast<double>(i) / static_cast<double>(n - 1);
        const double height = follower.height(side.chain[i]);
        side.share[i] = std::isnan(height) ? even : rising ? height : 1 - height;
    }
    side.share.front() = 0;
    side.share.back() = 1;
}

/// Facets of a rectangle whose opposite sides have as many points: the grid between them, so that no facet
/// cuts a corner that the sides do not.
geometry::Triangulation grid_between(const std::array<PatchSide, 4>& side, const Outline& outline,
                                     double width, double height)
{
    const std::size_t n = side[0].chain.size() - 1, m = side[1].chain.size() - 1;
    geometry::Triangulation grid{outline.flat, {}};
    for (std::size_t j = 1; j < m; ++j) {
        for (std::size_t i = 1; i < n; ++i) {
            const double low = side[0].share[i], lean = 1 - side[2].share[n - i] - low;
            const double left = 1 - side[3].share[m - j], slope = side[1].share[j] - left;
            const double s = (low + lean * left) / (1 - lean * slope);
            grid.points.emplace_back(s * width, (left + slope * s) * height);
        }
    }
    const auto at = [&](std::size_t i, std::size_t j) {
        const bool inside = i > 0 && i < n && j > 0 && j < m;
        const std::size_t round = j == 0 ? i : i == n ? n + j : j == m ? n + m + n - i : 2 * n + m + m - j;
        return static_cast<Index>(inside ? 2 * (n + m) + (j - 1) * (n - 1) + i - 1 : round);
    };
    for (std::size_t j = 0; j < m; ++j) {
        for (std::size_t i = 0; i < n; ++i) {
            const Quad q{at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)};
            const std::size_t k = (i + j) % 2; // diagonals by turns lean to neither side
            grid.triangles.push_back({q[k], q[k + 1], q[k + 2]});
            grid.triangles.push_back({q[k], q[k + 2], q[(k + 3) % 4]});
        }
    }
    return grid;
}

/// How far a patch between four straight sides would be off two flat facets [model length].
double twist_of(const std::array<PatchSide, 4>& side)
{
    const auto corner = [&](std::size_t i) { return side[i].points.front(); };
    return (corner(0) - corner(1) + corner(2) - corner(3)).norm() / 4;
}

/// Facets of a rectangle whose patch is twisted or bent both ways: a grid inside, no coarser than the sides,
/// and facets from it to the sides as they are.
/// @param width, height  segments of the sides each way: their own size in the plane.
geometry::Triangulation grid_within(const Outline& outline, double width, double height,
                                    const RunContext& context)
{
    // Cells each way: facets miss a twisted patch by 1/256 of what two of them do. Sides cut finer are bent,
    // and facets inside are to be no coarser.
    constexpr Index kCells = 16;
    // Many cells: no closer than a scan's sides ask for, which a void face does not need. A choice.
    constexpr double kMostCells = 1e5;
    const double coarser = std::max(1.0, std::sqrt(width * height / kMostCells));
    const Index across = std::max(kCells, static_cast<Index>(width / coarser));
    const Index along = std::max(kCells, static_cast<Index>(height / coarser));
    geometry::Triangulation inner{outline.flat, {}};
    const auto first = static_cast<Index>(inner.points.size());
    for (Index j = 1; j < along; ++j) {
        for (Index i = 1; i < across; ++i) inner.points.emplace_back(width * i / across, height * j / along);
    }
    const Index row = across - 1, rows = along - 1;
    const auto at = [&](Index i, Index j) { return first + j * row + i; };
    std::vector<std::vector<Index>> loops = outline.loops;
    std::vector<Index>& hole = loops.emplace_back();
    for (Index i = 0; i + 1 < row; ++i) hole.push_back(at(i, 0));
    for (Index j = 0; j + 1 < rows; ++j) hole.push_back(at(row - 1, j));
    for (Index i = row - 1; i > 0; --i) hole.push_back(at(i, rows - 1));
    for (Index j = rows - 1; j > 0; --j) hole.push_back(at(0, j));
    geometry::Triangulation grid = geometry::triangulate(inner.points, loops, {.interior_points = false},
                                                         context);
    for (Index j = 0; j + 1 < rows; ++j) {
        for (Index i = 0; i + 1 < row; ++i) {
            const Quad q{at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)};
            const std::size_t k = index(i + j) % 2; // diagonals by turns lean to neither side
            grid.triangles.push_back({q[k], q[k + 1], q[k + 2]});
            grid.triangles.push_back({q[k], q[k + 2], q[(k + 3) % 4]});
        }
    }
    return grid;
}

VoidFilling fill_transfinite(const Model& model, const std::vector<std::vector<EdgeUse>>& sides,
                             const Follower* follower, const RunContext& context)
{
    std::array<PatchSide, 4> side;
    for (std::size_t i = 0; i < 4; ++i) side[i] = patch_side(model, sides[i]);
    if (follower != nullptr) {
        by_height(side[1], *follower, true);
        by_height(side[3], *follower, false);
    }
    // Cut a rectangle that counts the sides' own segments: facets are then as long each way as the sides,
    // which were cut by their curvature, are that way.
    const auto segments = [&](std::size_t i, std::size_t j) {
        return static_cast<double>(std::max(side[i].chain.size(), side[j].chain.size()) - 1);
    };
    const double width = segments(0, 2);
    const double height = segments(1, 3);
    const std::array<Vec2, 5> corner{Vec2(0, 0), Vec2(width, 0), Vec2(width, height), Vec2(0, height),
                                     Vec2(0, 0)};
    Outline outline;
    outline.loops.emplace_back();
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t k = 0; k + 1 < side[i].chain.size(); ++k) {
            const double f = side[i].share[k];
            outline.loops.front().push_back(static_cast<Index>(outline.flat.size()));
            outline.model_point.push_back(side[i].chain[k]);
            outline.flat.emplace_back((1 - f) * corner[i] + f * corner[i + 1]);
        }
    }
    const bool even = side[0].chain.size() == side[2].chain.size() &&
                      side[1].chain.size() == side[3].chain.size();
    // A few facets would stand for a twisted patch that the swept mesh follows.
    constexpr double kFewSegments = 8, kFlat = 1e-3;
    const double across = (side[0].points.front() - side[2].points.front()).norm();
    const bool twisted = std::min(width, height) < kFewSegments && twist_of(side) > kFlat * across;
    const bool bent_both_ways = std::min(width, height) >= kFewSegments;
    const geometry::Triangulation flat = even && !twisted ? grid_between(side, outline, width, height)
                                         : twisted || bent_both_ways
                                             ? grid_within(outline, width, height, context)
                                             : geometry::triangulate(outline.flat, outline.loops, {},
                                                                     context);
    const auto backward = [](std::vector<Vec3> points) {
        std::reverse(points.begin(), points.end());
        return points;
    };
    const geometry::SweptPatch patch(side[0].points, side[1].points, backward(side[2].points),
                                     backward(side[3].points));
    const std::size_t walls = follower != nullptr ? follower->walls_at(side[0].chain.front()) : 0;
    VoidFilling result = filling_of(model, outline, flat, [&](std::size_t i) -> Vec3 {
        const double s = flat.points[i].x() / width, t = flat.points[i].y() / height;
        if (follower == nullptr) return patch(s, t);
        const auto led = [&](const Vec3& from, const Vec3& to) {
            return follower->morph(from, to, t, walls);
        };
        const Vec3 left = side[3].at(1 - t) - led(side[0].points.front(), side[2].points.back());
        const Vec3 right = side[1].at(t) - led(side[0].points.back(), side[2].points.front());
        return led(side[0].at(s), side[2].at(1 - s)) + (1 - s) * left + s * right;
    });
    const bool seam = sides[1].size() == sides[3].size() && sides[1].front().edge == sides[3].back().edge;
    result.geometry = follower != nullptr ? Geometry::followed
                      : seam              ? Geometry::annular
                                          : Geometry::transfinite;
    result.algorithm = seam ? "Algorithm 5" : "Algorithm 6";
    return result;
}

/// A bent face between four corners, where straight lines lead over it or its rim lies on no quadratic
/// height.
/// @param on_quadratic  whether the rim lies on one
std::optional<VoidFilling> fill_between_corners(const Model& model, const std::vector<Loop>& loops,
                                                bool on_quadratic, const RunContext& context)
{
    if (loops.size() != 1) return std::nullopt;
    const auto sides = four_corners(model, loops.front());
    if (sides.empty()) return std::nullopt;
    if (on_quadratic && !is_ruled(model, sides)) return std::nullopt;
    try {
        return fill_transfinite(model, sides, nullptr, context);
    } catch (const InvalidInput&) {
        return std::nullopt; // it folds
    }
}

std::string crossing_in_words(const Model& model, const std::vector<Loop>& loops,
                              const geometry::LoopCrossing& crossing)
{
    const auto edge_at = [&](std::size_t loop, std::size_t segment) {
        for (const EdgeUse& use : loops[loop].uses) {
            const std::size_t segments = model[use.edge].points.size() - 1;
            if (segment < segments) return name_of(model, use.edge);
            segment -= segments;
        }
        return std::string("an edge");
    };
    return edge_at(crossing.loop_a, crossing.segment_a) + " and " +
           edge_at(crossing.loop_b, crossing.segment_b);
}

// --- beyond the paper: least area ---------------------------------------------------------------------

/// A face that folds in its Newell plane and has no four sides: a membrane over its loops.
VoidFilling fill_with_least_area(const Model& model, const std::vector<Loop>& loops,
                                 const std::string& crossing, const std::string& name,
                                 const RunContext& context)
{
    std::vector<Index> model_point;
    std::vector<Vec3> points;
    std::vector<std::vector<Index>> cycles;
    for (const Loop& loop : loops) {
        std::vector<Index>& cycle = cycles.emplace_back();
        for (const Index p : loop_points(model, loop.uses)) {
            cycle.push_back(static_cast<Index>(points.size()));
            model_point.push_back(p);
            points.push_back(model.at(p));
        }
    }
    geometry::MinimalArea membrane;
    try {
        membrane = geometry::minimal_area(points, cycles, {}, context);
    } catch (const InvalidInput& error) {
        throw NotClosed("closure.outline_crosses",
                        name + " cannot be laid out in a plane: " + crossing +
                            " cross there; and no surface was found over its loops (" + error.what() +
                            "); give a face for it, or split it by one more wall");
    }
    VoidFilling result;
    const auto base = static_cast<Index>(model.points.size());
    const auto rim = static_cast<Index>(points.size());
    result.points.assign(membrane.points.begin() + rim, membrane.points.end());
    for (const Triangle& t : membrane.triangles) {
        Triangle mapped{};
        for (std::size_t i = 0; i < 3; ++i)
            mapped[i] = t[i] < rim ? model_point[static_cast<std::size_t>(t[i])] : base + t[i] - rim;
        result.triangles.push_back(mapped);
    }
    result.geometry = Geometry::minimal;
    result.algorithm = "least area";
    return result;
}

} // namespace

std::vector<std::vector<EdgeUse>> logical_sides(const OpenVolume& volume, const Loop& loop)
{
    const auto edges_of = [&](Role role) {
        std::set<EdgeId> edges;
        for (const Rim& rim : rims(volume.model, volume.faces(role))) {
            for (const EdgeUse& use : rim.uses) edges.insert(use.edge);
        }
        return edges;
    };
    const std::set<EdgeId> source = edges_of(Role::source);
    const std::set<EdgeId> target = edges_of(Role::target);
    const std::size_t n = loop.uses.size();
    const auto kind = [&](std::size_t i) {
        const EdgeId edge = loop.uses[i % n].edge;
        return source.contains(edge) ? 0 : target.contains(edge) ? 2 : 1;
    };
    std::size_t start = 0;
    while (start < n && !(kind(start) == 0 && kind(start + n - 1) != 0)) ++start;
    if (start == n) return {};
    std::vector<std::vector<EdgeUse>> sides;
    std::vector<int> kinds;
    for (std::size_t i = 0; i < n; ++i) {
        const int k = kind(start + i);
        if (kinds.empty() || kinds.back() != k) {
            kinds.push_back(k);
            sides.emplace_back();
        }
        sides.back().push_back(loop.uses[(start + i) % n]);
    }
    if (kinds != std::vector<int>{0, 1, 2, 1}) return {};
    return sides;
}

VoidFilling fill(const OpenVolume& volume, const std::vector<Loop>& loops, const Follower* follower,
                 const std::string& name, const RunContext& context)
{
    check_cancelled(context);
    const Model& model = volume.model;
    const NewellOutline newell = newell_outline(model, loops);
    const auto crossing = geometry::find_crossing(newell.outline.flat, newell.outline.loops);
    const bool flat = newell.bulge <= model.tolerance;
    const auto sides = loops.size() == 1 ? logical_sides(volume, loops.front())
                                         : std::vector<std::vector<EdgeUse>>{};
    const bool has_sides = !sides.empty() && (!flat || crossing);
    const auto on = flat || has_sides ? std::nullopt : quadratic_through(model, newell);
    VoidFilling result;
    if (has_sides) {
        try {
            result = fill_transfinite(model, sides, follower, context);
        } catch (const InvalidInput& error) {
            throw NotClosed("closure.face_folds", name + ", with " +
                                                      name_of(model, sides.front().front().edge) +
                                                      ", folds where its sides lead: " + error.what());
        }
    } else if (auto patch = flat ? std::nullopt
                                 : fill_between_corners(model, loops, on.has_value(), context)) {
        result = std::move(*patch);
    } else if (!crossing) {
        result = fill_on_newell_plane(model, newell, on, context);
    } else {
        result = fill_with_least_area(model, loops, crossing_in_words(model, loops, *crossing), name,
                                      context);
    }
    result.loops = loops;
    return result;
}

VoidFilling fill_as(const OpenVolume& volume, const std::vector<Loop>& loops,
                    const geometry::FacetTree& shape, double facet_size, const std::string& name,
                    const RunContext& context)
{
    const Model& model = volume.model;
    const NewellOutline newell = newell_outline(model, loops);
    const Outline& outline = newell.outline;
    if (const auto crossing = geometry::find_crossing(outline.flat, outline.loops)) {
        throw NotClosed("closure.outline_crosses",
                        name +
                            " cannot be laid out in a plane: " + crossing_in_words(model, loops, *crossing) +
                            " cross there, so that it cannot be parallel to the given end");
    }
    geometry::TriangulateOptions fine;
    fine.size = [=](const Vec2&) { return facet_size; };
    const geometry::Triangulation flat = geometry::triangulate(outline.flat, outline.loops, fine, context);
    std::vector<double> heights;
    for (const Vec2& place : flat.points) {
        check_cancelled(context);
        const auto height = height_of(shape, newell.plane, place, model.tolerance);
        if (!height) {
            throw NotClosed("closure.cap_folds",
                            name + " cannot be parallel to the given end, which folds over the plane of the "
                                   "walls' rim; use cap = \"flat\", or give the face");
        }
        heights.push_back(*height);
    }
    std::vector<double> left = rim_heights(model, newell);
    for (std::size_t i = 0; i < left.size(); ++i) left[i] -= heights[i];
    const std::vector<double> moved = harmonic_heights(flat, left, context);
    VoidFilling result = filling_of(model, outline, flat, [&](std::size_t i) {
        return geometry::from_plane(newell.plane, flat.points[i], heights[i] + moved[i]);
    });
    result.loops = loops;
    result.geometry = Geometry::parallel;
    result.algorithm = "Algorithm 4";
    return result;
}

FaceId add_void_face(OpenVolume& volume, VoidFilling filling, Role role)
{
    Model& model = volume.model;
    const FaceId id = topology::add_void_face(model, filling.geometry);
    model[id].triangles = std::move(filling.triangles);
    model[id].loops = std::move(filling.loops);
    model.points.insert(model.points.end(), filling.points.begin(), filling.points.end());
    volume.role.push_back(role);
    return id;
}

} // namespace lacuna::closure
