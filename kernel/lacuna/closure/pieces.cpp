// SPDX-License-Identifier: MIT
#include <lacuna/closure/detail/pieces.h>

#include <lacuna/closure/detail/outline.h>
#include <lacuna/closure/shared/straighten_lines.h>
#include <lacuna/core/error.h>
#include <lacuna/core/shared/attempt.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/shared/facet_tree.h>
#include <lacuna/geometry/shared/predicates.h>
#include <lacuna/geometry/shared/union_find.h>
#include <lacuna/topology/auto_roles.h>
#include <lacuna/topology/shared/face_parts.h>
#include <lacuna/topology/shared/face_plane.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <ranges>
#include <set>

namespace lacuna::closure {

using namespace topology;

namespace {

/// A piece, as faces of the common model.
struct Part {
    std::vector<FaceId> skin, partitions;
    std::vector<FaceId> behind; ///< partitions that the piece lies behind
};

class Parter {
public:
    Parter(const PartedVolume& parted, const Subject& tool, const RunContext& context)
        : parted_(parted), model_(parted.volume.model), tool_(tool), context_(context)
    {
    }

    std::vector<StepPiece> run()
    {
        find_parts();
        std::vector<StepPiece> pieces;
        const std::vector<int> level = parted_.stacked ? levels() : std::vector<int>(parts_.size(), 0);
        for (const Part& part : parts_) {
            Roles roles = roles_of(part);
            // Ends of the whole may not be ends of a piece: then those of the piece are to be found.
            if (has_part_without_end(roles) || touches(roles.source, roles.target)) roles = all_walls(part);
            pieces.push_back({open_volume(model_, roles, context_), level[pieces.size()]});
        }
        return pieces;
    }

private:
    void find_parts()
    {
        const std::size_t faces = model_.faces.size();
        geometry::UnionFind sets(faces + 2 * parted_.partitions.size());
        std::set<EdgeId> rims;
        std::vector<char> is_partition(faces, 0);
        for (const Partition& partition : parted_.partitions) {
            is_partition[partition.face.index()] = 1;
            for (const EdgeUse& use : partition.behind) rims.insert(use.edge);
        }
        for (std::size_t e = 0; e < model_.edges.size(); ++e) {
            if (rims.contains(EdgeId(e))) continue;
            std::size_t first = faces;
            for (const FaceUse& use : model_.uses_of_edge(EdgeId(e))) {
                if (is_partition[use.face.index()] != 0) continue;
                if (first != faces) sets.unite_least(first, use.face.index());
                first = use.face.index();
            }
        }
        for (std::size_t p = 0; p < parted_.partitions.size(); ++p) {
            for (const EdgeUse& use : parted_.partitions[p].behind) {
                for (const FaceUse& user : model_.uses_of_edge(use.edge)) {
                    if (is_partition[user.face.index()] != 0) continue;
                    const bool behind = user.reversed == use.reversed;
                    sets.unite(faces + 2 * p + (behind ? 0 : 1), user.face.index());
                }
            }
        }
        std::map<std::size_t, std::size_t> number;
        for (std::size_t p = 0; p < parted_.partitions.size(); ++p) {
            const FaceId face = parted_.partitions[p].face;
            const std::size_t behind = sets.find(faces + 2 * p), before = sets.find(faces + 2 * p + 1);
            if (behind == before) {
                throw NotSweepable(
                    Message("closure.cut_apart",
                            "{}{} cuts the volume open at {}, but the volume stays in one piece", tool_.words,
                            tool_.entity, entity_of(model_, face))
                        .remedy("cut it at another place too, or choose another cut"));
            }
            for (const std::size_t root : {behind, before}) {
                const auto [found, fresh] = number.try_emplace(root, parts_.size());
                if (fresh) parts_.emplace_back();
                parts_[found->second].partitions.push_back(face);
                if (root == behind) parts_[found->second].behind.push_back(face);
            }
        }
        std::map<std::size_t, std::vector<FaceId>> lone;
        for (std::size_t f = 0; f < faces; ++f) {
            if (is_partition[f] != 0) continue;
            const auto found = number.find(sets.find(f));
            if (found != number.end())
                parts_[found->second].skin.emplace_back(f);
            else
                lone[sets.find(f)].emplace_back(f);
        }
        // A part of the skin that touches no partition belongs to the piece that encloses the part. If the
        // pieces are open, as for ends without walls, it belongs to the piece with the largest winding number
        // around it.
        std::vector<std::size_t> home;
        for (const auto& [root, skin] : lone) home.push_back(part_round(skin));
        std::size_t next = 0;
        for (const auto& [root, skin] : lone) {
            std::vector<FaceId>& own = parts_[home[next++]].skin;
            own.insert(own.end(), skin.begin(), skin.end());
        }
    }

    /// Level of each part: the number of pieces in front of it, along the longest chain of pieces. In a ring
    /// of pieces, such as steps on both sides of a shaft, each one lies in front of another.
    [[nodiscard]] std::vector<int> levels() const
    {
        const int most = static_cast<int>(parts_.size()) - 1;
        std::vector<int> levels(parts_.size(), 0);
        const auto raise = [&](std::size_t p, std::size_t other) {
            const int now = std::min(most, levels[other] + 1);
            if (p == other || now <= levels[p] ||
                std::ranges::find_first_of(parts_[p].behind, parts_[other].partitions) ==
                    parts_[p].behind.end())
                return false;
            levels[p] = now;
            return true;
        };
        for (bool changed = true; changed;) {
            changed = false;
            for (std::size_t p = 0; p < parts_.size(); ++p)
                for (std::size_t other = 0; other < parts_.size(); ++other)
                    changed = raise(p, other) || changed;
        }
        return levels;
    }

    [[nodiscard]] std::size_t part_round(const std::vector<FaceId>& skin)
    {
        const Triangle& t = model_[skin.front()].triangles.front();
        const Vec3 p = (model_.at(t[0]) + model_.at(t[1]) + model_.at(t[2])) / 3;
        std::size_t best = 0;
        double most = -1;
        for (std::size_t i = 0; i < parts_.size(); ++i) {
            const Model part = open_volume(model_, all_walls(parts_[i]), context_).model;
            const geometry::FacetTree facets(part.points, facets_of(part, all_faces(part)));
            const double winding = std::abs(facets.winding_number(p));
            if (winding <= most) continue;
            most = winding;
            best = i;
        }
        return best;
    }

    [[nodiscard]] static Roles all_walls(const Part& part)
    {
        Roles roles;
        roles.walls = part.skin;
        roles.walls.insert(roles.walls.end(), part.partitions.begin(), part.partitions.end());
        return roles;
    }

    /// Whether a piece has ends, and a body in it has neither.
    [[nodiscard]] bool has_part_without_end(const Roles& roles) const
    {
        std::vector<FaceId> faces = roles.source;
        faces.insert(faces.end(), roles.target.begin(), roles.target.end());
        if (faces.empty()) return false;
        const std::set<FaceId> ends(faces.begin(), faces.end());
        faces.insert(faces.end(), roles.walls.begin(), roles.walls.end());
        return std::ranges::any_of(connected_parts(model_, faces), [&](const std::vector<FaceId>& part) {
            return std::ranges::none_of(part, [&](FaceId face) { return ends.contains(face); });
        });
    }

    /// Whether some faces share a vertex with other faces.
    [[nodiscard]] bool touches(const std::vector<FaceId>& faces, const std::vector<FaceId>& ends) const
    {
        const std::set<VertexId> met = vertices_of(model_, faces), own = vertices_of(model_, ends);
        return std::ranges::any_of(own, [&](VertexId vertex) { return met.contains(vertex); });
    }

    [[nodiscard]] Roles roles_of(const Part& part) const
    {
        Roles roles;
        for (const FaceId face : part.skin) list_of(roles, parted_.volume.role[face.index()]).push_back(face);
        std::vector<std::vector<FaceId>> across;
        for (std::vector<FaceId>& cut : connected_parts(model_, part.partitions)) {
            // A cut that touches faces of an end in its own plane is part of that end.
            std::vector<FaceId>* const end = goes_on(cut, roles.source)   ? &roles.source
                                             : goes_on(cut, roles.target) ? &roles.target
                                                                          : nullptr;
            if (end != nullptr) {
                end->insert(end->end(), cut.begin(), cut.end());
                continue;
            }
            std::vector<FaceId>* const facing = faced_as(cut, part, roles);
            const auto touch_ends = [&](const std::vector<FaceId>& faces) {
                return touches(faces, roles.source) || touches(faces, roles.target);
            };
            const bool touched = touch_ends(cut);
            if (facing != nullptr && !touched)
                facing->insert(facing->end(), cut.begin(), cut.end());
            else if (touched || (!roles.source.empty() && !roles.target.empty()) ||
                     touch_ends(with_coplanar(cut, roles.walls)))
                roles.walls.insert(roles.walls.end(), cut.begin(), cut.end());
            else
                across.push_back(std::move(cut));
        }
        if (across.empty()) return turned(roles);
        for (std::vector<FaceId>& cut : across) {
            cut = with_coplanar(std::move(cut), roles.walls);
            std::erase_if(roles.walls,
                          [&](FaceId wall) { return std::ranges::find(cut, wall) != cut.end(); });
        }
        if (roles.source.empty() && roles.target.empty() && across.size() == 1) take_end(roles);
        for (std::size_t c = 0; c < across.size(); ++c) {
            const bool first = c == 0 && roles.source.empty();
            std::vector<FaceId>& end = first || (!roles.target.empty() && c == 0) ? roles.source
                                                                                  : roles.target;
            end.insert(end.end(), across[c].begin(), across[c].end());
        }
        return turned(roles);
    }

    [[nodiscard]] bool lies_in_cut(FaceId face) const
    {
        return parted_.plane && lies_in_plane(model_, face, *parted_.plane);
    }

    /// The end that a flat cut belongs to in a piece with both ends: the end with about the same outward
    /// normal. Null if the cut is not perpendicular to the sweep (`kOneCurve`).
    [[nodiscard]] std::vector<FaceId>* faced_as(const std::vector<FaceId>& cut, const Part& part,
                                                Roles& roles) const
    {
        if (!parted_.plane || roles.source.empty() || roles.target.empty()) return nullptr;
        const Vec3 area = area_vector_of(model_, roles.source);
        const bool behind = std::ranges::find(part.behind, cut.front()) != part.behind.end();
        const double along = (behind ? 1 : -1) * parted_.plane->normal.dot(area) / area.norm();
        if (along > kOneCurve) return &roles.source;
        return along < -kOneCurve ? &roles.target : nullptr;
    }

    /// Whether a cut touches faces of an end that lie in the plane of the cut.
    [[nodiscard]] bool goes_on(const std::vector<FaceId>& cut, const std::vector<FaceId>& end) const
    {
        return std::ranges::any_of(end,
                                   [&](FaceId face) { return lies_in_cut(face) && touches(cut, {face}); });
    }

    /// A cut together with the walls in its plane that are connected to it, such as a shoulder. All of them
    /// get the same role.
    [[nodiscard]] std::vector<FaceId> with_coplanar(std::vector<FaceId> cut,
                                                    const std::vector<FaceId>& walls) const
    {
        std::vector<FaceId> both = cut;
        std::ranges::copy_if(walls, std::back_inserter(both), [&](FaceId wall) { return lies_in_cut(wall); });
        for (std::vector<FaceId>& end : connected_parts(model_, both))
            if (std::ranges::find(end, cut.front()) != end.end()) return std::move(end);
        return cut;
    }

    [[nodiscard]] Roles turned(Roles roles) const
    {
        if (parted_.volume.turned_round) std::swap(roles.source, roles.target);
        return roles;
    }

    /// Choose an end among the walls, if exactly one end can be found among them.
    void take_end(Roles& roles) const
    {
        for (const RoleCandidate& candidate : role_candidates(model_, roles.walls, {}, context_)) {
            const bool source = !candidate.roles.source.empty(), target = !candidate.roles.target.empty();
            if (source == target) continue;
            roles.target = source ? candidate.roles.source : candidate.roles.target;
            roles.walls = candidate.roles.walls;
            return;
        }
    }

    const PartedVolume& parted_;
    const Model& model_;
    const Subject& tool_;
    const RunContext& context_;
    std::vector<Part> parts_;
};

} // namespace

WalkImprint imprint(OpenVolume& volume, const std::vector<SectionWalk>& walks, const geometry::Plane& plane,
                    const RunContext& context)
{
    ModelBuilder model(std::move(volume.model));
    WalkImprint made = imprint_walks(model, walks, plane, model.tolerance, context);
    volume.model = std::move(model).finish();
    for (std::size_t f = volume.role.size(); f < made.parent.size(); ++f)
        volume.role.push_back(volume.role[made.parent[f].index()]);
    return made;
}

std::vector<StepPiece> pieces_of(const PartedVolume& parted, const Subject& tool, const RunContext& context)
{
    return Parter(parted, tool, context).run();
}

std::vector<StepPiece> cut_each(std::vector<StepPiece> pieces, const geometry::Plane& plane,
                                const std::function<std::vector<StepPiece>(const OpenVolume&)>& cut,
                                const Eigen::AlignedBox3d* reach)
{
    const auto is_crossed = [&](const Model& model) {
        bool below = false, above = false;
        Eigen::AlignedBox3d box;
        for (const Vec3& p : model.points) {
            const double height = geometry::height(plane, p);
            (height < 0 ? below : above) |= std::abs(height) > model.tolerance;
            box.extend(p);
        }
        return below && above &&
               (reach == nullptr || box.squaredExteriorDistance(*reach) <= model.tolerance * model.tolerance);
    };
    std::vector<StepPiece> result;
    for (StepPiece& piece : pieces) {
        if (!is_crossed(piece.volume.model)) {
            result.push_back(std::move(piece));
            continue;
        }
        auto parts = attempt<NotSweepable>([&] { return cut(piece.volume); });
        if (parts)
            std::ranges::move(*parts, std::back_inserter(result));
        else if (parts.why->code() == "closure.cut_misses")
            result.push_back(std::move(piece));
        else
            parts.raise();
    }
    return result;
}

std::vector<std::vector<std::size_t>> regions_of(const std::vector<std::vector<Vec2>>& loops)
{
    std::vector<std::vector<std::size_t>> round(loops.size()); // by loop: the loops it lies in
    for (std::size_t i = 0; i < loops.size(); ++i) {
        for (std::size_t o = 0; o < loops.size(); ++o)
            if (i != o && geometry::encloses(loops[o], loops[i])) round[i].push_back(o);
    }
    std::vector<std::vector<std::size_t>> regions;
    for (std::size_t i = 0; i < loops.size(); ++i) {
        if (round[i].size() % 2 != 0) continue;
        std::vector<std::size_t>& region = regions.emplace_back(1, i);
        for (std::size_t h = 0; h < loops.size(); ++h) {
            if (round[h].size() == round[i].size() + 1 && std::ranges::find(round[h], i) != round[h].end())
                region.push_back(h);
        }
    }
    return regions;
}

void straighten_lines(Model& model, const std::vector<FaceId>& parts, const geometry::Plane& plane,
                      const std::vector<std::vector<EdgeUse>>& lines, const RunContext& context,
                      const std::function<bool(const Vec3&)>& keeps)
{
    ModelBuilder builder(std::move(model));
    for (const EdgeUse& use : lines | std::views::join) {
        Edge& edge = builder[use.edge];
        std::vector<Index> kept{edge.points.front()};
        for (std::size_t i = 1; keeps && i + 1 < edge.points.size(); ++i)
            if (keeps(builder.at(edge.points[i]))) kept.push_back(edge.points[i]);
        kept.push_back(edge.points.back());
        edge.points = std::move(kept);
        edge.params.clear();
        edge.curve = nullptr;
    }
    for (const FaceId id : parts) {
        Face& part = builder[id];
        std::map<Index, Vec2> uv;
        for (std::size_t t = 0; t < part.uv.size(); ++t)
            for (std::size_t k = 0; k < 3; ++k) uv[part.triangles[t][k]] = part.uv[t][k];
        Outline outline;
        for (const Loop& loop : part.loops) {
            const std::vector<Index> rim = loop_points(builder, loop.uses);
            outline.add_loop(flat_places(plane, places_at(builder, rim)), rim);
        }
        const geometry::Triangulation made = geometry::triangulate(outline.flat, outline.loops,
                                                                   {.interior_points = false}, context);
        part.triangles = filling_of(builder, outline, made, [](std::size_t) { return Vec3(); }).triangles;
        part.uv.clear();
        if (uv.empty()) continue;
        for (const Triangle& t : part.triangles) part.uv.push_back({uv.at(t[0]), uv.at(t[1]), uv.at(t[2])});
    }
    builder.build_loops(context);
    model = std::move(builder).finish();
}

std::string partition_name(const Model& model)
{
    int number = 1;
    for (const Face& face : model.faces) {
        if (face.name.starts_with("cut_"))
            number = std::max(number, std::atoi(face.name.c_str() + 4) + 1); // 0 if no number follows
    }
    return formatted("cut_{}", number);
}

FaceId add_partition(Model& model, const std::vector<std::vector<EdgeUse>>& loops,
                     const geometry::Plane& plane, const std::string& name, const RunContext& context)
{
    Outline outline;
    for (const std::vector<EdgeUse>& loop : loops)
        outline.add_loop(flat_places(plane, loop_places(model, loop)), loop_points(model, loop));
    if (geometry::find_crossing(outline.flat, outline.loops))
        throw NotSweepable(
            Message("closure.cut_touches", "{} would run along faces that are nearly in its plane", name)
                .remedy("cut the volume by another plane, with cut{{ plane = … }}"));
    const geometry::Triangulation made = geometry::triangulate(outline.flat, outline.loops,
                                                               {.interior_points = false}, context);
    ModelBuilder builder(std::move(model));
    const FaceId face = builder.add_void_face(Geometry::newell);
    builder[face].name = name;
    builder[face].triangles = filling_of(builder, outline, made, [](std::size_t) {
                                  return Vec3();
                              }).triangles;
    model = std::move(builder).finish();
    return face;
}

} // namespace lacuna::closure
