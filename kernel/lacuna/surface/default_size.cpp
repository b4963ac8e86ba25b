// SPDX-License-Identifier: MIT
#include <lacuna/surface/shared/default_size.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/number_text.h>
#include <lacuna/topology/shared/give_mesh.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

namespace lacuna::surface {

using namespace topology;

namespace {

/// A facet side on an edge without kept nodes counts as at least the diagonal of the rims' bounding box
/// divided by this. Heuristic: a finely faceted square then gets 14 sides per edge, and a circle 44 sides in
/// total.
constexpr double kMostAlong = 20;

} // namespace

DefaultSize default_size(const OpenVolume& volume)
{
    const Model& model = volume.model;
    const std::vector<Rim> all = rims(model, volume.faces(Role::source));
    Eigen::AlignedBox3d box;
    for (const Rim& rim : all) {
        for (const EdgeUse& use : rim.uses) {
            for (const Index point : model[use.edge].points) box.extend(model.at(point));
        }
    }
    if (box.isEmpty()) return {model.diagonal / kMostAlong, "a twentieth of the model's diagonal"};
    const double least = box.diagonal().norm() / kMostAlong;
    const std::set<EdgeId> kept = kept_edges(model);
    double length = 0, sides = 0;
    std::size_t given = 0, finer = 0, edges = 0;
    for (const Rim& rim : all) {
        for (const EdgeUse& use : rim.uses) {
            const double own = edge_length(model, use.edge);
            double count = static_cast<double>(model[use.edge].points.size() - 1);
            if (kept.contains(use.edge)) {
                ++given;
            } else if (own < count * least) {
                count = std::max(1.0, std::ceil(own / least));
                ++finer;
            }
            length += own;
            sides += count;
            ++edges;
        }
    }
    std::string why = formatted("the mean side of the {} on the source's rims",
                                given == edges ? "given mesh" : "facets");
    if (finer == edges)
        why = "a twentieth of the diagonal of the source rims' box (their facets are finer)";
    else if (finer > 0)
        why += ", at least a twentieth of the diagonal of their box on each edge";
    return {length / sides, why};
}

SizeField even_size(double length)
{
    return [length](const Vec3&) { return length; };
}

SizeField checked_size(const SizeField& field, const std::string& option)
{
    return [field, option](const Vec3& p) {
        const double h = field(p);
        if (!(h > 0) || !std::isfinite(h)) {
            throw InvalidInput("sweep.size",
                               "sweep: option '{}' must be a positive number everywhere; at {} it is {}",
                               option, place_with_digits(p, 2), found(h));
        }
        return h;
    };
}

} // namespace lacuna::surface
