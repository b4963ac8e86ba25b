// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/volume_share.h>

#include <lacuna/closure/close.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/edge_key.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/surface/shared/rim_breaks.h>
#include <lacuna/surface/shared/shape_size.h>
#include <lacuna/surface/shared/wall_columns.h>
#include <lacuna/sweep/detail/plans.h>
#include <lacuna/sweep/detail/turned_round.h>
#include <lacuna/sweep/detail/words.h>
#include <lacuna/topology/shared/facet_area.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <set>
#include <unordered_map>
#include <utility>

namespace lacuna::sweep {

using namespace topology;

namespace {

/// Allowed volume error with default numbers of sides, as a share of the volume. The first value is the
/// total. Of this, the second value is reserved for curvature of ends and the third for curvature along the
/// sweep, if there is such curvature. The total must stay below 1 %; the margin covers effects that the model
/// ignores.
constexpr double kAllLost = 0.008, kLostByEnds = 0.002, kLostByLayers = 0.003;
/// Creases across an end get nodes if this needs at most this many sides per turn. If more are needed, the
/// creases are taken for mere borders of fine facets, and a smaller size is used instead.
constexpr int kMostForCreases = 40;
/// Curvature of an end may reduce its size to the first value, as a share of the default. It may reduce the
/// size further as long as the end has at most the second number of quads. Not measured.
constexpr double kLeastPart = 0.25, kMostForEnds = 2000;
/// Factor by which the sides of quads inside ends exceed the size. Measured on domes with six to twelve
/// sides: they had half to two thirds as many quads as the area divided by the squared size.
constexpr double kLonger = 1.35;
/// Upper bound of the mean elongation of quads on an end, √(area / projected area). Ends that are steeper,
/// such as most of a ball, are not paved in one plane.
constexpr double kSteepest = 2;
/// So that a grid fits, the rim of an end may have fewer sides than the size requires, for example 16 instead
/// of 24. The wall model therefore uses the size times this factor.
constexpr double kFewer = 1.5;

double lost_by(double turn, double side) { return turn * side * side / 12; }

double area_of(const OpenVolume& volume, Role end)
{
    double area = 0;
    for (const FaceId face : volume.faces(end)) area += face_area(volume.model, face);
    return area;
}

/// How a face bends at the sides between its facets.
struct FaceBends {
    struct Side {
        Index a, b;    ///< points at its ends
        double turn;   ///< angle between the facets [radian]; negative: concave
        double length; ///< [model length]
        double area;   ///< of the two facets [model length²]
    };
    std::vector<Side> sides;
    /// How much the face bends in its second direction, relative to the first: 0 for a cylinder, whose facets
    /// turn at one of their sides each, and about 1 for a sphere.
    double second = 0;
};

FaceBends bends_of(const Model& model, const Face& face)
{
    FaceBends bends;
    std::vector<std::array<double, 3>> of_facet(face.triangles.size(), {0, 0, 0});
    std::unordered_map<std::uint64_t, std::pair<std::size_t, std::size_t>> first; // facet and side
    for (std::size_t f = 0; f < face.triangles.size(); ++f) {
        const Triangle& t = face.triangles[f];
        for (std::size_t k = 0; k < 3; ++k) {
            const Index a = t[k], b = t[(k + 1) % 3];
            const auto [other, fresh] = first.try_emplace(edge_key(a, b), f, k);
            if (fresh) continue;
            const auto [g, j] = other->second;
            const Vec3 side = model.at(b) - model.at(a);
            const Vec3 own = facet_area_vector(model, t);
            const Vec3 beside = facet_area_vector(model, face.triangles[g]);
            const double turn = std::atan2(
                beside.stableNormalized().cross(own.stableNormalized()).dot(side.stableNormalized()),
                own.stableNormalized().dot(beside.stableNormalized()));
            if (turn == 0) continue;
            bends.sides.push_back({a, b, turn, side.norm(), own.norm() + beside.norm()});
            of_facet[f][k] = of_facet[g][j] = std::abs(turn) * side.norm();
        }
    }
    double most = 0, next = 0; // the two largest bends of each facet
    for (std::array<double, 3>& here : of_facet) {
        std::ranges::sort(here);
        most += here[2];
        next += here[1];
    }
    if (most > 0) bends.second = next / most;
    return bends;
}

/// The volume that a mesh loses on an end because of the end's own curvature. Creases with nodes at both ends
/// lose nothing.
/// @param scale  length of the end's sides, relative to the size
/// @param per_turn  sides for a full turn of a rim; 0: the rims do not limit the sides
double lost_on_end(const OpenVolume& volume, Role end, double scale, const SweepOptions& options,
                   const surface::SizeField& size, int per_turn, const std::set<Index>& kept)
{
    const Model& model = volume.model;
    double lost = 0;
    // The normal of the end, if its faces look the same way; the opposite halves of a tube do not.
    Vec3 normal = Vec3::Zero();
    double areas = 0;
    for (const FaceId id : volume.faces(end)) {
        normal += face_area_vector(model, id);
        areas += face_area_vector(model, id).norm();
    }
    const double alike = normal.norm() / areas;
    normal.stableNormalize();
    for (const FaceId id : volume.faces(end)) {
        const Face& face = model[id];
        // Sides of order 2 lie on exact surfaces and lose nothing there. On facets they may have been kept
        // straight for better cells.
        if (face.kind == "plane" || (options.order > 1 && face.surface != nullptr)) continue;
        // Quads are even in the plane, so they are longer on a steep end. If a face bends in one direction
        // only, such as a cylinder, its rims bend as it does, so its sides are also limited as theirs are.
        const Vec3 own = face_area_vector(model, id);
        const double flat = std::lerp(own.norm(), std::abs(own.dot(normal)), alike);
        const double steep = std::min(std::sqrt(face_area(model, id) / flat), kSteepest);
        const FaceBends bends = bends_of(model, face);
        for (const auto& [a, b, turn, length, area] : bends.sides) {
            if (kept.contains(a) && kept.contains(b)) continue;
            const double by_size = steep * kLonger * size((model.at(a) + model.at(b)) / 2);
            const double by_turn = per_turn > 0
                                       ? steep * kFullTurn * area / (std::abs(turn) * length * per_turn)
                                       : kInfinity;
            const double longest = scale * std::lerp(std::min(by_size, by_turn), by_size, bends.second);
            lost -= length * lost_by(turn, longest);
        }
    }
    return lost;
}

double lost_on_ends(const OpenVolume& volume, const SweepOptions& options, const surface::SizeField& size,
                    int per_turn, const std::set<Index>& kept)
{
    const double scale = std::sqrt(area_of(volume, Role::target) / area_of(volume, Role::source));
    return std::abs((lost_on_end(volume, Role::source, 1, options, size, per_turn, kept) +
                     lost_on_end(volume, Role::target, scale, options, size, per_turn, kept)) /
                    closure::enclosed_volume(volume));
}

/// Six times the volume of a tetrahedron with its fourth corner in the origin.
double six_volumes(const Vec3& a, const Vec3& b, const Vec3& c) { return a.dot(b.cross(c)); }

/// The number of sides of a mesh, given by the sides per full turn and by a factor on the requested size.
struct Sides {
    int per_turn = 0; ///< 0: as many as the wall model has columns
    double part = 1;
};

/// Rows of points on the walls of each linking surface, with many more columns and rows than a mesh has. The
/// nodes of a mesh are interpolated between these points. The enclosed volume is that between the wall quads
/// and cones that close both ends. The cones of all rims of the target have one apex, and those of all rims
/// of the source have their apex in the origin.
class Walls {
public:
    Walls(const OpenVolume& volume, std::vector<surface::LinkingSurface> links, const SweepOptions& options,
          const surface::SizeField& size)
        : volume_(volume),
          links_(std::move(links)),
          whole_(closure::enclosed_volume(volume)),
          curved_(options.order > 1 && std::ranges::none_of(volume.faces(Role::wall), [&](FaceId wall) {
                      const Face& face = volume.model[wall];
                      return face.surface == nullptr && face.origin == Origin::given;
                  }))
    {
        const bool divides = may_divide_rims(volume, options);
        for (const surface::LinkingSurface& link : links_) {
            Ring& ring = rings_.emplace_back();
            const std::vector<double> turning = surface::turning_of_segments(volume.model, link);
            std::vector<std::vector<double>> shares; // for each segment: evenly spaced positions of nodes
            int first = 0;
            for (const surface::RimSegment& segment : link.segments) {
                const double length = segment.source_to - segment.source_from;
                const bool fixed = segment.given && !divides;
                const double fine = fixed ? 1
                                          : std::ceil(surface::kMostPerTurn * length / link.source.length());
                const double middle[] = {(segment.source_from + segment.source_to) / 2};
                ring.segments.push_back({first, static_cast<int>(fine), fixed,
                                         length / size(link.source.points(middle).front()),
                                         turning[shares.size()]});
                std::vector<double>& even = shares.emplace_back();
                for (int k = 0; k < static_cast<int>(fine); ++k) even.push_back(k / fine);
                first += static_cast<int>(fine);
            }
            ring.nodes = surface::linking_nodes(link, shares, shares);
            ring.rows = surface::wall_rows(volume, link, ring.nodes, 1, {});
        }
        origin_ = rings_.front().rows.front().front();
        apex_ = rings_.front().rows.back().front() - origin_;
        for (std::size_t b = 0; b < rings_.size(); ++b) {
            double own = 0; // volume between the walls as given
            for (const FaceId wall : links_[b].walls) {
                for (const Triangle& t : volume.model[wall].triangles)
                    own += six_volumes(volume.model.at(t[0]) - origin_, volume.model.at(t[1]) - origin_,
                                       volume.model.at(t[2]) - origin_);
            }
            double found = rings_[b].within = enclosed(rings_[b], {}, 0, 1);
            for (const EdgeUse use : links_[b].target.uses()) {
                const std::vector<Vec3> line = places_at(volume.model, use_points(volume.model, use));
                for (std::size_t i = 0; i + 1 < line.size(); ++i)
                    found -= six_volumes(apex_, line[i] - origin_, line[i + 1] - origin_);
            }
            rings_[b].sign = found * own < 0 ? -1 : 1;
            // Walls are straight from rim to rim if straight ones do not change the volume visibly.
            straight_ = straight_ && std::abs(rings_[b].sign * found - own) < 6 * kVisible * whole_;
        }
    }

    /// Whether the walls are straight from rim to rim.
    [[nodiscard]] bool straight() const { return straight_; }

    /// Project the points between the rims onto the walls.
    void follow(const RunContext& context)
    {
        for (std::size_t b = 0; b < rings_.size(); ++b) {
            rings_[b].rows = surface::wall_rows(volume_, links_[b], rings_[b].nodes, kFineChords, context);
            rings_[b].within = enclosed(rings_[b], {}, 0, 1);
        }
    }

    /// Relative volume error of a mesh compared with the walls; negative: the mesh encloses less.
    /// @param layers  0: as many as there are rows.
    [[nodiscard]] double off(const Sides& sides, int layers) const
    {
        double sum = 0;
        for (const Ring& ring : rings_) {
            double own = enclosed(ring, sides, layers, 1);
            // A parabola through the middle of a side regains 4/3 of the volume that two straight halves
            // regain.
            if (curved_) own += 4. / 3 * (enclosed(ring, sides, layers, 2) - own);
            sum += ring.sign * (own - ring.within);
        }
        return sum / (6 * whole_);
    }

private:
    struct Segment {
        int first = 0, fine = 1; ///< index of its first column, and number of its columns
        bool fixed = false;      ///< whether it stays a single side even if more sides are requested
        double by_size = 1;      ///< number of sides that the size requires
        double turn = 0;         ///< turning angle of the rim [radian]

        [[nodiscard]] int count(const Sides& sides, int parts) const
        {
            if (fixed || sides.per_turn == 0) return fine;
            const double bends = turn * sides.per_turn / (2 * std::numbers::pi);
            // A mesh with more sides than the model has columns would not be more accurate.
            const double most = fine;
            return parts * static_cast<int>(
                               std::lround(std::clamp(std::max(by_size / sides.part, bends), 1.0, most)));
        }
    };
    struct Ring {
        std::vector<Segment> segments;
        surface::LinkingNodes nodes;
        std::vector<std::vector<Vec3>> rows;
        double sign = 1;   ///< sign of its enclosed volume
        double within = 0; ///< six times the volume enclosed by its walls
    };

    /// Six times the volume that a mesh of the ring encloses.
    /// @param layers  0: all rows. @param parts  number of parts into which each side and each layer is
    ///         divided.
    [[nodiscard]] double enclosed(const Ring& ring, const Sides& of, int layers, int parts) const
    {
        std::vector<double> places; // columns of the mesh, as positions among the columns of a row
        for (const Segment& segment : ring.segments) {
            const int sides = segment.count(of, parts);
            for (int i = 0; i < sides; ++i)
                places.push_back(segment.first + static_cast<double>(i) * segment.fine / sides);
        }
        const std::size_t steps = ring.rows.size() - 1, rows = layers == 0 ? steps : index(layers * parts);
        const auto row = [&](std::size_t k) {
            const double up = static_cast<double>(steps * k) / static_cast<double>(rows);
            const std::size_t below = std::min(static_cast<std::size_t>(up), steps - 1);
            const std::vector<Vec3>&a = ring.rows[below], &b = ring.rows[below + 1];
            const double f = up - static_cast<double>(below);
            std::vector<Vec3> points;
            for (const double place : places) {
                const std::size_t i = static_cast<std::size_t>(place), next = (i + 1) % a.size();
                const double g = place - static_cast<double>(i);
                points.emplace_back((1 - f) * ((1 - g) * a[i] + g * a[next]) +
                                    f * ((1 - g) * b[i] + g * b[next]) - origin_);
            }
            return points;
        };
        double sum = 0;
        std::vector<Vec3> low = row(0);
        for (std::size_t k = 1; k <= rows; ++k) {
            std::vector<Vec3> high = row(k);
            for (std::size_t i = 0; i < low.size(); ++i) {
                const std::size_t next = (i + 1) % low.size();
                const Vec3 &a = low[i], &b = low[next], &d = high[i], &e = high[next];
                sum += (six_volumes(a, b, e) + six_volumes(a, e, d) + six_volumes(a, b, d) +
                        six_volumes(b, e, d)) /
                       2;
                if (k == rows) sum += six_volumes(apex_, d, e);
            }
            low = std::move(high);
        }
        return sum;
    }

    const OpenVolume& volume_;
    std::vector<surface::LinkingSurface> links_;
    double whole_ = 0;
    bool curved_ = false; ///< whether sides are of order 2 on exact walls; on facets, sides may stay straight
    Vec3 origin_, apex_;
    std::vector<Ring> rings_;
    bool straight_ = true;
};

/// Finds the numbers of sides by trying them on the wall model.
class Planner {
public:
    Planner(const OpenVolume& volume, std::span<const surface::LinkingSurface> links,
            const SweepOptions& options, const surface::SizeField& size, const RunContext& context)
        : volume_(volume), links_(links), options_(options), size_(size), context_(context)
    {
    }

    VolumePlan by_default()
    {
        on_ends_ = lost_on_ends(volume_, options_, size_, 0, {});
        Sides sides{options_.curvature};
        const double quads = area_of(volume_, Role::source) / std::pow(size_(volume_.model.points[0]), 2);
        const double least = std::min(kLeastPart, std::sqrt(quads / kMostForEnds));
        if (is_enough(sides) || is_enough({surface::kMostPerTurn})) {
            while (!is_enough(sides)) ++sides.per_turn;
            const int enough = sides.per_turn; // enough if creases across an end get no nodes
            while (ends_ > kLostByEnds && sides.per_turn < std::max(enough, kMostForCreases)) {
                ++sides.per_turn;
                if (!is_enough(sides)) break;
            }
            if (ends_ > kLostByEnds) sides.per_turn = enough;
        } else { // the walls bend more than their rims, so more sides of the rims do not help
            while (sides.part > least && !is_enough(sides)) sides.part *= kSuggestedShare;
        }
        is_enough(sides);
        find_walls();
        const double most = std::max(kLostByEnds, left() - std::abs(walls_->off(sides, 0)));
        if (ends_ > most) sides.part = std::min(sides.part, std::max(std::sqrt(most / ends_), least));
        return {sides.per_turn, sides.part, layers(sides, kLostByLayers)};
    }

    /// If the requested sides lose too much, choose sides that lose six tenths of the allowed share, which
    /// leaves the rest for the layers. What ends lose falls with the square of the number of sides. A polygon
    /// of n sides lacks 2 π² / (3 n²) of its circle's area; if that is not enough for the rims, sides are
    /// added as long as each step clearly reduces the loss.
    VolumePlan by_numbers()
    {
        constexpr double kOfShare = 0.6, kHelps = 0.75;
        const double share = options_.volume_share;
        const double turn2 = 2 * std::numbers::pi * std::numbers::pi;
        const auto wanted = static_cast<int>(std::ceil(std::sqrt(turn2 / (3 * kOfShare * share))));
        follow({});
        int sides = options_.curvature;
        const auto on_rims = [&](int per_turn) { return std::abs(rims_->off({per_turn, kFewer}, 0)); };
        if (lost_on_ends(volume_, options_, size_, sides, {}) > share) {
            const OpenVolume laid_out = lies_on_target(volume_, options_) ? turned_round(volume_) : volume_;
            const double lost = lost_on_ends(laid_out, options_,
                                             surface::shape_size(laid_out, size_, {sides, 0}).at, sides, {});
            if (lost > share)
                sides = std::min(surface::kMostPerTurn,
                                 static_cast<int>(std::ceil(sides * std::sqrt(lost / (kOfShare * share)))));
        }
        for (double lost = on_rims(sides); lost > share;) {
            const int more = std::max(sides + sides / 4 + 1, wanted);
            const double left = on_rims(more);
            if (more > surface::kMostPerTurn || left > kHelps * lost) break;
            sides = more;
            lost = left;
        }
        const bool counted = options_.layers.count > 0 || !options_.layers.heights.empty();
        if (counted) return {.per_turn = sides};
        return {sides, 1, layers({sides}, share)};
    }

private:
    /// Compute the wall model of a mesh that has nodes at the given breaks.
    void follow(const surface::RimBreaks& breaks)
    {
        if (rims_ && breaks.pairs == pairs_ && breaks.on_crease == on_crease_) return;
        pairs_ = breaks.pairs;
        on_crease_ = breaks.on_crease;
        std::vector<surface::LinkingSurface> followed(links_.begin(), links_.end());
        if (!pairs_.empty()) followed = surface::follow_facets(breaks, std::move(followed));
        rims_ = std::make_shared<Walls>(volume_, std::move(followed), options_, size_);
        walls_ = nullptr;
    }

    /// The allowed error minus the share reserved for curvature along the sweep.
    [[nodiscard]] double left() const { return kAllLost - (rims_->straight() ? 0 : kLostByLayers); }

    /// Whether these sides are enough for the rims and, if the walls bend between the rims, for the walls.
    bool is_enough(const Sides& sides)
    {
        const surface::RimBreaks breaks = facets_.breaks(sides.per_turn, size_);
        follow(breaks);
        ends_ = on_ends_ > kLostByEnds && !breaks.points.empty()
                    ? lost_on_ends(volume_, options_, size_, 0, breaks.points)
                    : on_ends_;
        const double share = left() - std::min(kLostByEnds, ends_);
        if (std::abs(rims_->off(sides, 0)) > share) return false;
        find_walls();
        return std::abs(walls_->off(sides, 0)) <= share;
    }

    void find_walls()
    {
        if (walls_) return;
        walls_ = rims_;
        if (rims_->straight()) return;
        walls_ = std::make_shared<Walls>(*rims_);
        walls_->follow(context_);
    }

    /// A function that returns the number of layers with which curved walls lose at most `share`. It starts
    /// at `least`.
    std::function<int(int)> layers(const Sides& sides, double share)
    {
        find_walls();
        if (walls_->straight()) return {};
        return [walls = walls_, sides, share](int least) {
            const double whole = walls->off(sides, 0);
            int count = least;
            // More layers than the model has rows would not be more accurate.
            while (count < kFineChords && std::abs(walls->off(sides, count) - whole) > share)
                count += 1 + count / 16;
            return count;
        };
    }

    const OpenVolume& volume_;
    std::span<const surface::LinkingSurface> links_;
    const SweepOptions& options_;
    const surface::SizeField& size_;
    const RunContext& context_;
    surface::RimFacets facets_{volume_, links_};
    /// The breaks for which the wall model was computed.
    std::vector<std::vector<std::pair<double, double>>> pairs_;
    std::vector<char> on_crease_;
    double on_ends_ = 0, ends_ = 0; ///< volume lost on ends: without breaks, and with the current breaks
    std::shared_ptr<Walls> rims_, walls_; ///< wall models: straight between the rims, and as given
};

} // namespace

bool sizes_by_default(const SweepOptions& options)
{
    const bool layers = options.layers.count > 0 || !options.layers.heights.empty();
    return !options.size && options.volume_share > 0 && options.curvature > 0 && options.intervals.empty() &&
           (!layers || options.beside.settle);
}

bool may_divide_rims(const OpenVolume& volume, const SweepOptions& options)
{
    return sizes_by_default(options) && !options.wedges && !options.beside.settle &&
           std::ranges::all_of(volume.model.faces, [](const Face& face) { return face.given_quads.empty(); });
}

double volume_lost(const Fidelity& fidelity) { return 1 - fidelity.volume / fidelity.sealed_volume; }

VolumePlan plan_volume(const OpenVolume& volume, std::span<const surface::LinkingSurface> links,
                       const SweepOptions& options, const surface::SizeField& size, const RunContext& context)
{
    if (options.volume_share == 0 || options.curvature == 0) return {.per_turn = options.curvature};
    if (sizes_by_default(options)) return Planner(volume, links, options, size, context).by_default();
    return Planner(volume, links, options, size, context).by_numbers();
}

} // namespace lacuna::sweep
