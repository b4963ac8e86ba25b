// SPDX-License-Identifier: MIT
#include "support/refusal.h"

#include <lacuna/healing/split_facets.h>
#include <lacuna/topology/open_volume.h>
#include <lacuna/topology/shared/give_mesh.h>

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

using namespace lacuna;
using namespace lacuna::topology;

namespace {

/// A prism over a segment of a circle, whose arc has a number of sides: bottom, top, chord and arc are faces.
OpenVolume segment_prism(Index sides)
{
    healing::FacetSoup soup;
    const auto add = [&](Index a, Index b, Index c, int label) {
        soup.triangles.push_back({a, b, c});
        soup.triangle_label.push_back(label);
    };
    const Index top = sides + 1;
    for (const double z : {0.0, 1.0})
        for (Index i = 0; i <= sides; ++i) {
            const double angle = std::numbers::pi / 3 * i / sides;
            soup.points.emplace_back(std::cos(angle), std::sin(angle), z);
        }
    for (Index i = 1; i < sides; ++i) {
        add(0, i + 1, i, 0);
        add(top, top + i, top + i + 1, 1);
    }
    add(sides, 0, top, 2);
    add(sides, top, top + sides, 2);
    for (Index i = 0; i < sides; ++i) {
        add(i, i + 1, top + i + 1, 3);
        add(i, top + i + 1, top + i, 3);
    }
    Model model = healing::split_facets(soup);
    const std::size_t faces = model.faces.size();
    return {std::move(model), std::vector<Role>(faces, Role::wall), {}};
}

} // namespace

TEST_CASE("nodes that leave no area of a face are refused by its name, not found out later")
{
    for (const Index sides : {2, 3, 8})
        for (const std::size_t between : {0, 1, 3}) {
            CAPTURE(sides);
            CAPTURE(between);
            OpenVolume volume = segment_prism(sides);
            const Model& model = volume.model;
            for (std::size_t e = 0; e < model.edges.size(); ++e) {
                const std::vector<Index>& points = model.edges[e].points;
                if (points.size() < 3 || model.at(points.front()).z() < 0.5) continue;
                EdgeNodes nodes{EdgeId(e), {model.at(points.front())}};
                for (std::size_t i = 1; i <= between; ++i) {
                    const double angle = std::numbers::pi / 3 * static_cast<double>(i) /
                                         static_cast<double>(between + 1);
                    const bool forward = model.at(points.front()).y() < model.at(points.back()).y();
                    const double own = forward ? angle : std::numbers::pi / 3 - angle;
                    nodes.nodes.emplace_back(std::cos(own), std::sin(own), 1);
                }
                nodes.nodes.push_back(model.at(points.back()));
                const std::string code = test::refusal(
                    [&] {
                        give_edge_nodes(volume, {&nodes, 1});
                    },
                    between == 0 ? std::vector<std::string>{"no area"} : std::vector<std::string>{});
                CHECK(code == (between == 0 ? "topology.face_vanishes" : "done"));
                break;
            }
            for (const Face& face : volume.model.faces) CHECK(!face.triangles.empty());
        }
}
