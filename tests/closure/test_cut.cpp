// SPDX-License-Identifier: MIT
#include "closure/sealing_checks.h"
#include "support/dice.h"
#include "support/refusal.h"

#include <lacuna/closure/shared/branches.h>
#include <lacuna/closure/shared/cut.h>
#include <lacuna/closure/shared/piece_ends.h>
#include <lacuna/core/error.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

using namespace lacuna;
using namespace lacuna::topology;
using closure::StepPiece;
using test::PrismOptions;

namespace {

/// Area of the given faces by tag.
std::map<int, double> given_area(const Model& model)
{
    std::map<int, double> area;
    for (std::size_t f = 0; f < model.faces.size(); ++f)
        if (model.faces[f].origin == Origin::given) area[model.faces[f].tag] += face_area(model, FaceId(f));
    return area;
}

/// Of a cut of a watertight volume: pieces are watertight, fill it, keep its faces, lie on one side of the
/// plane each, and each new face is two pieces'.
void check_cut(const OpenVolume& whole, const std::vector<StepPiece>& pieces, const geometry::Plane& plane)
{
    CHECK(pieces.size() >= 2);
    double volume = 0;
    std::map<int, double> area;
    std::map<std::string, int> uses;
    for (const StepPiece& piece : pieces) {
        const Model& model = piece.volume.model;
        CHECK(closure::is_watertight(piece.volume));
        volume += closure::enclosed_volume(piece.volume);
        for (const auto& [tag, own] : given_area(model)) area[tag] += own;
        double least = 0, most = 0;
        for (const Vec3& p : model.points) {
            least = std::min(least, geometry::height(plane, p));
            most = std::max(most, geometry::height(plane, p));
        }
        CHECK(std::min(-least, most) <= 2 * model.tolerance);
        for (const Face& face : model.faces)
            if (face.origin == Origin::made_void) ++uses[face.name];
    }
    CHECK(volume == doctest::Approx(closure::enclosed_volume(whole)).epsilon(1e-9));
    for (const auto& [tag, own] : given_area(whole.model))
        CHECK(area[tag] == doctest::Approx(own).epsilon(1e-9));
    for (const auto& [name, count] : uses) {
        CAPTURE(name);
        CHECK(count == 2);
    }
}

PrismOptions random_prism(test::Dice& dice)
{
    PrismOptions options;
    options.sides = dice.chance(0.3) ? 0 : dice.whole(3, 8);
    options.height = dice.between(1, 4);
    options.holes = dice.chance(0.4) ? dice.whole(1, 3) : 0;
    options.hole_sides = dice.chance(0.5) ? 0 : dice.whole(3, 6);
    options.levels = 4;
    if (dice.chance(0.3)) options.taper = dice.between(0.6, 1.4);
    if (dice.chance(0.3)) options.bend = dice.between(10, 90);
    if (dice.chance(0.3)) options.belly = dice.between(0.8, 1.3);
    if (dice.chance(0.3)) options.target = dice.chance(0.5) ? test::End::tilted : test::End::bowed;
    return options;
}

/// Planes through points and edges of the model too.
geometry::Plane random_plane(test::Dice& dice, const Model& model)
{
    const auto point = [&] { return model.points[index(dice.whole(0, int(model.points.size()) - 1))]; };
    Vec3 normal(dice.between(-1, 1), dice.between(-1, 1), dice.between(-1, 1));
    if (dice.chance(0.4)) normal = Vec3::Unit(dice.whole(0, 2));
    Vec3 origin = (point() + point() + point() + point()) / 4;
    if (dice.chance(0.4)) origin = point();
    if (dice.chance(0.2)) {
        const Vec3 along = point() - origin;
        if (along.norm() > 0.1) normal -= normal.dot(along) / along.squaredNorm() * along;
    }
    return geometry::plane_across(origin, normal.normalized());
}

OpenVolume box(const Vec3& size)
{
    PrismOptions options;
    options.radius = std::sqrt(2.0);
    OpenVolume volume = test::prism(options).open();
    volume.model = test::moved(volume.model, [&](const Vec3& p) {
        return Vec3((p.x() + 1) / 2 * size.x(), (p.y() + 1) / 2 * size.y(), p.z() / 2 * size.z());
    });
    return volume;
}

} // namespace

TEST_CASE("a plane cuts any prism into pieces that fill it, through nodes and edges as well")
{
    int cut = 0;
    std::map<std::string, int> refused;
    for (unsigned seed = 1; seed <= 400; ++seed) {
        CAPTURE(seed);
        test::Dice dice(seed);
        const OpenVolume whole = test::prism(random_prism(dice)).open();
        const geometry::Plane plane = random_plane(dice, whole.model);
        try {
            check_cut(whole, closure::cut_by_plane(whole, plane), plane);
            ++cut;
        } catch (const Error& error) {
            ++refused[error.code()];
            if (std::string(error.code()) == "closure.cut_touches") continue;
            // A plane that has the volume on one side misses it; nothing else is refused.
            double least = 0, most = 0;
            for (const Vec3& p : whole.model.points) {
                least = std::min(least, geometry::height(plane, p));
                most = std::max(most, geometry::height(plane, p));
            }
            CAPTURE(std::string(error.what()));
            CHECK(std::min(-least, most) <= whole.model.tolerance);
        }
    }
    for (const auto& [code, count] : refused) MESSAGE(code << ": " << count);
    CHECK(refused["closure.cut_touches"] <= 4);
    CHECK(cut >= 340);
}

TEST_CASE("a piece cut aslant gets two ends apart, and its faces and volume stay as they are")
{
    test::Dice dice(20261123);
    int read = 0, ended = 0, all = 0;
    for (int member = 0; member < 120; ++member) {
        CAPTURE(member);
        PrismOptions options;
        options.sides = dice.whole(3, 8);
        options.height = dice.between(1, 4);
        const OpenVolume whole = test::prism(options).open();
        const Vec3 normal(dice.between(-1, 1), dice.between(-1, 1), dice.between(-1, 1));
        const Vec3 origin(dice.between(-0.5, 0.5), dice.between(-0.5, 0.5),
                          dice.between(0.1, options.height - 0.1));
        const geometry::Plane plane = geometry::plane_across(origin, normal.normalized());
        const std::vector<StepPiece> before = closure::cut_by_plane(whole, plane);
        const auto [pieces, changed] = closure::read_ends(before);
        read += static_cast<int>(changed);
        check_cut(whole, pieces, plane);
        CHECK(closure::read_ends(pieces).changed == 0); // it is settled
        for (std::size_t p = 0; p < pieces.size(); ++p) {
            const OpenVolume& piece = pieces[p].volume;
            ++all;
            CHECK(piece.model.faces.size() == before[p].volume.model.faces.size());
            const std::vector<FaceId> source = piece.faces(Role::source), target = piece.faces(Role::target);
            if (source.empty() || target.empty()) {
                CHECK(piece.role == before[p].volume.role);
                CHECK_THROWS_AS(closure::check_ends(piece, "it"), NotSweepable);
                continue;
            }
            ++ended;
            CHECK_NOTHROW(closure::check_ends(piece, "it"));
            CHECK(rims(piece.model, source).size() == 1);
            CHECK(rims(piece.model, target).size() == 1);
            std::set<VertexId> met;
            for (const Rim& rim : rims(piece.model, source))
                for (const EdgeUse& use : rim.uses) met.insert(use_from(piece.model, use));
            for (const Rim& rim : rims(piece.model, target)) {
                for (const EdgeUse& use : rim.uses) CHECK(!met.contains(use_from(piece.model, use)));
            }
        }
    }
    MESSAGE(ended << " of " << all << " pieces have two ends, " << read << " of them read anew");
    CHECK(ended > 0.9 * all);
    CHECK(read > 0);
}

TEST_CASE("no prism has branches, whatever it lacks")
{
    for (unsigned seed = 1; seed <= 200; ++seed) {
        CAPTURE(seed);
        test::Dice dice(seed);
        PrismOptions options = random_prism(dice);
        options.rows = dice.whole(1, 3);
        const int gone = dice.whole(0, 9);
        options.drop = [=](const test::Part& part) { return part.role == Role::wall && part.side == gone; };
        CHECK(!closure::has_branches(test::prism(options).open()));
    }
}

TEST_CASE("a volume without some of its walls is cut as it would be closed")
{
    int cut = 0;
    for (unsigned seed = 1; seed <= 60; ++seed) {
        CAPTURE(seed);
        test::Dice dice(seed);
        PrismOptions options;
        options.sides = dice.whole(4, 8);
        const int gone = dice.whole(0, options.sides - 1);
        const bool two = dice.chance(0.5);
        const int other = (gone + (dice.chance(0.5) ? 1 : 2)) % options.sides;
        options.drop = [=](const test::Part& part) {
            return part.role == Role::wall && (part.side == gone || (two && part.side == other));
        };
        const auto prism = test::prism(options);
        const geometry::Plane plane = geometry::plane_across(
            Vec3(0, 0, 1), Vec3(dice.between(-0.3, 0.3), dice.between(-0.3, 0.3), 1));
        double volume = 0;
        for (StepPiece& piece : closure::cut_by_plane(prism.open(), plane)) {
            CHECK(closure::is_watertight(piece.volume));
            volume += closure::enclosed_volume(piece.volume);
        }
        CHECK(volume == doctest::Approx(prism.volume).epsilon(1e-9));
        ++cut;
    }
    CHECK(cut == 60);
}

TEST_CASE("a volume that cannot be closed as a whole is cut with a gap on both sides")
{
    // Of a box with an end at each of three sides, two of them walls, nothing says how a sweep would go.
    OpenVolume whole = box({2, 3, 4});
    Roles roles;
    std::set<FaceId> faces;
    for (const FaceId face : all_faces(whole.model)) faces.insert(face);
    const FaceId front = whole.faces(Role::wall).front();
    faces.erase(front);
    for (const FaceId face : faces) roles.walls.push_back(face);
    const OpenVolume part = open_volume(whole.model, roles);
    double volume = 0;
    const Vec3 normal = face_area_vector(whole.model, front).normalized();
    for (StepPiece& piece : closure::cut_by_plane(
             part, geometry::plane_across({1, 1.5, 2}, Vec3(normal.y(), normal.x(), 0.1)))) {
        volume += 1;
        CHECK(piece.volume.model.faces.size() >= 4);
    }
    CHECK(volume == 2);
}

TEST_CASE("a cut across the sweep is the end that a piece lacks, one along it a wall")
{
    const OpenVolume whole = box({2, 3, 4});
    const auto ends = [](const OpenVolume& volume) {
        return std::pair(volume.faces(Role::source).size(), volume.faces(Role::target).size());
    };
    for (const StepPiece& piece :
         closure::cut_by_plane(whole, geometry::plane_across({0, 0, 1}, Vec3::UnitZ()))) {
        CHECK(ends(piece.volume) == std::pair<std::size_t, std::size_t>(1, 1));
        for (std::size_t f = 0; f < piece.volume.model.faces.size(); ++f)
            if (piece.volume.model.faces[f].origin == Origin::made_void)
                CHECK(piece.volume.role[f] != Role::wall);
    }
    for (const StepPiece& piece :
         closure::cut_by_plane(whole, geometry::plane_across({1, 0, 0}, Vec3::UnitX()))) {
        CHECK(ends(piece.volume) == std::pair<std::size_t, std::size_t>(1, 1));
        for (std::size_t f = 0; f < piece.volume.model.faces.size(); ++f)
            if (piece.volume.model.faces[f].origin == Origin::made_void)
                CHECK(piece.volume.role[f] == Role::wall);
    }
}

TEST_CASE("a plane that misses or only touches is refused by what it touches and how far off it is")
{
    const OpenVolume whole = box({2, 3, 4});
    CHECK(test::refusal(
              [&] {
                  closure::cut_by_plane(whole, geometry::plane_across({0, 0, 9}, Vec3::UnitZ()));
              },
              {"misses", "from -9 to -5"}) == "closure.cut_misses");
    CHECK(test::refusal(
              [&] {
                  closure::cut_by_plane(whole, geometry::plane_across({0, 0, 4}, Vec3::UnitZ()));
              },
              {"touches", name_of(whole.model, whole.faces(Role::target).front())}) == "closure.cut_misses");
    CHECK(test::refusal(
              [&] {
                  closure::cut_by_plane(whole, geometry::plane_across({0, 0, 4}, Vec3(0, 1, 1)));
              },
              {"touches"}) != "closure.faces_cross");
}

TEST_CASE("quads a face came with are kept along their lines and never cut")
{
    OpenVolume whole = box({2, 3, 4});
    ModelBuilder model(std::move(whole.model));
    for (Face& face : model.faces) face.keeps_nodes = true;
    std::size_t walls = 0;
    for (const FaceId wall : whole.faces(Role::wall)) {
        // Facets of a wall in pairs of one level: quads of half a height.
        Face& face = model[wall];
        std::map<std::set<Index>, std::size_t> seen;
        for (std::size_t a = 0; a < face.triangles.size(); ++a) {
            for (std::size_t b = a + 1; b < face.triangles.size(); ++b) {
                std::set<Index> corners(face.triangles[a].begin(), face.triangles[a].end());
                corners.insert(face.triangles[b].begin(), face.triangles[b].end());
                if (corners.size() != 4 || seen.contains(corners)) continue;
                // The two corners that are not shared are opposite ones.
                const auto lone = [&](const Triangle& t, const Triangle& other) {
                    return std::ranges::find_if(
                               t, [&](Index p) { return std::ranges::find(other, p) == other.end(); }) -
                           t.begin();
                };
                const auto k = static_cast<std::size_t>(lone(face.triangles[a], face.triangles[b]));
                const Triangle &t = face.triangles[a], &u = face.triangles[b];
                const Index far = u[static_cast<std::size_t>(lone(u, t))];
                const Quad quad{t[k], t[(k + 1) % 3], far, t[(k + 2) % 3]};
                const Vec3 diagonal = model.at(quad[0]) - model.at(quad[2]);
                if (std::abs(diagonal.z()) < 0.1 || std::hypot(diagonal.x(), diagonal.y()) < 0.1) continue;
                seen.emplace(corners, a);
                if (face.given_quads.empty()) face.given_quads.push_back(quad);
            }
        }
        walls += face.given_quads.empty() ? 0 : 1;
    }
    whole.model = std::move(model).finish();
    REQUIRE(walls == 4);
    const FaceId wall = whole.faces(Role::wall).front();
    const Quad quad = whole.model[wall].given_quads.front();
    const Vec3 middle = (whole.model.at(quad[0]) + whole.model.at(quad[2])) / 2;
    CHECK(test::refusal([&] { closure::cut_by_plane(whole, geometry::plane_across(middle, Vec3::UnitZ())); },
                        {"quads", "face", "keep_mesh = false"}) == "topology.splits_mesh");
    // Along the walls' edges upright, through two opposite corners of the box: no quad is met.
    const auto pieces = closure::cut_by_plane(whole,
                                              geometry::plane_across({0, 0, 0}, Vec3(3, -2, 0).normalized()));
    std::size_t kept = 0;
    for (const StepPiece& piece : pieces)
        for (const Face& face : piece.volume.model.faces) kept += face.given_quads.size();
    CHECK(kept == 4);
}

TEST_CASE(
    "a partition that ends on the volume's edges cuts it, bent or flat, and another flat face by its plane")
{
    const OpenVolume whole = box({2, 2, 4});
    const geometry::Plane middle = geometry::plane_across({0, 0, 2}, Vec3::UnitZ());
    const auto flat = closure::cut_by_plane(whole, middle);
    // The cut's own face, from one of the pieces, cuts by its plane where its rim is no edge of the volume.
    const Model& piece = flat.front().volume.model;
    for (std::size_t f = 0; f < piece.faces.size(); ++f) {
        if (piece.faces[f].origin == Origin::given) continue;
        const auto again = closure::cut_by_face(whole, piece, FaceId(f));
        check_cut(whole, again, middle);
    }
    // A wall of the volume has all of it on one side.
    CHECK(test::refusal([&] { closure::cut_by_face(whole, whole.model, whole.faces(Role::wall).front()); },
                        {"touches"}) == "closure.cut_misses");
    // A roof over the rim of one level, ridge in the middle.
    OpenVolume stacked = whole;
    {
        PrismOptions options;
        options.radius = std::sqrt(2.0);
        options.rows = 2;
        options.height = 4;
        stacked = test::prism(options).open();
    }
    healing::FacetSoup soup;
    std::vector<Vec3> rim;
    for (std::size_t e = 0; e < stacked.model.edges.size(); ++e) {
        const Edge& edge = stacked.model.edges[e];
        if (std::ranges::all_of(edge.points,
                                [&](Index p) { return std::abs(stacked.model.at(p).z() - 2) < 1e-9; }))
            for (const Index p : edge.points) rim.push_back(stacked.model.at(p));
    }
    REQUIRE(rim.size() >= 8);
    std::ranges::sort(rim, {}, [](const Vec3& p) { return std::atan2(p.y(), p.x()); });
    for (const Vec3& p : rim)
        if (soup.points.empty() || (p - soup.points.back()).norm() > 1e-9) soup.points.push_back(p);
    if ((soup.points.front() - soup.points.back()).norm() < 1e-9) soup.points.pop_back();
    const auto count = static_cast<Index>(soup.points.size());
    soup.points.emplace_back(0, 0, 2.7);
    for (Index i = 0; i < count; ++i) {
        soup.triangles.push_back({i, (i + 1) % count, count});
        soup.triangle_label.push_back(1);
    }
    healing::SplitOptions whole_labels;
    whole_labels.whole_labels = true;
    const Model tent = healing::split_facets(soup, whole_labels);
    REQUIRE(tent.faces.size() == 1);
    const auto pieces = closure::cut_by_face(stacked, tent, FaceId(0));
    REQUIRE(pieces.size() == 2);
    double volume = 0;
    for (const StepPiece& part : pieces) {
        CHECK(closure::is_watertight(part.volume));
        volume += closure::enclosed_volume(part.volume);
    }
    CHECK(volume == doctest::Approx(16).epsilon(1e-9));
    CHECK(std::abs(closure::enclosed_volume(pieces[0].volume) - 8) > 0.5);
    // Lifted, its rim leaves the edges.
    const Model off = test::moved(tent, [](const Vec3& p) { return Vec3(p + Vec3(0, 0, 0.1)); });
    CHECK(test::refusal([&] { closure::cut_by_face(stacked, off, FaceId(0)); }, {"curved", "leaves"}) ==
          "closure.cut_face");
}

TEST_CASE("a ring that is cut once does not come apart, and one cut right through does")
{
    // A square ring upright: a plane through its hole crosses it twice.
    PrismOptions options;
    options.holes = 1;
    OpenVolume ring = test::prism(options).open();
    const geometry::Plane plane = geometry::plane_across({0, 0, 0}, Vec3(0.3, 1, 0).normalized());
    const auto pieces = closure::cut_by_plane(ring, plane);
    check_cut(ring, pieces, plane);
    CHECK(pieces.size() == 2);
    // A face that covers one of the two places alone.
    healing::FacetSoup soup;
    const Vec3 along = plane.normal.cross(Vec3::UnitZ());
    soup.points = {0.05 * along, 3 * along, 3 * along + Vec3(0, 0, 2), 0.05 * along + Vec3(0, 0, 2)};
    soup.triangles = {{0, 1, 2}, {0, 2, 3}};
    soup.triangle_label = {1, 1};
    const Model half = healing::split_facets(soup);
    CHECK(test::refusal([&] { closure::cut_by_face(ring, half, FaceId(0)); }, {"stays in one piece"}) ==
          "closure.cut_apart");
    CHECK(all_faces(half).size() == 1);
}
