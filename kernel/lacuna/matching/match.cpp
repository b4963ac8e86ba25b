// SPDX-License-Identifier: MIT
#include <lacuna/matching/match.h>

#include <lacuna/core/error.h>
#include <lacuna/geometry/affine.h>
#include <lacuna/matching/arc_pairs.h>
#include <lacuna/matching/assignment.h>
#include <lacuna/matching/loop_shape.h>
#include <lacuna/matching/nearest.h>
#include <lacuna/matching/side_lines.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>

namespace lacuna::matching {

using namespace topology;

namespace {

/// Confidence below which the second best is named beside the best: it fits within a quarter as well.
constexpr double kUnsure = 0.25;
/// What a turn of 180° counts in a score, against a residual as large as the loop: small, so that it only decides
/// between fits that are about as good.
constexpr double kTurnWeight = 0.1;

struct Problem {
    const OpenVolume& volume;
    const MatchOptions& options;
    std::vector<LoopShape> source, target;
    std::map<VertexId, VertexId> hard; ///< source vertex → target vertex
    std::vector<int> forced;           ///< target loop of each source loop, -1: open
    std::optional<bool> backward;      ///< known when walls join the ends
};

std::size_t position(const std::vector<VertexId>& list, VertexId wanted)
{
    return static_cast<std::size_t>(std::find(list.begin(), list.end(), wanted) - list.begin());
}

/// True when the hard pairs of the two loops allow the lay.
bool allowed(const Problem& problem, const LoopShape& source, const LoopShape& target, std::size_t shift,
             bool backward)
{
    const std::size_t n = source.vertices.size();
    if (by_length(source, target)) return true;
    for (std::size_t i = 0; i < n; ++i) {
        const auto pair = problem.hard.find(source.vertices[i]);
        if (pair == problem.hard.end()) continue;
        const std::size_t j = backward ? (shift + n - i) % n : (shift + i) % n;
        if (target.vertices[j] != pair->second) return false;
    }
    return true;
}

double turn_of(const Eigen::Matrix3d& rotation)
{
    return std::abs(Eigen::AngleAxisd(rotation).angle()) / std::numbers::pi;
}

/// Every lay of one loop on another, best first. Points already matched elsewhere (`from`, `to`) take part in the fit.
std::vector<Lay> lays(const Problem& problem, int s, int t, bool with_scale,
                      const std::vector<Vec3>& from = {}, const std::vector<Vec3>& to = {})
{
    const LoopShape& source = problem.source[static_cast<std::size_t>(s)];
    const LoopShape& target = problem.target[static_cast<std::size_t>(t)];
    const std::size_t shifts = by_length(source, target) ? kSamples : target.vertices.size();
    const double scale = std::max(source.length, target.length);
    std::vector<Vec3> a = source_samples(source, target);
    a.insert(a.end(), from.begin(), from.end());
    std::vector<Lay> result;
    for (const bool backward : {true, false}) {
        if (problem.backward && *problem.backward != backward) continue;
        for (std::size_t shift = 0; shift < shifts; ++shift) {
            if (!allowed(problem, source, target, shift, backward)) continue;
            std::vector<Vec3> b = target_samples(source, target, shift, backward);
            b.insert(b.end(), to.begin(), to.end());
            Lay lay{shift, backward, 0, geometry::fit_rigid(a, b, with_scale)};
            lay.score = lay.fit.rms / scale +
                        kTurnWeight * (turn_of(lay.fit.rotation) + overturned(source, target, backward));
            result.push_back(lay);
        }
    }
    std::stable_sort(result.begin(), result.end(),
                     [](const Lay& x, const Lay& y) { return x.score < y.score; });
    return result;
}

double relative(double a, double b)
{
    const double most = std::max(std::abs(a), std::abs(b));
    return most > 0 ? std::abs(a - b) / most : 0;
}

/// How far a loop's middle lands from another's once the source has been moved by `fit`.
double misfit(const Problem& problem, std::size_t s, std::size_t t, const geometry::RigidFit& fit,
              double reach)
{
    return (fit(problem.source[s].centroid) - problem.target[t].centroid).norm() / reach;
}

/// What it costs to send loop s to loop t once the source has been moved by `fit`.
double loop_cost(const Problem& problem, std::size_t s, std::size_t t, const geometry::RigidFit& fit,
                 double reach)
{
    if (problem.forced[s] >= 0 && problem.forced[s] != static_cast<int>(t))
        return std::numeric_limits<double>::infinity();
    const double place = misfit(problem, s, t, fit, reach);
    if (problem.forced[s] >= 0) return place;
    const LoopShape& a = problem.source[s];
    const LoopShape& b = problem.target[t];
    const double counts = relative(static_cast<double>(a.vertices.size()),
                                   static_cast<double>(b.vertices.size()));
    return place + relative(a.length * fit.scale, b.length) +
           relative(a.area.norm() * fit.scale * fit.scale, b.area.norm()) + counts;
}

struct Arrangement {
    std::vector<int> target; ///< of each source loop
    int anchor = 0;
    Lay lay;                 ///< of the anchor; its score counts where the other loops land
    std::optional<Lay> next; ///< the second best with the same pairs
    double score = std::numeric_limits<double>::infinity();
};

/// The arrangement that a lay of the anchor leads to; nothing where no complete one is cheaper than `limit`.
std::optional<Arrangement> arrangement_of(const Problem& problem, std::size_t anchor, std::size_t t,
                                          const Lay& lay, double reach, double limit)
{
    const std::size_t n = problem.source.size();
    const auto at = [](std::size_t i) { return static_cast<Eigen::Index>(i); };
    Eigen::MatrixXd cost(at(n), at(n));
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) {
            const bool fixed = (i == anchor) != (j == t);
            cost(at(i), at(j)) = fixed ? std::numeric_limits<double>::infinity()
                                       : loop_cost(problem, i, j, lay.fit, reach);
        }
    }
    // However the loops are paired, each costs its least: most lays are out before they are assigned.
    if (!(lay.score + cost.rowwise().minCoeff().sum() / static_cast<double>(n) < limit)) return std::nullopt;
    Arrangement result{assign(cost), static_cast<int>(anchor), lay, {}, lay.score};
    for (std::size_t i = 0; i < n; ++i) {
        if (result.target[i] < 0) return std::nullopt;
        result.score += cost(at(i), result.target[i]) / static_cast<double>(n);
        result.lay.score += misfit(problem, i, static_cast<std::size_t>(result.target[i]), lay.fit, reach) /
                            static_cast<double>(n);
    }
    return result.score < limit ? std::optional(result) : std::nullopt;
}

/// Keep the two best arrangements with different pairs, and of the lays of each the two best that differ.
void keep(const Problem& problem, Arrangement candidate, std::vector<Arrangement>& best)
{
    const auto same = std::find_if(
        best.begin(), best.end(), [&](const Arrangement& other) { return other.target == candidate.target; });
    if (same == best.end()) {
        best.push_back(std::move(candidate));
    } else {
        const LoopShape& source = problem.source[static_cast<std::size_t>(candidate.anchor)];
        const LoopShape& target = problem.target[static_cast<std::size_t>(
            candidate.target[static_cast<std::size_t>(candidate.anchor)])];
        std::vector<Lay> others{candidate.lay, same->lay};
        if (same->next) others.push_back(*same->next);
        if (candidate.score < same->score) std::swap(*same, candidate);
        same->next.reset();
        for (const Lay& lay : others) {
            if (differ(source, target, lay, same->lay) && (!same->next || lay.score < same->next->score))
                same->next = lay;
        }
    }
    std::stable_sort(best.begin(), best.end(),
                     [](const Arrangement& a, const Arrangement& b) { return a.score < b.score; });
    if (best.size() > 2) best.pop_back();
}

/// Pair the loops: lay one source loop on each target loop it may go to, in every way, and see how the others fall.
/// @return the two best arrangements with different pairs, best first.
std::vector<Arrangement> arrange(const Problem& problem)
{
    const std::size_t n = problem.source.size();
    double reach = 0;
    for (const LoopShape& shape : problem.target) reach = std::max(reach, shape.length);
    const auto first_forced = std::find_if(problem.forced.begin(), problem.forced.end(),
                                           [](int t) { return t >= 0; });
    const auto anchor = first_forced == problem.forced.end()
                            ? std::size_t{0}
                            : static_cast<std::size_t>(first_forced - problem.forced.begin());
    std::vector<Arrangement> best;
    for (std::size_t t = 0; t < n; ++t) {
        if (problem.forced[anchor] >= 0 && problem.forced[anchor] != static_cast<int>(t)) continue;
        for (const bool with_scale : {false, true}) {
            for (const Lay& lay : lays(problem, static_cast<int>(anchor), static_cast<int>(t), with_scale)) {
                // With loops to spare for a second arrangement nothing worse than it matters.
                const double limit = n > 2 && best.size() > 1 ? best.back().score
                                                              : std::numeric_limits<double>::infinity();
                auto found = arrangement_of(problem, anchor, t, lay, reach, limit);
                if (found) keep(problem, std::move(*found), best);
            }
        }
    }
    return best;
}

/// Loop that holds a vertex; -1 for none.
int loop_with(const std::vector<LoopShape>& loops, VertexId vertex)
{
    for (std::size_t l = 0; l < loops.size(); ++l) {
        if (position(loops[l].vertices, vertex) < loops[l].vertices.size()) return static_cast<int>(l);
    }
    return -1;
}

void force(Problem& problem, int s, int t, const std::string& because)
{
    int& now = problem.forced[static_cast<std::size_t>(s)];
    if (now >= 0 && now != t) {
        throw NotClosed("matching.loops_contradict",
                        "source loop " + std::to_string(s + 1) + " would go to target loop " +
                            std::to_string(now + 1) + " and, " + because + ", to target loop " +
                            std::to_string(t + 1) + "; give the pairs by hand with match{ loops = … }");
    }
    now = t;
}

/// Walls settle loops and vertices before anything is guessed.
void read_walls(Problem& problem)
{
    const OpenVolume& volume = problem.volume;
    const Model& model = volume.model;
    for (const SideLine& line : side_lines(volume)) {
        problem.hard[line.source] = line.target;
        force(problem, loop_with(problem.source, line.source), loop_with(problem.target, line.target),
              "by its walls");
    }
    for (const std::vector<FaceId>& part : connected_parts(model, volume.faces(Role::wall))) {
        std::vector<int> s, t;
        for (const FaceId face : part) {
            for (const Loop& loop : model[face].loops) {
                for (const EdgeUse& use : loop.uses) {
                    const int on_s = loop_with(problem.source, use_from(model, use));
                    const int on_t = loop_with(problem.target, use_from(model, use));
                    if (on_s >= 0 && std::find(s.begin(), s.end(), on_s) == s.end()) s.push_back(on_s);
                    if (on_t >= 0 && std::find(t.begin(), t.end(), on_t) == t.end()) t.push_back(on_t);
                }
            }
        }
        if (!s.empty() && !t.empty())
            problem.backward = true; // oriented through the walls: the rims run opposite ways
        if (s.size() == 1 && t.size() == 1)
            force(problem, s.front(), t.front(), "by " + name_of(model, part.front()));
    }
}

VertexId vertex_with_tag(const Model& model, const std::vector<LoopShape>& loops, int tag,
                         const std::string& end)
{
    std::string known;
    for (const LoopShape& loop : loops) {
        for (const VertexId v : loop.vertices) {
            if (model[v].tag == tag) return v;
            known += (known.empty() ? "" : ", ") + std::to_string(model[v].tag);
        }
    }
    throw InvalidInput("matching.unknown_vertex", "vertex " + std::to_string(tag) +
                                                      " is not on the rim of the " + end +
                                                      ", whose vertices are " + known);
}

void read_options(Problem& problem)
{
    const Model& model = problem.volume.model;
    for (const int s : problem.options.flip) {
        if (s >= 0 && s < static_cast<int>(problem.source.size())) continue;
        throw InvalidInput("matching.unknown_loop", "flip names source loop " + std::to_string(s + 1) +
                                                        ": the loops are numbered from 1 to " +
                                                        std::to_string(problem.source.size()));
    }
    for (const auto& [s, t] : problem.options.loops) {
        if (s < 0 || t < 0 || s >= static_cast<int>(problem.source.size()) ||
            t >= static_cast<int>(problem.target.size())) {
            throw InvalidInput("matching.unknown_loop", "loop pair {" + std::to_string(s + 1) + ", " +
                                                            std::to_string(t + 1) +
                                                            "}: the loops are numbered from 1 to " +
                                                            std::to_string(problem.source.size()));
        }
        force(problem, s, t, "as the recipe asks");
    }
    const std::map<VertexId, VertexId> by_walls = problem.hard;
    for (const auto& [s, t] : problem.options.vertices) {
        const VertexId from = vertex_with_tag(model, problem.source, s, "source");
        const VertexId to = vertex_with_tag(model, problem.target, t, "target");
        const auto known = problem.hard.find(from);
        if (known != problem.hard.end() && known->second != to) {
            throw InvalidInput("matching.vertices_contradict",
                               "vertex " + std::to_string(s) +
                                   (by_walls.contains(from) ? " is joined by walls" : " goes by the recipe") +
                                   " to vertex " + std::to_string(model[known->second].tag) +
                                   " and cannot go to vertex " + std::to_string(t));
        }
        const auto taken = std::find_if(problem.hard.begin(), problem.hard.end(), [&](const auto& pair) {
            return pair.second == to && pair.first != from;
        });
        if (taken != problem.hard.end()) {
            throw InvalidInput(
                "matching.vertices_contradict",
                "vertices " + std::to_string(model[taken->first].tag) + " and " + std::to_string(s) +
                    " of the source cannot both go to vertex " + std::to_string(t) +
                    (by_walls.contains(taken->first) ? ", which walls join to the first" : ""));
        }
        problem.hard[from] = to;
        force(problem, loop_with(problem.source, from), loop_with(problem.target, to), "by its vertices");
    }
}

/// Cut a loop where a vertex of the other end needs a partner: at the point of its edges that is nearest.
void add_split(const Model& model, const Rim& rim, const LoopShape& shape, double share, Split split,
               Match& match)
{
    const double wanted = share * shape.length;
    std::size_t nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i + 1 < shape.points.size(); ++i) {
        const double apart = std::abs(shape.arc[i] - wanted);
        const double distance = std::min(apart, shape.length - apart);
        if (distance < least) {
            least = distance;
            nearest = i;
        }
    }
    std::size_t first = 0;
    for (const EdgeUse& use : rim.uses) {
        const std::size_t segments = model[use.edge].points.size() - 1;
        if (nearest < first + segments) {
            split.edge = use.edge;
            split.point = use.reversed ? segments - (nearest - first) : nearest - first;
            match.splits.push_back(split);
            return;
        }
        first += segments;
    }
}

/// Pair the vertices of two loops by how far along them they stand.
std::vector<std::pair<VertexId, VertexId>> pair_by_length(const Problem& problem, Match& match,
                                                          const Lay& lay, std::size_t s, std::size_t t)
{
    const Model& model = problem.volume.model;
    const LoopShape& source = problem.source[s];
    const LoopShape& target = problem.target[t];
    const auto arc_loop = [](const LoopShape& shape) {
        ArcLoop loop{shape.vertices, shape.vertex_arc, shape.corner};
        for (double& at : loop.at) at /= shape.length;
        return loop;
    };
    std::vector<std::pair<VertexId, VertexId>> hard;
    for (const VertexId v : source.vertices) {
        const auto pair = problem.hard.find(v);
        if (pair != problem.hard.end()) hard.emplace_back(*pair);
    }
    ArcPairs pairs = pair_by_arc(arc_loop(source), arc_loop(target),
                                 static_cast<double>(lay.shift) / kSamples, lay.backward, hard);
    for (const auto& [vertex, share] : pairs.split_target)
        add_split(model, match.target_loops[t], target, share, {vertex, true, {}, 0}, match);
    for (const auto& [vertex, share] : pairs.split_source)
        add_split(model, match.source_loops[s], source, share, {vertex, false, {}, 0}, match);
    if (source.vertices.size() != target.vertices.size()) {
        match.notes.push_back("source loop " + std::to_string(s + 1) + " has " +
                              std::to_string(source.vertices.size()) + " vertices, target loop " +
                              std::to_string(t + 1) + " has " + std::to_string(target.vertices.size()) +
                              ": paired by how far along they stand");
    }
    return pairs.vertices;
}

/// Where a loop could as well be laid another way, say which two there are: the recipe can choose.
void note_candidates(const Problem& problem, std::size_t s, int t, const Lay& best, const Lay& second,
                     Match& match)
{
    const LoopShape& source = problem.source[s];
    const LoopShape& target = problem.target[static_cast<std::size_t>(t)];
    const auto start_on = [&](const Lay& lay) {
        if (by_length(source, target))
            return std::to_string(lay.shift * 100 / kSamples) + "% of the target loop's length";
        return "vertex " + std::to_string(problem.volume.model[target.vertices[lay.shift]].tag);
    };
    match.notes.push_back("source loop " + std::to_string(s + 1) + ": vertex " +
                          std::to_string(problem.volume.model[source.vertices.front()].tag) +
                          " was laid on " + start_on(best) + ", and " +
                          (best.shift == second.shift ? "the other way round" : start_on(second)) +
                          " fits about as well; choose with match{ vertices = … }" +
                          (best.backward == second.backward ? "" : " or match{ flip = … }"));
}

void pair_vertices(const Problem& problem, Match& match, const Arrangement& arrangement)
{
    const std::size_t n = problem.source.size();
    std::vector<Vec3> from, to;
    std::vector<LoopPair> pairs(n);
    std::vector<std::vector<std::pair<VertexId, VertexId>>> vertices(n);
    std::vector<std::size_t> order{static_cast<std::size_t>(arrangement.anchor)};
    for (std::size_t s = 0; s < n; ++s) {
        if (s != static_cast<std::size_t>(arrangement.anchor)) order.push_back(s);
    }
    std::optional<bool> backward = problem.backward;
    for (const std::size_t s : order) {
        const int t = match.loops[s].target;
        const LoopShape& source = problem.source[s];
        const LoopShape& target = problem.target[static_cast<std::size_t>(t)];
        Problem local = problem;
        local.backward = backward;
        const auto flip = std::find(problem.options.flip.begin(), problem.options.flip.end(),
                                    static_cast<int>(s));
        std::vector<Lay> found;
        if (s == static_cast<std::size_t>(arrangement.anchor) && flip == problem.options.flip.end()) {
            found = {arrangement.lay};
            if (arrangement.next) found.push_back(*arrangement.next);
        } else {
            if (flip != problem.options.flip.end())
                local.backward = !(backward ? *backward : arrangement.lay.backward);
            found = lays(local, static_cast<int>(s), t, true, from, to);
        }
        if (found.empty()) {
            throw NotClosed(
                "matching.vertices_contradict",
                "no way to lay source loop " + std::to_string(s + 1) + " on target loop " +
                    std::to_string(t + 1) +
                    " keeps the vertex pairs that the walls or the recipe fix; check match{ vertices = … }");
        }
        const Lay& lay = found.front();
        // A loop turned round by hand says nothing of how the others run.
        if (!backward) backward = flip == problem.options.flip.end() ? lay.backward : !lay.backward;
        match.loops[s] = {static_cast<int>(s), t, !lay.backward};
        const auto second = std::find_if(
            found.begin(), found.end(), [&](const Lay& other) { return differ(source, target, lay, other); });
        if (by_length(source, target)) {
            vertices[s] = pair_by_length(problem, match, lay, s, static_cast<std::size_t>(t));
        } else {
            const std::size_t k = source.vertices.size();
            for (std::size_t i = 0; i < k; ++i) {
                const std::size_t j = lay.backward ? (lay.shift + k - i) % k : (lay.shift + i) % k;
                vertices[s].emplace_back(source.vertices[i], target.vertices[j]);
            }
        }
        // One hard pair settles all of a loop.
        const bool guessed = std::none_of(source.vertices.begin(), source.vertices.end(),
                                          [&](VertexId v) { return problem.hard.contains(v); });
        if (second != found.end() && guessed) {
            // The pairs of the loops may have been chosen for their shapes, and not be the best by where they land.
            const double ratio = std::min(1.0, std::max(lay.score, 1e-12) / std::max(second->score, 1e-12));
            match.confidence = std::min(match.confidence, 1 - ratio);
            if (1 - ratio < kUnsure) note_candidates(problem, s, t, lay, *second, match);
        }
        const std::vector<Vec3> a = source_samples(source, target);
        const std::vector<Vec3> b = target_samples(source, target, lay.shift, lay.backward);
        from.insert(from.end(), a.begin(), a.end());
        to.insert(to.end(), b.begin(), b.end());
    }
    for (std::size_t s = 0; s < n; ++s) {
        for (const auto& pair : vertices[s]) {
            match.vertices.push_back(pair);
            const auto known = problem.hard.find(pair.first);
            match.hard.push_back(known != problem.hard.end() && known->second == pair.second);
        }
    }
}

/// The paper's own way.
void by_nearest(const Problem& problem, Match& match)
{
    NearestInput input{match.source_loops,
                       match.target_loops,
                       problem.hard,
                       problem.forced,
                       std::vector<bool>(problem.source.size(), false),
                       problem.backward};
    for (const int s : problem.options.flip) input.turned[static_cast<std::size_t>(s)] = true;
    NearestMatch found = match_nearest(problem.volume.model, input);
    match.loops = std::move(found.loops);
    match.vertices = std::move(found.vertices);
    match.confidence = found.confidence;
    match.notes = std::move(found.notes);
    for (const auto& pair : match.vertices) match.hard.push_back(problem.hard.contains(pair.first));
}

/// Numbers as the recipe counts them, from 1.
std::string numbers(const std::vector<int>& list)
{
    std::string text;
    for (const int i : list) text += (text.empty() ? "" : ", ") + std::to_string(i + 1);
    return text;
}

std::string loops_in_words(std::size_t count)
{
    return std::to_string(count) + (count == 1 ? " loop" : " loops");
}

} // namespace

Match match(const OpenVolume& volume, const MatchOptions& options)
{
    const Model& model = volume.model;
    Match result;
    result.method = options.method == Method::nearest ? "nearest" : "aligned";
    result.source_loops = rims(model, volume.faces(Role::source));
    result.target_loops = rims(model, volume.faces(Role::target));
    if (result.source_loops.empty() || result.target_loops.empty()) {
        const bool source = result.source_loops.empty();
        throw NotClosed("matching.no_rim",
                        std::string("the ") + (source ? "source" : "target") +
                            " has no rim to match: it is missing, or it is a closed surface");
    }
    if (result.source_loops.size() != result.target_loops.size()) {
        throw NotClosed("matching.loop_counts",
                        "the source has " + loops_in_words(result.source_loops.size()) +
                            " and the target has " + loops_in_words(result.target_loops.size()) +
                            "; a sweep needs as many on both ends: check the roles, or leave out the faces "
                            "that close a loop");
    }
    Problem problem{volume, options, {}, {}, {}, {}, {}};
    for (const Rim& rim : result.source_loops) problem.source.push_back(shape_of(model, rim));
    for (const Rim& rim : result.target_loops) problem.target.push_back(shape_of(model, rim));
    problem.forced.assign(problem.source.size(), -1);
    read_walls(problem);
    read_options(problem);
    if (options.method == Method::nearest) {
        by_nearest(problem, result);
        return result;
    }

    const std::vector<Arrangement> found = arrange(problem);
    if (found.empty()) {
        throw NotClosed("matching.no_pairs", "no pairing of the loops keeps what walls and recipe fix; check "
                                             "match{ loops = …, vertices = … }");
    }
    result.loops.resize(problem.source.size());
    for (std::size_t s = 0; s < result.loops.size(); ++s) result.loops[s].target = found.front().target[s];
    const bool open = std::find(problem.forced.begin(), problem.forced.end(), -1) != problem.forced.end();
    if (open && found.size() > 1) {
        result.confidence = 1 - std::max(found[0].score, 1e-12) / std::max(found[1].score, 1e-12);
        if (result.confidence < kUnsure) {
            result.notes.push_back("the source's loops were sent, in their order, to target loops " +
                                   numbers(found[0].target) + ", and " + numbers(found[1].target) +
                                   " fits about as well; choose with match{ loops = … }");
        }
    }
    pair_vertices(problem, result, found.front());
    return result;
}

} // namespace lacuna::matching
