// SPDX-License-Identifier: MIT
//
// Steps of split_facets(): weld points, match facet sides, collect adjacent facets into faces, and chain the
// segments between faces into edges. Segment: an undirected side of facets, see `FacetSides`.
#include <lacuna/healing/split_facets.h>
#include <lacuna/topology/model.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/incidence.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/core/shared/number_text.h>
#include <lacuna/geometry/shared/angle.h>
#include <lacuna/healing/detail/divide_arms.h>
#include <lacuna/healing/detail/facet_normals.h>
#include <lacuna/healing/detail/facet_sides.h>
#include <lacuna/healing/detail/smooth_noise.h>
#include <lacuna/healing/detail/soup_facets.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <span>

namespace lacuna::healing {
namespace {

/// Number of sides over which the turn of a border is measured on a noisy surface. With noise of 40 % of the
/// facets' sides, the measured turn is then off by 9°, about a quarter of the default feature angle.
constexpr int kNoisyReach = 8;

struct Flood {
    std::vector<Index> face;   ///< by facet: the face that it belongs to
    std::vector<bool> flipped; ///< by facet: whether it is oriented against its face
    Index faces = 0;
};

/// Cosine of the angle between two facets at a side. 1 if they are halves of one given quad.
double cosine_across(const Facets& facets, const FacetSides& sides, const std::vector<Vec3>& normal,
                     Index side, Index other)
{
    const std::size_t f = index(side / 3), g = index(other / 3);
    if (facets.quad[f] >= 0 && facets.quad[f] == facets.quad[g]) return 1;
    return (sides.from(other) != sides.from(side) ? 1 : -1) * normal[f].dot(normal[g]);
}

double least_cosine(double feature) { return std::cos(std::min(feature + kFileAccuracy, std::numbers::pi)); }

/// Closes creases that fade and come back, such as the junction of two pipes of almost the same width. From
/// the end of a crease, the sharpest sides that go on are followed, as long as facets turn by more than half
/// the feature angle there, up to another crease.
class CreaseGaps {
public:
    CreaseGaps(const Facets& facets, const FacetSides& sides, const std::vector<Vec3>& normal, double feature)
        : points_(facets.points), sides_(sides), cosine_(sides.segment_count(), 1)
    {
        const double sharp = least_cosine(feature), weak = least_cosine(feature / 2);
        for (std::size_t s = 0; s < cosine_.size(); ++s) {
            const auto on = sides.on(static_cast<Index>(s));
            const bool inner = on.size() == 2 && partner(facets, sides, on[0]) >= 0;
            cosine_[s] = inner ? cosine_across(facets, sides, normal, on[0], on[1]) : -1;
        }
        creases_ = incidence(points_.size(), [&](const auto& visit) {
            for (std::size_t s = 0; s < cosine_.size(); ++s) {
                if (!(cosine_[s] < weak)) continue;
                const Index side = sides.on(static_cast<Index>(s)).front();
                visit(index(sides.from(side)), static_cast<Index>(s));
                visit(index(sides.to(side)), static_cast<Index>(s));
            }
        });
        for (std::size_t s = 0; s < cosine_.size(); ++s) sharp_.push_back(cosine_[s] < sharp ? 1 : 0);
    }

    /// For each segment, whether it closes such a gap. Empty if there are none.
    [[nodiscard]] std::vector<char> find() const
    {
        std::vector<char> closing;
        for (std::size_t p = 0; p < points_.size(); ++p) {
            const auto here = creases_.of(p);
            if (std::ranges::count_if(here, [&](Index s) { return sharp_[index(s)] != 0; }) != 1) continue;
            const std::vector<Index> gap = from(static_cast<Index>(p));
            if (!gap.empty()) closing.resize(sharp_.size(), 0);
            for (const Index s : gap) closing[index(s)] = 1;
        }
        return closing;
    }

private:
    /// The segments from the end of a crease to another crease; empty if they lead nowhere.
    [[nodiscard]] std::vector<Index> from(Index end) const
    {
        std::vector<Index> path;
        const auto first = creases_.of(index(end));
        Index last = *std::ranges::find_if(first, [&](Index s) { return sharp_[index(s)] != 0; });
        Index at = end;
        while (true) {
            const Vec3 ahead = points_[index(at)] - points_[index(sides_.other_end(last, at))];
            Index next = -1;
            for (const Index s : creases_.of(index(at))) {
                const Vec3 way = points_[index(sides_.other_end(s, at))] - points_[index(at)];
                const bool goes_on = geometry::angle_between(ahead, way) <
                                     kBendBelow * std::numbers::pi / 180;
                if (s != last && goes_on && (next < 0 || cosine_[index(s)] < cosine_[index(next)])) next = s;
            }
            if (next < 0 || std::ranges::find(path, next) != path.end()) return {};
            path.push_back(next);
            at = sides_.other_end(next, at);
            last = next;
            if (std::ranges::any_of(creases_.of(index(at)), [&](Index s) { return sharp_[index(s)] != 0; }))
                return at == end ? std::vector<Index>{} : path;
        }
    }

    const std::vector<Vec3>& points_;
    const FacetSides& sides_;
    std::vector<double> cosine_; ///< by segment: of the angle across it; -1 at borders
    std::vector<char> sharp_;    ///< by segment: whether faces end there
    Incidence creases_;          ///< segments with creases at each point
};

/// @param closing  by segment: whether faces end there at any angle; may be empty
Flood flood_faces(const Facets& facets, const FacetSides& sides, const std::vector<Vec3>& normal,
                  double feature, const std::vector<char>& closing, const RunContext& context)
{
    const double least = least_cosine(feature);
    Flood flood{std::vector<Index>(facets.count(), -1), std::vector<bool>(facets.count(), false), 0};
    std::vector<Index> front;
    for (std::size_t seed = 0; seed < facets.count(); ++seed) {
        if (flood.face[seed] >= 0) continue;
        const Index face = flood.faces++;
        flood.face[seed] = face;
        front.assign(1, static_cast<Index>(seed));
        // Area of facets that keep their given orientation, minus that of reversed facets.
        double as_given = 0;
        for (std::size_t i = 0; i < front.size(); ++i) {
            if (i % kBetweenPolls == 0) check_cancelled(context);
            const Index f = front[i];
            as_given += (flood.flipped[index(f)] ? -1 : 1) *
                        area_vector(facets.points, facets.corner[index(f)]).norm();
            for (Index side = 3 * f; side < 3 * f + 3; ++side) {
                const Index other = partner(facets, sides, side);
                if (other < 0) continue;
                const Index g = other / 3;
                if (cosine_across(facets, sides, normal, side, other) < least) continue;
                if (!closing.empty() && closing[index(sides.segment(side))] != 0) continue;
                const bool agree = sides.from(other) != sides.from(side);
                const bool flipped = agree ? flood.flipped[index(f)] : !flood.flipped[index(f)];
                if (flood.face[index(g)] < 0) {
                    flood.face[index(g)] = face;
                    flood.flipped[index(g)] = flipped;
                    front.push_back(g);
                } else if (flood.flipped[index(g)] != flipped) {
                    throw InvalidInput(Message("topology.not_orientable",
                                               "{} is one-sided like a Möbius band: its facets at {} cannot "
                                               "be oriented consistently",
                                               NamedEntity{"face", face + 1},
                                               place_with_digits(facets.points[index(sides.from(side))], 6))
                                           .remedy("give its parts different labels"));
                }
            }
        }
        if (as_given < 0)
            for (const Index f : front) flood.flipped[index(f)] = !flood.flipped[index(f)];
    }
    return flood;
}

/// Faces that are parts of earlier ones, in the numbers of these: the first part of each has its number, and
/// the other parts follow after all.
Flood numbered_after(const Flood& before, Flood parts)
{
    std::vector<Index> number(index(parts.faces), -1);
    std::vector<char> taken(index(before.faces), 0);
    Index next = before.faces;
    for (std::size_t f = 0; f < parts.face.size(); ++f) {
        Index& own = number[index(parts.face[f])];
        char& is_taken = taken[index(before.face[f])];
        if (own < 0) own = is_taken != 0 ? next++ : before.face[f];
        is_taken = 1;
        parts.face[f] = own;
    }
    return parts;
}

/// Move the facets at the border of a face into the adjacent face if their own normals are closer to the
/// normals there, or if that shortens the border.
void straighten_borders(const Facets& facets, const FacetSides& sides, std::vector<Vec3>& normal,
                        Flood& flood, const RunContext& context)
{
    // A side more in the other face weighs as much as normals whose cosines differ by kSideWeight. With 0.5,
    // rims of saw cuts are off by a facet at noise of 20 % of the sides, with 1 at noise of 10 %.
    constexpr double kSideWeight = 0.7;
    const Incidence at_point = incidence(facets.points.size(), [&](const auto& visit) {
        for (Index f = 0; index(f) < facets.count(); ++f)
            for (const Index p : facets.corner[index(f)]) visit(index(p), f);
    });
    // Whether all facets at the corner opposite a side are in the face of the side's facet. The face then
    // stays in one part without this facet.
    const auto is_inside = [&](Index side) {
        const Index opposite = sides.to(3 * (side / 3) + (side + 1) % 3);
        return std::ranges::all_of(at_point.of(index(opposite)), [&](Index f) {
            return flood.face[index(f)] == flood.face[index(side / 3)];
        });
    };
    std::vector<Vec3> own; // of each facet with those across its sides
    for (Index f = 0; index(f) < facets.count(); ++f) {
        Vec3 area = area_vector(facets.points, facets.corner[index(f)]);
        for (Index side = 3 * f; side < 3 * f + 3; ++side) {
            const Index other = partner(facets, sides, side);
            if (other >= 0)
                area += (sides.from(other) != sides.from(side) ? 1 : -1) *
                        area_vector(facets.points, facets.corner[index(other / 3)]);
        }
        own.push_back(area.stableNormalized());
    }
    for (int pass = 0; pass < kMostRounds; ++pass) {
        check_cancelled(context);
        bool any = false;
        for (Index f = 0; index(f) < facets.count(); ++f) {
            std::array<Index, 3> across{};
            for (Index k = 0; k < 3; ++k) across[index(k)] = partner(facets, sides, 3 * f + k);
            double best = 0;
            Index into = -1;
            for (Index k = 0; k < 3; ++k) {
                const Index other = across[index(k)];
                if (other < 0 || flood.face[index(other / 3)] == flood.face[index(f)]) continue;
                const auto sides_in = [&](Index face) {
                    return std::ranges::count_if(
                        across, [&](Index side) { return side >= 0 && flood.face[index(side / 3)] == face; });
                };
                const std::ptrdiff_t there = sides_in(flood.face[index(other / 3)]);
                if (there < 2 && !is_inside(3 * f + k)) continue;
                double gain = kSideWeight * static_cast<double>(there - sides_in(flood.face[index(f)]));
                const double agree = sides.from(other) != sides.from(3 * f + k) ? 1 : -1;
                gain += own[index(f)].dot(agree * normal[index(other / 3)] - normal[index(f)]);
                if (gain <= best) continue;
                best = gain;
                into = k;
            }
            if (into < 0) continue;
            const Index other = across[index(into)];
            const bool agree = sides.from(other) != sides.from(3 * f + into);
            normal[index(f)] = (agree ? 1 : -1) * normal[index(other / 3)];
            flood.face[index(f)] = flood.face[index(other / 3)];
            flood.flipped[index(f)] = flood.flipped[index(other / 3)] != !agree;
            any = true;
        }
        if (!any) return;
    }
}

/// The faces of a noisy surface, separated by the mean normals of patches (`patch_normals()`). A region with
/// fewer facets than a patch is not a face of its own; it is added to an adjacent face.
Flood flood_noisy(const Facets& facets, const FacetSides& sides, double feature, const RunContext& context)
{
    std::vector<Vec3> normal = patch_normals(facets, sides, context);
    Flood flood = flood_faces(facets, sides, normal, feature, {}, context);
    std::vector<std::size_t> size(index(flood.faces), 0);
    for (const Index face : flood.face) ++size[index(face)];
    const std::vector<Vec3> before = normal;
    std::vector<Index> dust;
    for (Index f = 0; index(f) < facets.count(); ++f) {
        if (size[index(flood.face[index(f)])] >= kPatch) continue;
        normal[index(f)].setZero();
        dust.push_back(f);
    }
    if (!dust.empty()) {
        borrow_normals(facets, sides, dust, normal, context);
        for (const Index f : dust) // facets without a larger adjacent face get their previous normals back
            if (normal[index(f)].isZero(0)) normal[index(f)] = before[index(f)];
        flood = flood_faces(facets, sides, normal, feature, {}, context);
    }
    straighten_borders(facets, sides, normal, flood, context);
    // A small face may have lost all its facets.
    std::vector<Index> used(index(flood.faces), 0);
    for (const Index face : flood.face) used[index(face)] = 1;
    std::vector<Index> number(used.size());
    std::exclusive_scan(used.begin(), used.end(), number.begin(), Index{0});
    flood.faces = std::accumulate(used.begin(), used.end(), Index{0});
    for (Index& face : flood.face) face = number[index(face)];
    return flood;
}

Message note_on(const NoiseSmoothed& moved)
{
    if (moved.most == 0)
        return Message("healing.noisy_facets",
                       "the facets are noisy, so faces are separated by the mean normals of patches")
            .remedy("load with a larger feature_angle if the angles between facets are no noise")
            .as_warning();
    return Message(
               "healing.noisy_facets",
               "the facets are noisy and were smoothed: points moved by {:.3g} on average and {:.3g} at most",
               moved.mean, moved.most)
        .remedy("load with keep_noise = true to leave them where they are, or with a larger feature_angle if "
                "the angles between facets are no noise")
        .as_warning();
}

bool is_plane(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles, double tolerance)
{
    Vec3 normal = Vec3::Zero();
    for (const Triangle& t : triangles) normal += area_vector(points, t);
    if (!(normal.norm() > 0)) return false;
    normal.normalize();
    double low = std::numeric_limits<double>::max();
    double high = std::numeric_limits<double>::lowest();
    const Vec3& origin = points[index(triangles.front()[0])];
    for (const Triangle& t : triangles) {
        for (const Index p : t) {
            const double height = (points[index(p)] - origin).dot(normal);
            low = std::min(low, height);
            high = std::max(high, height);
        }
    }
    return high - low <= 2 * tolerance;
}

void add_faces(topology::ModelBuilder& model, const Facets& facets, const Flood& flood, const FacetSoup& soup)
{
    model.faces.resize(index(flood.faces));
    for (std::size_t f = 0; f < facets.count(); ++f) {
        topology::Face& face = model.faces[index(flood.face[f])];
        Triangle corner = facets.corner[f];
        if (flood.flipped[f]) std::swap(corner[1], corner[2]);
        if (face.triangles.empty() && facets.label[f] >= 0 &&
            static_cast<std::size_t>(facets.label[f]) < soup.label_name.size()) {
            face.name = soup.label_name[static_cast<std::size_t>(facets.label[f])];
        }
        const bool told = facets.label[f] >= 0 && index(facets.label[f]) < soup.label_keeps_nodes.size();
        if (told && soup.label_keeps_nodes[index(facets.label[f])] != 0) face.keeps_nodes = true;
        face.triangles.push_back(corner);
        const bool first_half = facets.quad[f] >= 0 && (f == 0 || facets.quad[f - 1] != facets.quad[f]);
        if (!first_half) continue;
        Quad quad = facets.quads[index(facets.quad[f])];
        if (flood.flipped[f]) std::swap(quad[1], quad[3]);
        face.given_quads.push_back(quad);
        if (!told) face.keeps_nodes = true;
    }
    for (std::size_t f = 0; f < model.faces.size(); ++f) {
        model.faces[f].tag = static_cast<int>(f) + 1;
        if (is_plane(model.points, model.faces[f].triangles, model.tolerance)) model.faces[f].kind = "plane";
    }
}

/// Chains the segments between faces into edges.
class Chains {
public:
    /// @param reach  number of sides over which the turn of a border is measured.
    Chains(topology::ModelBuilder& model, const FacetSides& sides, const Flood& flood, double feature,
           int reach, const RunContext& context)
        : model_(model),
          sides_(sides),
          context_(context),
          feature_(std::min(feature + kFileAccuracy, std::numbers::pi)),
          reach_(reach),
          kind_(sides.segment_count(), -1),
          done_(sides.segment_count(), false)
    {
        find_borders(flood);
        check_cancelled(context_);
        vertex_at_.assign(model.points.size(), VertexId());
        is_vertex_.resize(model.points.size());
        for (std::size_t p = 0; p < model.points.size(); ++p)
            is_vertex_[p] = ends_chains(static_cast<Index>(p));
    }

    /// Add the edges, face by face. The first face at an edge is on the left of the edge.
    void add_edges(const Flood& flood)
    {
        const Incidence of_face = incidence(index(flood.faces), [&](const auto& visit) {
            for (std::size_t f = 0; f < flood.face.size(); ++f)
                visit(index(flood.face[f]), static_cast<Index>(f));
        });
        check_cancelled(context_);
        for (const Index f : of_face.items) {
            for (Index side = 3 * f; side < 3 * f + 3; ++side) {
                const Index segment = sides_.segment(side);
                if (kind_[index(segment)] < 0 || done_[index(segment)]) continue;
                const bool flipped = flood.flipped[index(f)];
                add_edge(segment, flipped ? sides_.to(side) : sides_.from(side));
            }
        }
    }

private:
    /// Find the segments that belong to edges: those at which some face does not have exactly two facets.
    /// Segments with the same faces are of one kind; segments of one kind are chained into edges.
    void find_borders(const Flood& flood)
    {
        std::map<std::vector<Index>, Index> kinds;
        std::vector<Index> faces;
        const auto count = static_cast<Index>(sides_.segment_count());
        for (Index s = 0; s < count; ++s) {
            const auto on = sides_.on(s);
            if (on.size() == 2 && flood.face[index(on[0]) / 3] == flood.face[index(on[1]) / 3]) continue;
            faces.clear();
            for (const Index side : on) faces.push_back(flood.face[index(side) / 3]);
            std::sort(faces.begin(), faces.end());
            const auto is_twice = [&](Index face) { return std::ranges::count(faces, face) == 2; };
            if (std::ranges::all_of(faces, is_twice)) continue;
            kind_[index(s)] = kinds.try_emplace(faces, static_cast<Index>(kinds.size())).first->second;
        }
        at_ = incidence(model_.points.size(), [&](const auto& visit) {
            for (Index s = 0; s < count; ++s) {
                if (kind_[index(s)] < 0) continue;
                visit(index(sides_.from(sides_.on(s).front())), s);
                visit(index(sides_.to(sides_.on(s).front())), s);
            }
        });
    }

    [[nodiscard]] std::span<const Index> segments_at(Index point) const { return at_.of(index(point)); }

    /// Whether a chain continues through a point: exactly two edge segments meet there, and both are of one
    /// kind.
    [[nodiscard]] bool goes_on(Index point) const
    {
        const auto here = segments_at(point);
        return here.size() == 2 && kind_[index(here[0])] == kind_[index(here[1])];
    }

    /// The next points along a chain, at most `reach_` of them.
    [[nodiscard]] std::vector<Index> points_after(Index point, Index segment) const
    {
        std::vector<Index> points;
        for (int k = 0; k < reach_; ++k) {
            const Index next = sides_.other_end(segment, points.empty() ? point : points.back());
            points.push_back(next);
            if (!goes_on(next)) break;
            segment = segments_at(next)[segments_at(next)[0] == segment ? 1 : 0];
        }
        return points;
    }

    /// Turn of a chain at a point within it [radians].
    [[nodiscard]] double turn_at(Index point) const
    {
        const auto here = segments_at(point);
        const Vec3 into = model_.at(point) - model_.at(points_after(point, here[0]).back());
        const Vec3 onward = model_.at(points_after(point, here[1]).back()) - model_.at(point);
        return geometry::angle_between(into, onward);
    }

    /// Whether chains end at this point: segments of different kinds meet there, or the point is a corner,
    /// where a chain turns by more than the feature angle. If `reach_` exceeds 1, a corner must also have the
    /// largest turn of all points within the reach, and its turn must exceed that at one end of the reach by
    /// more than the feature angle.
    [[nodiscard]] bool ends_chains(Index point) const
    {
        const auto here = segments_at(point);
        if (here.empty()) return false;
        if (!goes_on(point)) return true;
        const double turn = turn_at(point);
        if (!(turn > feature_)) return false;
        if (reach_ == 1) return true;
        double least = turn;
        for (const Index segment : here) {
            const std::vector<Index> others = points_after(point, segment);
            for (const Index other : others)
                if (!goes_on(other) || std::pair(turn_at(other), other) > std::pair(turn, point))
                    return false;
            least = std::min(least, turn_at(others.back()));
        }
        return turn - least > feature_;
    }

    VertexId vertex(Index point)
    {
        VertexId& id = vertex_at_[index(point)];
        if (!id.valid()) {
            id = VertexId(model_.vertices.size());
            model_.vertices.push_back({.point = point, .tag = static_cast<int>(model_.vertices.size()) + 1});
        }
        return id;
    }

    /// The points of a chain from `point` along `segment`, up to a vertex or back to the start.
    std::vector<Index> walk(Index segment, Index point)
    {
        std::vector<Index> points{point};
        while (true) {
            done_[index(segment)] = true;
            point = sides_.other_end(segment, point);
            points.push_back(point);
            if (is_vertex_[index(point)] || point == points.front()) return points;
            const auto here = segments_at(point);
            segment = here[0] == segment ? here[1] : here[0];
        }
    }

    void add_edge(Index segment, Index start)
    {
        std::vector<Index> points = walk(segment, start);
        const bool closed = points.front() == points.back();
        if (!is_vertex_[index(start)] && !closed) {
            // The walk started in the middle of a chain: prepend the other part, reversed.
            const auto here = segments_at(start);
            std::vector<Index> before = walk(here[0] == segment ? here[1] : here[0], start);
            std::reverse(before.begin(), before.end());
            before.pop_back();
            points.insert(points.begin(), before.begin(), before.end());
        } else if (!is_vertex_[index(start)]) {
            points.pop_back();
            std::rotate(points.begin(), std::min_element(points.begin(), points.end()), points.end());
            points.push_back(points.front());
        }
        topology::Edge edge;
        edge.tag = static_cast<int>(model_.edges.size()) + 1;
        edge.from = vertex(points.front());
        edge.to = vertex(points.back());
        edge.points = std::move(points);
        model_.edges.push_back(std::move(edge));
    }

    topology::ModelBuilder& model_;
    const FacetSides& sides_;
    const RunContext& context_;
    double feature_;
    int reach_;
    std::vector<Index> kind_; ///< kind of each segment; -1: the segment is within a face
    std::vector<bool> done_;  ///< by segment: whether it is part of an edge already
    Incidence at_;            ///< edge segments at each point
    std::vector<bool> is_vertex_;
    std::vector<VertexId> vertex_at_;
};

} // namespace

topology::Model split_facets(const FacetSoup& soup, const SplitOptions& options, const RunContext& context)
{
    if (!(options.feature_angle > 0 && options.feature_angle <= 180)) {
        throw InvalidInput("topology.bad_angle",
                           "'feature_angle' is {:.6g} degrees; it must be above {} and at most {}",
                           found(options.feature_angle), needed(0), needed(180));
    }
    if (!(options.tolerance >= 0)) {
        throw InvalidInput("topology.bad_tolerance", "'tolerance' is {:.6g}; it must be {} or above",
                           found(options.tolerance), needed(0));
    }
    const double feature = options.feature_angle * std::numbers::pi / 180;
    const Facets facets = facets_of(soup, options.tolerance, context);
    check_cancelled(context);
    const FacetSides sides(facets.corner, facets.points.size());
    check_cancelled(context);
    const double face_angle = options.whole_labels ? std::numbers::pi : feature;
    const std::vector<Vec3> normal = own_normals(facets, sides, feature, context);
    Flood flood = flood_faces(facets, sides, normal, face_angle, {}, context);
    const bool noisy = !options.whole_labels &&
                       is_noisy(facets, sides, normal, flood.face, flood.flipped, feature, context);
    topology::ModelBuilder model;
    if (noisy)
        flood = flood_noisy(facets, sides, feature, context);
    else if (!options.whole_labels)
        if (const auto closing = CreaseGaps(facets, sides, normal, feature).find(); !closing.empty())
            flood = numbered_after(flood, flood_faces(facets, sides, normal, feature, closing, context));
    model.points = facets.points;
    model.tolerance = facets.tolerance;
    model.diagonal = facets.diagonal;
    if (facets.joined > kFileAccuracy * facets.diagonal) {
        model.notes.push_back(Message("healing.joined_points",
                                      "points that are up to {:.2g} apart are read as one", facets.joined)
                                  .remedy("load with a smaller 'tolerance' to keep them apart")
                                  .as_warning());
    }
    if (facets.repeated > 0) {
        model.notes.push_back({"healing.repeated_facets", "{} {} listed twice; one of each is kept",
                               facets.repeated, facets.repeated == 1 ? "facet was" : "facets were"});
    }
    if (facets.shrunk > 0) {
        model.notes.push_back({"healing.small_facets",
                               "{} {} smaller than the tolerance of {:.4g} and left out", facets.shrunk,
                               facets.shrunk == 1 ? "facet was" : "facets were", facets.tolerance});
    }
    add_faces(model, facets, flood, soup);
    check_cancelled(context);
    Chains(model, sides, flood, feature, noisy ? kNoisyReach : 1, context).add_edges(flood);
    check_cancelled(context);
    if (noisy)
        model.notes.push_back(note_on(options.keep_noise ? NoiseSmoothed{} : smooth_noise(model, context)));
    model.build_loops(context);
    if (!options.whole_labels) divide_arms(model, context);
    return std::move(model).finish();
}

} // namespace lacuna::healing
