// SPDX-License-Identifier: MIT
#include "support/dirt.h"

#include <lacuna/topology/shared/side_points.h>

#include <algorithm>

namespace lacuna::test {

using namespace topology;

namespace {

} // namespace

void append_loose(Model& model, const Model& from, const std::vector<FaceId>& faces)
{
    ModelBuilder to(std::move(model));
    for (const FaceId f : faces) {
        const Model one = extract(from, {f});
        const auto points = static_cast<Index>(to.points.size());
        const std::size_t vertices = to.vertices.size(), edges = to.edges.size();
        to.points.insert(to.points.end(), one.points.begin(), one.points.end());
        for (Vertex v : one.vertices) {
            v.point += points;
            v.tag = static_cast<int>(to.vertices.size()) + 1;
            to.vertices.push_back(v);
        }
        for (Edge e : one.edges) {
            for (Index& p : e.points) p += points;
            e.from = VertexId(e.from.index() + vertices);
            e.to = VertexId(e.to.index() + vertices);
            e.tag = static_cast<int>(to.edges.size()) + 1;
            to.edges.push_back(e);
        }
        Face face = one.faces[0];
        for (Triangle& t : face.triangles)
            for (Index& p : t) p += points;
        for (Quad& q : face.given_quads)
            for (Index& p : q) p += points;
        for (Loop& loop : face.loops)
            for (EdgeUse& use : loop.uses) use.edge = EdgeId(use.edge.index() + edges);
        to.faces.push_back(face);
    }
    model = std::move(to).finish();
}

Model exploded(const Model& model)
{
    ModelBuilder builder;
    builder.tolerance = model.tolerance;
    builder.diagonal = model.diagonal;
    Model loose = std::move(builder).finish();
    append_loose(loose, model, all_faces(model));
    return loose;
}

Vec3 wobble(std::mt19937& random)
{
    const auto part = [&] { return 2 * (static_cast<double>(random()) / 4294967295.0) - 1; };
    const Vec3 v(part(), part(), part());
    return v / std::max(1.0, v.norm());
}

void shake(Model& whole, double amount, unsigned seed)
{
    ModelBuilder model(std::move(whole));
    std::mt19937 random(seed);
    std::vector<bool> done(model.points.size(), false);
    for (const Edge& edge : model.edges) {
        for (const Index p : edge.points) {
            if (done[index(p)]) continue;
            done[index(p)] = true;
            model.points[index(p)] += amount * wobble(random);
        }
    }
    whole = std::move(model).finish();
}

void divide_sides(Model& whole, unsigned seed)
{
    ModelBuilder model(std::move(whole));
    std::mt19937 random(seed);
    SidePoints sides;
    for (Edge& edge : model.edges) {
        if (random() % 2 == 0) continue;
        Edge finer = edge;
        finer.points = {edge.points.front()};
        if (edge.curve) finer.params = {edge.params.front()};
        for (std::size_t i = 0; i + 1 < edge.points.size(); ++i) {
            if (random() % 3 != 0) {
                Vec3 middle = (model.at(edge.points[i]) + model.at(edge.points[i + 1])) / 2;
                if (edge.curve) {
                    const double t = (edge.params[i] + edge.params[i + 1]) / 2;
                    edge.curve->evaluate({&t, 1}, {&middle, 1});
                    finer.params.push_back(t);
                }
                sides.add(edge.points[i], edge.points[i + 1], {static_cast<Index>(model.points.size())});
                finer.points.push_back(static_cast<Index>(model.points.size()));
                model.points.push_back(middle);
            }
            finer.points.push_back(edge.points[i + 1]);
            if (edge.curve) finer.params.push_back(edge.params[i + 1]);
        }
        edge = finer;
    }
    for (Face& face : model.faces) cut_at_sides(model.points, face, sides);
    whole = std::move(model).finish();
}

void divide_edges(Model& whole, std::size_t every)
{
    ModelBuilder model(std::move(whole));
    const std::size_t count = model.edges.size();
    for (std::size_t e = 0; e < count; e += every) {
        if (model.edges[e].points.size() < 3) continue;
        Edge& first = model.edges[e];
        Edge second = first;
        const auto cut = static_cast<std::ptrdiff_t>(first.points.size() / 2);
        const VertexId v(model.vertices.size());
        model.vertices.push_back(
            {first.points[static_cast<std::size_t>(cut)], static_cast<int>(v.index()) + 1});
        first.points.resize(static_cast<std::size_t>(cut) + 1);
        second.points.erase(second.points.begin(), second.points.begin() + cut);
        if (first.curve) {
            first.params.resize(first.points.size());
            second.params.erase(second.params.begin(), second.params.begin() + cut);
        }
        first.to = second.from = v;
        second.tag = static_cast<int>(model.edges.size()) + 1;
        model.edges.push_back(second);
    }
    for (Face& face : model.faces) face.loops.clear();
    model.build_loops();
    whole = std::move(model).finish();
}

} // namespace lacuna::test
