// SPDX-License-Identifier: MIT
#include "support/check_valid.h"
#include "support/volumes.h"

#include <lacuna/healing/split_facets.h>
#include <lacuna/sweep/sweep.h>

#include <Eigen/Geometry>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

using namespace lacuna;
using namespace lacuna::topology;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180;

/// A part of a pipe's axis: straight, or an arc.
struct Leg {
    double length = 0;
    double bend = 0;    ///< [degrees]
    double towards = 0; ///< which way it bends, in the frame that was carried there [degrees]
};

/// An arc by its radius.
Leg arc(double radius, double bend, double towards = 0) { return {radius * bend * kDegree, bend, towards}; }

/// A frame that is carried along the axis with no rotation about it.
struct Frame {
    Vec3 at = Vec3::Zero(), way = Vec3::UnitZ(), across = Vec3::UnitX();
    [[nodiscard]] Vec3 beside() const { return way.cross(across); }
};

Frame carried(const Frame& from, const Leg& leg, double share)
{
    Frame to = from;
    const double run = leg.length * share;
    if (leg.bend == 0) {
        to.at += run * from.way;
        return to;
    }
    const double radius = leg.length / (leg.bend * kDegree), towards = leg.towards * kDegree;
    const Vec3 in = std::cos(towards) * from.across + std::sin(towards) * from.beside();
    const Eigen::AngleAxisd turn(share * leg.bend * kDegree, from.way.cross(in));
    to.at = from.at + radius * in - radius * (turn * in);
    to.way = turn * from.way;
    to.across = turn * from.across;
    return to;
}

/// A pipe of facets: a section carried along an axis.
struct PipeOptions {
    std::vector<Leg> legs{};
    std::function<double(double)> section = [](double) { return 1.0; }; ///< radius by angle
    double bore = 0;            ///< size of a hole over that of the section; 0: none
    double taper = 1;           ///< size of the target over the source's
    bool faces_of_legs = false; ///< each leg's wall is a face; else all are one
    bool seams = false;         ///< walls are cut open along facet sides
    double facets_turn = 0; ///< of the facets and seams against the carried frame, from end to end [degrees]
    int straight_rows = 1;  ///< rows of facets along a straight leg
};

struct Pipe {
    OpenVolume volume;
    std::vector<Frame> axis; ///< closely
};

Pipe pipe(const PipeOptions& o)
{
    constexpr int kRound = 48;
    healing::FacetSoup soup;
    Pipe made;
    double whole = 0;
    for (const Leg& leg : o.legs) whole += leg.length;
    const auto add_ring = [&](const Frame& frame, double run, double size) {
        const auto first = static_cast<Index>(soup.points.size());
        for (int i = 0; i < kRound; ++i) {
            const double angle = 2 * kPi * i / kRound + o.facets_turn * kDegree * run / whole;
            const double radius = size * (1 + (o.taper - 1) * run / whole) * o.section(angle);
            soup.points.push_back(frame.at + radius * std::cos(angle) * frame.across +
                                  radius * std::sin(angle) * frame.beside());
        }
        return first;
    };
    const auto label = [&](const std::string& name) {
        const auto found = std::ranges::find(soup.label_name, name);
        if (found == soup.label_name.end()) soup.label_name.push_back(name);
        return static_cast<int>(std::ranges::find(soup.label_name, name) - soup.label_name.begin());
    };
    const auto add = [&](const Triangle& t, int part) {
        soup.triangles.push_back(t);
        soup.triangle_label.push_back(part);
    };
    const auto strip = [&](Index low, Index high, int part) {
        for (Index i = 0; i < kRound; ++i) {
            const Index j = (i + 1) % kRound;
            add({low + i, low + j, high + j}, part);
            add({low + i, high + j, high + i}, part);
        }
    };
    std::vector<std::pair<Index, Index>> ends; ///< of each loop
    for (const double size : o.bore > 0 ? std::vector<double>{1, o.bore} : std::vector<double>{1}) {
        Frame frame;
        double run = 0;
        Index low = add_ring(frame, 0, size);
        ends.emplace_back(low, low);
        for (std::size_t l = 0; l < o.legs.size(); ++l) {
            const Leg& leg = o.legs[l];
            const int rows = leg.bend == 0 ? o.straight_rows : static_cast<int>(std::ceil(leg.bend / 7.5));
            for (int row = 1; row <= rows; ++row) {
                const double share = static_cast<double>(row) / rows;
                const Index high = add_ring(carried(frame, leg, share), run + share * leg.length, size);
                strip(low, high,
                      label("wall " + std::to_string(size) + " " + std::to_string(o.faces_of_legs ? l : 0)));
                low = high;
            }
            constexpr int kClosely = 400;
            for (int k = 0; k < kClosely && size == 1; ++k)
                made.axis.push_back(carried(frame, leg, static_cast<double>(k) / kClosely));
            frame = carried(frame, leg, 1);
            run += leg.length;
        }
        if (size == 1) made.axis.push_back(frame);
        ends.back().second = low;
    }
    for (const bool target : {false, true}) {
        const int part = label(target ? "target" : "source");
        const Index rim = target ? ends.front().second : ends.front().first;
        if (o.bore > 0) {
            strip(rim, target ? ends.back().second : ends.back().first, part);
            continue;
        }
        soup.points.push_back((target ? made.axis.back() : made.axis.front()).at);
        for (Index i = 0; i < kRound; ++i)
            add({rim + i, rim + (i + 1) % kRound, static_cast<Index>(soup.points.size()) - 1}, part);
    }
    healing::SplitOptions split;
    split.whole_labels = true;
    Model model = healing::split_facets(soup, split);
    Roles roles;
    for (std::size_t f = 0; f < model.faces.size(); ++f) {
        const std::string& name = model.faces[f].name;
        (name == "source" ? roles.source : name == "target" ? roles.target : roles.walls).emplace_back(f);
    }
    if (o.seams)
        for (const FaceId wall : roles.walls) test::add_seam(model, wall);
    made.volume = open_volume(model, roles);
    return made;
}

/// Of a point beside the axis, in the carried frame [radian].
double angle_at(const Pipe& pipe, const Vec3& p)
{
    const Frame& frame = *std::ranges::min_element(pipe.axis, {},
                                                   [&](const Frame& f) { return (p - f.at).squaredNorm(); });
    const Vec3 off = p - frame.at;
    return std::atan2(off.dot(frame.beside()), off.dot(frame.across));
}

struct Drift {
    double turned = 0;  ///< of a column against the carried frame, at most [degrees]
    double crowded = 0; ///< of the angle between columns against the one on the source, at most [share]
};

Drift drift_of_columns(const Pipe& pipe, const mesh::HexMesh& mesh)
{
    Drift drift;
    const auto angle = [&](Index node, int layer) {
        return angle_at(pipe,
                        mesh.nodes[index(node) + static_cast<std::size_t>(layer * mesh.nodes_per_layer)]);
    };
    for (const Segment& side : mesh.rim) {
        const double a0 = angle(side[0], 0), b0 = angle(side[1], 0);
        for (int layer = 1; layer <= mesh.layers; ++layer) {
            const double a = angle(side[0], layer), b = angle(side[1], layer);
            drift.turned = std::max(drift.turned, std::abs(std::remainder(a - a0, 2 * kPi)) / kDegree);
            drift.crowded = std::max(
                drift.crowded,
                std::abs(std::remainder(b - a, 2 * kPi) / std::remainder(b0 - a0, 2 * kPi) - 1));
        }
    }
    return drift;
}

double ellipse(double angle) { return 1 / std::hypot(std::cos(angle), std::sin(angle) / 0.7); }
double rounded_square(double angle)
{
    return std::pow(std::pow(std::cos(angle), 4) + std::pow(std::sin(angle), 4), -0.25);
}

} // namespace

TEST_CASE("columns of bent pipes keep their angles in the frame that is carried with the least rotation")
{
    const std::vector<std::pair<std::string, std::vector<Leg>>> axes{
        {"elbow", {{6}, arc(4, 90), {3}}},
        {"sharp elbow", {{4}, arc(1.6, 90), {4}}},
        {"bend alone", {arc(3, 150)}},
        {"S", {{3}, arc(3, 60), {2}, arc(3, 60, 180), {3}}},
        {"U", {{5}, arc(2.5, 90), {2}, arc(2.5, 90), {5}}},
        {"out of plane", {{4}, arc(3, 90), {3}, arc(3, 90, 90), {4}}},
        {"one bend after the other", {{3}, arc(3, 80), arc(3, 80, 110), arc(3, 60, 200), {3}}},
        {"far", {{20}, arc(3, 90), {20}, arc(3, 90, 60), {20}, arc(3, 45, 240), {10}}},
    };
    const std::vector<std::pair<std::string, PipeOptions>> kinds{
        {"round", {}},
        {"a face a leg", {.faces_of_legs = true}},
        {"many facets", {.straight_rows = 8}},
        {"seams", {.seams = true}},
        {"a face a leg, with seams", {.faces_of_legs = true, .seams = true}},
        {"facets that turn", {.facets_turn = 100, .straight_rows = 12}},
        {"seams that turn", {.seams = true, .facets_turn = 100, .straight_rows = 12}},
        {"ellipse", {.section = ellipse}},
        {"rounded square, a face a leg", {.section = rounded_square, .faces_of_legs = true}},
        {"taper", {.taper = 0.6}},
        {"ring", {.bore = 0.6}},
        {"ring, a face a leg, with seams", {.bore = 0.5, .faces_of_legs = true, .seams = true}},
    };
    int members = 0;
    for (const auto& [way, legs] : axes) {
        for (const auto& [kind, options] : kinds) {
            CAPTURE(way);
            CAPTURE(kind);
            PipeOptions o = options;
            o.legs = legs;
            const Pipe made = pipe(o);
            sweep::SweepOptions asked;
            asked.size = [](const Vec3&) { return 0.5; };
            const sweep::Swept swept = sweep::sweep(made.volume, asked);
            test::check_valid(swept.mesh);
            const Drift drift = drift_of_columns(made, swept.mesh);
            CHECK(drift.turned <= 3);
            CHECK(drift.crowded <= 0.1);
            ++members;
        }
    }
    MESSAGE(members << " pipes");
}
