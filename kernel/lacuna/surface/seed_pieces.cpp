// SPDX-License-Identifier: MIT
#include <lacuna/surface/detail/seed_pieces.h>

#include <algorithm>

namespace lacuna::surface {

using namespace topology;

double wanted_at(const SeedPiece& piece, double fraction)
{
    const auto steps = static_cast<double>(piece.wanted.size() - 1);
    const double at = std::clamp((fraction - piece.from) / (piece.to - piece.from), 0.0, 1.0) * steps;
    const auto step = std::min(static_cast<std::size_t>(at), piece.wanted.size() - 2);
    return piece.wanted[step] +
           (at - static_cast<double>(step)) * (piece.wanted[step + 1] - piece.wanted[step]);
}

int Seeds::count(EdgeId edge) const
{
    int sum = 0;
    for (const SeedPiece& piece : pieces.at(edge)) sum += piece.count;
    return sum;
}

std::vector<double> Seeds::fractions(EdgeId edge) const
{
    std::vector<double> result;
    for (const SeedPiece& piece : pieces.at(edge)) {
        const std::vector<double> more = piece.fractions();
        result.insert(result.end(), more.begin(), more.end());
    }
    result.push_back(1);
    return result;
}

std::vector<double> SeedPiece::fractions() const
{
    std::vector<double> result{from};
    if (fixed || !placed.empty()) {
        const std::vector<double>& inside = fixed ? kept : placed;
        result.insert(result.end(), inside.begin(), inside.end());
        return result;
    }
    result.insert(result.end(), low.begin(), low.end());
    const double first = result.back(), last = high.empty() ? to : high.front();
    const double before = wanted.empty() ? 0 : wanted_at(*this, first);
    const double apart = wanted.empty() ? 0 : wanted_at(*this, last) - before;
    std::size_t step = 0;
    for (int i = 1; i < between(); ++i) {
        const double share = static_cast<double>(i) / between();
        if (wanted.empty()) {
            result.push_back(first + (last - first) * share);
            continue;
        }
        const double at = before + share * apart;
        while (step + 2 < wanted.size() && wanted[step + 1] < at) ++step;
        const double along = (static_cast<double>(step) +
                              (at - wanted[step]) / (wanted[step + 1] - wanted[step])) /
                             static_cast<double>(wanted.size() - 1);
        result.push_back(from + (to - from) * along);
    }
    result.insert(result.end(), high.begin(), high.end());
    return result;
}

std::size_t Seeds::piece_of(const LinkingSurface& link, const RimSegment& segment) const
{
    const double middle = link.source.position((segment.source_from + segment.source_to) / 2).fraction;
    const std::vector<SeedPiece>& own = pieces.at(link.source.uses()[segment.use].edge);
    const auto piece = std::upper_bound(own.begin(), own.end(), middle,
                                        [](double at, const SeedPiece& p) { return at < p.to; });
    return static_cast<std::size_t>(piece - own.begin());
}

LinkingNodes Seeds::nodes(const LinkingSurface& link) const
{
    std::vector<std::vector<double>> source, target;
    for (const RimSegment& segment : link.segments) {
        const EdgeUse use = link.source.uses()[segment.use];
        const SeedPiece& piece = pieces.at(use.edge)[piece_of(link, segment)];
        source.push_back(piece.shares(use.reversed));
        target.push_back(piece.shares_above(use.reversed));
    }
    return linking_nodes(link, source, target);
}

namespace {

/// Relative positions on a piece, in the direction of an edge use.
std::vector<double> shares_of(const SeedPiece& piece, std::vector<double> fractions, bool reversed)
{
    for (double& f : fractions) f = (f - piece.from) / (piece.to - piece.from);
    if (!reversed) return fractions;
    std::vector<double> back{0};
    for (std::size_t i = fractions.size(); i-- > 1;) back.push_back(1 - fractions[i]);
    return back;
}

} // namespace

std::vector<double> SeedPiece::shares(bool reversed) const { return shares_of(*this, fractions(), reversed); }

std::vector<double> SeedPiece::shares_above(bool reversed) const
{
    if (fixed || placed_above.empty()) return shares(reversed);
    std::vector<double> own{from};
    own.insert(own.end(), placed_above.begin(), placed_above.end());
    return shares_of(*this, std::move(own), reversed);
}

} // namespace lacuna::surface
