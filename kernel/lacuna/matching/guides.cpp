// SPDX-License-Identifier: MIT
#include <lacuna/matching/shared/guides.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/attempt.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/core/shared/parallel.h>
#include <lacuna/geometry/newell.h>
#include <lacuna/geometry/shared/affine.h>
#include <lacuna/geometry/shared/minimal_frame.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/topology/shared/face_parts.h>
#include <lacuna/topology/shared/use_places.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <ranges>
#include <set>
#include <span>

namespace lacuna::matching {

using namespace topology;

namespace {

/// Number of sample points of a section between two side lines. An affine fit needs four points; twice as
/// many reduce the effect of the facets. With 16 points, a twisted prism of four sides closes to 0.7 % of its
/// volume instead of 0.5 %.
constexpr int kSamplesBetween = 8;

using FacetSide = std::pair<Index, Index>;

FacetSide side(Index a, Index b) { return {std::min(a, b), std::max(a, b)}; }

/// A level line of `wall_heights()` on the facets of one connected part of the walls.
struct LevelLine {
    std::vector<Vec3> points;
    std::vector<FacetSide> sides;                             ///< by point: the facet side on which it lies
    std::vector<std::pair<std::size_t, std::size_t>> anchors; ///< (index of the point, number of the side
                                                              ///< line that crosses there), in traversal
                                                              ///< order
    bool closed = false;
    Vec3 rise{0, 0, 0}; ///< upward direction on the walls, integrated along the line
};

/// Mean upward direction on the walls at each model point. The directions of single facets would jump from
/// facet to facet.
std::vector<Vec3> ways_up(const OpenVolume& volume, const std::vector<double>& heights)
{
    const Model& model = volume.model;
    std::vector<Vec3> sum(model.points.size(), Vec3::Zero());
    for (const FaceId face : volume.faces(Role::wall)) {
        for (const Triangle& t : model[face].triangles) {
            const auto height = [&](std::size_t i) { return heights[static_cast<std::size_t>(t[i])]; };
            const Vec3 a = model.at(t[1]) - model.at(t[0]), b = model.at(t[2]) - model.at(t[0]);
            const Vec3 normal = a.cross(b);
            const Vec3 gradient = (height(1) - height(0)) * b.cross(normal) +
                                  (height(2) - height(0)) * normal.cross(a);
            if (!gradient.allFinite()) continue;
            for (const Index p : t)
                sum[static_cast<std::size_t>(p)] += normal.norm() * gradient.stableNormalized();
        }
    }
    for (Vec3& up : sum) up.stableNormalize();
    return sum;
}

/// For each level, the facets that it passes through, in their order. Empty if some facet has no height.
/// Cost: nearly linear in the facets and in the output.
std::optional<std::vector<std::vector<Triangle>>> facets_at_levels(const OpenVolume& volume,
                                                                   const std::vector<FaceId>& part,
                                                                   const std::vector<double>& heights,
                                                                   const std::vector<double>& levels)
{
    std::vector<std::vector<Triangle>> found(levels.size());
    for (const FaceId face : part) {
        for (const Triangle& t : volume.model[face].triangles) {
            double least = heights[index(t[0])], most = least;
            for (const Index p : t) {
                const double height = heights[index(p)];
                if (std::isnan(height)) return std::nullopt;
                least = std::min(least, height);
                most = std::max(most, height);
            }
            // A corner exactly at a level counts as above it.
            for (auto level = std::upper_bound(levels.begin(), levels.end(), least);
                 level != levels.end() && *level <= most; ++level)
                found[static_cast<std::size_t>(level - levels.begin())].push_back(t);
        }
    }
    return found;
}

/// The level line at height t; empty if there are several lines or none.
/// @param triangles  the facets that the level passes through.
std::optional<LevelLine> level_line(const Model& model, const std::vector<Triangle>& triangles,
                                    const std::vector<double>& heights, double t, const std::vector<Vec3>& up,
                                    const std::map<FacetSide, std::size_t>& on_line)
{
    const auto above = [&](Index p) { return heights[static_cast<std::size_t>(p)] >= t; };
    const auto crossing = [&](const FacetSide& at, const std::vector<Vec3>& of) {
        const auto a = static_cast<std::size_t>(at.first), b = static_cast<std::size_t>(at.second);
        const double f = (t - heights[a]) / (heights[b] - heights[a]);
        return Vec3((1 - f) * of[a] + f * of[b]);
    };
    std::map<FacetSide, FacetSide> next;
    std::set<FacetSide> entered;
    LevelLine line;
    for (const Triangle& triangle : triangles) {
        FacetSide from{-1, -1}, to{-1, -1};
        for (std::size_t i = 0; i < 3; ++i) {
            const Index a = triangle[i], b = triangle[(i + 1) % 3];
            if (above(a) && !above(b)) from = side(a, b);
            if (!above(a) && above(b)) to = side(a, b);
        }
        if (from.first < 0 || to.first < 0) continue;
        next[from] = to;
        entered.insert(to);
        const double piece = (crossing(to, model.points) - crossing(from, model.points)).norm();
        line.rise += piece * (crossing(from, up) + crossing(to, up));
    }
    if (next.empty()) return std::nullopt;
    line.closed = true;
    FacetSide start = next.begin()->first;
    for (const auto& [from, to] : next) {
        if (!entered.contains(from)) {
            start = from;
            line.closed = false;
            break;
        }
        if (on_line.contains(from)) start = from;
    }
    std::size_t steps = 0;
    for (FacetSide at = start;; ++steps) {
        if (const auto found = on_line.find(at); found != on_line.end())
            line.anchors.emplace_back(line.points.size(), found->second);
        line.points.push_back(crossing(at, model.points));
        line.sides.push_back(at);
        const auto onward = next.find(at);
        if (onward == next.end()) break;
        at = onward->second;
        if (at == start) {
            ++steps;
            line.points.push_back(line.points.front());
            line.sides.push_back(line.sides.front());
            break;
        }
    }
    if (steps != next.size()) return std::nullopt;
    return line;
}

/// A facet side whose face has an exact surface.
struct ExactSide {
    FaceId face;
    Vec2 first, second; ///< parameters at the ends, the lower point first
};

/// The sides of a wall part that lie on an exact surface.
std::map<FacetSide, ExactSide> exact_sides(const Model& model, const std::vector<FaceId>& part)
{
    std::map<FacetSide, ExactSide> found;
    for (const FaceId face : part) {
        if (model[face].surface == nullptr) continue;
        const std::vector<Triangle>& triangles = model[face].triangles;
        for (std::size_t f = 0; f < triangles.size(); ++f) {
            for (std::size_t i = 0; i < 3; ++i) {
                const std::size_t j = (i + 1) % 3;
                const Index a = triangles[f][i], b = triangles[f][j];
                const Vec2 &at_a = model[face].uv[f][i], &at_b = model[face].uv[f][j];
                found.try_emplace(side(a, b),
                                  a < b ? ExactSide{face, at_a, at_b} : ExactSide{face, at_b, at_a});
            }
        }
    }
    return found;
}

/// Project the points of level lines onto the exact surfaces of their faces. For a thin void, the sag of the
/// facets would be large compared with the void. A point stays in place if it cannot be projected, or if it
/// would move further than the length of its facet side.
void put_on_surfaces(const Model& model, const std::vector<FaceId>& part, std::vector<LevelLine>& lines,
                     const RunContext& context)
{
    const std::map<FacetSide, ExactSide> exact = exact_sides(model, part);
    if (exact.empty()) return;
    struct Moved {
        std::vector<Vec3*> from;
        std::vector<double> reach;
        std::vector<Vec3> to;
        std::vector<Vec2> uv;
    };
    std::map<FaceId, Moved> moved;
    for (LevelLine& line : lines) {
        for (std::size_t i = 0; i < line.points.size(); ++i) {
            const auto found = exact.find(line.sides[i]);
            if (found == exact.end()) continue;
            const ExactSide& on = found->second;
            const Vec3 &a = model.at(line.sides[i].first), &b = model.at(line.sides[i].second);
            const double length = (b - a).norm();
            const double share = length > 0 ? (line.points[i] - a).norm() / length : 0;
            Moved& of_face = moved[on.face];
            of_face.from.push_back(&line.points[i]);
            of_face.reach.push_back(length);
            of_face.to.push_back(line.points[i]);
            of_face.uv.emplace_back((1 - share) * on.first + share * on.second);
        }
    }
    for (auto& [face, points] : moved) {
        if (!attempt<BackendError>([&] { model[face].surface->project(points.to, points.uv, context); }))
            continue;
        for (std::size_t i = 0; i < points.to.size(); ++i)
            if ((points.to[i] - *points.from[i]).norm() <= points.reach[i]) *points.from[i] = points.to[i];
    }
}

/// Make a closed line start where it crosses the side line with the lowest number.
void start_at_first_anchor(LevelLine& line)
{
    if (!line.closed || line.anchors.empty()) return;
    const auto first = std::ranges::min_element(line.anchors, {}, [](const auto& at) { return at.second; });
    const std::size_t shift = first->first;
    line.points.pop_back();
    const std::size_t n = line.points.size();
    std::rotate(line.points.begin(), line.points.begin() + static_cast<std::ptrdiff_t>(shift),
                line.points.end());
    line.points.push_back(line.points.front());
    for (auto& [point, number] : line.anchors) point = (point + n - shift) % n;
    std::sort(line.anchors.begin(), line.anchors.end());
}

/// Whether two lines cross the same side lines in the same order, and are both closed or both open.
bool are_alike(const LevelLine& a, const LevelLine& b)
{
    return a.closed == b.closed &&
           std::ranges::equal(a.anchors | std::views::values, b.anchors | std::views::values);
}

/// Sample points of a level line.
/// @param start  running length at which a closed line that crosses no side line starts.
std::vector<Vec3> sampled(const LevelLine& line, double start = 0)
{
    const std::vector<double> arc = geometry::arc_lengths(line.points);
    std::vector<double> stops{0};
    for (const auto& [point, number] : line.anchors) {
        if (point > 0 && point + 1 < line.points.size()) stops.push_back(arc[point]);
    }
    stops.push_back(arc.back());
    const int each = line.closed && line.anchors.empty() ? kFineChords : kSamplesBetween;
    std::vector<Vec3> samples;
    for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
        for (int k = 0; k < each; ++k) {
            const double at = start + stops[i] + (stops[i + 1] - stops[i]) * k / each;
            samples.push_back(geometry::point_at(line.points, arc, at <= arc.back() ? at : at - arc.back()));
        }
    }
    if (!line.closed) samples.push_back(line.points.back());
    return samples;
}

/// For each section, the direction of the curve through the centroids of all sections.
std::vector<Vec3> ways_along(const std::vector<LevelLine>& lines)
{
    std::vector<Vec3> middles;
    std::vector<double> widths;
    for (const LevelLine& line : lines) {
        middles.push_back(geometry::mean_point(sampled(line)));
        widths.push_back(geometry::length(line.points) / std::numbers::pi);
    }
    return geometry::ways_along(middles, widths);
}

/// Samples of a closed section. The start is chosen for the least twist relative to the section below: first
/// the best sample, then the place beside it for which the mean offset along the line is zero. Without the
/// second step, each section would be twisted by up to half a step.
/// @param onward  rotation of the sweep direction from the section below to this one. Without this rotation,
///                inclined levels would twist a little at every step of a bend.
std::vector<Vec3> aligned(const LevelLine& line, const std::vector<Vec3>& below,
                          const Eigen::Matrix3d& onward)
{
    const std::vector<Vec3> section = sampled(line);
    const std::size_t n = section.size();
    const Vec3 to = geometry::mean_point(section), from = geometry::mean_point(below);
    const auto off = [&](std::size_t i, std::size_t k) {
        return Vec3((section[(i + k) % n] - to) - onward * (below[i] - from));
    };
    std::size_t best = 0;
    double least = kInfinity;
    for (std::size_t k = 0; k < n; ++k) {
        double sum = 0;
        for (std::size_t i = 0; i < n && sum < least; ++i) sum += off(i, k).squaredNorm();
        if (sum < least) {
            least = sum;
            best = k;
        }
    }
    double against = 0, along = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const Vec3 step = (section[(i + best + 1) % n] - section[(i + best + n - 1) % n]) / 2;
        against -= step.dot(off(i, best));
        along += step.squaredNorm();
    }
    const double length = geometry::length(line.points);
    const double further = along > 0 ? std::clamp(against / along, -0.5, 0.5) : 0;
    const double start = (static_cast<double>(best) + further) * length / static_cast<double>(n);
    return sampled(line, start < 0 ? start + length : start);
}

/// The sections of one connected part of the walls.
struct PartSections {
    std::vector<std::vector<Vec3>> points;
    std::vector<Vec3> areas;
    bool closed = false;
};

/// Complete a section for the fit.
/// @return  its area vector, which points up the wall, so that the area vectors of several wall parts can be
///         added.
///
/// An open section does not determine the size of the void beside it. A straight section does not even
/// determine the rotation about itself. Therefore two points off the wall are added to an open section, and
/// its area is increased by that of a circle whose circumference is the distance between the section's ends.
Vec3 complete(const LevelLine& line, std::vector<Vec3>& section)
{
    const Vec3 area = geometry::newell_vector(section);
    if (line.closed) return area.dot(line.rise) < 0 ? Vec3(-area) : area;
    const Vec3 open = section.back() - section.front();
    const Vec3 up = (line.rise - line.rise.dot(open) / open.squaredNorm() * open).stableNormalized();
    const Vec3 middle = geometry::mean_point(section);
    const Vec3 off = up.cross(open) / kFullTurn;
    section.push_back(middle + off);
    section.push_back(middle - off);
    return (std::abs(area.dot(up)) + open.squaredNorm() / (4 * std::numbers::pi)) * up;
}

/// Number of points that `complete()` adds to an open section.
constexpr std::size_t kAdded = 2;
/// Walls that form no ring are extrapolated to the rest of their loop if their largest distance from their
/// own chord is at least this share of the loop's largest distance from that chord. Extrapolation then at
/// most about doubles the error of the fit.
constexpr double kReach = 0.5;

/// Whether walls that form no ring can be extrapolated to the rest of their loop, see `kReach`.
/// @param section  section of the walls at the rim, without the points of `complete()`.
/// @param rim  the whole loop.
bool says_the_rest(std::span<const Vec3> section, const std::vector<Vec3>& rim)
{
    const Vec3 from = section.front(), gap = (section.back() - from).stableNormalized();
    const auto furthest = [&](std::span<const Vec3> points) {
        double most = 0;
        for (const Vec3& p : points) most = std::max(most, ((p - from) - (p - from).dot(gap) * gap).norm());
        return most;
    };
    const double reach = furthest(section);
    return reach > 0 && reach >= kReach * furthest(rim);
}

/// For both ends of an open line: whether the end lies on a side line.
std::pair<bool, bool> ends_anchored(const LevelLine& line)
{
    if (line.anchors.empty()) return {false, false};
    return {line.anchors.front().first == 0, line.anchors.back().first + 1 == line.points.size()};
}

/// If walls end between the rims, some open lines are longer than others. Trim all lines to the side lines
/// that they share.
/// @return  false if the lines end differently and share fewer than two side lines.
bool cut_to_shared(std::vector<LevelLine>& lines)
{
    const bool alike = std::ranges::all_of(
        lines, [&](const LevelLine& line) { return ends_anchored(line) == ends_anchored(lines.front()); });
    if (alike || lines.front().closed) return true;
    if (lines.front().anchors.size() < 2) return false;
    for (LevelLine& line : lines) {
        const auto first = static_cast<std::ptrdiff_t>(line.anchors.front().first);
        const auto last = static_cast<std::ptrdiff_t>(line.anchors.back().first);
        line.points = {line.points.begin() + first, line.points.begin() + last + 1};
        for (auto& [point, number] : line.anchors) point -= static_cast<std::size_t>(first);
    }
    return true;
}

/// Sections of one connected part of the walls. Empty if a level is not a single line, or if the lines do not
/// cross the same side lines.
PartSections sections_of(const OpenVolume& volume, const std::vector<FaceId>& part,
                         const std::vector<double>& heights, const std::vector<Vec3>& up,
                         const std::map<FacetSide, std::size_t>& on_line, const RunContext& context)
{
    std::vector<double> levels;
    // The first and the last level are slightly inside the wall part, because facets have corners on the
    // rims.
    for (int k = 0; k <= kFineChords; ++k)
        levels.push_back(std::clamp(static_cast<double>(k) / kFineChords, kRoundoff, 1 - kRoundoff));
    const auto facets = facets_at_levels(volume, part, heights, levels);
    if (!facets) return {};
    std::vector<LevelLine> lines;
    for (std::size_t k = 0; k < levels.size(); ++k) {
        check_cancelled(context);
        std::optional<LevelLine> line = level_line(volume.model, (*facets)[k], heights, levels[k], up,
                                                   on_line);
        if (!line) return {};
        lines.push_back(std::move(*line));
    }
    put_on_surfaces(volume.model, part, lines, context);
    for (std::size_t k = 0; k < levels.size(); ++k) {
        start_at_first_anchor(lines[k]);
        if (!are_alike(lines[k], lines.front())) return {};
    }
    if (!cut_to_shared(lines)) return {};
    PartSections result;
    result.closed = lines.front().closed;
    std::vector<std::vector<Vec3>>& sections = result.points;
    const bool guess = lines.front().closed && lines.front().anchors.empty();
    const std::vector<Vec3> ways = guess ? ways_along(lines) : std::vector<Vec3>{};
    for (std::size_t k = 0; k < lines.size(); ++k) {
        const LevelLine& line = lines[k];
        sections.push_back(guess && k > 0
                               ? aligned(line, sections.back(), geometry::least_turn(ways[k - 1], ways[k]))
                               : sampled(line));
        result.areas.push_back(complete(line, sections.back()));
        if (sections.back().size() != sections.front().size()) return {};
    }
    return result;
}

/// Add the sections of a wall part to each source loop that the part touches, if the part can be extrapolated
/// (`says_the_rest()`). Sections of several parts on one loop are merged.
void add_to_loops(const OpenVolume& volume, const std::vector<FaceId>& part, const PartSections& sections,
                  std::vector<LoopSections>& loops)
{
    const Model& model = volume.model;
    const std::set<EdgeId> edges = edges_of(model, part);
    for (const Rim& rim : rims(model, volume.faces(Role::source))) {
        if (std::ranges::none_of(rim.uses, [&](const EdgeUse& use) { return edges.contains(use.edge); }))
            continue;
        std::vector<Index> points;
        for (const EdgeUse& use : rim.uses)
            points.insert(points.end(), model[use.edge].points.begin(), model[use.edge].points.end());
        const std::span<const Vec3> rim_section(sections.points.front());
        if (!says_the_rest(rim_section.first(rim_section.size() - kAdded), places_at(model, points)))
            continue;
        auto loop = std::ranges::find(loops, points, &LoopSections::rim);
        if (loop == loops.end()) {
            loop = loops.insert(loops.end(), {points, {}, {}});
            loop->levels.resize(sections.points.size());
        }
        loop->faces.insert(loop->faces.end(), part.begin(), part.end());
        for (std::size_t k = 0; k < sections.points.size(); ++k) {
            const std::vector<Vec3>& own = sections.points[k];
            loop->levels[k].insert(loop->levels[k].end(), own.begin(), own.end() - kAdded);
        }
    }
}

} // namespace

Sections cut_sections(const OpenVolume& volume, const std::vector<SideLine>& lines, const RunContext& context)
{
    const Model& model = volume.model;
    Sections result;
    result.heights = wall_heights(volume, lines, context);
    const std::vector<Vec3> up = ways_up(volume, result.heights);
    result.levels.resize(kFineChords + 1);
    std::map<FacetSide, std::size_t> on_line;
    for (std::size_t l = 0; l < lines.size(); ++l) {
        for (const EdgeUse& use : lines[l].uses) {
            const std::vector<Index>& points = model[use.edge].points;
            for (std::size_t i = 0; i + 1 < points.size(); ++i) on_line[side(points[i], points[i + 1])] = l;
        }
    }
    const std::vector<std::vector<FaceId>> walls = connected_parts(model, volume.faces(Role::wall));
    std::vector<PartSections> parts(walls.size());
    // Exact surfaces must be evaluated by one thread at a time.
    RunContext threads = context;
    if (std::ranges::any_of(volume.faces(Role::wall), [&](FaceId f) { return model[f].surface != nullptr; }))
        threads.threads = 1;
    parallel_each(threads, walls.size(), 1, [&](std::size_t p) {
        parts[p] = sections_of(volume, walls[p], result.heights, up, on_line, context);
    });
    for (std::size_t p = 0; p < walls.size(); ++p) {
        result.closed = result.closed || parts[p].closed;
        if (!parts[p].closed && !parts[p].points.empty())
            add_to_loops(volume, walls[p], parts[p], result.loops);
    }
    if (!parts.empty()) result.areas.assign(result.levels.size(), Vec3::Zero());
    for (const PartSections& part : parts) {
        if (result.closed && !part.closed) continue; // rings need no extrapolation; ignore other parts
        for (std::size_t k = 0; k < part.points.size(); ++k) {
            result.areas[k] += part.areas[k];
            result.levels[k].insert(result.levels[k].end(), part.points[k].begin(), part.points[k].end());
        }
    }
    return result;
}

} // namespace lacuna::matching
