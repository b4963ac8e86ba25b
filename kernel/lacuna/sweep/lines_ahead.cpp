// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/lines_ahead.h>

#include <lacuna/surface/shared/edge_nodes.h>
#include <lacuna/surface/shared/imprint.h>
#include <lacuna/topology/shared/face_parts.h>

#include <algorithm>
#include <ranges>
#include <utility>

namespace lacuna::sweep {

using namespace topology;

std::vector<LineAhead> lines_ahead(const SameEdges& edges, const std::function<double(std::size_t)>& sides_of)
{
    std::vector<LineAhead> ahead;
    std::vector<std::vector<std::size_t>> shared_by(edges.members().size());
    for (std::size_t f = 0; f < edges.shared().size(); ++f) {
        shared_by[edges.shared()[f].a].push_back(f);
        shared_by[edges.shared()[f].b].push_back(f);
    }
    const auto add_line = [&](const EdgeUse& use, std::size_t m, std::size_t other, EdgeId line) {
        const MemberEdge &rim = edges[edges.number(m, use.edge)], &edge = edges[edges.number(other, line)];
        if (rim.closed) return;
        const Vec3 along = rim.to - rim.from;
        LineAhead part{edges.number(m, use.edge), 1, 0, edge.length / sides_of(edges.number(other, line))};
        for (const Vec3& p : surface::edge_line(edges.model(other), line)) {
            const double share = (p - rim.from).dot(along) / along.squaredNorm();
            part.from = std::min(part.from, share);
            part.to = std::max(part.to, share);
        }
        ahead.push_back(part);
    };
    const auto role_of = [&](std::size_t m, FaceId face) {
        return edges.members()[m].volume->role[face.index()];
    };
    const auto opposite = [](Role end) { return end == Role::source ? Role::target : Role::source; };
    // Lines in the stack of members behind the face: a member's quads go on through all of them.
    const auto add = [&](std::size_t m, FaceId face) {
        std::vector<std::pair<std::size_t, Role>> stack{{m, opposite(role_of(m, face))}};
        for (std::size_t next = 0; next < stack.size(); ++next) {
            const auto [behind, end] = stack[next];
            const OpenVolume& volume = *edges.members()[behind].volume;
            const auto lines = surface::closed_lines(volume, end, surface::inner_edges(volume, end));
            for (const EdgeUse& line : lines | std::views::join)
                for (const Loop& loop : border_loops(edges.model(m), face))
                    for (const EdgeUse& use : loop.uses) add_line(use, m, behind, line.edge);
            for (const std::size_t f : shared_by[behind]) {
                const SharedFace& shared = edges.shared()[f];
                const bool is_a = shared.a == behind;
                if (role_of(behind, is_a ? shared.face_a : shared.face_b) != end) continue;
                const std::size_t other = is_a ? shared.b : shared.a;
                const Role there = role_of(other, is_a ? shared.face_b : shared.face_a);
                const std::pair next_end{other, opposite(there)};
                if (there != Role::wall && std::ranges::find(stack, next_end) == stack.end())
                    stack.push_back(next_end);
            }
        }
    };
    for (const SharedFace& face : edges.shared()) {
        const bool a = edges.is_wall(face.a, face.face_a), b = edges.is_wall(face.b, face.face_b);
        if (a && !b) add(face.b, face.face_b);
        if (b && !a) add(face.a, face.face_a);
    }
    return ahead;
}

} // namespace lacuna::sweep
