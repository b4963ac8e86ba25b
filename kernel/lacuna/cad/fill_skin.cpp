// SPDX-License-Identifier: MIT
//
// A pyramid is placed on each quad here; the CAD process fills the triangles that remain with tetrahedra.
#include <lacuna/cad/load.h>

#include <lacuna/cad/detail/pyramid_layer.h>
#include <lacuna/cad/detail/worker.h>
#include <lacuna/core/shared/constants.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/core/shared/number_text.h>
#include <lacuna/core/shared/same_corners.h>
#include <lacuna/geometry/shared/union_find.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace lacuna::cad {

using namespace cad_protocol;
using mesh::ClosedSkin;
using mesh::TetMesh;

namespace {

/// Ratio of Gmsh's number of tetrahedra to the number of regular tetrahedra that have the skin's volume. The
/// side of the regular tetrahedra is the mean longest side of the skin's triangles, weighted by area.
/// Measured for balls of 1e3, 1e4 and 1e5 triangles: 0.79, 0.64 and 0.58.
constexpr double kTetShare = 0.6;

double six_volumes(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d)
{
    return (b - a).cross(c - a).dot(d - a);
}

std::string words_for(const ClosedSkin& skin)
{
    return formatted("a skin of {} triangles and {} quads", skin.triangles.size(), skin.quads.size());
}

/// Check that each side is used as often in one direction as in the other.
void check_closed(const ClosedSkin& skin, const std::vector<SkinSide>& sides)
{
    const auto open = [&](Index at) {
        throw InvalidInput(Message("cad.skin_open",
                                   "{} is not closed, or its faces are not oriented consistently, near {}",
                                   words_for(skin), place_with_digits(skin.points[index(at)], 6))
                               .remedy("close the gap there, and orient all faces outward"));
    };
    std::map<std::pair<Index, Index>, int> balance;
    for (const SkinSide& s : sides) {
        if (s.from == s.to) open(s.from);
        const auto place = balance.try_emplace(std::minmax(s.from, s.to), 0).first;
        place->second += s.from < s.to ? 1 : -1;
    }
    for (const auto& [ends, count] : balance)
        if (count != 0) open(ends.first);
}

void check_numbers(const ClosedSkin& skin)
{
    const auto in_range = [&](Index p) { return p >= 0 && index(p) < skin.points.size(); };
    const auto all = [&](const auto& face) { return std::ranges::all_of(face, in_range); };
    if (!std::ranges::all_of(skin.triangles, all) || !std::ranges::all_of(skin.quads, all) ||
        !std::ranges::all_of(skin.points, [](const Vec3& p) { return p.allFinite(); }))
        throw InvalidInput(Message("cad.skin_open",
                                   "{} has faces with invalid point numbers, or points that are not finite",
                                   words_for(skin))
                               .remedy("check the points and faces of the skin"));
}

/// Six times the volume that facets enclose. The origin should be near the facets, for precision.
double enclosed(const std::vector<Vec3>& points, const std::vector<Triangle>& facets, const Vec3& origin)
{
    double sum = 0;
    for (const Triangle& t : facets)
        sum += six_volumes(origin, points[index(t[0])], points[index(t[1])], points[index(t[2])]);
    return sum;
}

/// The facets of each connected part of the skin, the outer part first.
/// @throw InvalidInput  there is more than one outer part, or none.
std::vector<std::vector<Triangle>> split_into_shells(const ClosedSkin& skin, const PyramidLayer& layer,
                                                     const std::vector<SkinSide>& sides)
{
    geometry::UnionFind parts(layer.face_sides.size());
    std::map<std::pair<Index, Index>, Index> first_at;
    for (const SkinSide& s : sides) {
        const auto place = first_at.try_emplace(std::minmax(s.from, s.to), s.face).first;
        parts.unite_least(index(place->second), index(s.face));
    }
    std::map<std::size_t, std::vector<Triangle>> by_root;
    for (std::size_t face = 0; face < layer.face_sides.size(); ++face) {
        std::vector<Triangle>& part = by_root[parts.find(face)];
        part.insert(part.end(), layer.face_sides[face].begin(), layer.face_sides[face].end());
    }
    std::vector<std::vector<Triangle>> shells;
    int outer = 0;
    for (auto& [root, part] : by_root) {
        const bool is_outer = enclosed(layer.points, part, layer.points[index(part[0][0])]) > 0;
        outer += is_outer ? 1 : 0;
        shells.insert(is_outer ? shells.begin() : shells.end(), std::move(part));
    }
    if (outer != 1)
        throw InvalidInput(Message("cad.skin_open",
                                   "{} has {} outer parts (shells oriented outward), but {} is needed",
                                   words_for(skin), found(outer), needed(1))
                               .remedy("orient the skin outward, and open separate parts one by one, with "
                                       "open_volume{{ faces = … }}"));
    return shells;
}

double expected_tets(const std::vector<Vec3>& points, const std::vector<std::vector<Triangle>>& shells)
{
    double volume = 0, sides = 0, weights = 0;
    for (const std::vector<Triangle>& shell : shells) {
        volume += enclosed(points, shell, points[index(shells[0][0][0])]) / 6;
        for (const Triangle& t : shell) {
            const Vec3 &a = points[index(t[0])], &b = points[index(t[1])], &c = points[index(t[2])];
            const double area = (b - a).cross(c - a).norm();
            sides += area * std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
            weights += area;
        }
    }
    const double side = sides / weights;
    return kTetShare * volume / (side * side * side / (6 * std::sqrt(2.0)));
}

[[noreturn]] void refuse_count(double count)
{
    throw NotSweepable(Message("cad.tet_count",
                               "the volume needs {:.3g} tetrahedra; at most {:.3g} are allowed", found(count),
                               needed(kMostCells))
                           .remedy("use a larger 'size'"));
}

[[noreturn]] void refuse_mesh(const char* why)
{
    throw NotSweepable(Message("cad.fill_skin", "Gmsh's tetrahedra do not fill the volume: {}", why)
                           .remedy("use another 'size'"));
}

/// Check that all tetrahedra are positive, that each facet of the shells is a face of exactly one
/// tetrahedron, and that the total volume is that of the shells.
void check_filled(const std::vector<std::vector<Triangle>>& shells, const FillSkinReply& reply,
                  std::size_t given, const RunContext& context)
{
    const std::vector<Vec3>& points = reply.points;
    std::map<Triangle, int> uses;
    double wanted = 0, volume = 0;
    for (const std::vector<Triangle>& shell : shells) {
        check_cancelled(context);
        wanted += enclosed(points, shell, points[index(shells[0][0][0])]);
        for (const Triangle& t : shell) uses[rising(t)] = 0;
    }
    constexpr std::array<Triangle, 4> kFaces{{{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}}};
    for (std::size_t i = 0; i < reply.tets.size(); ++i) {
        if (i % kBetweenPolls == 0) check_cancelled(context);
        const Quad& t = reply.tets[i];
        const double own = six_volumes(points[index(t[0])], points[index(t[1])], points[index(t[2])],
                                       points[index(t[3])]);
        if (!(own > 0)) refuse_mesh("a tetrahedron is flat or inverted");
        volume += own;
        for (const Triangle& f : kFaces) {
            const Triangle face{t[index(f[0])], t[index(f[1])], t[index(f[2])]};
            if (std::ranges::any_of(face, [&](Index p) { return index(p) >= given; })) continue;
            const auto place = uses.find(rising(face));
            if (place != uses.end()) ++place->second;
        }
    }
    for (const auto& [face, count] : uses)
        if (count != 1) refuse_mesh("a face of the skin belongs to no tetrahedron, or to several");
    if (!(std::abs(volume - wanted) <= kSamePlace * wanted))
        refuse_mesh("their volume differs from that of the skin");
}

FillSkinReply ask_worker(const FillSkinRequest& request, double tets, const std::string& subject,
                         const RunContext& context)
{
    Task task{subject, "filling it with tetrahedra"};
    task.context = &context;
    // In the limits of the CAD process, a tetrahedron counts as a point. It takes 0.6 kB and 0.06 ms.
    task.points = request.points.size() + static_cast<std::uint64_t>(tets);
    try {
        return Worker::current(&context, subject)->ask<FillSkinReply>(Opcode::fill_skin, request, task);
    } catch (const BackendError& error) {
        // No input file is involved, so the standard advice does not apply.
        const std::string& code = error.code();
        MessageParts parts = error.message().parts();
        if (code == "cad.gmsh") {
            parts.code = "cad.fill_skin";
            parts.remedy = "use another 'size'";
            throw NotSweepable(Message(std::move(parts)));
        }
        if (code == "cad.worker_ended")
            throw BackendError(Message(code, "Gmsh's tetrahedral mesher crashed on {}", subject)
                                   .remedy("use another 'size'"));
        if (code == "cad.time_limit")
            parts.remedy = "use a larger 'size', or allow more with LACUNA_CAD_SECONDS";
        if (code == "cad.memory_limit")
            parts.remedy = "use a larger 'size', or allow more with LACUNA_CAD_MEGABYTES";
        throw BackendError(Message(std::move(parts)));
    }
}

} // namespace

TetMesh fill_skin(const ClosedSkin& skin, const RunContext& context)
{
    check_cancelled(context);
    check_numbers(skin);
    const std::vector<SkinSide> sides = skin_sides(skin);
    check_closed(skin, sides);
    if (sides.empty())
        throw InvalidInput(Message("cad.skin_open", "a skin without faces cannot be filled")
                               .remedy("give the faces of a closed skin"));
    const PyramidLayer layer = place_pyramids(skin, sides, context);
    const FillSkinRequest request{layer.points, split_into_shells(skin, layer, sides)};
    const double expected = expected_tets(request.points, request.shells);
    if (!(expected <= kMostCells)) refuse_count(expected);

    FillSkinReply reply = ask_worker(request, expected, words_for(skin), context);
    const std::size_t given = request.points.size();
    if (reply.points.size() < given ||
        !std::equal(request.points.begin(), request.points.end(), reply.points.begin()))
        throw BackendError("cad.protocol", "the CAD process moved nodes of the skin");
    if (static_cast<double>(reply.tets.size()) > kMostCells)
        refuse_count(static_cast<double>(reply.tets.size()));
    check_filled(request.shells, reply, given, context);

    TetMesh mesh{std::move(reply.points), {}};
    mesh.cells.reserve(skin.quads.size() + reply.tets.size());
    auto apex = static_cast<Index>(skin.points.size());
    for (const Quad& q : skin.quads) {
        mesh.cells.push_back({q[0], q[3], q[2], q[1], apex, apex, apex, apex});
        ++apex;
    }
    for (const Quad& t : reply.tets) mesh.cells.push_back({t[0], t[1], t[2], t[2], t[3], t[3], t[3], t[3]});
    return mesh;
}

} // namespace lacuna::cad
