// SPDX-License-Identifier: MIT
#include <lacuna/quality/shared/layered.h>

#include <lacuna/core/shared/bytes.h>
#include <lacuna/quality/detail/coincident.h>
#include <lacuna/quality/detail/findings.h>
#include <lacuna/quality/detail/worst_list.h>
#include <lacuna/quality/shared/metrics.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace lacuna::quality {
namespace {

using mesh::HexMesh;
using mesh::LayeredMesh;

/// The layers [first, last).
struct Slab {
    int first = 0, last = 0;
};

std::vector<Slab> slabs_of(const HexMesh& mesh)
{
    const int step = mesh::layers_at_once(mesh);
    std::vector<Slab> slabs;
    for (int first = 0; first < mesh.layers; first += step)
        slabs.push_back({first, std::min(first + step, mesh.layers)});
    return slabs;
}

/// Compute the slabs of this process one by one; for each, call `visit(slab, its cells as a mesh)`.
template <class Visit>
void each_slab(const LayeredMesh& layered, std::span<const Slab> slabs, const Team* team,
               const RunContext& context, const Visit& visit)
{
    HexMesh cells;
    const auto [begin, end] = share_of(team, slabs.size());
    for (const Slab& slab : slabs.subspan(begin, end - begin)) {
        check_cancelled(context);
        cells = mesh::make_layers(layered, slab.first, slab.last, std::move(cells), context);
        visit(slab, std::as_const(cells));
    }
}

/// Serialise the results of slabs for a team; the same list of fields serves writing and reading.
template <class A, class Own>
void put(A& with, Own& quality)
{
    with(quality.hexes), with(quality.wedges), with(quality.min_scaled_jacobian);
    with(quality.mean_scaled_jacobian), with(quality.inverted), with(quality.uncertified);
    with(quality.histogram), with(quality.volume), with(quality.worst), with(quality.least_by_kind);
}

/// An oriented box of a slab: its first axis points from the lowest level to the highest.
void lay_box(std::span<const Vec3> nodes, std::size_t row, SlabPlace& place)
{
    Vec3 way = Vec3::Zero();
    for (std::size_t i = 0; i < row; ++i) way += nodes[nodes.size() - row + i] - nodes[i];
    way = way.stableNormalized();
    if (way.isZero(0)) way = Vec3::UnitX();
    const Vec3 beside = way.unitOrthogonal();
    place.frame.row(0) = way.transpose();
    place.frame.row(1) = beside.transpose();
    place.frame.row(2) = way.cross(beside).transpose();
    for (const Vec3& p : nodes) place.box.extend(place.frame * p);
}

bool contains(const SlabPlace& slab, const Vec3& p) { return slab.box.contains(slab.frame * p); }

/// False if an axis of one of the boxes separates them.
bool may_meet(const SlabPlace& a, const SlabPlace& b)
{
    const auto apart = [](const SlabPlace& own, const SlabPlace& other) {
        Eigen::AlignedBox3d seen;
        for (int corner = 0; corner < 8; ++corner)
            seen.extend(own.frame * (other.frame.transpose() *
                                     other.box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner))));
        return !own.box.intersects(seen);
    };
    return !apart(a, b) && !apart(b, a);
}

/// Search for close points in slabs that are not neighbours.
class FarPairs {
public:
    FarPairs(const LayeredMesh& layered, const std::vector<Slab>& slabs, std::vector<SlabPlace> boxes,
             const Eigen::AlignedBox3d& bounds, double tolerance, const RunContext& context)
        : layered_(layered),
          slabs_(slabs),
          boxes_(std::move(boxes)),
          bounds_(bounds),
          grid_(bounds, tolerance),
          context_(context),
          beside_(slabs.size())
    {
        const Vec3 room = Vec3::Constant(tolerance);
        for (SlabPlace& own : boxes_) own.box = {own.box.min() - room, own.box.max() + room};
        for (std::size_t a = 0; a < slabs.size(); ++a)
            for (std::size_t b = a + 2; b < slabs.size(); ++b)
                if (may_meet(boxes_[a], boxes_[b])) {
                    beside_[a].push_back(b);
                    beside_[b].push_back(a);
                }
    }

    [[nodiscard]] std::optional<std::array<Index, 2>> first()
    {
        std::optional<std::array<Index, 2>> least;
        if (std::ranges::all_of(beside_, [](const auto& list) { return list.empty(); })) return least;
        std::size_t shares = 1; // parts of the cubes, processed one after the other
        for (std::size_t share = 0; share < shares; ++share) {
            if (!gather(share, shares)) {
                shares *= 2; // too many nodes: start again with smaller parts
                share = static_cast<std::size_t>(-1);
                continue;
            }
            std::vector<Vec3> places;
            for (const Entry& entry : entries_) places.push_back(entry.place);
            const auto pair = find_coincident(places, 0, grid_.tolerance, bounds_, context_);
            if (!pair) continue;
            const std::array<Index, 2> nodes{entries_[index((*pair)[0])].node,
                                             entries_[index((*pair)[1])].node};
            if (!least || nodes < *least) least = nodes;
        }
        return least;
    }

private:
    struct Entry {
        Index node;
        Vec3 place;
    };
    /// Limit on the entries held at once: 64 MB.
    static constexpr std::size_t kMost = std::size_t(1) << 21;

    /// Call `visit(node, point)` for the nodes of a slab that lie in the box of another slab.
    template <class Visit>
    void each_node(std::size_t slab, const Visit& visit)
    {
        if (beside_[slab].empty()) return;
        const std::size_t row = index(layered_.mesh.nodes_per_layer);
        const auto [first, last] = slabs_[slab];
        nodes_.resize(static_cast<std::size_t>(last - first + 1) * row);
        layered_.nodes.place(first, last + 1, nodes_, context_);
        for (std::size_t i = 0; i < nodes_.size(); ++i) {
            const bool beside = std::any_of(beside_[slab].begin(), beside_[slab].end(),
                                            [&](std::size_t b) { return contains(boxes_[b], nodes_[i]); });
            if (beside) visit(static_cast<Index>(static_cast<std::size_t>(first) * row + i), nodes_[i]);
        }
    }

    /// Collect the nodes, ascending, in one share of the grid's cubes. A node within a tolerance of a second
    /// cube counts in both. @return false if there are too many
    bool gather(std::size_t share, std::size_t shares)
    {
        entries_.clear();
        for (std::size_t slab = 0; slab < slabs_.size(); ++slab) {
            check_cancelled(context_);
            each_node(slab, [&](Index node, const Vec3& p) {
                if (entries_.size() <= kMost && is_in_share(p, share, shares)) entries_.push_back({node, p});
            });
            if (entries_.size() > kMost) return false;
        }
        // Nodes between two slabs were collected twice.
        std::ranges::stable_sort(entries_, {}, &Entry::node);
        const auto twice = std::ranges::unique(entries_, {}, &Entry::node);
        entries_.erase(twice.begin(), twice.end());
        return true;
    }

    [[nodiscard]] bool is_in_share(const Vec3& p, std::size_t share, std::size_t shares) const
    {
        bool found = false;
        grid_.visit(p, [&](std::uint32_t hash) { found = found || hash % shares == share; });
        return found;
    }

    const LayeredMesh& layered_;
    const std::vector<Slab>& slabs_;
    std::vector<SlabPlace> boxes_;
    Eigen::AlignedBox3d bounds_; ///< bounding box of all nodes
    CoincidenceGrid grid_;
    const RunContext& context_;
    std::vector<std::vector<std::size_t>> beside_; ///< non-neighbours whose boxes overlap
    std::vector<Vec3> nodes_;
    std::vector<Entry> entries_;
};

NodeName name_of_node(const LayeredMesh& layered, Index node, const RunContext& context)
{
    const Index row = layered.mesh.nodes_per_layer;
    std::vector<Vec3> nodes(index(row));
    layered.nodes.place(node / row, node / row + 1, nodes, context);
    return node_name(nodes[index(node % row)], node, row, static_cast<std::size_t>(layered.mesh.layers) + 1);
}

template <class A, class Own>
void put_place(A& with, Own& place)
{
    with(place.not_finite);
    for (auto* box : {&place.bounds, &place.box})
        for (auto* corner : {&box->min(), &box->max()}) with(*corner);
    for (int d = 0; d < 9; ++d) with(place.frame.data()[d]);
}

/// The extent of the nodes of a slab.
/// @param first  the lowest level of the slab
/// @param row    number of nodes per level
SlabPlace place_of(std::span<const Vec3> nodes, int first, std::size_t row, const RunContext& context)
{
    SlabPlace place;
    place.bounds = finite_bounds(nodes, context);
    if (place.bounds.isEmpty()) {
        place.not_finite = static_cast<Index>(static_cast<std::size_t>(first) * row) +
                           first_not_finite(nodes);
        return place;
    }
    lay_box(nodes, row, place);
    return place;
}

} // namespace

std::optional<Finding> find_misplaced(const LayeredMesh& layered, std::span<const SlabPlace> places,
                                      const RunContext& context, const Team* team)
{
    const HexMesh& mesh = layered.mesh;
    const std::size_t row = index(mesh.nodes_per_layer);
    const std::vector<Slab> slabs = slabs_of(mesh);
    const auto [begin, end] = share_of(team, slabs.size());
    Eigen::AlignedBox3d bounds;
    for (const SlabPlace& place : places) {
        if (place.not_finite >= 0) return not_finite(name_of_node(layered, place.not_finite, context));
        bounds.extend(place.bounds);
    }
    const double tolerance = coincidence_tolerance(bounds);
    std::optional<std::array<Index, 2>> least;
    const auto take = [&](const std::optional<std::array<Index, 2>>& pair) {
        if (pair && (!least || *pair < *least)) least = pair;
    };
    // Search each slab together with the next one. Pairs of nodes of this slab and the previous one were
    // found in the search of the previous slab.
    std::vector<Vec3> nodes;
    for (std::size_t s = begin; s < end && (s == 0 || s + 1 < slabs.size()); ++s) {
        check_cancelled(context);
        const int first = slabs[s].first, last = slabs[std::min(s + 1, slabs.size() - 1)].last;
        const auto count = [&](int levels) { return static_cast<std::size_t>(levels) * row; };
        if (!nodes.empty()) // this slab was loaded as the next of the previous one
            nodes.erase(nodes.begin(),
                        nodes.end() - static_cast<std::ptrdiff_t>(count(slabs[s].last - first + 1)));
        const std::size_t there = nodes.size();
        nodes.resize(count(last - first + 1));
        layered.nodes.place(first + static_cast<int>(there / row), last + 1, std::span(nodes).subspan(there),
                            context);
        if (auto pair = find_coincident(nodes, row, tolerance, bounds, context)) {
            const auto before = static_cast<Index>(static_cast<std::size_t>(first) * row);
            take(std::array<Index, 2>{(*pair)[0] + before, (*pair)[1] + before});
        }
    }
    // Bends at which distant slabs touch are rare, so one process searches all of them.
    if (begin == 0)
        take(FarPairs(layered, slabs, {places.begin(), places.end()}, bounds, tolerance, context).first());
    Writer own_pair;
    if (least) own_pair(*least);
    for (const auto& pair : gathered<std::array<Index, 2>>(team, std::move(own_pair))) take(pair);
    if (!least) return std::nullopt;
    return coincident_nodes(name_of_node(layered, (*least)[0], context),
                            name_of_node(layered, (*least)[1], context));
}

MeasuredLayers measure(const LayeredMesh& layered, const RunContext& context, const Team* team)
{
    const HexMesh& mesh = layered.mesh;
    MeasuredLayers measured;
    Quality& all = measured.quality;
    WorstList worst;
    double sum = 0;
    const std::vector<Slab> slabs = slabs_of(mesh);
    Writer own_found;
    each_slab(layered, slabs, team, context, [&](const Slab& slab, const HexMesh& cells) {
        Quality own = measure(cells, context);
        for (WorstCell& cell : own.worst) {
            cell.cell += static_cast<std::size_t>(slab.first) * mesh.quads.size();
            cell.layer += slab.first;
        }
        put(own_found, std::as_const(own));
        const SlabPlace place = place_of(cells.nodes, slab.first, index(mesh.nodes_per_layer), context);
        put_place(own_found, place);
    });
    // Sum in the order of the slabs, so that the result does not depend on which process measured them.
    const auto add_slab = [&](Reader& reader) {
        Quality own;
        put(reader, own);
        put_place(reader, measured.slabs.emplace_back());
        all.hexes += own.hexes;
        all.wedges += own.wedges;
        for (std::size_t k = 0; k < own.least_by_kind.size(); ++k)
            all.least_by_kind[k] = std::min(all.least_by_kind[k], own.least_by_kind[k]);
        all.inverted += own.inverted;
        all.uncertified += own.uncertified;
        all.volume += own.volume;
        sum += own.mean_scaled_jacobian * static_cast<double>(own.cells());
        for (std::size_t b = 0; b < own.histogram.size(); ++b) all.histogram[b] += own.histogram[b];
        for (const WorstCell& cell : own.worst) worst.offer(cell, cell.cell % mesh.quads.size());
    };
    for (const std::string& bytes : gather(team, std::move(own_found).take()))
        for (Reader reader(bytes); !reader.is_empty();) add_slab(reader);
    if (all.cells() == 0) return measured;
    all.mean_scaled_jacobian = sum / static_cast<double>(all.cells());
    for (const auto& [cell, column] : worst.entries) all.worst.push_back(cell);
    all.min_scaled_jacobian = all.worst.front().scaled_jacobian;
    return measured;
}

double mean_volume(const LayeredMesh& layered, const RunContext& context, const Team* team)
{
    Writer own;
    each_slab(layered, slabs_of(layered.mesh), team, context, [&](const Slab&, const HexMesh& cells) {
        for (const double volume : layer_volumes(cells, context)) own(volume);
    });
    return mean_volume(gathered<double>(team, std::move(own)), layered.mesh.cell_count());
}

Proof prove(const LayeredMesh& layered, Quality measured, std::optional<Finding> misplaced,
            double min_scaled_jacobian)
{
    Proof proof;
    proof.finding = check_arrays(layered.mesh, index(layered.mesh.nodes_per_layer));
    if (proof.finding) return proof;
    proof.quality = std::move(measured);
    proof.finding = check_quality(proof.quality, min_scaled_jacobian, layered.mesh.layers);
    if (!proof.finding) proof.finding = std::move(misplaced);
    return proof;
}

} // namespace lacuna::quality
