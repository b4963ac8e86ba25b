// SPDX-License-Identifier: MIT
#include <lacuna/surface/shared/given_nodes.h>

#include <lacuna/core/message.h>
#include <lacuna/surface/detail/chain_nodes.h>
#include <lacuna/surface/detail/paired_breaks.h>
#include <lacuna/topology/shared/give_mesh.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace lacuna::surface {

using namespace topology;

namespace {

/// Maximum number of pairs of nodes that are compared to match two rims with different numbers of nodes. This
/// many pairs take 32 MB and 0.1 s.
constexpr std::size_t kMostPairs = 4'000'000;

/// A break between segments: corresponding positions on both rims.
struct Break {
    /// Running lengths on both chains. The target's may exceed the length of its chain.
    double source = 0, target = 0;
    bool given = false; ///< whether the part of the rim to the next break is one side of a given quad
};

/// Divides the segments of one linking surface at given nodes.
class BreakKeeper {
public:
    BreakKeeper(const OpenVolume& volume, const std::set<EdgeId>& kept, const GivenColumns& columns,
                LinkingSurface& link, bool wedges)
        : model_(volume.model), kept_(kept), columns_(columns), link_(link)
    {
        for (std::size_t f = 0; f < model_.faces.size(); ++f) {
            const Face& face = model_.faces[f];
            const bool end = volume.role[f] != Role::wall;
            if (!face.keeps_nodes || !has_cells_to_keep(face, wedges && end)) continue;
            for (const EdgeUse& use : uses_of(face)) of_quads_.insert(use.edge);
        }
        const auto is_kept = [&](EdgeId edge) { return kept_.contains(edge); };
        source_ = chain_nodes(model_, link.source, is_kept);
        target_ = chain_nodes(model_, link.target, is_kept);
    }

    void run(std::vector<std::string>& notes)
    {
        if (source_.empty() && target_.empty()) return;
        const double s_end = link_.source.length(), t_end = link_.target.length();
        std::vector<Break> breaks;
        for (const RimSegment& segment : link_.segments)
            breaks.push_back({segment.source_from, segment.target_from, false});
        if (link_.lines.empty()) align_start(breaks);
        breaks.push_back({s_end, breaks.front().target + t_end, false});
        breaks = with_columns(breaks);
        for (std::size_t i = breaks.size() - 1; i-- > 1;) {
            if (is_in_stub(breaks[i])) breaks.erase(breaks.begin() + static_cast<std::ptrdiff_t>(i));
        }
        breaks = with_pairs_between_lines(breaks);
        std::vector<Break> result;
        for (std::size_t i = 0; i + 1 < breaks.size(); ++i) add_between(breaks[i], breaks[i + 1], result);
        link_.segments.clear();
        result.push_back(breaks.back());
        for (std::size_t i = 0; i + 1 < result.size(); ++i) {
            RimSegment segment{
                result[i].source, result[i + 1].source, result[i].target, result[i + 1].target, 0,
                result[i].given};
            segment.use = link_.source.position((segment.source_from + segment.source_to) / 2).use;
            link_.segments.push_back(segment);
        }
        if (lost_ > 0) {
            notes.push_back(formatted("{} given nodes of the target's rim, starting at {}, are not kept: the "
                                      "source's rim has a different number of nodes",
                                      lost_, entity_of(model_, lost_edge_)));
        }
    }

private:
    /// On a ring without side lines, move all breaks along the target so that the ring's start corresponds to
    /// a given node of the target.
    void align_start(std::vector<Break>& breaks) const
    {
        const double length = link_.target.length();
        const double start = breaks.front().target;
        double move = 0;
        if (columns_.rows > 0) {
            move = start_between_columns() - start;
        } else if (std::ranges::all_of(link_.target.uses(),
                                       [&](const EdgeUse& use) { return kept_.contains(use.edge); })) {
            double least = length;
            for (const ChainNode& node : target_) {
                const double off = std::remainder(node.at - start, length);
                if (std::abs(off) < least) {
                    least = std::abs(off);
                    move = off;
                }
            }
        }
        for (Break& b : breaks) b.target += move;
        const double turns = std::floor(breaks.front().target / length + kSamePlace);
        for (Break& b : breaks) b.target -= turns * length;
    }

    /// Position on the target that corresponds to the start of the ring. If both rims have the same number of
    /// nodes between the two columns next to the start, it is found by counting nodes. Otherwise it is
    /// interpolated between these columns.
    [[nodiscard]] double start_between_columns() const
    {
        const double s_length = link_.source.length(), t_length = link_.target.length();
        const GivenColumn &first = columns_.whole.front(), &last = columns_.whole.back();
        const Break after{first.source_at, first.target_at, false};
        if (after.source <= kSamePlace * s_length) return after.target;
        Break before{last.source_at - s_length, last.target_at, false};
        while (before.target > after.target - kSamePlace * t_length) before.target -= t_length;
        const std::vector<double> s = inside(source_, link_.source, before.source + s_length,
                                             after.source + s_length);
        const std::vector<double> t = inside(target_, link_.target, before.target + t_length,
                                             after.target + t_length);
        const auto at = std::ranges::find_if(
            s, [&](double x) { return std::abs(x - s_length) <= kSamePlace * s_length; });
        if (s.size() == t.size() && at != s.end())
            return t[static_cast<std::size_t>(at - s.begin())] - t_length;
        const double share = -before.source / (after.source - before.source);
        return before.target + share * (after.target - before.target);
    }

    /// A running length of the target chain, increased by whole turns until it is at least `from`.
    [[nodiscard]] double past(double at, double from) const
    {
        const double length = link_.target.length();
        while (at < from - kSamePlace * length) at += length;
        return at;
    }

    /// Add a break at every column. Between columns with given quads from rim to rim, all other breaks are
    /// removed.
    [[nodiscard]] std::vector<Break> with_columns(const std::vector<Break>& breaks) const
    {
        if (columns_.rows == 0) return breaks;
        const double slack = kSamePlace * link_.source.length();
        std::vector<Break> merged;
        std::size_t next = 0;
        double target = breaks.front().target;
        const std::vector<GivenColumn>& columns = columns_.whole;
        for (std::size_t c = 0; c <= columns.size(); ++c) {
            const double limit = c < columns.size() ? columns[c].source_at : link_.source.length();
            const bool inside = c > 0 && !columns[c - 1].faces.empty();
            for (; next < breaks.size() && breaks[next].source < limit - slack; ++next) {
                if (!inside && (merged.empty() || breaks[next].source > merged.back().source + slack))
                    merged.push_back(breaks[next]);
            }
            while (next < breaks.size() && breaks[next].source <= limit + slack) ++next;
            if (c == columns.size()) break;
            target = past(columns[c].target_at, merged.empty() ? target : merged.back().target);
            merged.push_back({columns[c].source_at, target, !columns[c].faces.empty()});
        }
        merged.push_back(breaks.back());
        return merged;
    }

    /// Whether a break lies inside a side of a stub's quad.
    [[nodiscard]] bool is_in_stub(const Break& at) const
    {
        for (std::size_t i = 0; i < columns_.stubs.size(); ++i) {
            const GivenStub& stub = columns_.stubs[i];
            if (stub.faces.empty()) continue;
            // The side runs from this stub to the next stub on the same rim.
            std::size_t next = (i + 1) % columns_.stubs.size();
            while (columns_.stubs[next].from_target != stub.from_target)
                next = (next + 1) % columns_.stubs.size();
            const double length = stub.from_target ? link_.target.length() : link_.source.length();
            const double slack = kSamePlace * length, place = stub.from_target ? at.target : at.source;
            const auto along = [&](double to) {
                const double way = std::fmod(to - stub.at, length);
                return way < -slack ? way + length : way;
            };
            const double end = along(columns_.stubs[next].at), here = along(place);
            if (here > slack && here < (end < slack ? length : end) - slack) return true;
        }
        return false;
    }

    /// Pair the given nodes of both ends in order between two side lines, or around the ring, if both ends
    /// have the same number of them.
    [[nodiscard]] std::vector<Break> with_pairs_between_lines(const std::vector<Break>& breaks) const
    {
        std::vector<double> hard;
        for (const LinkingLine& line : link_.lines) hard.push_back(line.source_at);
        if (hard.empty()) hard.push_back(breaks.front().source);
        hard.push_back(link_.source.length());
        const double slack = kSamePlace * link_.source.length();
        std::vector<Break> result;
        std::size_t i = 0;
        for (std::size_t h = 0; h + 1 < hard.size(); ++h) {
            std::vector<Break> between;
            for (; i < breaks.size() && breaks[i].source < hard[h + 1] - slack; ++i)
                between.push_back(breaks[i]);
            if (between.empty() || i >= breaks.size()) return breaks;
            const bool has_columns = std::ranges::any_of(between, [](const Break& b) { return b.given; });
            std::vector<Break> paired;
            if (!has_columns) paired = pairs(between.front(), breaks[i]);
            const std::vector<Break>& use = paired.empty() ? between : paired;
            result.insert(result.end(), use.begin(), use.end());
        }
        result.push_back(breaks.back());
        return result;
    }

    /// Pairs of the nodes of both ends in [from, to), in order. Empty if the two numbers of nodes differ, or
    /// if not all edges are kept.
    [[nodiscard]] std::vector<Break> pairs(const Break& from, const Break& to) const
    {
        if (!covered(link_.source, from.source, to.source) || !covered(link_.target, from.target, to.target))
            return {};
        const std::vector<double> s = inside(source_, link_.source, from.source, to.source);
        const std::vector<double> t = inside(target_, link_.target, from.target, to.target);
        if (s.size() != t.size()) return {};
        std::vector<Break> result{{from.source, from.target, true}};
        for (std::size_t i = 0; i < s.size(); ++i) result.push_back({s[i], t[i], true});
        return result;
    }

    /// Whether all edges of a chain between two running lengths are kept.
    [[nodiscard]] bool covered(const Chain& chain, double from, double to) const
    {
        return !meets(chain, from, to, [&](EdgeId edge) { return !kept_.contains(edge); });
    }

    /// Whether a chain has, between two running lengths, an edge for which `wanted` holds.
    template <class Wanted>
    [[nodiscard]] static bool meets(const Chain& chain, double from, double to, const Wanted& wanted)
    {
        const double length = chain.length(), slack = kSamePlace * length;
        for (std::size_t u = 0; u < chain.uses().size(); ++u) {
            if (!wanted(chain.uses()[u].edge)) continue;
            for (int turn = 0; turn < 2; ++turn) {
                if (chain.start(u) + turn * length < to - slack &&
                    chain.start(u + 1) + turn * length > from + slack)
                    return true;
            }
        }
        return false;
    }

    /// Running lengths of the given nodes strictly between two positions.
    static std::vector<double> inside(const std::vector<ChainNode>& nodes, const Chain& chain, double from,
                                      double to)
    {
        const double length = chain.length(), slack = kSamePlace * length;
        std::vector<double> result;
        for (int turn = 0; turn < 2; ++turn) {
            for (const ChainNode& node : nodes) {
                const double at = node.at + turn * length;
                if (at > from + slack && at < to - slack) result.push_back(at);
            }
        }
        return result;
    }

    void add_between(const Break& from, const Break& to, std::vector<Break>& result)
    {
        if (from.given) {
            result.push_back(from);
            return;
        }
        std::vector<Break> both = pairs(from, to);
        if (!both.empty()) {
            result.insert(result.end(), both.begin(), both.end());
            return;
        }
        const bool source_kept = covered(link_.source, from.source, to.source);
        const bool target_kept = covered(link_.target, from.target, to.target);
        result.push_back({from.source, from.target, source_kept || target_kept});
        std::vector<double> s = inside(source_, link_.source, from.source, to.source);
        std::vector<double> t = inside(target_, link_.target, from.target, to.target);
        if (!source_kept) s.clear();
        if (!target_kept) t.clear();
        if (s.empty() && t.empty()) return;
        // Nodes can be added to rims of kept triangles, but not to rims of kept quads.
        std::vector<double>* left_out = nullptr;
        const auto of_quads = [&](EdgeId edge) { return of_quads_.contains(edge); };
        if (source_kept && meets(link_.source, from.source, to.source, of_quads)) left_out = &t;
        if (left_out == nullptr && target_kept && meets(link_.target, from.target, to.target, of_quads))
            left_out = &s;
        if (left_out == nullptr && s.size() * t.size() > kMostPairs) left_out = &t;
        if (left_out != nullptr && !left_out->empty()) {
            const bool target = left_out == &t;
            if (lost_ == 0)
                lost_edge_ = edge_at(target ? link_.target : link_.source,
                                     target ? from.target : from.source);
            lost_ += left_out->size();
            left_out->clear();
        }
        for (double& x : s) x = (x - from.source) / (to.source - from.source);
        for (double& x : t) x = (x - from.target) / (to.target - from.target);
        BreakPairs shares = paired_breaks(s, t);
        complete(shares);
        for (const auto& [a, b] : shares) {
            result.push_back({from.source + a * (to.source - from.source),
                              from.target + b * (to.target - from.target), true});
        }
    }

    static EdgeId edge_at(const Chain& chain, double at)
    {
        return chain.uses()[chain.position(chain.wrapped(at) + kSamePlace * chain.length()).use].edge;
    }

    const Model& model_;
    const std::set<EdgeId>& kept_;
    std::set<EdgeId> of_quads_; ///< edges of faces whose quads are kept
    const GivenColumns& columns_;
    LinkingSurface& link_;
    std::vector<ChainNode> source_, target_; ///< given nodes of either chain
    std::size_t lost_ = 0;
    EdgeId lost_edge_;
};

} // namespace

KeptNodes keep_given_nodes(const OpenVolume& volume, std::span<const GivenColumns> columns,
                           std::vector<LinkingSurface> links, bool wedges)
{
    KeptNodes result{std::move(links)};
    const std::set<EdgeId> kept = kept_edges(volume.model);
    if (kept.empty()) return result;
    for (std::size_t b = 0; b < result.links.size(); ++b)
        BreakKeeper(volume, kept, columns[b], result.links[b], wedges).run(result.notes);
    return result;
}

} // namespace lacuna::surface
