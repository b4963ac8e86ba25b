// SPDX-License-Identifier: GPL-2.0-or-later
#include <lacuna/cad_worker/detail/cad_curves.h>

#include <lacuna/cad_worker/detail/gmsh_api.h>
#include <lacuna/cad_worker/exact_geometry.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/geometry/shared/angle.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/geometry/shared/union_find.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <unordered_map>

namespace lacuna::cad_worker {

namespace {

std::vector<double> evenly(double low, double high, std::size_t sides)
{
    std::vector<double> params(sides + 1);
    for (std::size_t i = 0; i <= sides; ++i) {
        params[i] = low + (high - low) * static_cast<double>(i) / static_cast<double>(sides);
    }
    return params;
}

/// Group points by single linkage within the tolerance. Returns, for each point, the smallest index in its
/// group.
std::vector<std::size_t> clusters(const std::vector<CadVertex>& vertices, double tolerance)
{
    geometry::UnionFind sets(vertices.size());
    // After sorting along x, only points within the tolerance along x are compared.
    std::vector<std::size_t> order(vertices.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return std::pair(vertices[a].at.x(), a) < std::pair(vertices[b].at.x(), b);
    });
    for (std::size_t i = 0; i < order.size(); ++i) {
        for (std::size_t k = i + 1; k < order.size(); ++k) {
            if (vertices[order[k]].at.x() - vertices[order[i]].at.x() > tolerance) break;
            if ((vertices[order[k]].at - vertices[order[i]].at).norm() > tolerance) continue;
            sets.unite_least(order[i], order[k]);
        }
    }
    std::vector<std::size_t> root(vertices.size());
    for (std::size_t i = 0; i < root.size(); ++i) root[i] = sets.find(i);
    return root;
}

void read_vertices(CadWire& wire, double tolerance)
{
    for (const int tag : tags_of(0)) {
        std::vector<double> at;
        gmsh::model::getValue(0, tag, {}, at);
        wire.vertices.push_back({tag, {at[0], at[1], at[2]}, -1});
    }
    const std::vector<std::size_t> root = clusters(wire.vertices, tolerance);
    for (std::size_t i = 0; i < root.size(); ++i) {
        CadVertex& vertex = wire.vertices[i];
        if (root[i] == i) {
            vertex.point = static_cast<Index>(wire.points.size());
            wire.points.push_back(vertex.at);
            wire.point_tag.push_back(vertex.tag);
        } else {
            vertex.point = wire.vertices[root[i]].point;
        }
    }
}

void read_faces(CadWire& wire)
{
    std::map<int, std::size_t> curve_of_tag;
    for (const int tag : tags_of(2)) {
        CadFaceInfo face;
        face.tag = tag;
        for (const auto& [curve_dim, signed_tag] : boundary_of({{2, tag}})) {
            const auto [place, fresh] = curve_of_tag.try_emplace(std::abs(signed_tag), wire.curves.size());
            const std::size_t curve = place->second;
            if (fresh) wire.curves.emplace_back().tag = std::abs(signed_tag);
            ++wire.curves[curve].uses;
            const auto side = std::find_if(face.sides.begin(), face.sides.end(),
                                           [&](const auto& s) { return s.curve == curve; });
            if (side == face.sides.end()) {
                face.sides.push_back({curve, 1});
            } else {
                ++side->uses;
            }
        }
        wire.faces.push_back(std::move(face));
    }
}

void read_curves(CadWire& wire)
{
    std::unordered_map<int, int> vertex_of_tag;
    for (std::size_t i = 0; i < wire.vertices.size(); ++i)
        vertex_of_tag[wire.vertices[i].tag] = static_cast<int>(i);
    for (CadCurveInfo& curve : wire.curves) {
        std::vector<double> low, high;
        gmsh::model::getParametrizationBounds(1, curve.tag, low, high);
        curve.low = low.at(0);
        curve.high = high.at(0);
        std::vector<int> up, down;
        gmsh::model::getAdjacencies(1, curve.tag, up, down);
        if (down.empty()) {
            throw BackendError(
                Message("cad.curve_without_ends", "{} has no end points", NamedEntity{"curve", curve.tag})
                    .remedy("export the file again"));
        }
        curve.from = vertex_of_tag.at(down.front());
        curve.to = vertex_of_tag.at(down.back());
        curve.params = evenly(curve.low, curve.high, kFineChords);
        curve.points = curve_points(curve.tag, curve.params);
        curve.length = geometry::length(curve.points);
        // In some files, the vertices of a curve are listed in the opposite order. The order of the
        // parameters decides.
        const Vec3& begin = wire.vertices[index(curve.from)].at;
        const Vec3& end = wire.vertices[index(curve.to)].at;
        const double kept = (begin - curve.points.front()).norm() + (end - curve.points.back()).norm();
        const double swapped = (end - curve.points.front()).norm() + (begin - curve.points.back()).norm();
        if (swapped < kept) std::swap(curve.from, curve.to);
    }
}

struct OnCurve {
    double param = 0;
    double distance = 0;
};

/// The point of a curve closest to `p`, between two parameters.
OnCurve closest_on_curve(const CadCurveInfo& curve, const Vec3& p, double low, double high)
{
    double best = kInfinity;
    double t = low;
    for (std::size_t i = 0; i + 1 < curve.points.size(); ++i) {
        if (curve.params[i + 1] < low || curve.params[i] > high) continue;
        const Vec3 side = curve.points[i + 1] - curve.points[i];
        const double s = side.squaredNorm() > 0
                             ? std::clamp((p - curve.points[i]).dot(side) / side.squaredNorm(), 0.0, 1.0)
                             : 0;
        const double d = (curve.points[i] + s * side - p).squaredNorm();
        if (d >= best) continue;
        best = d;
        t = curve.params[i] + s * (curve.params[i + 1] - curve.params[i]);
    }
    t = std::clamp(t, low, high);
    // The polyline is fine, so Gauss-Newton starts close and converges fast.
    Vec3 at = curve_points(curve.tag, {t}).front();
    for (int i = 0; i < kMostSteps; ++i) {
        const Vec3 tangent = curve_tangents(curve.tag, {t}).front();
        if (!(tangent.squaredNorm() > 0)) break;
        const double next = std::clamp(t + (p - at).dot(tangent) / tangent.squaredNorm(), low, high);
        const Vec3 next_at = curve_points(curve.tag, {next}).front();
        if ((next_at - p).norm() > (at - p).norm()) break;
        const bool still = std::abs(next - t) <= 1e-14 * (curve.high - curve.low);
        t = next;
        at = next_at;
        if (still) break;
    }
    return {t, (at - p).norm()};
}

/// Parameters at which ends of other curves lie on a curve that only one face uses, and these ends.
/// @param loose_points  ends of all curves that only one face uses.
std::vector<std::pair<double, Index>> cuts_of(const CadWire& wire, const CadCurveInfo& curve,
                                              const std::vector<Index>& loose_points, double tolerance)
{
    Eigen::AlignedBox3d box;
    for (const Vec3& p : curve.points) box.extend(p);
    // An arc extends beyond the box of its polyline by less than one segment, so enlarge the box by that.
    const double reach = curve.length / static_cast<double>(kFineChords) + tolerance;
    const Index from = wire.vertices[index(curve.from)].point;
    const Index to = wire.vertices[index(curve.to)].point;
    std::vector<std::pair<double, Index>> cuts;
    for (const Index point : loose_points) {
        const Vec3& p = wire.points[index(point)];
        if (point == from || point == to || box.exteriorDistance(p) > reach) continue;
        const OnCurve place = closest_on_curve(curve, p, curve.low, curve.high);
        if (place.distance <= tolerance && place.param > curve.low && place.param < curve.high) {
            cuts.emplace_back(place.param, point);
        }
    }
    std::sort(cuts.begin(), cuts.end());
    return cuts;
}

void cut_into_pieces(CadWire& wire, double tolerance)
{
    std::vector<Index> loose_points;
    for (const CadCurveInfo& curve : wire.curves) {
        if (curve.uses != 1) continue;
        for (const int v : {curve.from, curve.to}) loose_points.push_back(wire.vertices[index(v)].point);
    }
    std::sort(loose_points.begin(), loose_points.end());
    loose_points.erase(std::unique(loose_points.begin(), loose_points.end()), loose_points.end());

    for (std::size_t c = 0; c < wire.curves.size(); ++c) {
        CadCurveInfo& curve = wire.curves[c];
        const Index from = wire.vertices[index(curve.from)].point;
        const Index to = wire.vertices[index(curve.to)].point;
        if (from == to && curve.length <= tolerance) continue;
        std::vector<std::pair<double, Index>> cuts;
        if (curve.uses == 1) cuts = cuts_of(wire, curve, loose_points, tolerance);
        double low = curve.low;
        Index begin = from;
        cuts.emplace_back(curve.high, to);
        for (const auto& [param, point] : cuts) {
            curve.pieces.push_back(wire.pieces.size());
            wire.pieces.push_back({c, low, param, begin, point, 0, false});
            low = param;
            begin = point;
        }
    }
}

/// Whether piece `b` coincides with piece `a`. If so, the value says whether it runs in the opposite
/// direction; else empty.
std::optional<bool> runs_against(const CadWire& wire, const CadPiece& a, const CadPiece& b, double tolerance)
{
    const CadCurveInfo& on_a = wire.curves[a.curve];
    const CadCurveInfo& on_b = wire.curves[b.curve];
    double first = 0, last = 0;
    for (int i = 1; i < kChords; ++i) {
        const double t = a.low + (a.high - a.low) * i / kChords;
        const OnCurve place = closest_on_curve(on_b, curve_points(on_a.tag, {t}).front(), b.low, b.high);
        if (place.distance > tolerance) return std::nullopt;
        if (i == 1) first = place.param;
        last = place.param;
    }
    return last < first;
}

void sew_pieces(CadWire& wire, double tolerance)
{
    std::map<std::pair<Index, Index>, std::vector<std::size_t>> with_ends;
    int next_tag = 0;
    for (const CadCurveInfo& curve : wire.curves) next_tag = std::max(next_tag, curve.tag);
    // Sort by curve tag: among coincident curves, the one with the lowest tag defines tag and shape of the
    // edge.
    std::vector<std::size_t> order(wire.pieces.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return wire.curves[wire.pieces[a].curve].tag < wire.curves[wire.pieces[b].curve].tag;
    });
    for (const std::size_t p : order) {
        CadPiece& piece = wire.pieces[p];
        auto& rivals = with_ends[std::minmax(piece.from, piece.to)];
        bool sewn = false;
        for (const std::size_t e : rivals) {
            const CadPiece& master = wire.pieces[wire.edges[e].master];
            if (master.curve == piece.curve) continue;
            const auto against = runs_against(wire, piece, master, tolerance);
            // Compare in both directions, so that a short piece is not merged with a longer one that contains
            // it.
            if (!against || !runs_against(wire, master, piece, tolerance)) continue;
            piece.edge = e;
            piece.reversed = *against;
            sewn = true;
            break;
        }
        if (sewn) continue;
        const CadCurveInfo& curve = wire.curves[piece.curve];
        piece.edge = wire.edges.size();
        rivals.push_back(piece.edge);
        wire.edges.push_back({p, curve.pieces.front() == p ? curve.tag : ++next_tag, {}, {}});
    }
}

/// A fine polyline of a curve. It turns little from segment to segment, except at kinks.
struct FineCurve {
    std::vector<double> params, weight; ///< weight of the segment that ends at the parameter
};

FineCurve weigh(const CadCurveInfo& curve, double low, double high, const Fineness& fineness)
{
    struct Sample {
        double t;
        Vec3 at, tangent;
    };
    const auto sample = [&](const std::vector<double>& params) {
        const std::vector<Vec3> at = curve_points(curve.tag, params);
        const std::vector<Vec3> tangent = curve_tangents(curve.tag, params);
        std::vector<Sample> samples(params.size());
        for (std::size_t i = 0; i < params.size(); ++i)
            samples[i] = {params[i], at[i], tangent[i].normalized()};
        return samples;
    };
    const auto turn = [](const Sample& a, const Sample& b) {
        return geometry::angle_between(a.tangent, b.tangent);
    };
    std::vector<Sample> samples = sample(evenly(low, high, kFineChords));
    for (int round = 0; round < kMostSteps; ++round) {
        std::vector<double> between;
        for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
            if (turn(samples[i], samples[i + 1]) > fineness.turn)
                between.push_back((samples[i].t + samples[i + 1].t) / 2);
        }
        if (between.empty()) break;
        const std::vector<Sample> more = sample(between);
        samples.insert(samples.end(), more.begin(), more.end());
        std::sort(samples.begin(), samples.end(), [](const Sample& a, const Sample& b) { return a.t < b.t; });
    }
    FineCurve fine{{samples.front().t}, {0}};
    for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
        const double by_length = (samples[i + 1].at - samples[i].at).norm() / fineness.max_size;
        // Limit the weight to 1 at a kink, because more points there do not reduce the turn.
        const double by_turn = std::min(turn(samples[i], samples[i + 1]) / fineness.turn, 1.0);
        fine.params.push_back(samples[i + 1].t);
        fine.weight.push_back(std::max(by_length, by_turn));
    }
    return fine;
}

/// Parameters that divide the total weight evenly.
std::vector<double> share_out(const FineCurve& fine, double refinement, std::size_t least)
{
    const double total = std::accumulate(fine.weight.begin(), fine.weight.end(), 0.0);
    // Subtract a slack before rounding up, so that rounding errors do not add a segment to a whole circle.
    const auto wanted = static_cast<std::size_t>(
        std::max(0.0, std::ceil(total * refinement - kFileAccuracy)));
    const std::size_t sides = std::max(least, wanted);
    if (!(total > 0)) return evenly(fine.params.front(), fine.params.back(), sides);
    std::vector<double> params{fine.params.front()};
    double passed = 0;
    std::size_t i = 1;
    for (std::size_t k = 1; k < sides; ++k) {
        const double goal = total * static_cast<double>(k) / static_cast<double>(sides);
        while (i + 1 < fine.params.size() && passed + fine.weight[i] < goal) passed += fine.weight[i++];
        const double part = fine.weight[i] > 0 ? (goal - passed) / fine.weight[i] : 0.5;
        params.push_back(fine.params[i - 1] +
                         std::clamp(part, 0.0, 1.0) * (fine.params[i] - fine.params[i - 1]));
    }
    params.push_back(fine.params.back());
    return params;
}

} // namespace

CadWire read_wire(double tolerance)
{
    CadWire wire;
    read_vertices(wire, tolerance);
    read_faces(wire);
    read_curves(wire);
    cut_into_pieces(wire, tolerance);
    sew_pieces(wire, tolerance);
    return wire;
}

void divide(CadWire& wire, const Fineness& fineness, const std::vector<double>& refinement)
{
    wire.points.resize(wire.point_tag.size());
    for (std::size_t e = 0; e < wire.edges.size(); ++e) {
        CadEdge& edge = wire.edges[e];
        const CadPiece& piece = wire.pieces[edge.master];
        const CadCurveInfo& curve = wire.curves[piece.curve];
        // At least two segments: a single one could coincide with a facet side between the same two points.
        const std::size_t least = piece.from == piece.to ? 4 : 2;
        edge.params = share_out(weigh(curve, piece.low, piece.high, fineness), refinement[e], least);
        const std::vector<Vec3> at = curve_points(curve.tag, edge.params);
        edge.points.assign(1, piece.from);
        for (std::size_t i = 1; i + 1 < at.size(); ++i) {
            edge.points.push_back(static_cast<Index>(wire.points.size()));
            wire.points.push_back(at[i]);
        }
        edge.points.push_back(piece.to);
    }
}

PieceNodes nodes_of(const CadWire& wire, std::size_t p)
{
    const CadPiece& piece = wire.pieces[p];
    const CadEdge& edge = wire.edges[piece.edge];
    PieceNodes nodes{edge.params, edge.points};
    if (edge.master == p) return nodes;
    if (piece.reversed) std::reverse(nodes.points.begin(), nodes.points.end());
    nodes.params.front() = piece.low;
    nodes.params.back() = piece.high;
    const CadCurveInfo& curve = wire.curves[piece.curve];
    for (std::size_t i = 1; i + 1 < nodes.points.size(); ++i) {
        const Vec3& at = wire.points[index(nodes.points[i])];
        nodes.params[i] = closest_on_curve(curve, at, piece.low, piece.high).param;
    }
    return nodes;
}

} // namespace lacuna::cad_worker
