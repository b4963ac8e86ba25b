// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/morph.h>

#include <lacuna/core/message.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/sweep/detail/harmonic_spread.h>
#include <lacuna/sweep/detail/rim.h>
#include <lacuna/sweep/detail/surface_smoothing.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace lacuna::sweep {

namespace {

/// If the worst quad of the morphed mesh is below this share of the source's worst quad, other starting
/// positions are tried. With every quad below 0.5, finely graded meshes lose their grading.
constexpr double kStandsUp = 0.5;

/// The graph of a mesh, and the factorisation of its Laplacian with the rim fixed.
struct Spreader {
    NodeGraph graph;
    std::vector<double> weights;
    HarmonicSpread spread;

    Spreader(const mesh::QuadMesh& mesh, std::span<const Index> fixed, const RunContext& context)
        : graph(node_graph(mesh.quads, mesh.nodes.size())),
          weights(side_weights(graph, mesh.quads, mesh.nodes)),
          spread(graph, weights, fixed, context)
    {
    }
};
/// Returns the spreader, which is created when it is first used: affine images on planes do not need it.
using AskSpreader = std::function<const Spreader&()>;

struct Guess {
    std::vector<Vec3> nodes;
    bool affine = true; ///< the rims are related by an affine motion
};

/// Move the rim to the last row of the columns.
void put_rim(const RimColumns& columns, std::vector<Vec3>& nodes)
{
    const std::span<const Vec3> high = columns.row(columns.layers);
    for (std::size_t k = 0; k < high.size(); ++k) nodes[index(columns.rim[k])] = high[k];
}

/// Rows of nodes from rim to rim, see `morph()`.
using Rows = std::span<const std::vector<Index>>;

/// The source mapped by `base`. The difference between each mapped rim node and its required position is
/// spread harmonically over the inside, or linearly along the grid lines of a tube.
std::vector<Vec3> image_by(const std::function<Vec3(const Vec3&)>& base, const mesh::QuadMesh& source,
                           const RimColumns& columns, Rows rows, const AskSpreader& spreader,
                           const RunContext& context)
{
    std::vector<Vec3> nodes;
    for (const Vec3& node : source.nodes) nodes.push_back(base(node));
    const std::span<const Vec3> low = columns.row(0), high = columns.row(columns.layers);
    std::vector<Vec3> off(high.begin(), high.end());
    for (std::size_t k = 0; k < low.size(); ++k) off[k] -= base(low[k]);
    if (rows.empty()) {
        spreader().spread.add(off, 1, nodes.data(), nodes.size(), context);
    } else {
        std::vector<Vec3> moved(nodes.size(), Vec3::Zero());
        for (std::size_t k = 0; k < low.size(); ++k) moved[index(columns.rim[k])] = off[k];
        for (std::size_t r = 1; r + 1 < rows.size(); ++r) {
            const double up = static_cast<double>(r) / static_cast<double>(rows.size() - 1);
            for (std::size_t i = 0; i < rows[r].size(); ++i)
                nodes[index(rows[r][i])] += (1 - up) * moved[index(rows.front()[i])] +
                                            up * moved[index(rows.back()[i])];
        }
    }
    put_rim(columns, nodes);
    return nodes;
}

/// Node positions from the rims alone, without the surface.
Guess guess_from_rims(const mesh::QuadMesh& source, const RimColumns& columns, Rows rows,
                      const AskSpreader& spreader, const RunContext& context)
{
    Guess guess{source.nodes, true};
    if (columns.rim.empty()) return guess;
    const std::vector<Segment> sides = rim_sides(source, columns);
    const std::span<const Vec3> low = columns.row(0);
    const std::span<const Vec3> high = columns.row(columns.layers);
    const double low_size = radius(low);
    const double shrink = low_size > 0 ? radius(high) / low_size : 0;
    const double negligible = kVisible * shrink * shortest_side(source.quads, source.nodes);
    const geometry::AffineFit fit =
        RimFitter(low, sides, source.nodes).fit(high, rim_area(high, sides), negligible);
    if (fit.max_residual > negligible)
        return {image_by(fit, source, columns, rows, spreader, context), false};
    for (Vec3& node : guess.nodes) node = fit(node);
    put_rim(columns, guess.nodes);
    return guess;
}

std::vector<Index> nodes_off_rim(const mesh::QuadMesh& source, const RimColumns& columns)
{
    std::vector<char> on_rim(source.nodes.size(), 0);
    for (const Index node : columns.rim) on_rim[index(node)] = 1;
    std::vector<Index> result;
    for (std::size_t i = 0; i < on_rim.size(); ++i) {
        if (on_rim[i] == 0) result.push_back(static_cast<Index>(i));
    }
    return result;
}

/// Nodes of a mesh, and the quality of its worst quad.
struct Candidate {
    std::vector<Vec3> nodes;
    double worst = -1;
};

double largest_move(std::span<const Vec3> from, std::span<const Vec3> to)
{
    double largest = 0;
    for (std::size_t i = 0; i < from.size(); ++i) largest = std::max(largest, (to[i] - from[i]).norm());
    return largest;
}

/// A membrane that spans the rim and bulges under pressure, scaled so that its height is the rim's radius.
/// Empty if the rim encloses no area.
std::vector<Vec3> membrane(const mesh::QuadMesh& source, const RimColumns& columns,
                           const AskSpreader& spreader)
{
    const std::span<const Vec3> rim = columns.row(columns.layers);
    const Vec3 area = rim_area(rim, rim_sides(source, columns));
    if (!(area.norm() > 0)) return {};
    std::vector<Vec3> bulge(source.nodes.size(), Vec3(1, 0, 0));
    spreader().spread.solve(bulge);
    double top = 0;
    for (const Vec3& height : bulge) top = std::max(top, height[0]);
    if (!(top > 0)) return {};
    const Vec3 reach = radius(rim) / top * area.normalized();
    for (Vec3& height : bulge) height = height[0] * reach;
    return bulge;
}

/// Smooth the mesh until its worst quad is good enough. @return  the best mesh found
Candidate smoothed(const mesh::QuadMesh& source, const AskSpreader& spreader,
                   std::span<const Index> free_nodes, const SurfaceProjector& project, double good_enough,
                   Candidate found, const RunContext& context)
{
    const SurfaceSmoother smoother(source, spreader().graph, spreader().weights, spreader().spread,
                                   free_nodes, project);
    found.nodes = smoother.relax(std::move(found.nodes), good_enough, context);
    found.nodes = smoother.polish(std::move(found.nodes), good_enough, context);
    found.worst = worst_quad(source.quads, found.nodes, context);
    return found;
}

} // namespace

Morphed morph(const mesh::QuadMesh& source, const RimColumns& columns, const SurfaceProjector& project,
              const RunContext& context, std::span<const std::vector<Index>> rows)
{
    check_columns(source, columns);
    const std::vector<Index> free_nodes = nodes_off_rim(source, columns);
    std::optional<Spreader> made;
    const AskSpreader spreader = [&]() -> const Spreader& {
        return made ? *made : made.emplace(source, columns.rim, context);
    };
    const Guess guess = guess_from_rims(source, columns, rows, spreader, context);

    Morphed result;
    result.worst_source = worst_quad(source.quads, source.nodes, context);
    result.report = guess.affine ? "affine image of the source" : "fitted image of the source";
    Candidate found{guess.nodes, worst_quad(source.quads, guess.nodes, context)};
    // Smoothing cannot undo the distortion of an affine map between the rims, only that of the projection. In
    // this case, the goal is the quality before the projection.
    const double model = guess.affine ? std::min(result.worst_source, found.worst) : result.worst_source;
    if (project && !free_nodes.empty()) {
        Candidate projected{guess.nodes, -1};
        project_nodes(projected.nodes, free_nodes, project);
        const double move = largest_move(guess.nodes, projected.nodes);
        const double size = columns.rim.empty() ? radius(source.nodes) : radius(columns.row(columns.layers));
        if (move > kSamePlace * size) {
            projected.worst = worst_quad(source.quads, projected.nodes, context);
            found = std::move(projected);
            result.report += formatted(", projected by up to {:.2g} of its radius",
                                       size > 0 ? move / size : 0);
        }
        const double before = found.worst;
        const double good_enough = model - kAlikeSizes;
        std::vector<Vec3> start = guess.nodes;
        const auto start_from = [&](std::vector<Vec3> unprojected, const char* words) {
            Candidate other{unprojected, -1};
            project_nodes(other.nodes, free_nodes, project);
            other.worst = worst_quad(source.quads, other.nodes, context);
            if (other.worst <= found.worst) return;
            found = std::move(other);
            start = std::move(unprojected);
            result.report += words;
        };
        // Start from the source, with its nodes displaced like its rim. This suits a skin far from its rims,
        // such as a bent tube that is swept through its thickness. There an affine fit of the rims does not
        // describe the inside, and the residual turns with the bend, so it is not spread along grid lines.
        if (before < good_enough && !guess.affine)
            start_from(image_by([](const Vec3& p) { return p; }, source, columns, {}, spreader, context),
                       ", from the source moved with its rim");
        // Start from the harmonic image, in which every inner node is the weighted mean of its neighbours.
        // There, raised parts of the source (pockets, bosses, steps) lie side by side. In an affine image
        // they would overlap.
        if (found.worst < kStandsUp * good_enough && !columns.rim.empty())
            start_from(image_by([](const Vec3&) { return Vec3(Vec3::Zero()); }, source, columns, {}, spreader,
                                context),
                       ", from its harmonic image");
        // Start from a membrane. With a flat start in a deep bowl above a flat rim, the closest points of the
        // surface would crowd at the rim.
        if (found.worst < kStandsUp * good_enough) {
            const std::vector<Vec3> flat = start, bulge = membrane(source, columns, spreader);
            for (const double height : {0.5, -0.5, 1.0, -1.0, 2.0, -2.0, 4.0, -4.0}) {
                if (bulge.empty()) break;
                std::vector<Vec3> bulged = flat;
                for (std::size_t i = 0; i < bulge.size(); ++i) bulged[i] += height * bulge[i];
                start_from(std::move(bulged), ", bulged");
            }
        }
        if (found.worst < good_enough)
            found = smoothed(source, spreader, free_nodes, project, good_enough, std::move(found), context);
        if (found.worst > before)
            result.report += formatted(", smoothed from a worst quad of {:.2g}", before);
    }
    result.worst = found.worst;
    result.nodes = std::move(found.nodes);
    result.report += formatted("; worst quad {:.2g} (source {:.2g})", result.worst, result.worst_source);
    log_line(context, result.report);
    return result;
}

} // namespace lacuna::sweep
