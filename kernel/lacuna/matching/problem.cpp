// SPDX-License-Identifier: MIT
#include <lacuna/matching/detail/problem.h>

#include <lacuna/core/error.h>
#include <lacuna/matching/shared/guides.h>
#include <lacuna/topology/shared/give_mesh.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <set>
#include <string>

namespace lacuna::matching {

using namespace topology;

namespace {

/// Number of the loop with a vertex; -1: none.
int loop_with(const std::vector<LoopShape>& loops, VertexId vertex)
{
    for (std::size_t l = 0; l < loops.size(); ++l) {
        if (std::find(loops[l].vertices.begin(), loops[l].vertices.end(), vertex) != loops[l].vertices.end())
            return static_cast<int>(l);
    }
    return -1;
}

void force(Problem& problem, int s, int t, const std::string& because)
{
    int& now = problem.forced[static_cast<std::size_t>(s)];
    if (now >= 0 && now != t) {
        throw NotClosed("matching.loops_contradict", "source loop " + std::to_string(s + 1) +
                                                         " is paired with target loop " +
                                                         std::to_string(now + 1) + " and, " + because +
                                                         ", with target loop " + std::to_string(t + 1));
    }
    now = t;
}

/// Fix the loops and vertices that walls join.
void read_walls(Problem& problem, const std::vector<SideLine>& lines)
{
    const OpenVolume& volume = problem.volume;
    const Model& model = volume.model;
    for (const SideLine& line : lines) {
        problem.hard[line.source] = problem.walls[line.source] = line.target;
        force(problem, loop_with(problem.source, line.source), loop_with(problem.target, line.target),
              "by its walls");
    }
    for (const std::vector<FaceId>& part : connected_parts(model, volume.faces(Role::wall))) {
        std::vector<int> s, t;
        for (const FaceId face : part) {
            for (const EdgeUse& use : all_uses(model[face])) {
                const int on_s = loop_with(problem.source, use_from(model, use));
                const int on_t = loop_with(problem.target, use_from(model, use));
                if (on_s >= 0 && std::find(s.begin(), s.end(), on_s) == s.end()) s.push_back(on_s);
                if (on_t >= 0 && std::find(t.begin(), t.end(), on_t) == t.end()) t.push_back(on_t);
            }
        }
        if (!s.empty() && !t.empty())
            problem.backward = true; // the rims run in opposite directions, as the walls orient them
        if (s.size() == 1 && t.size() == 1)
            force(problem, s.front(), t.front(), "by " + name_of(model, part.front()));
    }
}

/// Levels between the rims: a bend turns by less than 6° between two.
constexpr int kLevels = 64;

/// Points of loops without walls and their images under the given walls. Rims alone do not fix the rotation
/// of a bend.
PointPairs led_by_walls(const Problem& problem, const std::vector<SideLine>& lines)
{
    const bool bare = std::any_of(problem.source.begin(), problem.source.end(), [&](const LoopShape& loop) {
        return std::none_of(loop.vertices.begin(), loop.vertices.end(),
                            [&](VertexId v) { return problem.on_wall[v.index()]; });
    });
    if (!bare || !problem.backward) return {};
    Sections sections = cut_sections(problem.volume, lines, kLevels, problem.context);
    return {std::move(sections.levels.front()), std::move(sections.levels.back())};
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
        force(problem, s, t, "by match{ loops = … }");
        for (int other = 0; other < static_cast<int>(problem.source.size()); ++other) {
            if (other == s || problem.forced[static_cast<std::size_t>(other)] != t) continue;
            throw NotClosed("matching.loops_contradict",
                            "source loops " + std::to_string(std::min(s, other) + 1) + " and " +
                                std::to_string(std::max(s, other) + 1) +
                                " are both paired with target loop " + std::to_string(t + 1) +
                                "; give each its own in match{ loops = … }");
        }
    }
    for (const auto& [s, t] : problem.options.vertices) {
        const VertexId from = vertex_with_tag(model, problem.source, s, "source");
        const VertexId to = vertex_with_tag(model, problem.target, t, "target");
        const auto known = problem.hard.find(from);
        if (known != problem.hard.end() && known->second != to) {
            throw InvalidInput("matching.vertices_contradict",
                               "vertex " + std::to_string(s) +
                                   (problem.walls.contains(from) ? " is paired by walls"
                                                                 : " is paired by match{ vertices = … }") +
                                   " with vertex " + std::to_string(model[known->second].tag) +
                                   " and cannot be paired with vertex " + std::to_string(t));
        }
        const auto taken = std::find_if(problem.hard.begin(), problem.hard.end(), [&](const auto& pair) {
            return pair.second == to && pair.first != from;
        });
        if (taken != problem.hard.end()) {
            throw InvalidInput(
                "matching.vertices_contradict",
                "vertices " + std::to_string(model[taken->first].tag) + " and " + std::to_string(s) +
                    " of the source cannot both be paired with vertex " + std::to_string(t) +
                    (problem.walls.contains(taken->first) ? ", which walls pair with the first" : ""));
        }
        problem.hard[from] = to;
        force(problem, loop_with(problem.source, from), loop_with(problem.target, to), "by its vertices");
    }
}

/// Loops with given sides throughout, as many on both ends, are measured in sides, so that nodes correspond.
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
    const std::vector<VertexId>& vertices = source[s].vertices;
    return std::any_of(vertices.begin(), vertices.end(), [&](VertexId v) { return hard.contains(v); });
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
