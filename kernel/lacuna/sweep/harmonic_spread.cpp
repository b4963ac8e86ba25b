// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/harmonic_spread.h>

#include <lacuna/core/error.h>
#include <lacuna/core/parallel.h>
#include <lacuna/core/vector_code.h>
#include <lacuna/geometry/sparse_factor.h>
#include <lacuna/mesh/quad_mesh.h>

#include <algorithm>
#include <vector>

namespace lacuna::sweep {

namespace {

/// Nodes a walk along sides reaches from the fixed ones, the fixed ones included.
std::vector<char> joined_to(const NodeGraph& graph, std::span<const Index> fixed)
{
    std::vector<char> joined(graph.size(), 0);
    std::vector<Index> front;
    for (const Index node : fixed) {
        joined[static_cast<std::size_t>(node)] = 1;
        front.push_back(node);
    }
    while (!front.empty()) {
        const auto node = static_cast<std::size_t>(front.back());
        front.pop_back();
        for (const Index next : graph.of(node)) {
            if (joined[static_cast<std::size_t>(next)] != 0) continue;
            joined[static_cast<std::size_t>(next)] = 1;
            front.push_back(next);
        }
    }
    return joined;
}

} // namespace

NodeGraph node_graph(std::span<const Quad> quads, std::size_t nodes)
{
    // Every side offers each of its ends to the other; sides two quads share are offered twice, then weeded.
    mesh::Incidence offered = mesh::incidence(nodes, [&](const auto& visit) {
        for (const Quad& quad : quads) {
            for (std::size_t i = 0; i < 4; ++i) {
                if (!mesh::is_side(quad, i)) continue;
                visit(index(quad[i]), quad[(i + 1) % 4]);
                visit(index(quad[(i + 1) % 4]), quad[i]);
            }
        }
    });
    NodeGraph graph;
    graph.begin.reserve(nodes + 1);
    graph.items.reserve(offered.items.size() / 2 + nodes);
    for (std::size_t i = 0; i < nodes; ++i) {
        const auto first = offered.items.begin() + offered.begin[i];
        const auto last = offered.items.begin() + offered.begin[i + 1];
        std::sort(first, last);
        std::unique_copy(first, last, std::back_inserter(graph.items));
        graph.begin.push_back(static_cast<Index>(graph.items.size()));
    }
    return graph;
}

std::vector<double> side_weights(const NodeGraph& graph, std::span<const Quad> quads,
                                 std::span<const Vec3> nodes)
{
    std::vector<double> weights(graph.items.size(), 0.0);
    const auto add = [&](Index from, Index to, double weight) {
        const std::span<const Index> around = graph.of(static_cast<std::size_t>(from));
        const auto place = std::lower_bound(around.begin(), around.end(), to) - around.begin();
        weights[static_cast<std::size_t>(graph.begin[static_cast<std::size_t>(from)] + place)] += weight;
    };
    const auto at = [&](Index node) -> const Vec3& { return nodes[static_cast<std::size_t>(node)]; };
    for (const Quad& q : quads) {
        const Vec3 middle = mesh::is_triangle(q) ? Vec3((at(q[0]) + at(q[1]) + at(q[2])) / 3)
                                                 : Vec3((at(q[0]) + at(q[1]) + at(q[2]) + at(q[3])) / 4);
        for (std::size_t i = 0; i < 4; ++i) {
            if (!mesh::is_side(q, i)) continue;
            const Index from = q[i];
            const Index to = q[(i + 1) % 4];
            const double across = (middle - (at(from) + at(to)) / 2).norm();
            const double length = (at(to) - at(from)).norm();
            // A quad without width or a side without length says nothing of the other.
            const double weight = across > 0 && length > 0 ? across / length : 0.5;
            add(from, to, weight);
            add(to, from, weight);
        }
    }
    return weights;
}

HarmonicSpread::HarmonicSpread(const NodeGraph& graph, std::span<const double> weights,
                               std::span<const Index> fixed, const RunContext& context)
    : fixed_count_(fixed.size())
{
    const std::size_t nodes = graph.size();
    const std::vector<char> joined = joined_to(graph, fixed);
    std::vector<Index> position(nodes, -1); // of fixed nodes in `fixed`
    for (std::size_t k = 0; k < fixed.size(); ++k)
        position[static_cast<std::size_t>(fixed[k])] = static_cast<Index>(k);

    place_.assign(nodes, -1);
    int unknowns = 0;
    for (std::size_t i = 0; i < nodes; ++i) {
        if (joined[i] != 0 && position[i] < 0) place_[i] = unknowns++;
    }
    if (unknowns == 0) return;

    Eigen::SparseMatrix<double> laplacian(unknowns, unknowns);
    laplacian.reserve(Eigen::VectorXi::Constant(unknowns, 5));
    for (std::size_t i = 0; i < nodes; ++i) {
        if (place_[i] < 0) continue;
        double sum = 0;
        for (Index k = graph.begin[i]; k < graph.begin[i + 1]; ++k)
            sum += weights[static_cast<std::size_t>(k)];
        laplacian.insert(place_[i], place_[i]) = sum;
        for (Index k = graph.begin[i]; k < graph.begin[i + 1]; ++k) {
            const auto next = static_cast<std::size_t>(graph.items[static_cast<std::size_t>(k)]);
            const double weight = weights[static_cast<std::size_t>(k)];
            if (place_[next] > place_[i]) laplacian.insert(place_[next], place_[i]) = -weight;
            if (place_[next] < 0) rim_sides_.push_back({place_[i], position[next], weight});
        }
    }
    laplacian.makeCompressed();

    const geometry::SparseFactor factor(laplacian, context);
    if (!factor.good()) {
        throw NotSweepable("sweep.laplacian",
                           "the source mesh's Laplacian could not be factored: check the source "
                           "quads for nodes used twice in one quad");
    }
    lower_ = factor.lower();
    diagonal_ = factor.diagonal();
    const auto& order = factor.order().indices();
    for (Index& place : place_) {
        if (place >= 0) place = order[place];
    }
    for (RimSide& side : rim_sides_) side.row = order[side.row];
}

namespace {

/// Both triangles and the diagonal over a block of 4 · kFours right-hand sides, row-major in the factor's
/// order. No number depends on how many there are.
template <int kFours>
LACUNA_INLINE void substitute_rows(const Eigen::SparseMatrix<double>& lower, const double* diagonal,
                                   double* block)
{
    const int* begin = lower.outerIndexPtr();
    const int* inner = lower.innerIndexPtr();
    const double* value = lower.valuePtr();
    const auto unknowns = static_cast<int>(lower.cols());
    const auto row = [&](int i) { return reinterpret_cast<Four*>(block) + std::ptrdiff_t{kFours} * i; };
    for (int j = 0; j < unknowns; ++j) {
        Four known[kFours];
        for (int k = 0; k < kFours; ++k) known[k] = row(j)[k];
        for (int p = begin[j]; p < begin[j + 1]; ++p) {
            Four* below = row(inner[p]);
            for (int k = 0; k < kFours; ++k) below[k] -= value[p] * known[k];
        }
    }
    for (int j = unknowns - 1; j >= 0; --j) {
        Four sum[kFours];
        for (int k = 0; k < kFours; ++k) sum[k] = row(j)[k] / diagonal[j];
        for (int p = begin[j]; p < begin[j + 1]; ++p) {
            const Four* known = row(inner[p]);
            for (int k = 0; k < kFours; ++k) sum[k] -= value[p] * known[k];
        }
        for (int k = 0; k < kFours; ++k) row(j)[k] = sum[k];
    }
}

#if defined(LACUNA_WIDER_VECTORS)
template <int kFours>
[[gnu::target("avx2")]] void substitute_avx2(const Eigen::SparseMatrix<double>& lower, const double* diagonal,
                                             double* block)
{
    substitute_rows<kFours>(lower, diagonal, block);
}
#endif

/// With the widest vectors the machine has; the same bits on every machine.
template <int kFours>
void substitute(const Eigen::SparseMatrix<double>& lower, const Eigen::VectorXd& diagonal,
                std::vector<double>& block)
{
#if defined(LACUNA_WIDER_VECTORS)
    if (has_avx2()) return substitute_avx2<kFours>(lower, diagonal.data(), block.data());
#endif
    substitute_rows<kFours>(lower, diagonal.data(), block.data());
}

} // namespace

void HarmonicSpread::add(std::span<const Vec3> values, std::size_t fields, Vec3* out, std::size_t stride,
                         const RunContext& context) const
{
    const auto unknowns = static_cast<std::size_t>(lower_.cols());
    if (unknowns == 0) return;
    constexpr std::size_t fields_at_once = kFields;
    constexpr std::size_t width = 3 * fields_at_once;
    static_assert(width % 4 == 0);
    const std::size_t blocks = (fields + fields_at_once - 1) / fields_at_once;
    parallel_for(context, blocks, 1, [&](std::size_t first_block, std::size_t last_block) {
        std::vector<double> block;
        for (std::size_t b = first_block; b < last_block; ++b) {
            const std::size_t first = b * fields_at_once;
            const std::size_t count = std::min(fields_at_once, fields - first);
            block.assign(unknowns * width, 0.0);
            for (const RimSide& side : rim_sides_) {
                double* row = block.data() + static_cast<std::size_t>(side.row) * width;
                for (std::size_t f = 0; f < count; ++f) {
                    const Vec3& value =
                        values[(first + f) * fixed_count_ + static_cast<std::size_t>(side.fixed)];
                    for (int k = 0; k < 3; ++k)
                        row[3 * f + static_cast<std::size_t>(k)] += side.weight * value[k];
                }
            }
            substitute<static_cast<int>(width / 4)>(lower_, diagonal_, block);
            for (std::size_t i = 0; i < place_.size(); ++i) {
                if (place_[i] < 0) continue;
                const double* row = block.data() + static_cast<std::size_t>(place_[i]) * width;
                for (std::size_t f = 0; f < count; ++f)
                    out[(first + f) * stride + i] += Eigen::Map<const Vec3>(row + 3 * f);
            }
        }
    });
}

void HarmonicSpread::solve(std::span<Vec3> load) const
{
    constexpr Index width = 4; // the last stays 0
    std::vector<double> block(static_cast<std::size_t>(lower_.cols()) * width);
    for (std::size_t i = 0; i < place_.size(); ++i) {
        if (place_[i] < 0) continue;
        for (int k = 0; k < 3; ++k) block[static_cast<std::size_t>(width * place_[i] + k)] = load[i][k];
    }
    substitute<width / 4>(lower_, diagonal_, block);
    for (std::size_t i = 0; i < place_.size(); ++i) {
        const double* row = block.data() + static_cast<std::size_t>(width * std::max(place_[i], Index{0}));
        load[i] = place_[i] < 0 ? Vec3(Vec3::Zero()) : Vec3(row[0], row[1], row[2]);
    }
}

} // namespace lacuna::sweep
