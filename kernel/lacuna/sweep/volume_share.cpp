// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/volume_share.h>

#include <lacuna/closure/close.h>
#include <lacuna/core/edge_key.h>
#include <lacuna/geometry/angle.h>
#include <lacuna/geometry/polyline.h>
#include <lacuna/surface/edge_nodes.h>
#include <lacuna/surface/rim_breaks.h>
#include <lacuna/surface/wall_columns.h>
#include <lacuna/topology/use_places.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <unordered_map>

namespace lacuna::sweep {

using namespace topology;

namespace {

/// A turn needs no more sides than this for its volume: an inscribed polygon of so many is off by 0.07 %.
constexpr int kMostPerTurn = 100;
/// Creases across an end are followed up to as many for a turn: more are fine facets, for which a size does.
constexpr int kMostForCreases = 40;
/// No end gets smaller quads than this part of the size for its bends: sixteen times as many. A choice.
constexpr double kLeastPart = 0.25;
/// Layers for the bends of the sweep, at most: as many as a spiral of five turns needs.
constexpr int kMostLayers = 300;
/// Between two nodes on facets a side of order 2 is off by half as much as a straight one at the most; on
/// exact curves by so little that it does not count.
constexpr double kOfOrder2 = 0.5;

/// Part of what straight sides lose.
double by_order(bool exact, const SweepOptions& options)
{
    if (options.order == 1) return 1;
    return exact ? 0 : kOfOrder2;
}

double lost_by(double turn, double side) { return turn * side * side / 12; }

double area_of(const OpenVolume& volume, Role end)
{
    double area = 0;
    for (const FaceId face : volume.faces(end)) area += face_area(volume.model, face);
    return area;
}

Vec3 facet_normal(const Model& model, const Triangle& t)
{
    return (model.at(t[1]) - model.at(t[0])).cross(model.at(t[2]) - model.at(t[0])).stableNormalized();
}

/// The rims of both ends, and the area of the sections there, across the walls, that is lost along them.
class Rims {
public:
    Rims(const OpenVolume& volume, const SweepOptions& options, const surface::SizeField& size)
        : model_(volume.model), divides_(may_divide_rims(volume, options))
    {
        const double source = area_of(volume, Role::source);
        for (const Role end : {Role::source, Role::target}) {
            const std::vector<FaceId> faces = volume.faces(end);
            const std::vector<Rim> walks = rims(model_, faces);
            std::unordered_map<std::uint64_t, Vec3> out; // from the wall, at each side
            for (const Rim& rim : walks) {
                for (const EdgeUse& use : rim.uses) {
                    const std::vector<Index> points = use_points(model_, use);
                    for (std::size_t i = 0; i + 1 < points.size(); ++i)
                        out.emplace(directed_key(points[i], points[i + 1]), Vec3::Zero());
                }
            }
            for (const FaceId wall : volume.faces(Role::wall)) {
                for (const Triangle& t : model_[wall].triangles) {
                    for (std::size_t k = 0; k < 3; ++k) {
                        const auto side = out.find(directed_key(t[(k + 1) % 3], t[k]));
                        if (side == out.end()) continue;
                        const Vec3 along = (model_.at(t[(k + 1) % 3]) - model_.at(t[k])).stableNormalized();
                        const Vec3 up = model_.at(t[(k + 2) % 3]) - model_.at(t[k]);
                        side->second = (up.dot(along) * along - up).stableNormalized();
                    }
                }
            }
            const double area = area_of(volume, end), scale = std::sqrt(area / source);
            Vec3 across = Vec3::Zero();
            for (const FaceId face : faces) across += face_area_vector(model_, face);
            area_ += across.norm();
            for (const Rim& rim : walks) {
                for (const EdgeUse& use : rim.uses) read(use, out, size, scale, options);
            }
        }
    }

    /// Share of the sections' area.
    [[nodiscard]] double lost(int per_turn, const surface::RimBreaks& breaks) const
    {
        double lost = 0;
        for (const Piece& piece : pieces_) {
            const auto followed = breaks.edges.find(piece.edge);
            if (followed != breaks.edges.end()) {
                lost += lost_between(piece, followed->second);
                continue;
            }
            for (const Bend& bend : piece.bends) {
                const double arc = 2 * std::numbers::pi / per_turn * bend.length / bend.size;
                lost += piece.part * lost_by(bend.turn, std::min({bend.side, arc, piece.arc.back()}));
            }
        }
        return area_ > 0 ? lost / area_ : 0;
    }

private:
    struct Bend {
        double turn = 0;   ///< in the section, positive outwards [radian]
        double size = 0;   ///< of the turn in space
        double length = 0; ///< of the rim that it stands for
        double side = 0;   ///< by the size
    };
    struct Piece {
        EdgeId edge;
        std::vector<Vec3> line;
        std::vector<double> arc;
        Vec3 normal = Vec3::Zero(); ///< of the section there, in the mean
        bool reversed = false;
        double part = 1; ///< of what straight sides lose
        std::vector<Bend> bends;
    };

    void read(EdgeUse use, const std::unordered_map<std::uint64_t, Vec3>& out, const surface::SizeField& size,
              double scale, const SweepOptions& options)
    {
        const Edge& edge = model_[use.edge];
        if (edge.keeps_nodes && !divides_) return;
        const std::vector<Index> points = use_points(model_, use);
        Piece piece{use.edge,
                    places_at(model_, points),
                    {},
                    Vec3::Zero(),
                    use.reversed,
                    by_order(edge.curve != nullptr, options),
                    {}};
        const std::vector<Vec3>& line = piece.line;
        piece.arc = geometry::arc_lengths(line);
        const std::size_t sides = line.size() - 1;
        const auto facet = [&](std::size_t i) { return out.at(directed_key(points[i], points[i + 1])); };
        for (std::size_t i = 0; i < sides; ++i) piece.normal += facet(i) * (line[i + 1] - line[i]).norm();
        const bool closed = edge.from == edge.to;
        // The half sides at the ends of an exact curve bend as the others do.
        const double all = edge.curve != nullptr && !closed && sides > 1
                               ? static_cast<double>(sides) / static_cast<double>(sides - 1)
                               : 1;
        for (std::size_t i = closed ? 0 : 1; i < sides; ++i) {
            const std::size_t before = i > 0 ? i - 1 : sides - 1;
            const Vec3 in = line[before + 1] - line[before], out = line[i + 1] - line[i];
            const double angle = geometry::angle_between(in, out);
            if (!(angle > 0)) continue;
            const Vec3 axis = in.cross(out).stableNormalized();
            const double turn = axis.dot((facet(before) + facet(i)).stableNormalized()) * angle;
            piece.bends.push_back(
                {all * turn, all * angle, all * (in.norm() + out.norm()) / 2, scale * size(line[i])});
        }
        pieces_.push_back(std::move(piece));
    }

    /// The area between the facets of an edge and the chords between the vertices that it keeps.
    static double lost_between(const Piece& piece, const std::vector<double>& kept)
    {
        const Vec3 up = piece.normal.stableNormalized();
        std::vector<double> ends = kept;
        if (piece.reversed)
            for (double& at : ends) at = 1 - at;
        std::ranges::sort(ends);
        ends.push_back(1);
        double twice = 0;
        std::size_t from = 0, next = 0;
        for (std::size_t i = 1; i < piece.line.size(); ++i) {
            const Vec3 &a = piece.line[i - 1] - piece.line[from], &b = piece.line[i] - piece.line[from];
            twice += a.cross(b).dot(up);
            if (piece.arc[i] < ends[next] * piece.arc.back() * (1 - 1e-9)) continue;
            from = i;
            ++next;
        }
        return piece.part * twice / 2;
    }

    const Model& model_;
    bool divides_; ///< sides between given nodes
    double area_ = 0;
    std::vector<Piece> pieces_;
};

/// What an end loses by its own bends, but for creases between nodes of its rims.
double lost_on_end(const OpenVolume& volume, Role end, double scale, const SweepOptions& options,
                   const surface::SizeField& size, const std::set<Index>& kept)
{
    const Model& model = volume.model;
    double lost = 0;
    for (const FaceId id : volume.faces(end)) {
        const Face& face = model[id];
        if (face.kind == "plane") continue;
        std::unordered_map<std::uint64_t, const Triangle*> first;
        for (const Triangle& t : face.triangles) {
            for (std::size_t k = 0; k < 3; ++k) {
                const Index a = t[k], b = t[(k + 1) % 3];
                const auto [other, fresh] = first.try_emplace(edge_key(a, b), &t);
                if (fresh || (kept.contains(a) && kept.contains(b))) continue;
                const Vec3 side = model.at(b) - model.at(a);
                const Vec3 own = facet_normal(model, t), beside = facet_normal(model, *other->second);
                const double turn = std::atan2(beside.cross(own).dot(side.stableNormalized()),
                                               own.dot(beside));
                if (turn == 0) continue;
                lost += by_order(face.surface != nullptr, options) * -side.norm() *
                        lost_by(turn, scale * size((model.at(a) + model.at(b)) / 2));
            }
        }
    }
    return lost;
}

double lost_on_ends(const OpenVolume& volume, const SweepOptions& options, const surface::SizeField& size,
                    const std::set<Index>& kept)
{
    const double scale = std::sqrt(area_of(volume, Role::target) / area_of(volume, Role::source));
    return std::abs((lost_on_end(volume, Role::source, 1, options, size, kept) +
                     lost_on_end(volume, Role::target, scale, options, size, kept)) /
                    closure::enclosed_volume(volume));
}

/// Points up the walls: rings of columns, one for each linking surface whose walls bend on the way.
std::vector<std::vector<std::vector<Vec3>>> bent_rings(const OpenVolume& volume,
                                                       std::span<const surface::LinkingSurface> links,
                                                       int steps, const RunContext& context)
{
    constexpr std::size_t kRing = 3;
    std::vector<std::vector<std::vector<Vec3>>> rings;
    for (const surface::LinkingSurface& link : links) {
        surface::LinkingSurface own = link;
        if (own.lines.size() < kRing) own.lines.clear(); // a seam or two say nothing of what is between
        auto columns = surface::wall_columns(volume, own, steps, context, surface::kAnyLonger);
        if (columns.size() >= kRing) rings.push_back(std::move(columns));
    }
    return rings;
}

/// What a ring encloses between some of its rows but for its ends.
double enclosed(const std::vector<std::vector<Vec3>>& ring, int rows)
{
    const auto steps = static_cast<double>(ring.front().size() - 1);
    const auto at = [&](std::size_t column, int row) -> Vec3 {
        const double place = steps * row / rows;
        const auto i = std::min(static_cast<std::size_t>(place), ring.front().size() - 2);
        const std::vector<Vec3>& points = ring[column];
        return points[i] + (place - static_cast<double>(i)) * (points[i + 1] - points[i]) - ring[0][0];
    };
    double sum = 0;
    for (std::size_t c = 0; c < ring.size(); ++c) {
        const std::size_t next = (c + 1) % ring.size();
        for (int row = 0; row < rows; ++row) {
            const Vec3 a = at(c, row), b = at(next, row), d = at(c, row + 1), e = at(next, row + 1);
            sum += (a.dot(b.cross(e) + e.cross(d) + b.cross(d)) + b.dot(e.cross(d))) / 12;
        }
    }
    return sum;
}

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

surface::SizeField even_size(double length)
{
    return [length](const Vec3&) { return length; };
}

double volume_lost(const Fidelity& fidelity) { return 1 - fidelity.volume / fidelity.sealed_volume; }

int sides_for_volume(double share, int before)
{
    constexpr double kOfShare = 0.6;
    const double wanted = std::sqrt(2 * std::numbers::pi * std::numbers::pi / (3 * kOfShare * share));
    return std::max(before + before / 4 + 1, static_cast<int>(std::ceil(wanted)));
}

std::optional<int> sides_for_lost_volume(const Fidelity& fidelity, const SweepOptions& options)
{
    if (options.volume_share == 0 || options.curvature == 0 || sizes_by_default(options) ||
        volume_lost(fidelity) <= options.volume_share)
        return std::nullopt;
    const int sides = sides_for_volume(options.volume_share, options.curvature);
    return sides > kMostPerTurn ? std::nullopt : std::optional(sides);
}

bool is_closer(double after, double before)
{
    constexpr double kLessLost = 0.75; // a choice, not a measurement
    return after <= kLessLost * before;
}

int planned_sides(const OpenVolume& volume, std::span<const surface::LinkingSurface> links,
                  const SweepOptions& options, const surface::SizeField& size)
{
    if (options.volume_share == 0 || options.curvature == 0) return options.curvature;
    const Rims rims(volume, options, size);
    if (!sizes_by_default(options)) {
        const bool enough = std::abs(rims.lost(options.curvature, {})) <= options.volume_share;
        return enough ? options.curvature : sides_for_volume(options.volume_share, options.curvature);
    }
    surface::RimFacets facets(volume, links);
    const double on_ends = lost_on_ends(volume, options, size, {});
    const bool bent = std::ranges::any_of(
        links, [&](const surface::LinkingSurface& link) { return surface::walls_bend(volume, link); });
    std::optional<int> enough; // for the rims
    for (int sides = options.curvature; sides <= (enough ? kMostForCreases : kMostPerTurn); ++sides) {
        const surface::RimBreaks breaks = facets.breaks(sides, size);
        const bool follows = on_ends > kLostByEnds && !breaks.points.empty();
        const double ends = follows ? lost_on_ends(volume, options, size, breaks.points) : on_ends;
        const double left = kAllLost - std::min(kLostByEnds, ends) - (bent ? kLostByLayers : 0);
        if (std::abs(rims.lost(sides, breaks)) > left) continue;
        if (ends <= kLostByEnds) return sides;
        if (!enough) enough = sides;
    }
    return enough.value_or(kMostPerTurn);
}

double planned_part_of_size(const OpenVolume& volume, KnownLinks& links, const SweepOptions& options,
                            const surface::SizeField& size, const RunContext& context)
{
    double lost = lost_on_ends(volume, options, size, {});
    if (lost > kLostByEnds) {
        const std::vector<surface::LinkingSurface> own = links.of(volume, context);
        const surface::RimBreaks breaks = surface::RimFacets(volume, own).breaks(options.curvature, size);
        lost = lost_on_ends(volume, options, size, breaks.points);
    }
    return lost <= kLostByEnds ? 1 : std::max(kLeastPart, std::sqrt(kLostByEnds / lost));
}

int planned_layers(const OpenVolume& volume, std::span<const surface::LinkingSurface> links, int least,
                   const SweepOptions& options, const RunContext& context)
{
    constexpr int kSteps = 64;
    const std::vector<FaceId> walls = volume.faces(Role::wall);
    const bool exact = std::ranges::all_of(walls, [&](FaceId f) {
        return volume.model[f].surface != nullptr || volume.model[f].origin == Origin::made_void;
    });
    const double part = by_order(exact, options) / closure::enclosed_volume(volume);
    if (part == 0) return least;
    const auto rings = bent_rings(volume, links, kSteps, context);
    const auto sum = [&](int rows) {
        double all = 0;
        for (const auto& ring : rings) all += enclosed(ring, rows);
        return all;
    };
    if (rings.empty()) return least;
    const double whole = sum(kSteps);
    int layers = least;
    while (layers < kMostLayers && std::abs(part * (whole - sum(layers))) > kLostByLayers) ++layers;
    return layers;
}

} // namespace lacuna::sweep
