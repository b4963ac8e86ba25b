// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/carry_lines.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/surface/shared/default_size.h>
#include <lacuna/surface/shared/edge_nodes.h>
#include <lacuna/surface/shared/imprint.h>
#include <lacuna/surface/shared/linking_surface.h>
#include <lacuna/surface/shared/seeds.h>
#include <lacuna/sweep/detail/turned_round.h>
#include <lacuna/topology/shared/face_parts.h>
#include <lacuna/topology/shared/split_edge.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

namespace lacuna::sweep {

using namespace topology;

namespace {

/// Copies the parts of a split face to a volume in which the face is still whole.
class FaceCopier {
public:
    /// @param whole  the whole face, or its parts if it is already split.
    FaceCopier(const Model& from, std::vector<FaceId> parts, OpenVolume& to, std::vector<FaceId> whole)
        : from_(from), parts_(std::move(parts)), to_(to.model), role_(to.role), whole_(std::move(whole))
    {
    }

    /// Add the vertices on the rim of the parts to the rim of the whole face. @return  whether any was added
    bool copy_vertices()
    {
        const std::size_t before = to_.vertices.size();
        copy_rim();
        return to_.vertices.size() > before;
    }

    /// @return  the parts in the volume with the whole face, in the same order.
    std::vector<FaceId> run()
    {
        copy_rim();
        ModelBuilder to(to_);
        copy_edges(to);
        std::vector<FaceId> copied = copy_faces(to);
        to.build_loops();
        to_ = std::move(to).finish();
        return copied;
    }

private:
    [[noreturn]] void refuse() const
    {
        throw NotSweepable(
            Message("surface.not_imprinted",
                    "{} is shared with a neighbour, but its rim has other points in the two volumes",
                    entity_of(to_, whole_.front()))
                .remedy("divide the edges of both volumes at the same points"));
    }

    [[nodiscard]] std::vector<EdgeId> rim_of_whole() const
    {
        std::vector<EdgeId> edges;
        for (const Rim& rim : rims(to_, whole_)) {
            for (const EdgeUse& use : rim.uses) edges.push_back(use.edge);
        }
        return edges;
    }

    [[nodiscard]] bool is_vertex(const Model& model, Index point) const
    {
        return std::ranges::any_of(model.vertices, [&](const Vertex& v) { return v.point == point; });
    }

    /// Add the points of the parts' rim that the whole face's rim lacks. If a point is a vertex of a part, it
    /// becomes a vertex of the whole face.
    void copy_rim()
    {
        for (const Rim& rim : rims(from_, parts_)) {
            std::vector<Index> walk = loop_points(from_, rim.uses);
            for (const Index p : walk) {
                if (const Index there = on_rim(from_.at(p)); there >= 0) place_[p] = there;
            }
            const auto known = std::ranges::find_if(walk, [&](Index p) { return place_.contains(p); });
            if (known == walk.end()) refuse();
            std::ranges::rotate(walk, known);
            for (std::size_t i = 0; i < walk.size(); ++i) {
                if (!place_.contains(walk[i])) insert(walk, i);
                if (is_vertex(from_, walk[i])) make_vertex(place_.at(walk[i]));
            }
        }
    }

    [[nodiscard]] Index on_rim(const Vec3& p) const
    {
        for (const EdgeId edge : rim_of_whole()) {
            for (const Index q : to_[edge].points)
                if ((to_.at(q) - p).norm() <= near_) return q;
        }
        return -1;
    }

    [[nodiscard]] std::vector<double> arc_of(EdgeId edge) const
    {
        return geometry::arc_lengths(surface::edge_line(to_, edge));
    }

    /// Insert point i of the walk on the rim of the whole face. The point splits the edge from the previous
    /// point of the walk to the next one that the rim already has.
    void insert(const std::vector<Index>& walk, std::size_t i)
    {
        const Index before = place_.at(walk[i - 1]);
        std::size_t k = i + 1;
        while (!place_.contains(walk[k % walk.size()])) ++k;
        const Index after = place_.at(walk[k % walk.size()]);
        const Vec3& p = from_.at(walk[i]);
        for (const EdgeId edge : rim_of_whole()) {
            const std::vector<Index>& points = to_[edge].points;
            for (std::size_t s = 0; s + 1 < points.size(); ++s) {
                const bool along = points[s] == before && points[s + 1] == after;
                if (!along && !(points[s] == after && points[s + 1] == before)) continue;
                const std::vector<double> arc = arc_of(edge);
                const double low = (p - to_.at(points[s])).norm(), high = (p - to_.at(points[s + 1])).norm();
                const double at = arc[s] + low / (low + high) * (arc[s + 1] - arc[s]);
                const EdgeSplit made = split_edge(to_, edge, at / arc.back());
                ModelBuilder to(std::move(to_));
                place_[walk[i]] = to[made.vertex].point;
                to.points[index(to[made.vertex].point)] = p;
                if (const auto param = param_of(walk[i], to[edge].curve))
                    to[edge].params.back() = to[made.behind].params.front() = *param;
                to_ = std::move(to).finish();
                return;
            }
        }
        refuse();
    }

    /// The parameter of a vertex on a curve; empty if no edge with this curve ends there.
    [[nodiscard]] std::optional<double> param_of(
        Index point, const std::shared_ptr<const geometry::ExactCurve>& curve) const
    {
        for (const Edge& edge : from_.edges) {
            if (curve == nullptr || edge.curve != curve) continue;
            if (edge.points.back() == point) return edge.params.back();
            if (edge.points.front() == point) return edge.params.front();
        }
        return std::nullopt;
    }

    void make_vertex(Index point)
    {
        if (is_vertex(to_, point)) return;
        for (const EdgeId edge : rim_of_whole()) {
            const std::vector<Index>& points = to_[edge].points;
            const auto at = std::ranges::find(points, point);
            if (at == points.end()) continue;
            const std::vector<double> arc = arc_of(edge);
            split_edge(to_, edge, arc[static_cast<std::size_t>(at - points.begin())] / arc.back());
            return;
        }
    }

    Index place_of(ModelBuilder& to, Index point)
    {
        const auto [found, fresh] = place_.try_emplace(point, static_cast<Index>(to.points.size()));
        if (fresh) to.points.push_back(from_.at(point));
        return found->second;
    }

    VertexId vertex_of(ModelBuilder& to, VertexId vertex)
    {
        const Index point = place_of(to, from_[vertex].point);
        for (std::size_t v = 0; v < to.vertices.size(); ++v)
            if (to.vertices[v].point == point) return VertexId(v);
        return to.add_void_vertex(point);
    }

    /// Copy the edges between parts.
    void copy_edges(ModelBuilder& to)
    {
        const auto is_part = [&](const FaceUse& use) {
            return std::ranges::find(parts_, use.face) != parts_.end();
        };
        for (std::size_t e = 0; e < from_.edges.size(); ++e) {
            const std::span<const FaceUse> uses = from_.uses_of_edge(EdgeId(e));
            if (uses.size() != 2 || uses[0].face == uses[1].face) continue;
            if (!is_part(uses[0]) || !is_part(uses[1])) continue;
            const Edge& edge = from_.edges[e];
            std::vector<Index> points;
            for (const Index p : edge.points) points.push_back(place_of(to, p));
            const VertexId start = vertex_of(to, edge.from), end = vertex_of(to, edge.to);
            const EdgeId made = to.add_void_edge(start, end, std::move(points));
            to[made].params = edge.params;
            to[made].curve = edge.curve;
        }
    }

    std::vector<FaceId> copy_faces(ModelBuilder& to)
    {
        const Vec3 area = area_vector_of(from_, parts_);
        const bool turned = area.dot(face_area_vector(to, whole_.front())) < 0;
        const Face before = to[whole_.front()];
        std::vector<FaceId> copied;
        for (const FaceId part : parts_) {
            Face face = before;
            face.triangles = from_[part].triangles;
            face.uv = from_[part].uv;
            for (std::size_t t = 0; t < face.triangles.size(); ++t) {
                for (Index& p : face.triangles[t]) p = place_of(to, p);
                if (!turned) continue;
                std::swap(face.triangles[t][1], face.triangles[t][2]);
                if (!face.uv.empty()) std::swap(face.uv[t][1], face.uv[t][2]);
            }
            if (copied.empty()) {
                copied.push_back(whole_.front());
                to[whole_.front()] = std::move(face);
                continue;
            }
            copied.emplace_back(to.faces.size());
            to.faces.push_back(std::move(face));
            role_.push_back(role_[whole_.front().index()]);
        }
        return copied;
    }

    const Model& from_;
    std::vector<FaceId> parts_;
    Model& to_;
    std::vector<Role>& role_;
    std::vector<FaceId> whole_;
    const double near_ = from_.tolerance;
    std::map<Index, Index> place_; ///< point in the other volume for each point of the parts
};

class LineCarrier {
public:
    LineCarrier(std::span<const AssemblyMember> members, std::span<OpenVolume> volumes,
                const RunContext& context)
        : members_(members),
          volumes_(volumes),
          context_(context),
          known_(members.size()),
          pairs_(members.size())
    {
    }

    std::vector<std::string> run()
    {
        share_vertices();
        bool changed = true;
        // In each round, every volume copies lines from one end to the other, so lines can pass through a
        // stack of as many volumes as there are rounds.
        for (int round = 0; changed; ++round) {
            if (round == kMostRounds)
                throw NotSweepable(
                    Message("sweep.lines_go_round",
                            "the lines inside the ends of these volumes cannot be imprinted on "
                            "their neighbours: after {} rounds, every line still requires "
                            "another line",
                            kMostRounds)
                        .remedy("divide the volumes so that neighbours share whole faces"));
            changed = false;
            for (std::size_t m = 0; m < volumes_.size(); ++m) {
                check_cancelled(context_);
                if (split_end(m, Role::source)) changed = true;
                if (split_end(m, Role::target)) changed = true;
            }
        }
        std::vector<std::string> report;
        for (const std::size_t m : split_)
            report.push_back(
                formatted("imprinted: ends of {} are split along lines that go on through their neighbours",
                          members_[m].region));
        return report;
    }

private:
    /// Give shared faces the same vertices on their rims in both volumes.
    void share_vertices()
    {
        const auto copy = [&](std::size_t from, FaceId face, std::size_t to, FaceId there) {
            if (!FaceCopier(volumes_[from].model, {face}, volumes_[to], {there}).copy_vertices())
                return false;
            split_.insert(to);
            return true;
        };
        for (bool changed = true; changed;) {
            changed = false;
            check_cancelled(context_);
            for (const SharedFace& face : shared_) {
                if (copy(face.a, face.face_a, face.b, face.face_b)) changed = true;
                if (copy(face.b, face.face_b, face.a, face.face_a)) changed = true;
            }
        }
    }

    /// Split an end that is shared with other members along the inner lines of the opposite end.
    bool split_end(std::size_t m, Role end)
    {
        OpenVolume volume = end == Role::source ? volumes_[m] : turned_round(volumes_[m]);
        if (surface::inner_edges(volume, Role::target).empty()) return false;
        bool is_shared = false;
        surface::ImprintedLines lines = surface::ImprintedLines::all;
        for (const SharedFace& face : shared_)
            for (const auto& [own, at, other, there] :
                 {std::tuple(face.a, face.face_a, face.b, face.face_b),
                  std::tuple(face.b, face.face_b, face.a, face.face_a)}) {
                if (own != m || volume.role[at.index()] != Role::source) continue;
                is_shared = true;
                // A closed line does not divide the rows of a wall: the sweep follows sides of its quads.
                if (volumes_[other].role[there.index()] == Role::wall) lines = surface::ImprintedLines::open;
            }
        if (!is_shared) return false;
        surface::SizeField size = members_[m].options.size;
        if (!size) size = surface::even_size(surface::default_size(volume).length);
        const std::vector<surface::KnownLine> known = known_lines(m, end);
        surface::Imprint imprint = surface::imprint_target(
            volume, surface::linking_surfaces(volume, surface::Turning::each, known_pairs(m, end, volume)),
            size, known, lines);
        if (imprint.volume->model.faces.size() == volume.model.faces.size()) return false;
        keep_images(m, end, imprint);
        split_.insert(m);
        volumes_[m] = end == Role::source ? std::move(*imprint.volume)
                                          : turned_round(std::move(*imprint.volume));
        std::map<FaceId, std::vector<FaceId>> parts;
        for (std::size_t f = 0; f < imprint.source_of.size(); ++f)
            parts[imprint.source_of[f]].emplace_back(f);
        const std::vector<SharedFace> before = std::exchange(shared_, {});
        for (const SharedFace& face : before) hand_on(m, face, parts);
        share_vertices();
        return true;
    }

    static void swap_ends(surface::KnownLine& line)
    {
        std::swap(line.source, line.target);
        std::swap(line.source_from, line.target_from);
        std::swap(line.source_to, line.target_to);
    }

    /// Corresponding lines and vertices on both ends of a member. The end that is to be split takes the place
    /// of the source.
    [[nodiscard]] std::vector<surface::KnownLine> known_lines(std::size_t m, Role end) const
    {
        std::vector<surface::KnownLine> lines = known_[m];
        if (end == Role::source) return lines;
        for (surface::KnownLine& line : lines) swap_ends(line);
        return lines;
    }

    [[nodiscard]] std::vector<surface::RimPair> known_pairs(std::size_t m, Role end,
                                                            const OpenVolume& volume) const
    {
        const auto on_rim = [&](Role role) {
            std::set<VertexId> met;
            for (const Rim& rim : rims(volume.model, volume.faces(role))) {
                for (const EdgeUse& use : rim.uses) met.insert(use_from(volume.model, use));
            }
            return met;
        };
        const std::set<VertexId> source = on_rim(Role::source), target = on_rim(Role::target);
        std::vector<surface::RimPair> pairs;
        for (surface::RimPair pair : pairs_[m]) {
            if (end == Role::target) std::swap(pair.source, pair.target);
            if (source.contains(pair.source) && target.contains(pair.target)) pairs.push_back(pair);
        }
        return pairs;
    }

    void keep_images(std::size_t m, Role end, const surface::Imprint& imprint)
    {
        const Model& model = imprint.volume->model;
        for (const auto& [edge, image] : imprint.images) {
            surface::KnownLine line{
                model[edge].points, model[image.target].points, 0, 1, image.from, image.to};
            if (line.source.front() == line.source.back() || line.target.front() == line.target.back())
                continue;
            for (const auto& [vertex, at] :
                 {std::pair(model[edge].from, image.from), std::pair(model[edge].to, image.to)}) {
                if (at != 0 && at != 1) continue;
                surface::RimPair pair{vertex, at == 0 ? model[image.target].from : model[image.target].to};
                if (end == Role::target) std::swap(pair.source, pair.target);
                const auto same = [&](const surface::RimPair& known) {
                    return known.source == pair.source || known.target == pair.target;
                };
                if (std::ranges::none_of(pairs_[m], same)) pairs_[m].push_back(pair);
            }
            if (end == Role::target) swap_ends(line);
            known_[m].push_back(std::move(line));
        }
    }

    void hand_on(std::size_t m, const SharedFace& face, const std::map<FaceId, std::vector<FaceId>>& parts_of)
    {
        const bool is_a = face.a == m, is_b = face.b == m;
        const FaceId own = is_a ? face.face_a : face.face_b;
        const auto parts = parts_of.find(own);
        if ((!is_a && !is_b) || parts == parts_of.end() || parts->second.size() < 2) {
            shared_.push_back(face);
            return;
        }
        const std::size_t other = is_a ? face.b : face.a;
        const FaceId whole = is_a ? face.face_b : face.face_a;
        FaceCopier(volumes_[other].model, {whole}, volumes_[m], parts->second).copy_vertices();
        const std::vector<FaceId> there =
            FaceCopier(volumes_[m].model, parts->second, volumes_[other], {whole}).run();
        split_.insert(other);
        for (std::size_t p = 0; p < there.size(); ++p) {
            const FaceId part = parts->second[p];
            shared_.push_back({face.a, face.b, is_a ? part : there[p], is_a ? there[p] : part});
        }
    }

    std::span<const AssemblyMember> members_;
    std::span<OpenVolume> volumes_;
    const RunContext& context_;
    std::vector<SharedFace> shared_ = shared_faces(members_, context_);
    /// For each member: corresponding lines on its source and its target.
    std::vector<std::vector<surface::KnownLine>> known_;
    std::vector<std::vector<surface::RimPair>> pairs_;
    std::set<std::size_t> split_;
};

} // namespace

std::vector<std::string> carry_lines(std::span<const AssemblyMember> members, std::span<OpenVolume> volumes,
                                     const RunContext& context)
{
    return LineCarrier(members, volumes, context).run();
}

} // namespace lacuna::sweep
