// SPDX-License-Identifier: MIT
#include "closure/sealing_checks.h"
#include "support/whole_families.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>

using namespace lacuna;
using namespace lacuna::topology;
using closure::Closure;
using test::End;
using test::Part;
using test::PrismOptions;
using test::without;

namespace {

/// Leave out walls by the bits of a number, in order of loop and side.
std::function<bool(const Part&)> by_bits(unsigned long bits, const PrismOptions& options)
{
    const int outer = std::max(options.sides, 1), inner = std::max(options.hole_sides, 1);
    return [=](const Part& part) {
        if (part.role != Role::wall) return false;
        const int number = part.loop == 0 ? part.side : outer + (part.loop - 1) * inner + part.side;
        return ((bits >> number) & 1UL) != 0;
    };
}

struct Missing {
    std::size_t walls = 0, corners = 0;
};

/// How many void faces and edges the paper's algorithms make: a face a missing wall, an edge a corner
/// between two missing walls.
Missing missing(const PrismOptions& options)
{
    Missing count;
    for (int loop = 0; loop <= options.holes; ++loop) {
        const int sides = std::max(loop == 0 ? options.sides : options.hole_sides, 1);
        for (int side = 0; side < sides; ++side) {
            if (!options.drop({Role::wall, loop, side, 0, 0})) continue;
            ++count.walls;
            if (options.drop({Role::wall, loop, (side + 1) % sides, 0, 0})) ++count.corners;
        }
    }
    return count;
}

/// @param closeness  of the volume to the whole's: void faces are flat or ruled as the walls were, but cut
///         into other facets.
void check_prism(const PrismOptions& options, VolumeClass value, double closeness = 1e-9)
{
    const auto prism = test::prism(options);
    auto volume = prism.open();
    CHECK(!closure::is_watertight(volume));
    const Closure closed = test::seal(volume);
    CHECK(to_string(closed.value) == to_string(value));
    CHECK(closed.watertight);
    test::check_sealed(volume);
    CHECK(closure::enclosed_volume(volume) == doctest::Approx(prism.facet_volume).epsilon(closeness));
    for (const FaceId face : closed.void_faces) CHECK(volume.model[face].origin == Origin::made_void);
    for (const EdgeId edge : closed.void_edges) CHECK(volume.model[edge].origin == Origin::made_void);
    CHECK(!closed.algorithms.empty());
    if (value == VolumeClass::I || value == VolumeClass::II || value == VolumeClass::III) {
        const Missing wanted = missing(options);
        CHECK(closed.void_faces.size() == wanted.walls);
        CHECK(closed.void_edges.size() == wanted.corners);
    }
}

/// A wall on part of a prism's side that stands on the source, or hangs from the target, and stops short of
/// the other.
struct Stub {
    int side = 0;
    bool hangs = false;
    double begin = 0, end = 1, height = 1; ///< shares of the side and of the prism's height
};

/// A prism of straight sides, of which some have a whole wall and some a stub.
struct StubbedPrism {
    std::vector<Vec2> outline; ///< anticlockwise
    double height = 2;
    std::vector<int> whole{}; ///< sides with a whole wall
    std::vector<Stub> stubs{};

    [[nodiscard]] double volume() const
    {
        double twice = 0;
        for (std::size_t i = 0; i < outline.size(); ++i) {
            const Vec2 &a = outline[i], &b = outline[(i + 1) % outline.size()];
            twice += a.x() * b.y() - a.y() * b.x();
        }
        return height * twice / 2;
    }

    [[nodiscard]] std::string name() const
    {
        std::string text = std::to_string(outline.size()) + " sides, whole walls on";
        for (const int side : whole) text += " " + std::to_string(side);
        for (const Stub& stub : stubs) {
            text += (stub.hangs ? "; hangs on side " : "; stands on side ") + std::to_string(stub.side) +
                    " from " + std::to_string(stub.begin) + " to " + std::to_string(stub.end) + ", " +
                    std::to_string(stub.height) + " high";
        }
        return text;
    }

    [[nodiscard]] OpenVolume open() const
    {
        healing::FacetSoup soup;
        Roles roles;
        int labels = 0;
        const auto add = [&](const std::vector<Vec3>& polygon, std::vector<FaceId>& faces) {
            std::vector<Index> at;
            for (const Vec3& p : polygon) {
                const auto same = std::find_if(soup.points.begin(), soup.points.end(),
                                               [&](const Vec3& q) { return (p - q).norm() < 1e-12; });
                at.push_back(static_cast<Index>(same - soup.points.begin()));
                if (same == soup.points.end()) soup.points.push_back(p);
            }
            for (std::size_t i = 2; i < at.size(); ++i) {
                soup.triangles.push_back({at[0], at[i - 1], at[i]});
                soup.triangle_label.push_back(labels);
            }
            faces.emplace_back(static_cast<std::size_t>(labels++));
        };
        std::vector<Vec3> low, high;
        for (const Vec2& p : outline) {
            low.insert(low.begin(), Vec3(p.x(), p.y(), 0));
            high.emplace_back(p.x(), p.y(), height);
        }
        add(low, roles.source);
        add(high, roles.target);
        const auto add_wall = [&](int side, double begin, double end, double from, double to) {
            const auto i = static_cast<std::size_t>(side);
            const Vec2 &a = outline[i], &b = outline[(i + 1) % outline.size()];
            const Vec2 p = a + begin * (b - a), q = a + end * (b - a);
            add({{p.x(), p.y(), from}, {q.x(), q.y(), from}, {q.x(), q.y(), to}, {p.x(), p.y(), to}},
                roles.walls);
        };
        for (const int side : whole) add_wall(side, 0, 1, 0, height);
        for (const Stub& s : stubs) {
            const double tall = s.height * height;
            add_wall(s.side, s.begin, s.end, s.hangs ? height - tall : 0, s.hangs ? height : tall);
        }
        return open_volume(healing::split_facets(soup), roles);
    }
};

/// Three to six corners on an ellipse, and one or two stubs of any width and height, at a corner or in the
/// middle of a side; now and then other sides have whole walls.
StubbedPrism random_stubbed_prism(std::mt19937_64& dice)
{
    std::uniform_real_distribution<double> uniform(0, 1);
    const auto between = [&](double low, double high) { return low + (high - low) * uniform(dice); };
    const auto one_of = [&](int n) { return static_cast<int>(dice() % static_cast<unsigned>(n)); };
    StubbedPrism prism;
    const int sides = 3 + one_of(4);
    const double wide = between(0.7, 1.5);
    for (int i = 0; i < sides; ++i) {
        const double angle = 2 * std::numbers::pi * (i + between(-0.15, 0.15)) / sides;
        prism.outline.emplace_back(wide * std::cos(angle), std::sin(angle));
    }
    prism.height = between(0.7, 3);
    std::set<int> free;
    for (int i = 0; i < sides; ++i) free.insert(i);
    const int stubs = 1 + one_of(2);
    for (int i = 0; i < stubs; ++i) {
        const auto side = std::next(free.begin(), one_of(static_cast<int>(free.size())));
        Stub stub{.side = *side, .hangs = one_of(2) == 1, .height = between(0.04, 0.96)};
        const int place = one_of(4); // from the first corner, to the second, in between, the whole side
        if (place == 1 || place == 2) stub.begin = between(0.01, 0.5);
        if (place == 0 || place == 2) stub.end = between(0.51, 0.99);
        if (place == 0 && one_of(2) == 1) stub.end = between(0.01, 0.5);
        prism.stubs.push_back(stub);
        free.erase(side);
    }
    for (const int side : free) {
        if (one_of(3) == 0) prism.whole.push_back(side);
    }
    return prism;
}

} // namespace

TEST_CASE("prisms of every set of missing walls close to the volume of the whole")
{
    int combinations = 0;
    for (const int sides : {3, 4, 6}) {
        for (const double taper : {1.0, 0.6}) {
            for (const End end : {End::planar, End::tilted}) {
                for (unsigned long bits = 1; bits < (1UL << sides); ++bits) {
                    PrismOptions options{.sides = sides, .taper = taper, .target = end};
                    options.drop = by_bits(bits, options);
                    CAPTURE(sides);
                    CAPTURE(taper);
                    CAPTURE(static_cast<int>(end));
                    CAPTURE(bits);
                    const bool all = bits + 1 == 1UL << sides;
                    const bool warped = taper != 1 && end != End::planar;
                    check_prism(options,
                                all                            ? VolumeClass::I
                                : missing(options).corners > 0 ? VolumeClass::II
                                                               : VolumeClass::III,
                                warped ? 0.02 : 1e-9);
                    ++combinations;
                }
            }
        }
    }
    MESSAGE(combinations << " prisms");
}

TEST_CASE(
    "prisms with holes close to the volume of the whole, whichever walls of whichever loops are missing")
{
    std::mt19937_64 dice(7);
    int combinations = 0;
    for (const int sides : {0, 3, 5}) {
        for (const int holes : {1, 2, 4}) {
            for (const int hole_sides : {0, 4}) {
                const int walls = std::max(sides, 1) + holes * std::max(hole_sides, 1);
                for (int trial = 0; trial < 8; ++trial) {
                    const unsigned long all = (1UL << walls) - 1;
                    const unsigned long bits = trial == 0 ? all : dice() & all;
                    if (bits == 0) continue;
                    PrismOptions options{.sides = sides, .holes = holes, .hole_sides = hole_sides};
                    options.drop = by_bits(bits, options);
                    CAPTURE(sides);
                    CAPTURE(holes);
                    CAPTURE(hole_sides);
                    CAPTURE(bits);
                    check_prism(options, bits == all                    ? VolumeClass::I
                                         : missing(options).corners > 0 ? VolumeClass::II
                                                                        : VolumeClass::III);
                    ++combinations;
                }
            }
        }
    }
    MESSAGE(combinations << " prisms with holes");
}

TEST_CASE("prisms without target, without source and without both close to the volume of the whole")
{
    int combinations = 0;
    for (const int sides : {0, 3, 4, 7}) {
        for (const int holes : {0, 1, 4}) {
            for (const int rows : {1, 2}) {
                for (const double bend : {0.0, 60.0}) {
                    for (int gone = 1; gone < 4; ++gone) {
                        PrismOptions options{.sides = sides,
                                             .height = 3,
                                             .holes = holes,
                                             .hole_sides = sides,
                                             .rows = rows,
                                             .levels = bend > 0 ? 6 : 1,
                                             .bend = bend};
                        options.drop = without((gone & 1) != 0, (gone & 2) != 0, false);
                        CAPTURE(sides);
                        CAPTURE(holes);
                        CAPTURE(rows);
                        CAPTURE(bend);
                        CAPTURE(gone);
                        check_prism(options, gone == 3 ? VolumeClass::V : VolumeClass::IV);
                        ++combinations;
                    }
                }
            }
        }
    }
    MESSAGE(combinations << " prisms without an end");
}

TEST_CASE("an open volume with one wall of three, as in the paper's figure 6, takes one void edge and two "
          "void faces")
{
    auto volume = test::prism({.sides = 3, .drop = without(false, false, false, {0, 1})}).open();
    const Closure closed = test::seal(volume);
    CHECK(closed.void_edges.size() == 1);
    CHECK(closed.void_faces.size() == 2);
    CHECK(closed.value == VolumeClass::II);
}

TEST_CASE("closing a closed volume adds nothing")
{
    auto volume = test::prism({.sides = 5, .holes = 1}).open();
    CHECK(closure::is_watertight(volume));
    const std::size_t faces = volume.model.faces.size();
    const Closure closed = test::seal(volume);
    CHECK(closed.value == VolumeClass::closed);
    CHECK(closed.void_faces.empty());
    CHECK(closed.void_edges.empty());
    CHECK(volume.model.faces.size() == faces);
    test::check_sealed(volume);
}

TEST_CASE("the order and the directions the facets come in do not matter")
{
    int combinations = 0;
    for (const auto& [drop, value] : std::vector<std::pair<std::function<bool(const Part&)>, VolumeClass>>{
             {without(false, false, true), VolumeClass::I},
             {without(false, false, false, {0, 1}), VolumeClass::II},
             {without(false, false, false, {0, 2}), VolumeClass::III},
             {without(false, true, false), VolumeClass::IV},
             {without(true, true, false), VolumeClass::V}}) {
        for (unsigned seed = 0; seed < 6; ++seed) {
            const auto prism = test::prism({.sides = 5, .holes = 2, .hole_sides = 3, .drop = drop});
            healing::SplitOptions split;
            split.whole_labels = true;
            const Model model = healing::split_facets(test::scrambled_facets(prism.soup, seed), split);
            Roles roles;
            for (std::size_t f = 0; f < model.faces.size(); ++f) {
                const Role role =
                    prism.part[static_cast<std::size_t>(std::stoi(model.faces[f].name.substr(1)))].role;
                (role == Role::source   ? roles.source
                 : role == Role::target ? roles.target
                                        : roles.walls)
                    .emplace_back(f);
            }
            auto volume = open_volume(model, roles);
            CAPTURE(std::string(to_string(value)));
            CAPTURE(seed);
            const Closure closed = test::seal(volume);
            CHECK(to_string(closed.value) == to_string(value));
            test::check_sealed(volume);
            CHECK(closure::enclosed_volume(volume) == doctest::Approx(prism.facet_volume).epsilon(1e-9));
            ++combinations;
        }
    }
    MESSAGE(combinations << " scrambled volumes");
}

TEST_CASE("a closed wall that is missing is closed by one void edge used twice")
{
    for (const double taper : {1.0, 0.5, 2.0}) {
        for (const double lift : {-0.3, 0.3}) {
            PrismOptions options{.sides = 0,
                                 .cuts = 4,
                                 .taper = taper,
                                 .target = End::tilted,
                                 .lift = lift,
                                 .drop = without(false, false, true)};
            const auto prism = test::prism(options);
            auto volume = prism.open();
            const Closure closed = test::seal(volume);
            CAPTURE(taper);
            CAPTURE(lift);
            CHECK(closed.value == VolumeClass::I);
            CHECK(closed.void_edges.size() == 1);
            CHECK(closed.void_faces.size() == 1);
            test::check_sealed(volume);
            CHECK(closure::enclosed_volume(volume) == doctest::Approx(prism.facet_volume).epsilon(0.02));
        }
    }
}

TEST_CASE("round ends whose vertices were cut at random close to the volume of the whole")
{
    int combinations = 0;
    for (const int holes : {0, 1, 2, 4}) {
        for (unsigned seed = 0; seed < 8; ++seed) {
            const auto prism = test::prism({.sides = 0,
                                            .holes = holes,
                                            .hole_sides = 0,
                                            .cuts = 4,
                                            .drop = without(false, false, true)});
            healing::FacetSoup soup = prism.soup;
            std::vector<std::size_t> order(soup.points.size());
            for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
            std::mt19937 dice(seed);
            std::shuffle(order.begin(), order.end(), dice);
            for (std::size_t i = 0; i < order.size(); ++i) soup.points[order[i]] = prism.soup.points[i];
            for (Triangle& t : soup.triangles) {
                for (Index& p : t) p = static_cast<Index>(order[static_cast<std::size_t>(p)]);
            }
            healing::SplitOptions split;
            split.whole_labels = true;
            auto volume = open_volume(healing::split_facets(soup, split),
                                      {{FaceId(std::size_t(0))}, {FaceId(std::size_t(1))}, {}});
            CAPTURE(holes);
            CAPTURE(seed);
            const Closure closed = test::seal(volume);
            CHECK(closed.void_edges.size() == static_cast<std::size_t>(holes) + 1);
            test::check_sealed(volume);
            CHECK(closure::enclosed_volume(volume) == doctest::Approx(prism.facet_volume).epsilon(0.01));
            ++combinations;
        }
    }
    MESSAGE(combinations << " round ends");
}

TEST_CASE("curved ends and walls close watertight, and near the volume of the whole")
{
    int combinations = 0;
    test::MembersToRun run(11);
    for (const int sides : {3, 4, 6}) {
        for (const int holes : {0, 1}) {
            for (const double twist : {0.0, 20.0}) {
                for (const double bend : {0.0, 40.0}) {
                    for (unsigned long bits = 0; bits < (1UL << sides); ++bits) {
                        if (!run.next()) continue;
                        PrismOptions options{.sides = sides,
                                             .height = 3,
                                             .holes = holes,
                                             .cuts = 4,
                                             .levels = 8,
                                             .twist = twist,
                                             .bend = bend,
                                             .target = End::bowed};
                        options.drop = by_bits(bits, options);
                        const auto prism = test::prism(options);
                        CAPTURE(sides);
                        CAPTURE(holes);
                        CAPTURE(twist);
                        CAPTURE(bend);
                        CAPTURE(bits);
                        auto volume = prism.open();
                        test::seal(volume);
                        test::check_sealed(volume);
                        // The chords of a bend cut off some of it.
                        CHECK(closure::enclosed_volume(volume) ==
                              doctest::Approx(prism.facet_volume).epsilon(bend > 0 ? 0.25 : 0.05));
                        const bool leads = holes > 0 ||
                                           missing(options).walls < static_cast<std::size_t>(sides);
                        if (leads && missing(options).walls > 0) {
                            auto followed = prism.open();
                            test::seal(followed, {closure::EdgeShape::follow});
                            test::check_sealed(followed);
                            CHECK(closure::enclosed_volume(followed) ==
                                  doctest::Approx(prism.facet_volume).epsilon(0.05));
                        }
                        ++combinations;
                    }
                }
            }
        }
    }
    MESSAGE(combinations << " curved prisms");
}

namespace {

/// A slot with a flat floor and round ends, milled into a curved part, whose mouth is not given.
struct MilledSlot {
    double length = 2; ///< of its straight sides; its half width is 1
    double turn = 0;   ///< of the slot about its tool's axis [rad]
    int half = 24;     ///< segments of a round end
    std::function<double(const Vec2&)> height;

    [[nodiscard]] std::vector<Vec2> outline() const
    {
        constexpr int kStraight = 12;
        std::vector<Vec2> points;
        for (const double side : {1.0, -1.0}) {
            for (int i = 0; i < half; ++i) {
                const double angle = std::numbers::pi * (static_cast<double>(i) / half - 0.5);
                points.emplace_back(side * Vec2(length / 2 + std::cos(angle), std::sin(angle)));
            }
            for (int i = 0; length > 0 && i < kStraight; ++i)
                points.emplace_back(side * Vec2(length * (0.5 - static_cast<double>(i) / kStraight), 1));
        }
        for (Vec2& p : points) p = Eigen::Rotation2Dd(turn) * p;
        return points;
    }

    /// Open above, with its floor as source.
    [[nodiscard]] OpenVolume open() const
    {
        healing::FacetSoup soup;
        const std::vector<Vec2> rim = outline();
        const auto n = static_cast<Index>(rim.size());
        for (const Vec2& p : rim) soup.points.emplace_back(p.x(), p.y(), 0);
        for (const Vec2& p : rim) soup.points.emplace_back(p.x(), p.y(), height(p));
        for (Index i = 2; i < n; ++i) soup.triangles.push_back({0, i, i - 1});
        for (Index i = 0; i < n; ++i) {
            const Index next = (i + 1) % n;
            soup.triangles.push_back({i, next, n + next});
            soup.triangles.push_back({i, n + next, n + i});
        }
        for (const Triangle& t : soup.triangles) {
            const bool floor = t[0] < n && t[1] < n && t[2] < n;
            soup.triangle_label.push_back(floor ? 0 : 1);
        }
        return open_volume(healing::split_facets(soup), {{FaceId(0)}, {}, {FaceId(1)}});
    }

    /// Of the outline's prism under the height, by rings of it about its middle.
    [[nodiscard]] double volume() const
    {
        constexpr int kRings = 60;
        const std::vector<Vec2> rim = outline();
        double sum = 0;
        for (std::size_t i = 0; i < rim.size(); ++i) {
            const Vec2 &a = rim[i], &b = rim[(i + 1) % rim.size()];
            const double area = (a.x() * b.y() - a.y() * b.x()) / 2;
            for (int k = 0; k < kRings; ++k) {
                const double share = (k + 0.5) / kRings;
                sum += area * 2 * share / kRings * height(share * (a + b) / 2);
            }
        }
        return sum;
    }
};

} // namespace

TEST_CASE("the mouth of a slot milled into a shaft or a ball has the shaft's or the ball's shape")
{
    int slots = 0;
    for (const double length : {1.0, 2.0, 6.0}) {
        for (const double turn : {0.0, 0.6, std::numbers::pi / 2}) {
            for (const double larger : {1.6, 2.5, 6.0}) { // the radius to what the slot reaches to
                for (const bool ball : {false, true}) {
                    CAPTURE(length);
                    CAPTURE(turn);
                    CAPTURE(larger);
                    CAPTURE(ball);
                    const bool along = turn == 0 && !ball;
                    const double radius = larger * (along ? 1 : 1 + length / 2);
                    const double floor = std::sqrt(radius * radius - (radius / larger) * (radius / larger)) -
                                         0.5;
                    const MilledSlot slot{length, turn, 24, [=](const Vec2& p) {
                                              const double off = ball ? p.squaredNorm() : p.y() * p.y();
                                              return std::sqrt(radius * radius - off) - floor;
                                          }};
                    OpenVolume volume = slot.open();
                    test::seal(volume);
                    test::check_sealed(volume);
                    const double near = larger < 2 ? 0.04 : 0.02;
                    CHECK(closure::enclosed_volume(volume) == doctest::Approx(slot.volume()).epsilon(near));
                    ++slots;
                }
            }
        }
    }
    MESSAGE(slots << " slots");
}

TEST_CASE("the mouth of a round hole, on which many curved parts fit, stays within its rim's heights")
{
    using Hole = std::pair<double, int>;
    for (const auto& [radius, half] : {Hole(1.2, 24), Hole(2, 24), Hole(5, 24), Hole(1.2, 6), Hole(2, 8)}) {
        CAPTURE(radius);
        CAPTURE(half);
        const MilledSlot hole{0, 0, half,
                              [r = radius](const Vec2& p) { return std::sqrt(r * r - p.y() * p.y()); }};
        OpenVolume volume = hole.open();
        const Closure closed = test::seal(volume, {.cap = closure::Cap::flat});
        test::check_sealed(volume);
        for (const FaceId face : closed.void_faces) {
            for (const Triangle& t : volume.model[face].triangles) {
                for (const Index p : t) {
                    CHECK(volume.model.at(p).z() <= radius + volume.model.tolerance);
                    CHECK(volume.model.at(p).z() >= std::sqrt(radius * radius - 1) - volume.model.tolerance);
                }
            }
        }
    }
}

TEST_CASE("walls missing from one row of a stack are closed")
{
    int combinations = 0;
    for (const int rows : {2, 3}) {
        for (int row = 0; row < rows; ++row) {
            for (unsigned side_bits = 1; side_bits < 16; ++side_bits) {
                PrismOptions options{.sides = 4, .rows = rows};
                options.drop = [=](const Part& p) {
                    return p.role == Role::wall && p.row == row && ((side_bits >> p.side) & 1U) != 0;
                };
                const auto prism = test::prism(options);
                CAPTURE(rows);
                CAPTURE(row);
                CAPTURE(side_bits);
                auto volume = prism.open();
                test::seal(volume);
                test::check_sealed(volume);
                CHECK(closure::enclosed_volume(volume) == doctest::Approx(prism.facet_volume).epsilon(1e-9));
                ++combinations;
            }
        }
    }
    MESSAGE(combinations << " stacks");
}

TEST_CASE("ends beside each other on a channel get no void edge where the channel's own rim joins them")
{
    // A slot with two shelves beside its mouth, and a floor of one or more faces: shelves are the ends.
    const std::vector<std::vector<Vec2>> sections{
        {{-1, 1}, {-3, 1}, {-3, -1}, {3, -1}, {3, 1}, {1, 1}},
        {{-1, 1}, {-3, 1}, {-3, -1}, {-1, -2}, {1, -2}, {3, -1}, {3, 1}, {1, 1}},
        {{-1, 1}, {-3, 1}, {-4, -1}, {4, -1}, {3, 1}, {1, 1}},
    };
    for (const std::vector<Vec2>& outline : sections) {
        const int sides = static_cast<int>(outline.size());
        const auto slot = test::prism(
            {.height = 5, .outline = outline, .drop = without(true, true, false, {sides - 1})});
        Roles roles{{slot.face({Role::wall, 0, 0})}, {slot.face({Role::wall, 0, sides - 2})}, {}};
        for (int side = 1; side + 2 < sides; ++side) roles.walls.push_back(slot.face({Role::wall, 0, side}));
        CAPTURE(sides);
        const auto open = open_volume(slot.model, roles);
        const auto [volume, closed] = closure::close(open, matching::match(open),
                                                     {.edge_shape = closure::EdgeShape::straight});
        test::check_sealed(volume);
        CHECK(closed.void_edges.size() == 2);
        CHECK(closed.void_faces.size() == 3);
        CHECK(closure::enclosed_volume(volume) == doctest::Approx(slot.facet_volume));
    }
}

TEST_CASE("pieces of walls missing from a row are closed")
{
    int combinations = 0;
    for (unsigned bits = 1; bits < 256; ++bits) {
        PrismOptions options{.sides = 4, .pieces = 2};
        options.drop = [=](const Part& p) {
            return p.role == Role::wall && ((bits >> (2 * p.side + p.piece)) & 1U) != 0;
        };
        const auto prism = test::prism(options);
        CAPTURE(bits);
        auto volume = prism.open();
        test::seal(volume);
        test::check_sealed(volume);
        CHECK(closure::enclosed_volume(volume) == doctest::Approx(prism.facet_volume).epsilon(1e-9));
        ++combinations;
    }
    MESSAGE(combinations << " rows");
}

TEST_CASE("a stub that ends within a side of a box leaves the sealed volume the box's")
{
    const std::vector<Vec2> square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    const std::vector<std::vector<Stub>> cases{
        {{.end = 0.5, .height = 0.5}},
        {{.end = 0.5, .height = 0.05}},
        {{.end = 0.3, .height = 0.25}},
        {{.end = 0.9, .height = 0.95}},
        {{.end = 0.99, .height = 0.5}},
        {{.begin = 0.5, .height = 0.5}},
        {{.begin = 0.3, .end = 0.6, .height = 0.5}},
        {{.end = 0.5, .height = 0.5}, {.side = 2, .end = 0.5, .height = 0.5}},
        {{.end = 0.5, .height = 0.4}, {.hangs = true, .end = 0.5, .height = 0.4}},
        {{.end = 0.5, .height = 0.4}, {.hangs = true, .end = 0.3, .height = 0.4}},
        {{.end = 0.5, .height = 0.4}, {.hangs = true, .begin = 0.3, .height = 0.4}},
        {{.end = 0.4, .height = 0.5}, {.begin = 0.6, .height = 0.3}},
    };
    for (const bool turned : {false, true}) {
        for (const bool opposite : {false, true}) {
            for (const std::vector<Stub>& stubs : cases) {
                StubbedPrism prism{.outline = square, .stubs = stubs};
                if (opposite && stubs.back().side != 2) prism.whole = {2};
                for (Stub& stub : prism.stubs) stub.hangs = stub.hangs != turned;
                CAPTURE(prism.name());
                auto volume = prism.open();
                test::seal(volume);
                test::check_sealed(volume);
                CHECK(closure::enclosed_volume(volume) == doctest::Approx(prism.volume()).epsilon(1e-9));
            }
        }
    }
}

TEST_CASE(
    "prisms with stubs of any width and height close to the volume of the whole, or are refused by name")
{
    std::mt19937_64 dice(7);
    int sealed = 0, refused = 0;
    for (int i = 0; i < 600; ++i) {
        const StubbedPrism prism = random_stubbed_prism(dice);
        CAPTURE(prism.name());
        auto volume = prism.open();
        try {
            test::seal(volume);
        } catch (const Error& error) {
            MESSAGE(error.code() << ": " << std::string(error.what()));
            ++refused;
            continue;
        }
        CHECK(closure::enclosed_volume(volume) == doctest::Approx(prism.volume()).epsilon(1e-9));
        ++sealed;
    }
    MESSAGE(sealed << " sealed, " << refused << " refused by name");
    CHECK(sealed > refused);
}

TEST_CASE("a class IV volume whose walls do not tell the missing end is refused, and the source's edge named")
{
    for (const int sides : {3, 4}) {
        for (const int holes : {0, 2}) {
            // One wall is left, about whose foot the end could be turned.
            auto volume = test::prism({.sides = sides,
                                       .holes = holes,
                                       .drop =
                                           [&](const test::Part& part) {
                                               return part.role == Role::target || part.loop > 0 ||
                                                      (part.role == Role::wall && part.side > 0);
                                           }})
                              .open();
            const auto before = volume.model.faces.size();
            CHECK(test::refusal([&] { test::seal(volume); }, {"edge ", "wall"}) == "closure.wall_missing");
            CHECK(volume.model.faces.size() == before); // what fails leaves the volume as it was
        }
    }
    auto alone = test::prism({.drop = without(false, true, true)}).open();
    CHECK(test::refusal([&] { test::seal(alone); }, {"edge "}) == "closure.wall_missing");
}

TEST_CASE("what fails leaves the volume as it was, and what is closed stays so when closed again")
{
    auto volume = test::prism({.sides = 4, .drop = without(false, false, false, {0, 1})}).open();
    test::seal(volume);
    const double before = closure::enclosed_volume(volume);
    const std::size_t faces = volume.model.faces.size();
    const Closure again = test::seal(volume);
    CHECK(again.value == VolumeClass::closed);
    CHECK(volume.model.faces.size() == faces);
    CHECK(closure::enclosed_volume(volume) == before);
}

TEST_CASE("ends with different numbers of corners and no walls between them are closed")
{
    int combinations = 0;
    for (const int below : {3, 4, 6}) {
        for (const int above : {0, 3, 4, 5}) {
            if (below == above) continue;
            auto soup = test::prism({.sides = below, .drop = without(false, true, true)}).soup;
            const auto upper = test::prism({.sides = above, .drop = without(true, false, true)}).soup;
            const auto base = static_cast<Index>(soup.points.size());
            soup.points.insert(soup.points.end(), upper.points.begin(), upper.points.end());
            for (const Triangle& t : upper.triangles) {
                soup.triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
                soup.triangle_label.push_back(1);
            }
            soup.label_name.push_back("top");
            healing::SplitOptions split;
            split.whole_labels = true;
            auto volume = open_volume(healing::split_facets(soup, split),
                                      {{FaceId(std::size_t(0))}, {FaceId(std::size_t(1))}, {}});
            CAPTURE(below);
            CAPTURE(above);
            test::seal(volume);
            test::check_sealed(volume);
            // Between the prisms over either end, or near: corners are cut where the facets are.
            const auto area = [](int sides) {
                return sides == 0 ? 3.14 : sides * std::sin(2 * 3.14159265 / sides) / 2;
            };
            CHECK(closure::enclosed_volume(volume) > 1.8 * std::min(area(below), area(above)));
            CHECK(closure::enclosed_volume(volume) < 2.1 * std::max(area(below), area(above)));
            ++combinations;
        }
    }
    MESSAGE(combinations << " pairs of ends");
}
