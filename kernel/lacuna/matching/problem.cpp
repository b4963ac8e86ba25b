// SPDX-License-Identifier: MIT
#include <lacuna/matching/detail/problem.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/matching/shared/guides.h>
#include <lacuna/topology/shared/face_parts.h>
#include <lacuna/topology/shared/give_mesh.h>
#include <lacuna/topology/shared/names_of.h>

#include <algorithm>
#include <ranges>
#include <set>

namespace lacuna::matching {

using namespace topology;

namespace {

/// Finds the loop that contains a vertex.
class LoopsAt {
public:
    explicit LoopsAt(const std::vector<LoopShape>& loops)
    {
        for (std::size_t l = 0; l < loops.size(); ++l)
            for (const VertexId vertex : loops[l].vertices) loop_.try_emplace(vertex, static_cast<int>(l));
    }
    /// @return  index of the loop; -1: none
    [[nodiscard]] int operator()(VertexId vertex) const
    {
        const auto loop = loop_.find(vertex);
        return loop == loop_.end() ? -1 : loop->second;
    }

private:
    std::map<VertexId, int> loop_;
};

void force(Problem& problem, int s, int t, const Argument& because)
{
    int& now = problem.forced[static_cast<std::size_t>(s)];
    if (now >= 0 && now != t) {
        throw NotClosed(Message("matching.loops_contradict", "{} is paired with {} and, by {}, also with {}",
                                source_loop(s), target_loop(now), because, target_loop(t))
                            .remedy("leave one of these pairs out"));
    }
    now = t;
}

/// Fix the loops and vertices that walls join.
void read_walls(Problem& problem, const std::vector<SideLine>& lines)
{
    const OpenVolume& volume = problem.volume;
    const Model& model = volume.model;
    const LoopsAt source(problem.source), target(problem.target);
    for (const SideLine& line : lines) {
        problem.hard[line.source] = problem.walls[line.source] = line.target;
        force(problem, source(line.source), target(line.target), "its walls");
    }
    for (const std::vector<FaceId>& part : connected_parts(model, volume.faces(Role::wall))) {
        std::set<int> s, t;
        for (const VertexId vertex : vertices_of(model, part)) {
            s.insert(source(vertex));
            t.insert(target(vertex));
        }
        s.erase(-1);
        t.erase(-1);
        if (!s.empty() && !t.empty())
            problem.backward = true; // walls orient the faces so that the rims of both ends run in opposite
                                     // directions
        if (s.size() == 1 && t.size() == 1)
            force(problem, *s.begin(), *t.begin(), entity_of(model, part.front()));
    }
}

/// Points of the first section through the given walls, and the corresponding points of the last section.
/// They determine the rotation of loops without walls; in a bend, the rims alone do not. Empty if every
/// source loop has a wall, or if no wall joins the ends.
PointPairs led_by_walls(const Problem& problem, const std::vector<SideLine>& lines)
{
    const bool bare = std::ranges::any_of(problem.source, [&](const LoopShape& loop) {
        return std::ranges::none_of(loop.vertices, [&](VertexId v) { return problem.on_wall[v.index()]; });
    });
    if (!bare || !problem.backward) return {};
    Sections sections = cut_sections(problem.volume, lines, problem.context);
    return {std::move(sections.levels.front()), std::move(sections.levels.back())};
}

VertexId vertex_with_tag(const Model& model, const std::vector<LoopShape>& loops, int tag, const char* end)
{
    const auto vertices = loops | std::views::transform(&LoopShape::vertices) | std::views::join;
    const auto tag_of = [&](VertexId v) { return model[v].tag; };
    if (const auto found = std::ranges::find(vertices, tag, tag_of); found != vertices.end()) return *found;
    throw InvalidInput(
        Message("matching.unknown_vertex", "{} is not on the rim of the {}", NamedEntity{"vertex", tag}, end)
            .remedy("name one of its vertices: {}", entities_of(model, vertices)));
}

void read_options(Problem& problem)
{
    const Model& model = problem.volume.model;
    for (const int s : problem.options.flip) {
        if (s >= 0 && s < static_cast<int>(problem.source.size())) continue;
        throw InvalidInput(Message("matching.unknown_loop",
                                   "option 'flip' names {}, but the loops are numbered from 1 to {}",
                                   source_loop(s), needed(problem.source.size()))
                               .remedy("name loops of volume:match().loops"));
    }
    for (const auto& [s, t] : problem.options.loops) {
        if (s < 0 || t < 0 || s >= static_cast<int>(problem.source.size()) ||
            t >= static_cast<int>(problem.target.size())) {
            throw InvalidInput(Message("matching.unknown_loop",
                                       "loop pair {{{}, {}}}: the loops are numbered from 1 to {}",
                                       found(s + 1), found(t + 1), needed(problem.source.size()))
                                   .remedy("name loops of volume:match().loops"));
        }
        force(problem, s, t, "match{ loops = … }");
        for (int other = 0; other < static_cast<int>(problem.source.size()); ++other) {
            if (other == s || problem.forced[static_cast<std::size_t>(other)] != t) continue;
            throw NotClosed(Message("matching.loops_contradict", "{} and {} are both paired with {}",
                                    source_loop(std::min(s, other)), source_loop(std::max(s, other)),
                                    target_loop(t))
                                .remedy("pair each with a different loop in match{{ loops = … }}"));
        }
    }
    for (const auto& [s, t] : problem.options.vertices) {
        const VertexId from = vertex_with_tag(model, problem.source, s, "source");
        const VertexId to = vertex_with_tag(model, problem.target, t, "target");
        const auto known = problem.hard.find(from);
        if (known != problem.hard.end() && known->second != to) {
            throw InvalidInput(Message("matching.vertices_contradict",
                                       "{} is paired by {} with {} and cannot be paired with {}",
                                       entity_of(model, from),
                                       problem.walls.contains(from) ? "walls" : "match{ vertices = … }",
                                       entity_of(model, known->second), entity_of(model, to))
                                   .remedy("leave this pair out of 'vertices'"));
        }
        const auto taken = std::ranges::find_if(
            problem.hard, [&](const auto& pair) { return pair.second == to && pair.first != from; });
        if (taken != problem.hard.end()) {
            throw InvalidInput(
                Message("matching.vertices_contradict",
                        "{} and {} of the source cannot both be paired with {}{}",
                        entity_of(model, taken->first), entity_of(model, from), entity_of(model, to),
                        problem.walls.contains(taken->first) ? ", which walls pair with the first" : "")
                    .remedy("leave one of these pairs out of 'vertices'"));
        }
        problem.hard[from] = to;
        force(problem, LoopsAt(problem.source)(from), LoopsAt(problem.target)(to), "its vertices");
    }
}

/// Measure the loops in sides (count_by_sides()), so that nodes correspond, if all edges of all loops have
/// given sides and the loops of both ends have the same numbers of sides.
void count_given_sides(Problem& problem)
{
    const auto sides_of = [](const std::vector<LoopShape>& loops) {
        std::vector<std::size_t> sides;
        for (const LoopShape& loop : loops) sides.push_back(given_sides(loop));
        std::ranges::sort(sides);
        return sides;
    };
    const std::vector<std::size_t> sides = sides_of(problem.source);
    if (sides.empty() || sides.front() == 0 || sides != sides_of(problem.target)) return;
    for (LoopShape& loop : problem.source) count_by_sides(loop);
    for (LoopShape& loop : problem.target) count_by_sides(loop);
}

} // namespace

bool Problem::has_hard(std::size_t s) const
{
    return std::ranges::any_of(source[s].vertices, [&](VertexId v) { return hard.contains(v); });
}

PointPairs Problem::led_near(std::size_t s) const
{
    const std::size_t most = kNearLoops * kFineChords;
    if (led.from.size() <= most) return led;
    std::vector<std::pair<double, std::size_t>> near;
    for (std::size_t p = 0; p < led.from.size(); ++p)
        near.emplace_back((led.from[p] - source[s].centroid).squaredNorm(), p);
    std::ranges::nth_element(near, near.begin() + static_cast<std::ptrdiff_t>(most));
    PointPairs pairs;
    for (std::size_t k = 0; k < most; ++k) {
        pairs.from.push_back(led.from[near[k].second]);
        pairs.to.push_back(led.to[near[k].second]);
    }
    return pairs;
}

Problem problem_of(const OpenVolume& volume, const MatchOptions& options, Match& match,
                   const RunContext& context)
{
    Problem problem{volume, options, context, {}, {}, {}, {}, {}, {}, {}, {}, {}};
    problem.on_wall = volume.on_wall();
    const std::set<EdgeId> kept = kept_edges(volume.model);
    for (const Rim& rim : match.source_loops) problem.source.push_back(shape_of(volume.model, rim, kept));
    for (const Rim& rim : match.target_loops) problem.target.push_back(shape_of(volume.model, rim, kept));
    count_given_sides(problem);
    problem.forced.assign(problem.source.size(), -1);
    match.side_lines = side_lines(volume, context);
    read_walls(problem, *match.side_lines);
    problem.led = led_by_walls(problem, *match.side_lines);
    read_options(problem);
    return problem;
}

} // namespace lacuna::matching
