// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/mesh/quad_mesh.h>
#include <lacuna/sweep/detail/harmonic_spread.h>
#include <lacuna/sweep/detail/morph.h>

#include <span>
#include <vector>

namespace lacuna::sweep {

/// Area vector around each node: the sum of the area vectors of its quads.
std::vector<Vec3> node_normals(std::span<const Quad> quads, std::span<const Vec3> nodes);

/// Minimum scaled Jacobian at the corners of a quad, measured along the quad's normal. This normal is
/// oriented like the normals of the quad's nodes. The value is 1 for a rectangle or an equilateral triangle,
/// 0 for a degenerate corner, and negative for a folded quad.
double quad_quality(const Quad& quad, std::span<const Vec3> nodes, std::span<const Vec3> normals);

/// The smallest `quad_quality()` of all quads; 1 if there are none.
double worst_quad(std::span<const Quad> quads, std::span<const Vec3> nodes, const RunContext& context = {});

/// Project some nodes onto the surface in one call.
void project_nodes(std::vector<Vec3>& nodes, std::span<const Index> which, const SurfaceProjector& project);

/// Moves the free nodes of a mesh along a surface until its worst quad is as good as that of a reference
/// mesh.
///
/// There are two methods. The result of each is kept only as far as it improves the worst quad.
/// 1. `relax()` moves every node to the weighted mean of its neighbours. The weights reproduce the reference
///    mesh, so that its grading is kept. All nodes are solved for at once, with the graph Laplacian as
///    preconditioner.
/// 2. `polish()` tries new positions for each node of a quad that is still poor: the mean of the node's
///    neighbours, and steps along the surface. A move is kept if it improves the worst of the quads around
///    the node.
class SurfaceSmoother {
public:
    /// All arguments must outlive the smoother. @param spread  with the fixed nodes of the smoothing.
    SurfaceSmoother(const mesh::QuadMesh& model, const NodeGraph& graph, std::span<const double> weights,
                    const HarmonicSpread& spread, std::span<const Index> free_nodes,
                    const SurfaceProjector& project);

    /// Project the free nodes onto the surface.
    void project(std::vector<Vec3>& nodes) const { project_nodes(nodes, free_nodes_, project_); }
    /// @return  the nodes with an improved worst quad, or the input.
    std::vector<Vec3> relax(std::vector<Vec3> nodes, double good_enough, const RunContext& context) const;
    std::vector<Vec3> polish(std::vector<Vec3> nodes, double good_enough, const RunContext& context) const;

private:
    [[nodiscard]] double worst_around(std::size_t node, std::span<const Vec3> nodes,
                                      std::span<const Vec3> normals) const;
    [[nodiscard]] std::vector<std::size_t> poor_nodes(std::span<const Vec3> nodes,
                                                      std::span<const Vec3> normals,
                                                      double good_enough) const;
    [[nodiscard]] Vec3 trial_place(std::size_t node, const Vec2& step, std::span<const Vec3> nodes,
                                   const Vec3& normal) const;
    bool polish_once(std::vector<Vec3>& nodes, double good_enough) const;

    const mesh::QuadMesh& model_;
    const NodeGraph& graph_;
    const HarmonicSpread& spread_;
    std::span<const Index> free_nodes_;
    const SurfaceProjector& project_;
    /// Weights of each node's neighbours, in the graph's order, adjusted so that they reproduce the reference
    /// mesh.
    std::vector<double> weights_;
    mesh::Incidence quads_at_ = mesh::quads_at_nodes(model_.quads, model_.nodes.size());
    std::vector<char> is_free_ = std::vector<char>(model_.nodes.size(), 0);
};

} // namespace lacuna::sweep
