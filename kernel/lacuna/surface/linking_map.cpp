// SPDX-License-Identifier: MIT
#include <lacuna/surface/detail/linking_map.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/edge_key.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/geometry/newell.h>
#include <lacuna/geometry/shared/affine.h>
#include <lacuna/geometry/shared/angle.h>
#include <lacuna/geometry/shared/cut.h>
#include <lacuna/geometry/shared/harmonic.h>
#include <lacuna/geometry/shared/minimal_frame.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/geometry/shared/union_find.h>
#include <lacuna/surface/detail/chain_nodes.h>
#include <lacuna/surface/detail/common_turn.h>
#include <lacuna/surface/shared/rim_breaks.h>
#include <lacuna/topology/shared/facet_area.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <unordered_map>

namespace lacuna::surface {

using namespace topology;

namespace {

/// Linear interpolation between values at increasing positions that begin with the least.
template <class Value>
Value between(const std::vector<double>& at, const std::vector<Value>& values, double x)
{
    const auto above = std::upper_bound(at.begin() + 1, at.end() - 1, x);
    const auto i = static_cast<std::size_t>(above - at.begin());
    const double f = std::clamp((x - at[i - 1]) / (at[i] - at[i - 1]), 0.0, 1.0);
    return values[i - 1] + f * (values[i] - values[i - 1]);
}

/// A path from rim to rim, along which the walls are cut open.
struct WayUp {
    std::vector<Index> points;
    double from = 0; ///< position of its start on the source rim

    /// The coordinate s at a position of the source rim; it jumps by 1 at the start of the path.
    [[nodiscard]] double coordinate(double at, double length) const
    {
        return at / length + (at < from ? 1 : 0);
    }
};

/// Shortest path along sides of facets to the target rim, from the first point of the source chain that has
/// one. Only the ends of the path touch the rims. All facets at a point may have their corners on its rim.
WayUp shortest_way_up(const Model& model, const std::vector<Triangle>& facets, const LinkingSurface& link,
                      const RunContext& context)
{
    std::set<Index> low, high;
    const std::vector<ChainNode> rim = chain_nodes(model, link.source);
    for (const ChainNode& p : rim) low.insert(p.point);
    for (const ChainNode& p : chain_nodes(model, link.target)) high.insert(p.point);
    for (const ChainNode& p : rim) {
        std::vector<Index> way = geometry::shortest_way(model.points, facets, p.point, low, high, context);
        if (!way.empty()) return {std::move(way), p.at};
    }
    throw NotSweepable(Message("surface.wall_broken",
                               "the facets of {} do not connect the source's rim to the target's",
                               entity_of(model, link.walls.front()))
                           .remedy("repair or remesh the face"));
}

/// The harmonic coordinate s with fixed values on the source rim only, and natural boundary conditions on the
/// target rim. Its values there show how the walls themselves rotate from source to target.
geometry::HarmonicValues natural_coordinate(const Model& model, const std::vector<Triangle>& facets,
                                            const LinkingSurface& link, const WayUp& cut,
                                            const RunContext& context)
{
    geometry::HarmonicProblem problem;
    problem.points = model.points;
    problem.triangles = facets;
    const std::vector<ChainNode> rim = chain_nodes(model, link.source);
    problem.fixed_values.resize(static_cast<Eigen::Index>(rim.size()), 1);
    for (std::size_t i = 0; i < rim.size(); ++i) {
        problem.fixed.push_back(rim[i].point);
        problem.fixed_values(static_cast<Eigen::Index>(i), 0) = cut.coordinate(rim[i].at,
                                                                               link.source.length());
    }
    problem.corner_turns = geometry::turns_along(facets, cut.points);
    problem.period = Eigen::RowVectorXd::Ones(1);
    problem.least_energy = true;
    return geometry::solve_on_facets(problem, context);
}

/// How oblique the lines between neighbouring side lines are: the mean square of the cosines of their angles
/// with the side lines, over lines at even steps.
/// @param steps  for each side line, where each point lies: its shares, or its t.
double obliqueness(const std::vector<LineHeights>& lines, std::vector<double> LineHeights::*steps)
{
    const auto at = [&](const LineHeights& line, int k) {
        return between(line.*steps, line.points, static_cast<double>(k) / kFineChords);
    };
    double sum = 0;
    for (std::size_t i = 0; i < lines.size(); ++i)
        for (int k = 1; k < kFineChords; ++k) {
            const LineHeights &one = lines[i], &next = lines[(i + 1) % lines.size()];
            const Vec3 across = (at(next, k) - at(one, k)).stableNormalized();
            for (const LineHeights* line : {&one, &next})
                sum += std::pow(across.dot((at(*line, k + 1) - at(*line, k - 1)).stableNormalized()), 2);
        }
    return sum / static_cast<double>(2 * lines.size() * (kFineChords - 1));
}

/// The harmonic coordinate t on each side line, with fixed values on the rims only. Empty if shares of the
/// lines' length are as good: layers at even shares then meet the lines at angles as close to 90 degrees.
std::vector<LineHeights> natural_heights(const Model& model, const std::vector<Triangle>& facets,
                                         const LinkingSurface& link, const RunContext& context)
{
    if (link.lines.size() < 2 || !has_bent_line(model, link)) return {};
    geometry::HarmonicProblem problem;
    problem.points = model.points;
    problem.triangles = facets;
    std::map<Index, double> fixed;
    for (const ChainNode& p : chain_nodes(model, link.source)) fixed[p.point] = 0;
    for (const ChainNode& p : chain_nodes(model, link.target)) fixed[p.point] = 1;
    problem.fix(fixed);
    const geometry::HarmonicValues values = geometry::solve_on_facets(problem, context);
    std::vector<LineHeights> lines;
    for (const LinkingLine& line : link.lines) {
        auto& [points, shares, heights] = lines.emplace_back();
        for (const Index p : use_points(model, line.line.uses)) {
            points.push_back(model.at(p));
            heights.push_back(values.at(p)[0]);
        }
        if (std::ranges::adjacent_find(heights, std::greater_equal{}) != heights.end()) return {};
        shares = geometry::arc_lengths(points);
        for (double& share : shares) share /= shares.back();
    }
    const double natural = obliqueness(lines, &LineHeights::heights);
    const double even = obliqueness(lines, &LineHeights::shares);
    if (!(natural < even - kVisible)) lines.clear();
    return lines;
}

Vec3 on_facets(const Model& model, const WallPosition& place)
{
    return point_on_facets(model, place.face, place.at);
}

/// Linear interpolation in [0, 1] between values at even steps.
double value_at(const std::vector<double>& values, double at)
{
    const double x = at * static_cast<double>(values.size() - 1);
    const std::size_t i = std::min(static_cast<std::size_t>(x), values.size() - 2);
    return values[i] + (x - static_cast<double>(i)) * (values[i + 1] - values[i]);
}

/// Whether an edge between two void faces was created when the volume was closed.
bool is_void(const Model& model, EdgeId edge)
{
    return model[edge].origin == Origin::made_void &&
           std::ranges::all_of(model.uses_of_edge(edge), [&](const FaceUse& user) {
               return model[user.face].origin == Origin::made_void;
           });
}

} // namespace

std::vector<Vec3> points_at(const Model& model, std::span<const WallPosition> places, bool exact)
{
    std::map<FaceId, std::vector<std::size_t>> on_face;
    for (std::size_t i = 0; i < places.size(); ++i) on_face[places[i].face].push_back(i);
    std::vector<Vec3> points(places.size());
    for (const auto& [face, members] : on_face) {
        const Face& f = model[face];
        std::vector<FacetPosition> at;
        for (const std::size_t i : members) at.push_back(places[i].at);
        const std::vector<Vec3> found = points_at(
            {model.points, f.triangles, f.uv, exact ? f.surface.get() : nullptr}, at);
        for (std::size_t k = 0; k < members.size(); ++k) points[members[k]] = found[k];
    }
    return points;
}

std::pair<double, double> unguided_target(const OpenVolume& volume, const LinkingSurface& link,
                                          const RunContext& context)
{
    const Model& model = volume.model;
    const std::vector<Triangle> facets = topology::facets_of(model, link.walls);
    const WayUp cut = shortest_way_up(model, facets, link, context);
    const geometry::HarmonicValues s = natural_coordinate(model, facets, link, cut, context);
    // At each point of the target rim, take the difference between the point's share of the rim's length and
    // its coordinate s. The differences are averaged as angles on a circle.
    const double length = link.target.length();
    Vec2 sum = Vec2::Zero();
    for (const ChainNode& p : chain_nodes(model, link.target)) {
        const double off = kFullTurn * (p.at / length - s.at(p.point)[0]);
        sum += Vec2(std::cos(off), std::sin(off));
    }
    const double start = std::atan2(sum.y(), sum.x()) / kFullTurn;
    return {(start - std::floor(start)) * length, s.at(cut.points.back())[0]};
}

double target_coordinate(const LinkingSurface& link, double target_at)
{
    const double length = link.target.length();
    const double first = link.segments.front().target_from;
    double at = target_at;
    while (at < first - kRoundoff * length) at += length;
    while (at > first + length * (1 + kRoundoff)) at -= length;
    for (const RimSegment& segment : link.segments) {
        if (at > segment.target_to && &segment != &link.segments.back()) continue;
        const double f = (at - segment.target_from) / (segment.target_to - segment.target_from);
        return (segment.source_from + f * (segment.source_to - segment.source_from)) / link.source.length();
    }
    return 1;
}

LinkingMap::LinkingMap(const OpenVolume& volume, const LinkingSurface& link, bool void_edges,
                       const RunContext& context)
    : model_(&volume.model), void_edges_(void_edges), given_branch_(link.branch), segments_(link.segments)
{
    const Model& model = volume.model;
    facets_ = facet_set(model, link.walls);
    const std::vector<Triangle>& facets = facets_.triangles;
    std::map<Index, Vec2> fixed;
    double end_branch = 0;
    WayUp cut;
    const std::vector<ChainNode> high = chain_nodes(model, link.target);
    std::vector<Crease> upright = link.lines.empty() ? creases_of(volume, link) : std::vector<Crease>{};
    for (const LinkingLine& line : link.lines)
        upright.push_back({line.source_at, use_points(model, line.line.uses)});
    if (upright.empty()) {
        cut = shortest_way_up(model, facets, link, context);
        const double natural =
            link.branch ? *link.branch
                        : natural_coordinate(model, facets, link, cut, context).at(cut.points.back())[0];
        const auto end = std::ranges::find_if(
            high, [&](const ChainNode& p) { return p.point == cut.points.back(); });
        const double wanted = target_coordinate(link, end->at);
        end_branch = wanted + std::round(natural - wanted);
        branch_ = end_branch;
    } else {
        cut.points = upright.front().points;
    }
    for (const ChainNode& p : chain_nodes(model, link.source))
        fixed[p.point] = Vec2(cut.coordinate(p.at, link.source.length()), 0);
    for (const ChainNode& p : high) {
        const double s = target_coordinate(link, p.at);
        const double turned = s - std::floor(s - end_branch + kRoundoff);
        fixed[p.point] = Vec2(p.point == cut.points.back() ? end_branch : turned, 1);
    }
    lines_ = natural_heights(model, facets, link, context);
    for (std::size_t u = 0; u < upright.size(); ++u) {
        const Crease& line = upright[u];
        std::vector<double> at = geometry::arc_lengths(places_at(model, line.points));
        for (double& share : at) share /= at.back();
        if (!lines_.empty()) at = lines_[u].heights;
        for (std::size_t i = 0; i < line.points.size(); ++i)
            fixed[line.points[i]] = Vec2(line.source_at / link.source.length(), at[i]);
    }

    geometry::HarmonicProblem problem;
    problem.points = model.points;
    problem.triangles = facets;
    problem.fix(fixed);
    problem.corner_turns = geometry::turns_along(facets, cut.points);
    problem.period = Eigen::RowVector2d(1, 0);
    check_cancelled(context);
    const geometry::HarmonicValues strip = geometry::solve_on_facets(problem, context);
    check_cancelled(context);

    // Give the strip the proportions of the walls in space. For a position just outside the strip, the
    // closest facet of a distorted strip might be a wrong one.
    width_ = (link.source.length() + link.target.length()) / 2;
    double area = 0;
    for (const FaceId wall : link.walls) area += face_area(model, wall);
    height_ = area / width_;

    std::vector<std::array<Vec2, 3>> corners(facets.size());
    std::vector<Triangle> flat_triangles;
    for (std::size_t t = 0; t < facets.size(); ++t) {
        double least = kInfinity, most = -least;
        for (std::size_t i = 0; i < 3; ++i) {
            const Index p = facets[t][i];
            const Vec2& place = strip_.try_emplace(p, strip.at(p).transpose()).first->second;
            corners[t][i] = place + Vec2(problem.corner_turns[t][i], 0);
            least = std::min(least, corners[t][i].x());
            most = std::max(most, corners[t][i].x());
        }
        // The strip is periodic. Add a copy of the triangle for every whole number of turns by which the
        // shifted triangle overlaps the range [0, 1] of s.
        for (int shift = static_cast<int>(std::ceil(-most)); least + shift <= 1; ++shift) {
            const auto base = static_cast<Index>(flat_.size());
            for (const Vec2& c : corners[t]) flat_.emplace_back((c.x() + shift) * width_, c.y() * height_, 0);
            flat_triangles.push_back({base, base + 1, base + 2});
            original_.push_back(static_cast<Index>(t));
        }
    }
    check_cancelled(context);
    tree_ = geometry::FacetTree(flat_, flat_triangles, context);
    check_cancelled(context);

    if (upright.empty() || !lines_.empty()) measure_heights(model);
    const bool creased = upright.size() > link.lines.size(); // columns then follow the creases
    if (!creased && !runs_straight(model, link)) measure_columns(model, link, context);
    find_rings(volume, link, corners, void_edges);
}

std::shared_ptr<const LinkingMap> map_of(const OpenVolume& volume, const LinkingSurface& link,
                                         bool void_edges, const RunContext& context)
{
    if (!link.map || !link.map->is_of(volume, link, void_edges))
        link.map = std::make_shared<const LinkingMap>(volume, link, void_edges, context);
    return link.map;
}

void LinkingMap::measure_heights(const Model& model)
{
    std::size_t near = kNoIndex;
    even_.assign(kFineChords + 1, 0.0);
    for (std::size_t c = 0; c < kChords; ++c) {
        std::vector<Vec3> column;
        for (std::size_t k = 0; k <= kFineChords; ++k) {
            const double s = static_cast<double>(c) / kChords, t = static_cast<double>(k) / kFineChords;
            column.push_back(on_facets(model, locate(s, t, near)));
        }
        const std::vector<double> arc = geometry::arc_lengths(column);
        for (std::size_t k = 0; k <= kFineChords; ++k) even_[k] += arc[k] / arc.back() / kChords;
    }
    double off = 0;
    for (std::size_t k = 0; k <= kFineChords; ++k)
        off = std::max(off, std::abs(even_[k] - static_cast<double>(k) / kFineChords));
    if (off < kVisible) even_.clear();
}

double LinkingMap::from_even(double height) const
{
    if (even_.empty()) return height;
    const auto steps = static_cast<double>(even_.size() - 1);
    const auto above = std::upper_bound(even_.begin() + 1, even_.end() - 1, height);
    const auto k = static_cast<double>(above - even_.begin() - 1);
    const double low = *(above - 1), high = *above;
    return high > low ? std::clamp((k + (height - low) / (high - low)) / steps, 0.0, 1.0) : k / steps;
}

double LinkingMap::to_even(double t) const { return even_.empty() ? t : value_at(even_, t); }

double LinkingMap::on_line(std::size_t line, double share) const
{
    return lines_.empty() ? share : between(lines_[line].shares, lines_[line].heights, share);
}

double LinkingMap::share_of_line(std::size_t line, double t) const
{
    return lines_.empty() ? t : between(lines_[line].heights, lines_[line].shares, t);
}

void LinkingMap::measure_columns(const Model& model, const LinkingSurface& link, const RunContext& context)
{
    // Sections lie a quarter of the radius apart. Frames transported over bends in several planes are then
    // accurate to 2°.
    constexpr double kLeads = 0.2; // minimum length of the axis, in radii of the sections; heuristic
    const double rows = std::ceil(
        std::clamp(kSamplesPerSide * kFullTurn * height_ / width_, double{kFineChords}, kMostSamples));
    std::vector<std::vector<Vec3>> rings;
    std::vector<Vec3> middles, areas;
    std::vector<double> widths;
    std::size_t near = kNoIndex;
    for (double row = 0; row <= rows; ++row) {
        check_cancelled(context);
        row_at_.push_back(from_even(row / rows));
        std::vector<Vec3>& ring = rings.emplace_back();
        for (std::size_t i = 0; i < kDegreesPerTurn; ++i) {
            const double s = static_cast<double>(i) / kDegreesPerTurn;
            ring.push_back(on_facets(model, locate(s, row_at_.back(), near)));
        }
        areas.push_back(geometry::newell_vector(ring).stableNormalized());
        ring.push_back(ring.front());
        middles.push_back(geometry::mean_point(geometry::even_places(ring, kFineChords)));
        widths.push_back(geometry::length(ring) / kFullTurn);
    }
    // The direction of the sweep at each section is that of the line through the centres. If the sections are
    // nested, as on a flat ring, their centres define no line, and the normals of the sections are used.
    const bool leads = geometry::length(middles) > kLeads * *std::ranges::max_element(widths);
    const std::vector<Vec3> ways = leads ? geometry::ways_along(middles, widths) : areas;
    // For each section, shares of its length at even steps of the harmonic s.
    std::vector<std::vector<double>> round;
    std::vector<Vec3> first;
    std::vector<double> turned; // rotation of the frame relative to the harmonic s [turns]
    Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
    for (std::size_t k = 0; k < rings.size(); ++k) {
        // Project the section along the direction of the sweep, because it is inclined if facets are coarse
        // or rims are oblique.
        for (Vec3& p : rings[k]) p -= ways[k].dot(p - middles[k]) * ways[k];
        round.push_back(geometry::arc_lengths(rings[k]));
        const double length = round.back().back();
        for (double& at : round.back()) at /= length;
        std::vector<Vec3> even = geometry::even_places(rings[k], kFineChords);
        even.pop_back();
        if (k == 0) first = even;
        if (k > 0) turn = geometry::least_turn(ways[k - 1], ways[k]) * turn;
        const double off = best_shift(first, std::move(even), turn) - turn_;
        turn_ += off - std::round(off);
        turned.push_back(turn_);
        most_turned_ = std::max(most_turned_, std::abs(turn_));
        bends_ = bends_ || geometry::angle_between(ways.front(), ways[k]) > kParallel;
    }
    // Columns between two side lines keep their share of the length between these lines.
    std::vector<double> knots{0};
    for (const LinkingLine& line : link.lines)
        if (line.source_at > 0) knots.push_back(line.source_at / link.source.length());
    knots.push_back(1);
    double worst = 0;
    for (std::size_t k = 0; k < round.size(); ++k) {
        const double up = static_cast<double>(k) / rows;
        const double frame = link.lines.empty() ? turned[k] - up * turn_ : 0;
        columns_.emplace_back();
        for (std::size_t i = 0; i <= kDegreesPerTurn; ++i) {
            const double s = static_cast<double>(i) / kDegreesPerTurn;
            const auto to = std::upper_bound(knots.begin() + 1, knots.end() - 1, s), from = to - 1;
            const auto share = [&](const std::vector<double>& of) {
                return (value_at(of, s) - value_at(of, *from)) / (value_at(of, *to) - value_at(of, *from));
            };
            const double low = value_at(round[k], *from), high = value_at(round[k], *to);
            const double f = (1 - up) * share(round.front()) + up * share(round.back());
            const double at = frame + low + f * (high - low);
            const geometry::PolylinePlace place = geometry::place_at(round[k], at - std::floor(at));
            columns_[k].push_back(std::floor(at) +
                                  (static_cast<double>(place.segment) + place.fraction) / kDegreesPerTurn);
            worst = std::max(worst, std::abs(columns_[k].back() - s));
        }
    }
    if (worst < kVisible) columns_.clear();
    if (std::abs(turn_) < kVisible) turn_ = 0;
}

double LinkingMap::harmonic(double s, double t) const
{
    const auto above = std::upper_bound(row_at_.begin() + 1, row_at_.end() - 1, t);
    const auto row = static_cast<std::size_t>(above - row_at_.begin() - 1);
    const double f = std::clamp((t - row_at_[row]) / (row_at_[row + 1] - row_at_[row]), 0.0, 1.0);
    const double at = s - std::floor(s);
    return std::floor(s) + (1 - f) * value_at(columns_[row], at) + f * value_at(columns_[row + 1], at);
}

Vec2 LinkingMap::upright(const Vec2& place) const
{
    if (columns_.empty()) return place;
    double low = place.x() - 2, high = place.x() + 2; // a column deviates by less than 2 from its harmonic s
    while (high - low > kRoundoff) {
        const double middle = (low + high) / 2;
        (harmonic(middle, place.y()) < place.x() ? low : high) = middle;
    }
    return {(low + high) / 2, place.y()};
}

WallPosition LinkingMap::locate(double s, double t, std::size_t& near) const
{
    if (!columns_.empty()) s = 0.5 + std::remainder(harmonic(s, t) - 0.5, 1.0);
    const Vec3 place(s * width_, t * height_, 0);
    geometry::FacetTree::Hit hit;
    if (near != kNoIndex)
        hit = geometry::closest_on_triangle(place,
                                            {flat_[3 * near], flat_[3 * near + 1], flat_[3 * near + 2]});
    if (hit.barycentric.minCoeff() < kSamePlace) {
        hit = tree_.closest(place);
        near = index(hit.triangle);
    }
    const std::size_t original = index(original_[near]);
    return {facets_.face[original], {facets_.number[original], hit.barycentric}};
}

std::vector<EdgeUse> edges_between(const Model& model, const LinkingSurface& link, bool void_edges)
{
    std::set<EdgeId> taken;
    for (const EdgeUse& use : link.source.uses()) taken.insert(use.edge);
    for (const EdgeUse& use : link.target.uses()) taken.insert(use.edge);
    for (const LinkingLine& line : link.lines) {
        for (const EdgeUse& use : line.line.uses) taken.insert(use.edge);
    }
    for (const FaceId wall : link.walls) {
        if (!matching::continued_wall(model, wall)) continue;
        for (const EdgeUse& use : uses_of(model[wall])) taken.insert(use.edge);
    }
    std::vector<EdgeUse> between;
    for (const FaceId wall : link.walls) {
        for (const EdgeUse& use : uses_of(model[wall])) {
            if (!taken.insert(use.edge).second) continue;
            const std::span<const FaceUse> beside = model.uses_of_edge(use.edge);
            const bool seam = beside.size() == 2 && beside[0].face == beside[1].face;
            if (!seam && (void_edges || !is_void(model, use.edge))) between.push_back(use);
        }
    }
    return between;
}

void LinkingMap::find_rings(const OpenVolume& volume, const LinkingSurface& link,
                            const std::vector<std::array<Vec2, 3>>& corners, bool void_edges)
{
    const Model& model = volume.model;
    const std::vector<EdgeUse> between = edges_between(model, link, void_edges);
    if (between.empty()) return;
    std::unordered_map<std::uint64_t, std::size_t> half; // directed side → triangle
    for (std::size_t t = 0; t < corners.size(); ++t) {
        const Triangle& facet = facets_.triangles[t];
        for (std::size_t i = 0; i < 3; ++i) half[directed_key(facet[i], facet[(i + 1) % 3])] = t;
    }
    std::vector<Ring> pieces;
    for (const EdgeUse& use : between) {
        Ring piece;
        double along = 0, up = 0;
        const std::vector<Index> points = use_points(model, use);
        const std::vector<Vec3> line = places_at(model, points);
        std::vector<double> share = geometry::arc_lengths(line);
        const double length = share.back();
        for (double& f : share) f = use.reversed ? 1 - f / length : f / length;
        for (std::size_t i = 0; i + 1 < points.size(); ++i) {
            const auto found = half.find(directed_key(points[i], points[i + 1]));
            if (found == half.end()) continue;
            const Triangle& t = facets_.triangles[found->second];
            const auto c = static_cast<std::size_t>(std::ranges::find(t, points[i]) - t.begin());
            const Vec2 a = upright(corners[found->second][c]);
            const Vec2 b = upright(corners[found->second][(c + 1) % 3]);
            piece.pieces.push_back({a, b, use.edge, share[i], share[i + 1]});
            piece.height += (a.y() + b.y()) / 2;
            along += std::abs(b.x() - a.x()) * width_;
            up += b.y() - a.y();
        }
        // The edges of a face with kept quads need not be followed: the given nodes already lie on them.
        const bool stays = std::ranges::any_of(model.uses_of_edge(use.edge), [&](const FaceUse& user) {
            return model[user.face].keeps_nodes && has_quads_all_over(model[user.face]);
        });
        if (stays) continue;
        const bool steep = piece.pieces.empty() || std::abs(up) * height_ > along;
        if (steep) {
            uprights_.push_back({use.edge, std::move(piece.pieces)});
            continue;
        }
        piece.height /= static_cast<double>(piece.pieces.size());
        piece.vertices = {use_from(model, use), use_to(model, use)};
        pieces.push_back(std::move(piece));
    }
    // Pieces that meet at a vertex form one ring.
    geometry::UnionFind sets(pieces.size());
    std::map<VertexId, std::size_t> first_at;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        for (const VertexId vertex : pieces[i].vertices)
            sets.unite_least(i, first_at.try_emplace(vertex, i).first->second);
    }
    std::map<std::size_t, Ring> rings;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        Ring& ring = rings[sets.find(i)];
        ring.height += pieces[i].height * static_cast<double>(pieces[i].pieces.size());
        ring.pieces.insert(ring.pieces.end(), pieces[i].pieces.begin(), pieces[i].pieces.end());
        ring.vertices.insert(ring.vertices.end(), pieces[i].vertices.begin(), pieces[i].vertices.end());
    }
    for (auto& [set, ring] : rings) {
        ring.height /= static_cast<double>(ring.pieces.size());
        rings_.push_back(std::move(ring));
    }
    std::ranges::stable_sort(rings_, {}, &Ring::height);
}

std::vector<LinkingMap::Crossing> LinkingMap::crossings(const Ring& ring, double s)
{
    // A column through an end of a piece crosses the ring, too.
    std::vector<Crossing> result;
    for (const Piece& piece : ring.pieces) {
        const Vec2 &a = piece.a, &b = piece.b;
        const double low = std::min(a.x(), b.x()), high = std::max(a.x(), b.x());
        for (double at = s + std::ceil(low - kSamePlace - s); at <= high + kSamePlace; at += 1) {
            const double f = high - low > kSamePlace ? std::clamp((at - a.x()) / (b.x() - a.x()), 0.0, 1.0)
                                                     : 0.5;
            result.push_back(
                {a.y() + f * (b.y() - a.y()), piece.edge, piece.from + f * (piece.to - piece.from)});
        }
    }
    std::ranges::sort(result, {}, &Crossing::t);
    return result;
}

} // namespace lacuna::surface
