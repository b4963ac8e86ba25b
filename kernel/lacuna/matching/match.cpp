// SPDX-License-Identifier: MIT
#include <lacuna/matching/match.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/attempt.h>
#include <lacuna/core/shared/constants.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/core/shared/list_text.h>
#include <lacuna/matching/detail/arc_pairs.h>
#include <lacuna/matching/detail/arrange.h>
#include <lacuna/matching/detail/nearest.h>
#include <lacuna/matching/detail/problem.h>
#include <lacuna/matching/detail/splits.h>
#include <lacuna/topology/shared/names_of.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

namespace lacuna::matching {

using namespace topology;

namespace {

/// Below this confidence, the second best alignment is reported too. At this limit, its residual is a third
/// larger than that of the best one.
constexpr double kUnsure = 0.25;
/// Below this confidence, an alignment under which the given meshes match is preferred to the best one,
/// unless it rotates more. At this limit, the residual of the best one is 2.5 times smaller. A lower value
/// fails for ring sectors whose outer end is eight times as far out as the inner one.
constexpr double kUnsureBesideSides = 0.6;
/// kTie: the same limit for an alignment that rotates more than the best one. kAsMuch: difference in rotation
/// that is ignored, as a share of half a turn. Both are small, so that a plain prism is not twisted to match
/// its target mesh.
constexpr double kTie = 0.1, kAsMuch = 0.05;

/// Confidence that the best score is right: 1 − best / second best.
double sureness(double best, double second)
{
    return 1 - std::min(1.0, std::max(best, kRoundoff) / std::max(second, kRoundoff));
}

/// Report a second alignment that fits about as well, so that the user can choose.
void note_candidates(const Problem& problem, std::size_t s, std::size_t t, const Alignment& best,
                     const Alignment& second, Match& match)
{
    const Model& model = problem.volume.model;
    const auto start_on = [&](const Alignment& alignment) {
        if (problem.paired_by_length(s, t))
            return formatted("{}% of the target loop's length", std::lround(alignment.offset * 100));
        return formatted("{}", entity_of(model, problem.target[t].vertices[alignment.shift]));
    };
    match.notes.push_back(
        {"matching.other_alignment",
         "{}: {} was matched to {}, and {} fits about as well; choose with match{{ vertices = … }}{}",
         source_loop(s), entity_of(model, problem.source[s].vertices.front()), start_on(best),
         best.shift == second.shift ? "the reverse direction" : start_on(second),
         best.backward == second.backward ? "" : " or match{ flip = … }"});
}

/// Report that no wall tells how far two loops are turned against each other, but that their shapes fit only
/// if they are turned by more than an eighth of a turn about the sweep.
void note_turn(const Problem& problem, std::size_t s, const Alignment& best, Match& match)
{
    if (!problem.led.from.empty() || problem.has_hard(s)) return;
    const Vec3 normal = problem.source[s].area.stableNormalized();
    const Eigen::Quaterniond turn(best.fit.rotation);
    const Eigen::Quaterniond bend = Eigen::Quaterniond::FromTwoVectors(normal, turn * normal);
    const double about = Eigen::AngleAxisd(bend.conjugate() * turn).angle() / std::numbers::pi;
    if (!(about > 0.25 + kAsMuch)) return;
    match.notes.push_back(
        Message("matching.turned",
                "{} is turned by {:.0f}° against the target about the sweep, because the shapes fit so",
                source_loop(s), found(180 * about))
            .remedy("match{{ method = \"nearest\" }} pairs the nearest vertices instead"));
}

/// Aligns every source loop with its target loop, and pairs the vertices accordingly.
class LoopAligner {
public:
    LoopAligner(const Problem& problem, Match& match)
        : problem_(problem),
          match_(match),
          chosen_(problem.source.size()),
          aligned_(chosen_.size(), false),
          sampled_(chosen_.size())
    {
        Eigen::AlignedBox3d box;
        for (const LoopShape& shape : problem.source) box.extend(shape.centroid);
        box.sizes().maxCoeff(&axis_);
        for (std::size_t s = 0; s < chosen_.size(); ++s)
            along_.emplace_back(problem.source[s].centroid[axis_], s);
        std::ranges::sort(along_);
    }

    void run(const Arrangement& arrangement)
    {
        const std::size_t n = chosen_.size();
        const auto anchor = static_cast<std::size_t>(arrangement.anchor);
        backward_ = problem_.backward;
        align(anchor, &arrangement);
        for (std::size_t s = 0; s < n; ++s) {
            if (s != anchor) align(s, nullptr);
        }
        for (std::size_t s = 0; s < n; ++s) slide(s);
        for (std::size_t s = 0; s < n; ++s) {
            if (problem_.paired_by_length(s, target(s)))
                pair_by_length(s);
            else
                pair_by_vertices(s);
        }
    }

private:
    [[nodiscard]] std::size_t target(std::size_t s) const
    {
        return static_cast<std::size_t>(match_.loops[s].target);
    }

    /// @param arrangement  the arrangement, for its anchor; null for any other loop
    void align(std::size_t s, const Arrangement* arrangement)
    {
        const std::size_t t = target(s);
        const std::vector<int>& flips = problem_.options.flip;
        const bool flip = std::ranges::find(flips, static_cast<int>(s)) != flips.end();
        std::vector<Alignment> found;
        if (arrangement != nullptr) {
            found = {arrangement->alignment};
            if (arrangement->next) found.push_back(*arrangement->next);
            if (!flip && chosen_.size() == 1) {
                prefer_unturned(s, t, found);
                prefer_given_sides(s, t, found);
            }
        }
        if (flip || arrangement == nullptr) {
            std::optional<bool> backward = backward_;
            if (flip) backward = !(backward_ ? *backward_ : arrangement->alignment.backward);
            found = alignments_of(problem_, s, t, true, backward, known_near(s));
        }
        if (found.empty()) {
            const auto [from, to] = fixed_vertices(s);
            if (from.empty())
                throw NotClosed(
                    Message("matching.vertices_contradict",
                            "no alignment of {} with {} keeps the vertex pairs fixed by the walls "
                            "or by match{{ vertices = … }}",
                            source_loop(s), target_loop(t))
                        .remedy("leave pairs out of match{{ vertices = … }}, or walls out of the roles"));
            throw NotClosed(
                Message("matching.vertices_contradict",
                        "no alignment of {} with {} keeps the vertex pairs fixed by the walls or "
                        "by match{{ vertices = … }}: {} to {}",
                        source_loop(s), target_loop(t), from, to)
                    .remedy("leave pairs out of match{{ vertices = … }}, or walls out of the roles"));
        }
        const Alignment& best = chosen_[s] = found.front();
        // A loop that the user reversed runs opposite to the other loops.
        if (!backward_) backward_ = flip ? !best.backward : best.backward;
        match_.loops[s].flipped = !best.backward;
        rate(s, found);
        if (arrangement != nullptr) note_turn(problem_, s, best, match_);
        aligned_[s] = true;
        sampled_[s] = samples(problem_, s, t, best);
    }

    /// The `kNearLoops` loops nearest to loop s for which `counts` is true, in the order of their numbers.
    /// Loops are visited in the order of their distances along the axis, until no other loop can be nearer.
    template <class Counts>
    [[nodiscard]] std::vector<std::size_t> nearest(std::size_t s, const Counts& counts) const
    {
        std::vector<std::pair<double, std::size_t>> near; // squared distances and loops, ascending
        const Vec3& centre = problem_.source[s].centroid;
        const double at = centre[axis_];
        auto above = std::ranges::lower_bound(along_, std::pair(at, std::size_t{0})), below = above;
        while (below != along_.begin() || above != along_.end()) {
            const double down = below == along_.begin() ? kInfinity : at - std::prev(below)->first;
            const double up = above == along_.end() ? kInfinity : above->first - at;
            const double gap = std::min(down, up);
            if (near.size() == kNearLoops && gap * gap > near.back().first) break;
            const std::size_t other = down < up ? (--below)->second : (above++)->second;
            if (!counts(other)) continue;
            const std::pair found((problem_.source[other].centroid - centre).squaredNorm(), other);
            near.insert(std::ranges::upper_bound(near, found), found);
            if (near.size() > kNearLoops) near.pop_back();
        }
        std::vector<std::size_t> loops;
        for (const auto& [away, other] : near) loops.push_back(other);
        std::ranges::sort(loops);
        return loops;
    }

    /// Corresponding points of the aligned loops near loop s.
    [[nodiscard]] PointPairs known_near(std::size_t s) const
    {
        PointPairs known;
        for (const std::size_t other : nearest(s, [&](std::size_t o) { return aligned_[o]; }))
            known.add(sampled_[other]);
        return known;
    }

    /// If a turn to the left and a turn to the right fit equally well, nothing tells which of them is meant:
    /// prefer the alignment that turns least. Example: a duct of 40 x 20 that becomes one of 20 x 40.
    void prefer_unturned(std::size_t s, std::size_t t, std::vector<Alignment>& found) const
    {
        const Alignment likeliest = found.front();
        if (found.size() < 2 || sureness(likeliest.score, found[1].score) > kFileAccuracy) return;
        const std::vector<Alignment> all = alignments_of(problem_, s, t, true, likeliest.backward);
        const Alignment& least = *std::ranges::min_element(all, {}, turn_of);
        if (turn_of(least) + kAsMuch < turn_of(likeliest)) found = {least, likeliest};
    }

    /// If several alignments fit about as well, prefer the one under which the given meshes of both ends
    /// match best.
    void prefer_given_sides(std::size_t s, std::size_t t, std::vector<Alignment>& found) const
    {
        std::size_t least = unlike_sides(problem_, s, t, found.front());
        if (least == 0) return;
        const Alignment likeliest = found.front();
        for (const Alignment& other : alignments_of(problem_, s, t, true, problem_.backward)) {
            const bool turns_more = turn_of(other) > turn_of(likeliest) + kAsMuch;
            if (sureness(likeliest.score, other.score) >= (turns_more ? kTie : kUnsureBesideSides)) continue;
            const std::size_t unlike = unlike_sides(problem_, s, t, other);
            if (unlike >= least) continue;
            least = unlike;
            found = {other, likeliest};
        }
        if (!differ(problem_, s, t, found.front(), likeliest)) return;
        match_.notes.push_back({"matching.aligned_by_meshes",
                                "{} was aligned so that the given meshes agree; by shape alone another "
                                "alignment fits better",
                                source_loop(s)});
    }

    /// Lower the confidence if a different alignment of a loop fits nearly as well as the best one. A loop
    /// with a hard pair has only one alignment.
    void rate(std::size_t s, const std::vector<Alignment>& found)
    {
        const std::size_t t = target(s);
        const Alignment& best = found.front();
        const auto second = std::ranges::find_if(
            found, [&](const Alignment& other) { return differ(problem_, s, t, best, other); });
        if (second == found.end() || problem_.has_hard(s)) return;
        // `best` may have a worse score than `second`, because arrangements are ranked by the shapes of all
        // loops.
        const double sure = sureness(best.score, second->score);
        match_.confidence = std::min(match_.confidence, sure);
        if (sure < kUnsure) note_candidates(problem_, s, t, best, *second, match_);
    }

    /// Improve the start of a loop that is paired by length: the fit includes the loops nearest to it. A loop
    /// that is measured in given sides stays as it is, because its samples are nodes. Of near loops that are
    /// paired by length too, only the centroid takes part, with the weight of a loop's samples: their starts
    /// may still change.
    void slide(std::size_t s)
    {
        const std::size_t t = target(s);
        if (!problem_.paired_by_length(s, t) || problem_.has_hard(s) || problem_.source[s].by_sides) return;
        PointPairs known;
        for (const std::size_t other : nearest(s, [&](std::size_t o) { return o != s; })) {
            const std::size_t its = target(other);
            if (!problem_.paired_by_length(other, its)) {
                known.add(sampled_[other]);
                continue;
            }
            known.from.insert(known.from.end(), kFineChords, problem_.source[other].centroid);
            known.to.insert(known.to.end(), kFineChords, problem_.target[its].centroid);
        }
        chosen_[s] = refined(problem_, s, t, chosen_[s], known);
    }

    void pair_by_vertices(std::size_t s)
    {
        const std::vector<VertexId>& source = problem_.source[s].vertices;
        const std::vector<VertexId>& target_vertices = problem_.target[target(s)].vertices;
        const Alignment& alignment = chosen_[s];
        const std::size_t n = source.size();
        for (std::size_t i = 0; i < n; ++i)
            add_pair(source[i], target_vertices[partner_place(i, n, alignment.shift, alignment.backward)]);
    }

    void pair_by_length(std::size_t s)
    {
        const std::size_t t = target(s);
        const LoopShape& source = problem_.source[s];
        const LoopShape& high = problem_.target[t];
        const ArcLoop low_loop = arc_loop(source), high_loop = arc_loop(high);
        const std::vector<std::pair<VertexId, VertexId>> hard = hard_pairs(s);
        if (!keeps_order(low_loop, high_loop, chosen_[s].backward, hard)) {
            const auto [from, to] = fixed_vertices(s);
            throw NotClosed(Message("matching.vertices_contradict",
                                    "vertex pairs on {} that are fixed by the walls or by match{{ vertices = "
                                    "… }} cross: {} to {}",
                                    source_loop(s), from, to)
                                .remedy("give 'vertices' in the same order around both loops"));
        }
        const ArcPairs pairs = pair_by_arc(low_loop, high_loop, chosen_[s].offset, chosen_[s].backward, hard,
                                           largest_twist(s));
        for (const auto& [from, to] : pairs.vertices) add_pair(from, to);
        for (const auto& [vertex, share] : pairs.split_target)
            match_.splits.push_back(split_at(vertex, true, match_.target_loops[t], high, share));
        for (const auto& [vertex, share] : pairs.split_source)
            match_.splits.push_back(split_at(vertex, false, match_.source_loops[s], source, share));
        note_lengths(s, pairs.split_source.size() + pairs.split_target.size());
    }

    /// Largest distance of paired smooth vertices, as a share of the loop. Given sides correspond; elsewhere
    /// columns between loops that are near each other must not lean by half of `kCreaseAngle`.
    [[nodiscard]] double largest_twist(std::size_t s) const
    {
        const LoopShape& source = problem_.source[s];
        if (source.by_sides) return 0.5 / static_cast<double>(given_sides(source));
        double gap = kInfinity;
        for (std::size_t i = 0; i < sampled_[s].from.size(); ++i)
            gap = std::min(gap, (sampled_[s].from[i] - sampled_[s].to[i]).norm());
        const double leaning = std::tan(kCreaseAngle / 2 * kDegree) * gap / source.length;
        return std::clamp(leaning, kFileAccuracy, most_twist());
    }

    void note_lengths(std::size_t s, std::size_t splits)
    {
        const std::size_t t = target(s), low = problem_.source[s].vertices.size(),
                          high = problem_.target[t].vertices.size();
        if (low == high && splits == 0) return;
        const auto vertices = [](std::size_t n) {
            return formatted("{} {}", n, n == 1 ? "vertex" : "vertices");
        };
        match_.notes.push_back(
            {"matching.paired_by_length", "{} has {} and {} has {}, so they are paired by arc length{}",
             source_loop(s), vertices(low), target_loop(t), vertices(high),
             splits == 0 ? "" : formatted(", with {} added by splitting edges", vertices(splits))});
    }

    void add_pair(VertexId source, VertexId to)
    {
        match_.vertices.emplace_back(source, to);
        const auto known = problem_.hard.find(source);
        match_.hard.push_back(known != problem_.hard.end() && known->second == to);
    }

    /// Vertices on walls are not `open`: they cause no splits, because walls or corners give them partners.
    [[nodiscard]] ArcLoop arc_loop(const LoopShape& shape) const
    {
        ArcLoop loop{shape.vertices, shape.vertex_arc, shape.corner, {}};
        for (double& at : loop.at) at /= shape.length;
        for (const VertexId v : shape.vertices) loop.open.push_back(!problem_.on_wall[v.index()]);
        return loop;
    }

    [[nodiscard]] std::vector<std::pair<VertexId, VertexId>> hard_pairs(std::size_t s) const
    {
        std::vector<std::pair<VertexId, VertexId>> pairs;
        for (const VertexId v : problem_.source[s].vertices) {
            const auto pair = problem_.hard.find(v);
            if (pair != problem_.hard.end()) pairs.emplace_back(*pair);
        }
        return pairs;
    }

    /// The vertices of `hard_pairs()` on source and target, for messages.
    [[nodiscard]] std::array<std::vector<NamedEntity>, 2> fixed_vertices(std::size_t s) const
    {
        std::array<std::vector<NamedEntity>, 2> fixed;
        for (const auto& [from, to] : hard_pairs(s)) {
            fixed[0].push_back(entity_of(problem_.volume.model, from));
            fixed[1].push_back(entity_of(problem_.volume.model, to));
        }
        return fixed;
    }

    const Problem& problem_;
    Match& match_;
    std::vector<Alignment> chosen_;
    std::vector<bool> aligned_;       ///< by loop: whether it is aligned already
    std::vector<PointPairs> sampled_; ///< corresponding points of the aligned loops, before slide()
    Eigen::Index axis_ = 0;           ///< axis along which the loops extend farthest
    std::vector<std::pair<double, std::size_t>> along_; ///< positions of the loops on the axis, with their
                                                        ///< numbers; ascending
    std::optional<bool> backward_;
};

/// Loop numbers as in recipes, from 1.
std::string numbers(const std::vector<int>& list)
{
    return full_list(list, [](int i) { return formatted("{}", i + 1); });
}

/// Whether method `aligned` succeeds where `nearest` failed.
bool can_be_aligned(const OpenVolume& volume, MatchOptions options, const RunContext& context)
{
    options.method = Method::aligned;
    return attempt([&] { return match(volume, options, context); }).value.has_value();
}

} // namespace

Match match(const OpenVolume& volume, const MatchOptions& options, const RunContext& context)
{
    const Model& model = volume.model;
    Match result;
    result.method = options.method == Method::nearest ? "nearest" : "aligned";
    result.source_loops = rims(model, volume.faces(Role::source));
    result.target_loops = rims(model, volume.faces(Role::target));
    if (result.source_loops.empty() || result.target_loops.empty()) {
        const bool source = result.source_loops.empty();
        throw NotClosed(Message("matching.no_rim",
                                "the {} has no rim: it has no faces, or its faces form a closed surface",
                                source ? "source" : "target")
                            .remedy("name faces with a rim"));
    }
    if (result.source_loops.size() != result.target_loops.size()) {
        throw NotClosed(
            Message(
                "matching.loop_counts",
                "the source ({}) has {} {}, but the target ({}) has {}: both ends need the same number of "
                "loops",
                entities_of(model, volume.faces(Role::source)), found(result.source_loops.size()),
                result.source_loops.size() == 1 ? "loop" : "loops",
                entities_of(model, volume.faces(Role::target)), found(result.target_loops.size()))
                .remedy("if a body stands on an end, also name the body's top as part of that end"));
    }
    Problem problem = problem_of(volume, options, result, context);
    if (options.method == Method::nearest) {
        auto matched = attempt<NotClosed>([&] { return match_nearest(problem, std::move(result)); });
        if (matched) return std::move(*matched);
        if (!can_be_aligned(volume, options, context)) matched.raise();
        throw NotClosed(matched.why->remedy("try method = \"aligned\", which matches them"));
    }

    const std::vector<Arrangement> pairings = arrange(problem);
    if (pairings.empty()) {
        throw NotClosed(
            Message("matching.no_pairs",
                    "no pairing of the loops keeps the pairs fixed by the walls or by match{{ … }}")
                .remedy("give fewer pairs"));
    }
    result.loops.resize(problem.source.size());
    for (std::size_t s = 0; s < result.loops.size(); ++s)
        result.loops[s] = {static_cast<int>(s), pairings.front().target[s], false};
    const bool open = std::ranges::find(problem.forced, -1) != problem.forced.end();
    if (open && pairings.size() > 1) {
        result.confidence = sureness(pairings[0].score, pairings[1].score);
        if (result.confidence < kUnsure) {
            result.notes.push_back(
                Message(
                    "matching.other_loops",
                    "the source loops were paired, in order, with target loops {}, but target loops {} fit "
                    "about as well",
                    numbers(pairings[0].target), numbers(pairings[1].target))
                    .remedy("to choose, use match{{ loops = … }}"));
        }
    }
    LoopAligner(problem, result).run(pairings.front());
    return result;
}

} // namespace lacuna::matching
