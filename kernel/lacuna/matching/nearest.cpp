// SPDX-License-Identifier: MIT
//
// The vertices of an end are numbered consecutively, loop by loop in traversal order. `Ends` holds the loop
// and the position of each vertex.
#include <lacuna/matching/detail/nearest.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/constants.h>
#include <lacuna/topology/shared/names_of.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>

namespace lacuna::matching {

using namespace topology;

namespace {

/// Step 7: a distance is an outlier if it differs from the mean by more than kDeviations standard deviations.
/// At least the share kShare of all distances must not be outliers. Both values are the paper's.
constexpr double kDeviations = 2;
constexpr double kShare = 0.5;

/// The vertices of one end.
struct Ends {
    std::vector<VertexId> vertex;
    std::vector<Vec3> at;
    std::vector<std::size_t> loop;  ///< by vertex: its loop
    std::vector<std::size_t> first; ///< index of each loop's first vertex, then the number of vertices
    std::vector<Vec3> area;         ///< area vector of each loop

    [[nodiscard]] std::size_t count(std::size_t l) const { return first[l + 1] - first[l]; }
};

/// Step 3: positions of the vertices of each loop.
Ends ends_of(const Model& model, const std::vector<LoopShape>& loops)
{
    Ends ends;
    for (std::size_t l = 0; l < loops.size(); ++l) {
        ends.first.push_back(ends.vertex.size());
        for (const VertexId v : loops[l].vertices) {
            ends.vertex.push_back(v);
            ends.at.push_back(model.at(model[v].point));
            ends.loop.push_back(l);
        }
        ends.area.push_back(loops[l].area);
    }
    ends.first.push_back(ends.vertex.size());
    return ends;
}

class Nearest {
public:
    Nearest(const Problem& problem, Match match)
        : problem_(problem),
          model_(problem.volume.model),
          source_(ends_of(model_, problem.source)),
          target_(ends_of(model_, problem.target)),
          partner_(source_.vertex.size(), kNoIndex),
          fixed_(source_.vertex.size(), kNoIndex),
          result_(std::move(match))
    {
        for (std::size_t s = 0; s < fixed_.size(); ++s) {
            const auto known = problem.hard.find(source_.vertex[s]);
            if (known == problem.hard.end()) continue;
            const auto found = std::ranges::find(target_.vertex, known->second);
            if (found != target_.vertex.end())
                fixed_[s] = static_cast<std::size_t>(found - target_.vertex.begin());
        }
        for (std::size_t s = 0; s < fixed_.size(); ++s) {
            check_cancelled(problem.context);
            nearest_to_source_.push_back(
                nearest(source_.at[s], target_, [&](std::size_t t) { return may(s, t); }));
        }
    }

    Match run()
    {
        match_vertices();
        match_loops();
        validate();
        find_direction();
        for (std::size_t l = 0; l + 1 < source_.first.size(); ++l) align(l);
        result_.confidence = std::min(result_.confidence, clearness());
        return std::move(result_);
    }

private:
    /// An alignment of two loops: vertex i of the source is paired with vertex shift ± i of the target.
    struct Way {
        std::size_t shift = 0;
        bool backward = true;
        std::size_t agree = 0;       ///< number of vertices whose nearest partner is their partner in this
                                     ///< alignment
        double distance = kInfinity; ///< sum of the distances of its pairs
    };

    [[nodiscard]] double distance(std::size_t s, std::size_t t) const
    {
        return (source_.at[s] - target_.at[t]).norm();
    }

    /// Whether two vertices may be paired; fixed pairs exclude other partners.
    [[nodiscard]] bool may(std::size_t s, std::size_t t) const
    {
        if (fixed_[s] != kNoIndex) return fixed_[s] == t;
        const int loop = problem_.forced[source_.loop[s]];
        if (loop >= 0 && static_cast<std::size_t>(loop) != target_.loop[t]) return false;
        return std::ranges::find(fixed_, t) == fixed_.end();
    }

    template <class Allowed>
    static std::size_t nearest(const Vec3& from, const Ends& ends, const Allowed& allowed)
    {
        std::size_t best = kNoIndex;
        double least = kInfinity;
        for (std::size_t i = 0; i < ends.at.size(); ++i) {
            const double d = (ends.at[i] - from).norm();
            if (d >= least || !allowed(i)) continue;
            least = d;
            best = i;
        }
        return best;
    }

    /// Steps 4 and 5: find the nearest target vertex of each source vertex. If this map is not one-to-one,
    /// find the nearest source vertex of each target vertex that has several partners or none.
    void match_vertices()
    {
        std::vector<int> met(target_.vertex.size(), 0);
        for (const std::size_t t : nearest_to_source_) {
            if (t != kNoIndex) ++met[t];
        }
        if (std::ranges::all_of(met, [](int count) { return count == 1; })) {
            partner_ = nearest_to_source_;
            return;
        }
        std::vector<std::tuple<double, std::size_t, std::size_t>> pairs;
        for (std::size_t s = 0; s < partner_.size(); ++s) {
            const std::size_t t = nearest_to_source_[s];
            if (t != kNoIndex && met[t] == 1)
                pairs.emplace_back(fixed_[s] != kNoIndex ? -1 : distance(s, t), s, t);
        }
        for (std::size_t t = 0; t < met.size(); ++t) {
            if (met[t] == 1) continue;
            const std::size_t s = nearest(target_.at[t], source_, [&](std::size_t i) { return may(i, t); });
            if (s != kNoIndex) pairs.emplace_back(distance(s, t), s, t);
        }
        std::sort(pairs.begin(), pairs.end());
        std::vector<bool> taken(met.size(), false);
        for (const auto& [d, s, t] : pairs) {
            if (partner_[s] != kNoIndex || taken[t]) continue;
            partner_[s] = t;
            taken[t] = true;
        }
    }

    /// Step 6: pair each loop with the target loop on which most partners of its vertices lie.
    void match_loops()
    {
        const std::size_t n = problem_.source.size();
        loop_.assign(n, kNoIndex);
        std::vector<std::size_t> claimed(n, kNoIndex);
        for (std::size_t l = 0; l < n; ++l) {
            check_cancelled(problem_.context);
            std::vector<std::size_t> votes(n, 0);
            for (std::size_t s = source_.first[l]; s < source_.first[l + 1]; ++s) {
                if (partner_[s] != kNoIndex) ++votes[target_.loop[partner_[s]]];
            }
            const auto most = std::ranges::max_element(votes);
            if (problem_.forced[l] >= 0) {
                loop_[l] = static_cast<std::size_t>(problem_.forced[l]);
            } else {
                if (*most == 0) refuse_loop(l, "none of its vertices is the nearest to one of the target");
                if (std::count(votes.begin(), votes.end(), *most) > 1)
                    refuse_loop(l, "its vertices are equally close to several target loops");
                loop_[l] = static_cast<std::size_t>(most - votes.begin());
            }
            const std::size_t other = std::exchange(claimed[loop_[l]], l);
            if (other != kNoIndex) {
                throw NotClosed(
                    Message("matching.nearest_failed",
                            "method \"nearest\" cannot match {0}: both {0} and {1} are nearest to {2}",
                            source_loop(l), source_loop(other), target_loop(loop_[l]))
                        .remedy("pair the loops with match{{ loops = … }}"));
            }
            if (source_.count(l) != target_.count(loop_[l])) {
                // match() advises the other method where it has tried that method with success.
                throw NotClosed("matching.edge_counts",
                                "{} has {} edges and {} has {}, but method \"nearest\" needs equal numbers",
                                source_loop(l), found(source_.count(l)), target_loop(loop_[l]),
                                found(target_.count(loop_[l])));
            }
        }
    }

    /// Step 7: drop the pairs whose distance is far from the mean; align() pairs their vertices again.
    void validate()
    {
        for (std::size_t l = 0; l + 1 < source_.first.size(); ++l) {
            std::vector<std::size_t> matched;
            double sum = 0;
            for (std::size_t s = source_.first[l]; s < source_.first[l + 1]; ++s) {
                if (partner_[s] == kNoIndex) continue;
                if (target_.loop[partner_[s]] != loop_[l]) {
                    partner_[s] = kNoIndex;
                    continue;
                }
                matched.push_back(s);
                sum += distance(s, partner_[s]);
            }
            const double count = static_cast<double>(std::max<std::size_t>(matched.size(), 1));
            const double mean = sum / count;
            double squares = 0;
            for (const std::size_t s : matched) squares += std::pow(distance(s, partner_[s]) - mean, 2);
            // The tolerance covers distances that differ by rounding only.
            const double reach = kDeviations * std::sqrt(squares / count) + model_.tolerance;
            std::size_t within = 0;
            for (const std::size_t s : matched) {
                if (std::abs(distance(s, partner_[s]) - mean) <= reach)
                    ++within;
                else if (fixed_[s] == kNoIndex)
                    partner_[s] = kNoIndex;
            }
            if (static_cast<double>(within) < kShare * count)
                refuse_loop(l, "the distances of its vertices vary too much");
        }
    }

    [[nodiscard]] std::vector<Way> ways(std::size_t l, std::size_t m) const
    {
        const std::size_t n = source_.count(l);
        std::vector<Way> result;
        for (const bool backward : {true, false}) {
            for (std::size_t shift = 0; shift < n; ++shift) {
                check_cancelled(problem_.context);
                Way way{shift, backward, 0, 0};
                bool keeps = true;
                for (std::size_t i = 0; i < n; ++i) {
                    const std::size_t s = source_.first[l] + i;
                    const std::size_t t = target_.first[m] + partner_place(i, n, shift, backward);
                    keeps = keeps && (fixed_[s] == kNoIndex || fixed_[s] == t);
                    way.agree += partner_[s] == t ? 1 : 0;
                    way.distance += distance(s, t);
                }
                if (keeps) result.push_back(way);
            }
        }
        return result;
    }

    /// The alignment with which most vertices agree; of equals, the one with the least sum of distances.
    static Way best_of(const std::vector<Way>& list)
    {
        return *std::ranges::min_element(list, [](const Way& a, const Way& b) {
            return std::tie(b.agree, a.distance) < std::tie(a.agree, b.distance);
        });
    }

    /// Step 6: find the direction, which is the same for all loops. Loops of one or two vertices do not
    /// determine the direction. If no other loop determines it, the area vectors do.
    void find_direction()
    {
        std::size_t backward = 0, forward = 0;
        Vec3 low = Vec3::Zero(), high = Vec3::Zero();
        for (std::size_t l = 0; l < loop_.size(); ++l) {
            low += source_.area[l];
            high += target_.area[loop_[l]];
            std::size_t most[2] = {0, 0};
            for (const Way& way : ways(l, loop_[l]))
                most[way.backward ? 0 : 1] = std::max(most[way.backward ? 0 : 1], way.agree);
            if (source_.count(l) <= 2) continue;
            backward += most[0];
            forward += most[1];
        }
        backward_ = problem_.backward.value_or(backward == forward ? low.dot(high) < 0 : backward > forward);
    }

    /// Align a loop so that most of its vertex pairs are kept. Dropped and unpaired vertices get the partners
    /// that this alignment gives them.
    void align(std::size_t l)
    {
        const std::size_t m = loop_[l], n = source_.count(l);
        std::vector<Way> found = ways(l, m);
        std::erase_if(found, [&](const Way& other) { return other.backward != backward_; });
        if (found.empty())
            throw NotClosed(
                Message("matching.nearest_failed",
                        "method \"nearest\" cannot match {} ({}): no alignment with {} keeps its fixed "
                        "vertex pairs",
                        source_loop(l), vertices_of(l), target_loop(m))
                    .remedy("leave pairs out of match{{ vertices = … }}"));
        Way way = best_of(found);
        const auto partner = [&](std::size_t i) {
            return target_.first[m] + partner_place(i, n, way.shift, way.backward);
        };
        // With a fixed pair, only one alignment is possible.
        const auto first = fixed_.begin() + static_cast<std::ptrdiff_t>(source_.first[l]);
        const bool settled = std::any_of(first, first + static_cast<std::ptrdiff_t>(n),
                                         [](std::size_t t) { return t != kNoIndex; });
        if (!settled && static_cast<double>(way.agree) < kShare * static_cast<double>(n)) {
            refuse_clash(l);
            refuse_loop(l, "the nearest vertices do not keep the order along the loop");
        }
        if (way.agree < n) {
            std::vector<NamedEntity> others;
            for (std::size_t i = 0; i < n; ++i)
                if (const std::size_t s = source_.first[l] + i; partner_[s] != partner(i))
                    others.push_back(entity_of(model_, source_.vertex[s]));
            result_.notes.push_back({"matching.nearest_taken",
                                     "{}: the target vertices nearest to {} have other partners, so these "
                                     "vertices are paired in the order of the loop",
                                     source_loop(l), others});
            result_.confidence = std::min(result_.confidence,
                                          static_cast<double>(way.agree) / static_cast<double>(n));
        }
        if (std::ranges::find(problem_.options.flip, static_cast<int>(l)) != problem_.options.flip.end()) {
            std::vector<Way> turned = ways(l, m);
            std::erase_if(turned, [&](const Way& other) { return other.backward == way.backward; });
            if (turned.empty())
                refuse_loop(l, "reversed by match{ flip = … }, it cannot keep its fixed vertex pairs");
            way = *std::ranges::min_element(turned, {}, &Way::distance);
        }
        result_.loops.push_back({static_cast<int>(l), static_cast<int>(m), !way.backward});
        for (std::size_t i = 0; i < n; ++i) {
            const std::size_t s = source_.first[l] + i;
            partner_[s] = partner(i);
            result_.vertices.emplace_back(source_.vertex[s], target_.vertex[partner_[s]]);
            result_.hard.push_back(problem_.hard.contains(source_.vertex[s]));
        }
    }

    /// 1 − sum of the distances of the pairs / sum of the distances to the nearest other target vertices, in
    /// [0, 1].
    [[nodiscard]] double clearness() const
    {
        double matched = 0, second = 0;
        for (std::size_t s = 0; s < partner_.size(); ++s) {
            if (fixed_[s] != kNoIndex) continue;
            const std::size_t next = nearest(source_.at[s], target_,
                                             [&](std::size_t t) { return t != partner_[s]; });
            if (next == kNoIndex) continue;
            matched += distance(s, partner_[s]);
            second += distance(s, next);
        }
        return second > 0 ? std::clamp(1 - matched / second, 0.0, 1.0) : 1;
    }

    /// Refuse a loop if two of its vertices share a nearest target vertex.
    void refuse_clash(std::size_t l) const
    {
        for (std::size_t a = source_.first[l]; a < source_.first[l + 1]; ++a) {
            for (std::size_t b = 0; b < partner_.size(); ++b) {
                if (a == b || nearest_to_source_[a] == kNoIndex ||
                    nearest_to_source_[a] != nearest_to_source_[b])
                    continue;
                throw NotClosed(
                    Message("matching.nearest_failed",
                            "method \"nearest\" cannot match {}: the nearest vertices do not keep the order "
                            "along the loop ({} and {} are both nearest to {})",
                            source_loop(l), entity_of(model_, source_.vertex[a]),
                            entity_of(model_, source_.vertex[b]),
                            entity_of(model_, target_.vertex[nearest_to_source_[a]]))
                        .remedy("pair the vertices with match{{ vertices = … }}"));
            }
        }
    }

    [[noreturn]] void refuse_loop(std::size_t l, const char* why) const
    {
        throw NotClosed(Message("matching.nearest_failed", "method \"nearest\" cannot match {} ({}): {}",
                                source_loop(l), vertices_of(l), why)
                            .remedy("pair the vertices with match{{ vertices = … }}"));
    }

    /// The source vertices of a loop, for messages.
    [[nodiscard]] std::vector<NamedEntity> vertices_of(std::size_t l) const
    {
        return entities_of(model_, std::span(source_.vertex).subspan(source_.first[l], source_.count(l)));
    }

    const Problem& problem_;
    const Model& model_;
    Ends source_, target_;
    std::vector<std::size_t> partner_;           ///< index of the target vertex of each source vertex
    std::vector<std::size_t> fixed_;             ///< index of the target vertex of each source vertex in a
                                                 ///< fixed pair; otherwise kNoIndex
    std::vector<std::size_t> nearest_to_source_; ///< nearest target vertex of each source vertex (step 4)
    std::vector<std::size_t> loop_;              ///< target loop of each source loop
    bool backward_ = true;                       ///< whether target loops are traversed against their own
                                                 ///< direction
    Match result_;
};

} // namespace

Match match_nearest(const Problem& problem, Match match) { return Nearest(problem, std::move(match)).run(); }

} // namespace lacuna::matching
