// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/harmonic_spread.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/parallel.h>
#include <lacuna/core/shared/vector_code.h>
#include <lacuna/geometry/shared/sparse_factor.h>
#include <lacuna/geometry/shared/union_find.h>
#include <lacuna/mesh/quad_mesh.h>

#include <algorithm>
#include <vector>

namespace lacuna::sweep {

NodeGraph node_graph(std::span<const Quad> quads, std::size_t nodes)
{
    // List each end of every side as a neighbour of the other end. A side between two quads is listed twice;
    // duplicates are removed below.
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
        const std::span<const Index> around = graph.of(index(from));
        const auto place = std::ranges::lower_bound(around, to) - around.begin();
        weights[index(graph.begin[index(from)]) + static_cast<std::size_t>(place)] += weight;
    };
    const auto at = [&](Index node) -> const Vec3& { return nodes[index(node)]; };
    for (const Quad& q : quads) {
        const Vec3 middle = mesh::is_triangle(q) ? Vec3((at(q[0]) + at(q[1]) + at(q[2])) / 3)
                                                 : Vec3((at(q[0]) + at(q[1]) + at(q[2]) + at(q[3])) / 4);
        for (std::size_t i = 0; i < 4; ++i) {
            if (!mesh::is_side(q, i)) continue;
            const Index from = q[i];
            const Index to = q[(i + 1) % 4];
            const double across = (middle - (at(from) + at(to)) / 2).norm();
            const double length = (at(to) - at(from)).norm();
            // This ratio is undefined for a quad of zero width or a side of zero length.
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
    geometry::UnionFind parts(nodes);
    for (std::size_t i = 0; i < nodes; ++i) {
        for (const Index next : graph.of(i)) parts.unite(index(next), i);
    }
    std::vector<Index> position(nodes, -1); // for each fixed node, its index in `fixed`
    std::vector<char> has_fixed(nodes, 0);  // for each component, by its root node
    for (std::size_t k = 0; k < fixed.size(); ++k) {
        position[index(fixed[k])] = static_cast<Index>(k);
        has_fixed[parts.find(fixed[k])] = 1;
    }

    place_.assign(nodes, -1);
    int unknowns = 0;
    for (std::size_t i = 0; i < nodes; ++i) {
        if (has_fixed[parts.find(i)] != 0 && position[i] < 0) place_[i] = unknowns++;
    }
    if (unknowns == 0) return;

    Eigen::SparseMatrix<double> laplacian(unknowns, unknowns);
    laplacian.reserve(Eigen::VectorXi::Constant(unknowns, 5));
    for (std::size_t i = 0; i < nodes; ++i) {
        if (place_[i] < 0) continue;
        double sum = 0;
        for (Index k = graph.begin[i]; k < graph.begin[i + 1]; ++k) sum += weights[index(k)];
        laplacian.insert(place_[i], place_[i]) = sum;
        for (Index k = graph.begin[i]; k < graph.begin[i + 1]; ++k) {
            const auto next = index(graph.items[index(k)]);
            const double weight = weights[index(k)];
            if (place_[next] > place_[i]) laplacian.insert(place_[next], place_[i]) = -weight;
            if (place_[next] < 0) rim_sides_.push_back({place_[i], position[next], weight});
        }
    }
    laplacian.makeCompressed();

    const geometry::SparseFactor factor(laplacian, context);
    if (!factor.good()) {
        throw NotSweepable(Message("sweep.laplacian", "the source mesh's Laplacian could not be factored")
                               .remedy("check the source quads for nodes used twice in one quad"));
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

/// Solve for a block of right-hand sides: forward substitution, division by the diagonal and backward
/// substitution. The rows of the block are in the factor's order, and each row has kPacks packs of numbers.
/// The result for one number does not depend on the size of the block.
template <int kPacks>
LACUNA_INLINE void substitute_rows(const Eigen::SparseMatrix<double>& lower, const double* diagonal,
                                   double* block)
{
    const int* begin = lower.outerIndexPtr();
    const int* inner = lower.innerIndexPtr();
    const double* value = lower.valuePtr();
    const auto unknowns = static_cast<int>(lower.cols());
    const auto row = [&](int i) { return reinterpret_cast<Four*>(block) + std::ptrdiff_t{kPacks} * i; };
    for (int j = 0; j < unknowns; ++j) {
        Four known[kPacks];
        for (int k = 0; k < kPacks; ++k) known[k] = row(j)[k];
        int p = begin[j];
        const int end = begin[j + 1];
        // Often a column of the factor has the entries of the next column plus one more. Both columns are
        // then applied in one pass through memory. The order of subtractions is unchanged, and so is the
        // rounding.
        if (p < end && inner[p] == j + 1 && end - p - 1 == begin[j + 2] - end) {
            Four next[kPacks];
            for (int k = 0; k < kPacks; ++k) row(j + 1)[k] = next[k] = row(j + 1)[k] - value[p] * known[k];
            for (++p; p < end; ++p) {
                const double low = value[p], high = value[p + (end - begin[j]) - 1];
                Four* below = row(inner[p]);
                for (int k = 0; k < kPacks; ++k) below[k] = below[k] - low * known[k] - high * next[k];
            }
            ++j;
            continue;
        }
        for (; p < end; ++p) {
            const double entry = value[p];
            Four* below = row(inner[p]);
            for (int k = 0; k < kPacks; ++k) below[k] -= entry * known[k];
        }
    }
    for (int j = unknowns - 1; j >= 0; --j) {
        Four sum[kPacks];
        for (int k = 0; k < kPacks; ++k) sum[k] = row(j)[k] / diagonal[j];
        for (int p = begin[j]; p < begin[j + 1]; ++p) {
            const Four* known = row(inner[p]);
            for (int k = 0; k < kPacks; ++k) sum[k] -= value[p] * known[k];
        }
        for (int k = 0; k < kPacks; ++k) row(j)[k] = sum[k];
    }
}

/// Solve rows of `kNumbers` numbers with the widest vectors of the machine. The result is bit-identical on
/// every machine.
template <int kNumbers>
void substitute(const Eigen::SparseMatrix<double>& lower, const Eigen::VectorXd& diagonal,
                std::vector<double>& block)
{
    static_assert(kNumbers % 4 == 0);
    with_avx2(
        [&]() LACUNA_INLINE_BODY { substitute_rows<kNumbers / 4>(lower, diagonal.data(), block.data()); });
}

} // namespace

HarmonicSpread::Fields HarmonicSpread::spread(std::span<const Vec3> values) const
{
    constexpr std::size_t width = 3 * kFields;
    Fields fields;
    fields.place_ = place_;
    fields.rows_.assign(static_cast<std::size_t>(lower_.cols()) * width + 1, 0.0);
    for (const RimSide& side : rim_sides_) {
        double* row = &fields.rows_[static_cast<std::size_t>(side.row) * width];
        for (std::size_t at = index(side.fixed); at < values.size(); at += fixed_count_, row += 3)
            for (int k = 0; k < 3; ++k) row[k] += side.weight * values[at][k];
    }
    substitute<static_cast<int>(width)>(lower_, diagonal_, fields.rows_);
    return fields;
}

void HarmonicSpread::add(std::span<const Vec3> values, std::size_t fields, Vec3* out, std::size_t stride,
                         const RunContext& context) const
{
    constexpr std::size_t at_once = kFields;
    parallel_for(context, (fields + at_once - 1) / at_once, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t first = begin * at_once; first < std::min(end * at_once, fields); first += at_once) {
            const std::size_t count = std::min(at_once, fields - first);
            const Fields spread_fields = spread(values.subspan(first * fixed_count_, count * fixed_count_));
            for (std::size_t i = 0; i < place_.size(); ++i) {
                const double* row = spread_fields.of(i);
                for (std::size_t f = 0; row != nullptr && f < count; ++f)
                    out[(first + f) * stride + i] += Eigen::Map<const Vec3>(row + 3 * f);
            }
        }
    });
}

void HarmonicSpread::solve(std::span<Vec3> load) const
{
    constexpr Index width = 4; // three coordinates; the last number stays 0
    std::vector<double> block(static_cast<std::size_t>(lower_.cols()) * width);
    for (std::size_t i = 0; i < place_.size(); ++i) {
        if (place_[i] >= 0) Vec3::Map(&block[index(width * place_[i])]) = load[i];
    }
    substitute<width>(lower_, diagonal_, block);
    for (std::size_t i = 0; i < place_.size(); ++i) {
        load[i].setZero();
        if (place_[i] >= 0) load[i] = Vec3::Map(&block[index(width * place_[i])]);
    }
}

} // namespace lacuna::sweep
