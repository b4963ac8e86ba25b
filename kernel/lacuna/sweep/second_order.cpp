// SPDX-License-Identifier: MIT
#include <lacuna/sweep/second_order.h>

#include <lacuna/core/error.h>
#include <lacuna/core/parallel.h>
#include <lacuna/mesh/quad_mesh.h>
#include <lacuna/sweep/detail/harmonic_spread.h>
#include <lacuna/sweep/detail/middle_skin.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lacuna::sweep {

namespace {

/// Bends below this share of a side are none: what projections leave. Straight cells then stay straight, to
/// the bit.
constexpr double kNoBend = 1e-9;
/// What the columns' cubics leave of the walls' bends is spread over the layers where it is more than this
/// share of a side; below, cells do not feel it. A choice, not a measurement.
constexpr double kSpread = 1e-3;

const Vec3* level_nodes(const mesh::HexMesh& mesh, int level)
{
    return mesh.nodes.data() + static_cast<std::size_t>(level) * index(mesh.nodes_per_layer);
}

/// Every middle node of a side in the middle of it.
void place_straight(mesh::HexMesh& mesh, const RunContext& context)
{
    const mesh::MiddlePlaces places(mesh);
    std::vector<Vec3>& middles = mesh.middles.nodes;
    const auto levels = static_cast<std::size_t>(mesh.layers) + 1;
    parallel_for(context, levels, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t l = begin; l < end; ++l) {
            const Vec3* nodes = level_nodes(mesh, static_cast<int>(l));
            for (std::size_t s = 0; s < mesh.middles.sides.size(); ++s) {
                const Segment& side = mesh.middles.sides[s];
                middles[places.side(l, static_cast<Index>(s))] =
                    (nodes[index(side[0])] + nodes[index(side[1])]) / 2;
            }
            if (l + 1 == levels) break;
            const Vec3* above = nodes + mesh.nodes_per_layer;
            for (Index n = 0; n < mesh.nodes_per_layer; ++n)
                middles[places.upright(l, n)] = (nodes[n] + above[n]) / 2;
        }
    });
}

std::vector<Vec3> bends_of(const mesh::HexMesh& mesh, int level)
{
    const mesh::MiddlePlaces places(mesh);
    const Vec3* nodes = level_nodes(mesh, level);
    std::vector<Vec3> bends(mesh.middles.sides.size());
    for (std::size_t s = 0; s < bends.size(); ++s) {
        const Segment& side = mesh.middles.sides[s];
        const Vec3 &a = nodes[index(side[0])], &b = nodes[index(side[1])];
        bends[s] = mesh.middles.nodes[places.side(static_cast<std::size_t>(level), static_cast<Index>(s))] -
                   (a + b) / 2;
        if (bends[s].squaredNorm() < kNoBend * kNoBend * (b - a).squaredNorm()) bends[s].setZero();
    }
    return bends;
}

bool any(const std::vector<Vec3>& vectors)
{
    return std::any_of(vectors.begin(), vectors.end(), [](const Vec3& v) { return !v.isZero(0); });
}

/// Share of the way of each level, by the means of its nodes.
std::vector<double> shares(const mesh::HexMesh& mesh)
{
    std::vector<double> share{0};
    Vec3 before = Vec3::Zero();
    for (int l = 0; l <= mesh.layers; ++l) {
        Vec3 mean = Vec3::Zero();
        const Vec3* nodes = level_nodes(mesh, l);
        for (Index n = 0; n < mesh.nodes_per_layer; ++n) mean += nodes[n];
        mean /= mesh.nodes_per_layer;
        if (l > 0) share.push_back(share.back() + (mean - before).norm());
        before = mean;
    }
    for (double& s : share) s = share.back() > 0 ? s / share.back() : 0;
    share.back() = 1;
    return share;
}

/// The sides on the levels between source and target.
void place_levels(mesh::HexMesh& mesh, const LevelBlend& blend, const RunContext& context)
{
    const mesh::MiddlePlaces places(mesh);
    std::vector<std::uint8_t> rim(mesh.middles.sides.size(), 0);
    for (const Index side : mesh.middles.rim_side) rim[index(side)] = 1;
    const std::vector<Vec3> first = blend.beyond(level_nodes(mesh, 0), rim, bends_of(mesh, 0));
    const std::vector<Vec3> last = blend.beyond(level_nodes(mesh, mesh.layers), rim,
                                                bends_of(mesh, mesh.layers));
    const bool ends = any(first) || any(last);
    const std::vector<double> share = shares(mesh);
    parallel_for(context, static_cast<std::size_t>(mesh.layers) - 1, 1,
                 [&](std::size_t begin, std::size_t end) {
                     std::vector<Vec3> extra;
                     for (std::size_t l = begin + 1; l < end + 1; ++l) {
                         const Vec3* nodes = level_nodes(mesh, static_cast<int>(l));
                         std::vector<Vec3> bends = bends_of(mesh, static_cast<int>(l)); // inside still none
                         if (!ends && !any(bends)) continue;
                         if (ends) {
                             extra.resize(first.size());
                             for (std::size_t s = 0; s < extra.size(); ++s)
                                 extra[s] = (1 - share[l]) * first[s] + share[l] * last[s];
                         }
                         blend.blend(nodes, rim, bends, extra);
                         for (std::size_t s = 0; s < bends.size(); ++s)
                             if (rim[s] == 0)
                                 mesh.middles.nodes[places.side(l, static_cast<Index>(s))] += bends[s];
                     }
                 });
}

/// The upright sides inside.
void place_columns(mesh::HexMesh& mesh, const RunContext& context)
{
    const mesh::MiddlePlaces places(mesh);
    std::vector<Index> rim;
    for (const Segment& side : mesh.rim) rim.push_back(side[0]);
    std::vector<std::uint8_t> on_rim(index(mesh.nodes_per_layer), 0);
    for (const Index n : rim) on_rim[index(n)] = 1;
    const auto layers = static_cast<std::size_t>(mesh.layers);
    double most = 0, left = 0; // bend of the rim's columns, and without their cubics, over the side
    std::vector<Vec3> beyond(layers * rim.size());
    for (std::size_t l = 0; l < layers; ++l) {
        const Vec3* nodes = level_nodes(mesh, static_cast<int>(l));
        for (std::size_t k = 0; k < rim.size(); ++k) {
            const Vec3 &a = nodes[rim[k]], &b = nodes[rim[k] + mesh.nodes_per_layer];
            const Vec3 bend = mesh.middles.nodes[places.upright(l, rim[k])] - (a + b) / 2;
            const double length = (b - a).norm();
            Vec3& rest = beyond[l * rim.size() + k];
            rest = bend - column_bend(mesh, rim[k], static_cast<int>(l));
            most = std::max(most, bend.norm() / length);
            left = std::max(left, rest.norm() / length);
        }
    }
    if (most < kNoBend) return;
    parallel_for(context, layers, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t l = begin; l < end; ++l)
            for (Index n = 0; n < mesh.nodes_per_layer; ++n)
                if (on_rim[index(n)] == 0)
                    mesh.middles.nodes[places.upright(l, n)] += column_bend(mesh, n, static_cast<int>(l));
    });
    if (left < kSpread) return;
    const std::span<const Vec3> source(mesh.nodes.data(), index(mesh.nodes_per_layer));
    const NodeGraph graph = node_graph(mesh.quads, source.size());
    const HarmonicSpread spread(graph, side_weights(graph, mesh.quads, source), rim, context);
    const std::size_t stride = places.upright(1, 0) - places.upright(0, 0);
    spread.add(beyond, layers, &mesh.middles.nodes[places.upright(0, 0)], stride, context);
}

void place_all_centres(mesh::HexMesh& mesh, const MiddleStates& states, const RunContext& context)
{
    // Layer by layer, first the even ones: two layers share the quads between them.
    const std::size_t quads = mesh.quads.size();
    for (const std::size_t parity : {0, 1}) {
        const std::size_t layers = (static_cast<std::size_t>(mesh.layers) + 1 - parity) / 2;
        parallel_for(context, layers, 1, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                for (std::size_t q = 0; q < quads; ++q)
                    place_centres(mesh, states, (2 * i + parity) * quads + q);
        });
    }
}

void check_amount(const mesh::HexMesh& mesh)
{
    const std::size_t all = mesh.nodes.size() + mesh::MiddlePlaces(mesh).count();
    if (all <= static_cast<std::size_t>(std::numeric_limits<Index>::max())) return;
    throw InvalidInput("sweep.too_many",
                       "a mesh of order 2 would have " + std::to_string(all) +
                           " nodes, more than can be numbered; ask for a larger 'size' or fewer 'layers'");
}

} // namespace

Elevated elevate(const topology::OpenVolume& volume, mesh::HexMesh& mesh, const std::vector<FaceId>& faces,
                 const SecondOrderOptions& options, const RunContext& context)
{
    mesh.middles = mesh::number_sides(mesh, !options.serendipity);
    check_amount(mesh);
    const mesh::MiddlePlaces places(mesh);
    mesh.middles.nodes.resize(places.count());
    MiddleStates states(places.count(), Middle::inside);
    place_straight(mesh, context);
    const LevelBlend blend(mesh);
    SkinCounts counts = place_skin(volume, mesh, faces, blend, options, states, context);
    check_cancelled(context);
    if (mesh.layers > 1) place_levels(mesh, blend, context);
    place_columns(mesh, context);
    if (mesh.middles.full) {
        place_all_centres(mesh, states, context);
        counts.given += place_skin_centres(volume, mesh, faces, options, states, context);
        place_all_centres(mesh, states, context);
    }
    check_cancelled(context);
    Elevated result;
    result.quality = quality::measure(mesh, context);
    std::size_t repaired = 0;
    if (result.quality.uncertified > 0) {
        repaired = repair_middles(volume, mesh, faces, states, context);
        result.quality = quality::measure(mesh, context);
    }
    result.report = std::string("order 2: ") + (mesh.middles.full ? "hex27" : "hex20") + ", " +
                    std::to_string(places.count()) + " middle nodes; of those on the skin " +
                    std::to_string(counts.exact) + " on exact curves and surfaces, " +
                    std::to_string(counts.facets) + " on facets, " + std::to_string(counts.given) + " given";
    if (repaired > 0)
        result.report += "; the inner ones of " + std::to_string(repaired) +
                         " cells moved to make them valid";
    return result;
}

mesh::HexMesh finer_skin(const mesh::HexMesh& mesh)
{
    const mesh::MiddlePlaces places(mesh);
    const auto sides = static_cast<Index>(mesh.middles.sides.size());
    mesh::HexMesh fine;
    fine.nodes_per_layer = mesh.nodes_per_layer + sides + static_cast<Index>(mesh.quads.size());
    fine.layers = 2 * mesh.layers;
    fine.patches = mesh.patches;
    // The rim's nodes come first on a level, and Eigen leaves new vectors as they are: the pages of what is
    // inside are never touched and take no memory.
    std::vector<Index> number(index(fine.nodes_per_layer), -1);
    Index next_number = 0;
    for (std::size_t r = 0; r < mesh.rim.size(); ++r) {
        number[index(mesh.rim[r][0])] = next_number++;
        number[index(mesh.nodes_per_layer + mesh.middles.rim_side[r])] = next_number++;
    }
    for (Index& n : number)
        if (n < 0) n = next_number++;
    fine.nodes.resize(index(fine.nodes_per_layer) * (2 * static_cast<std::size_t>(mesh.layers) + 1));
    for (std::size_t q = 0; q < mesh.quads.size(); ++q) {
        const Index centre = mesh.nodes_per_layer + sides + static_cast<Index>(q);
        for (std::size_t k = 0; k < 4; ++k) {
            const Index next = mesh.nodes_per_layer + mesh.middles.side_of[q][k];
            const Index before = mesh.nodes_per_layer + mesh.middles.side_of[q][(k + 3) % 4];
            fine.quads.push_back({number[index(mesh.quads[q][k])], number[index(next)], number[index(centre)],
                                  number[index(before)]});
            fine.source_patch.push_back(mesh.source_patch[q]);
            fine.target_patch.push_back(mesh.target_patch[q]);
        }
    }
    for (std::size_t r = 0; r < mesh.rim.size(); ++r) {
        const Index middle = mesh.nodes_per_layer + mesh.middles.rim_side[r];
        fine.rim.push_back({number[index(mesh.rim[r][0])], number[index(middle)]});
        fine.rim.push_back({number[index(middle)], number[index(mesh.rim[r][1])]});
    }
    for (int l = 0; l < fine.layers; ++l)
        for (std::size_t r = 0; r < mesh.rim.size(); ++r)
            fine.wall_patch.insert(fine.wall_patch.end(), 2,
                                   mesh.wall_patch[static_cast<std::size_t>(l / 2) * mesh.rim.size() + r]);
    // Each quad of the skin sets its nine nodes.
    const std::size_t quads = mesh.quads.size();
    const auto at = [&](std::size_t level, Index node) -> Vec3& {
        return fine.nodes[level * index(fine.nodes_per_layer) + index(number[index(node)])];
    };
    for (std::size_t i = 0; i < mesh.skin_count(); ++i) {
        const mesh::CellNodes nodes = mesh::skin_nodes(mesh, i);
        std::array<Vec3, 9> p;
        p.fill(Vec3::Zero());
        for (std::size_t n = 0; n < nodes.count; ++n) p[n] = mesh.node(index(nodes.node[n]));
        if (nodes.count == 8) {
            for (std::size_t k = 0; k < 4; ++k) p[8] += p[4 + k] / 2 - p[k] / 4;
        }
        if (i < 2 * quads) {
            const std::size_t level = i < quads ? 0 : static_cast<std::size_t>(fine.layers), q = i % quads;
            for (std::size_t k = 0; k < 4; ++k) {
                const std::size_t corner = i < quads ? (4 - k) % 4
                                                     : k; // the source's quads run the other way
                const std::size_t side = i < quads ? 3 - k : k;
                at(level, mesh.quads[q][corner]) = p[k];
                at(level, mesh.nodes_per_layer + mesh.middles.side_of[q][side]) = p[4 + k];
            }
            at(level, mesh.nodes_per_layer + sides + static_cast<Index>(q)) = p[8];
            continue;
        }
        const std::size_t wall = i - 2 * quads, low = 2 * (wall / mesh.rim.size()),
                          r = wall % mesh.rim.size();
        const Index from = mesh.rim[r][0], to = mesh.rim[r][1];
        const Index middle = mesh.nodes_per_layer + mesh.middles.rim_side[r];
        at(low, from) = p[0], at(low, to) = p[1], at(low + 2, to) = p[2], at(low + 2, from) = p[3];
        at(low, middle) = p[4], at(low + 1, to) = p[5], at(low + 2, middle) = p[6], at(low + 1, from) = p[7];
        at(low + 1, middle) = p[8];
    }
    return fine;
}

} // namespace lacuna::sweep
