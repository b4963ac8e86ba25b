// SPDX-License-Identifier: MIT
#include <lacuna/surface/shared/boundary_layers.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/surface/detail/face_sides.h>
#include <lacuna/surface/shared/edge_nodes.h>
#include <lacuna/topology/shared/facet_area.h>
#include <lacuna/topology/shared/select_faces.h>

#include <algorithm>
#include <cmath>

namespace lacuna::surface {

using namespace topology;

namespace {

std::string void_name(const Face& face) { return formatted("void:{}", face.tag); }

bool is_tagged(const Face& face, int tag) { return face.origin == Origin::given && face.tag == tag; }

bool is_named(const OpenVolume& volume, FaceId id, const std::string& name)
{
    const Face& face = volume.model[id];
    const Role role = volume.role[id.index()];
    if (name == "walls") return role == Role::wall;
    if ((name == "source" && role == Role::source) || (name == "target" && role == Role::target)) return true;
    return face.origin == Origin::made_void ? name == void_name(face) : topology::is_called(face, name);
}

class RimReader {
public:
    RimReader(const OpenVolume& volume, const LayerTables& tables)
        : volume_(volume), model_(volume.model), tables_(tables)
    {
        rows_.heights = tables.heights;
    }

    RimRows read(std::span<const LinkingSurface> links)
    {
        std::set<FaceId> reached;
        for (const LinkingSurface& link : links) {
            for (const RimSegment& segment : link.segments) {
                const EdgeId edge = link.source.uses()[segment.use].edge;
                const FaceId low = wall_on(volume_, edge),
                             high = wall_on(volume_, target_use(link, segment).edge);
                const FaceId wall = tables_.at(low) < 0 && tables_.at(high) >= 0 ? high : low;
                const auto [from, to] = edge_part(link, segment);
                rows_.parts[edge].push_back({from, to, tables_.at(wall), wall});
                reached.insert({low, high});
            }
        }
        // A wall that touches no rim is accepted if all walls have the same table: its rows continue those of
        // the walls between it and the rim.
        const std::vector<FaceId> walls = volume_.faces(Role::wall);
        for (const auto& [wall, table] : tables_.of) {
            const auto has_table = [&, table = table](FaceId other) { return tables_.at(other) == table; };
            if (volume_.role[wall.index()] != Role::wall || reached.contains(wall) ||
                std::ranges::all_of(walls, has_table))
                continue;
            throw NotSweepable(
                Message("surface.layers_unreached",
                        "{} has boundary layers but touches neither source nor target",
                        entity_of(model_, wall))
                    .remedy("add the wall below or above it to 'boundary_layers', or all walls with "
                            "walls = \"walls\""));
        }
        for (const FaceId face : volume_.faces(Role::source)) find_ends(face);
        return std::move(rows_);
    }

private:
    void find_ends(FaceId face)
    {
        for (const Loop& loop : border_loops(model_, face)) {
            const std::size_t n = loop.uses.size();
            for (std::size_t i = 0; i < n && n > 1; ++i) {
                const EdgeUse before = loop.uses[(i + n - 1) % n], after = loop.uses[i];
                const double angle = inner_angle(model_, face, loop, i);
                if (angle >= kCornerBelow) continue;
                add_end(face, before, after, true);
                add_end(face, after, before, false);
            }
        }
    }

    /// Record that the rows along the edge `with` end on the edge `on`.
    /// @param behind  whether `on` follows `with` in the loop; false: it precedes `with`.
    void add_end(FaceId face, EdgeUse with, EdgeUse on, bool behind)
    {
        const RimRows::Part* part = rows_.part_at(with.edge, with.reversed != behind ? 1.0 : 0.0);
        if (part == nullptr || part->table < 0) return;
        const std::vector<Index> points = use_points(model_, with);
        const Vec3 along = behind ? model_.at(points.back()) - model_.at(points[points.size() - 2])
                                  : model_.at(points[1]) - model_.at(points[0]);
        RimRows::End end;
        end.table = part->table;
        end.wall = part->wall;
        end.along = with.edge;
        end.corner = behind ? use_to(model_, with) : use_from(model_, with);
        end.inward = normal_at(face, model_[end.corner].point).cross(along).normalized();
        end.over = normal_at(end.wall, model_[end.corner].point);
        if (end.over.dot(end.inward) < 0) end.over = -end.over;
        const bool at_end = behind ? on.reversed : !on.reversed;
        const auto [found, fresh] = rows_.ends.try_emplace({on.edge, at_end}, end);
        if (fresh || found->second.table == end.table) return;
        throw NotSweepable(Message("surface.layers_meet",
                                   "boundary layers of {} and of {} differ and both end on {} at {}",
                                   entity_of(model_, found->second.wall), entity_of(model_, end.wall),
                                   entity_of(model_, on.edge), entity_of(model_, end.corner))
                               .remedy("give both walls the same table"));
    }

    [[nodiscard]] Vec3 normal_at(FaceId face, Index point) const
    {
        Vec3 normal = Vec3::Zero();
        for (const Triangle& t : model_[face].triangles) {
            if (std::ranges::find(t, point) == t.end()) continue;
            normal += facet_area_vector(model_, t);
        }
        return normal.stableNormalized();
    }

    const OpenVolume& volume_;
    const Model& model_;
    const LayerTables& tables_;
    RimRows rows_;
};

constexpr int kMostRows = 1000; // heuristic: the cost of fitting rows to each other is quadratic

/// @throw NotSweepable "surface.layers_room"  the rows are thicker than the volume, or thinner than the
///         tolerance.
/// @throw InvalidInput "sweep.too_many"  there are too many rows.
void check_room(const Model& model, const BoundaryLayer& layer)
{
    if (layer.count > kMostRows) {
        throw InvalidInput("sweep.too_many", "sweep: option 'boundary_layers' asks for {} rows; {} at most",
                           found(layer.count), needed(kMostRows));
    }
    const double height = row_heights(layer).back();
    if (!(height <= model.diagonal))
        throw NotSweepable(Message("surface.layers_room",
                                   "sweep: option 'boundary_layers' asks for {} rows from {:.3g} with growth "
                                   "{:.3g}, {:.3g} high in total, but the volume is only {:.3g} across",
                                   layer.count, layer.first, layer.growth, found(height),
                                   needed(model.diagonal))
                               .remedy("use fewer or thinner rows"));
    const double thinnest = std::min(layer.first, layer.first * std::pow(layer.growth, layer.count - 1));
    if (!(thinnest > model.tolerance))
        throw NotSweepable(Message("surface.layers_room",
                                   "sweep: option 'boundary_layers' asks for {} rows from {:.3g} with growth "
                                   "{:.3g}, the thinnest {:.3g}, below the model's tolerance of {:.3g}",
                                   layer.count, layer.first, layer.growth, found(thinnest),
                                   needed(model.tolerance))
                               .remedy("use fewer or thicker rows"));
}

} // namespace

std::vector<double> row_heights(const BoundaryLayer& layer)
{
    std::vector<double> heights;
    double thickness = layer.first, height = 0;
    for (int i = 0; i < layer.count; ++i, thickness *= layer.growth) heights.push_back(height += thickness);
    return heights;
}

bool has_face(const OpenVolume& volume, int tag)
{
    return std::ranges::any_of(volume.model.faces, [&](const Face& face) { return is_tagged(face, tag); });
}

FaceId wall_on(const OpenVolume& volume, EdgeId edge)
{
    for (const FaceUse& use : volume.model.uses_of_edge(edge)) {
        if (volume.role[use.face.index()] == Role::wall) return use.face;
    }
    return {};
}

bool has_face(const OpenVolume& volume, const std::string& name)
{
    return std::ranges::any_of(all_faces(volume.model),
                               [&](FaceId face) { return is_named(volume, face, name); });
}

std::vector<FaceId> faces_named(const OpenVolume& volume, const FaceNames& names, const std::string& option)
{
    const std::vector<FaceId> all = all_faces(volume.model);
    std::set<FaceId> found;
    const auto add = [&](const Argument& what, const auto& is_it, bool leave_inner = false) {
        bool any = false;
        for (const FaceId face : all) {
            if (!is_it(face)) continue;
            any = true;
            if (!leave_inner || !names.inner.contains(face)) found.insert(face);
        }
        if (any) return;
        throw InvalidInput(Message("surface.no_such_face",
                                   "sweep: option '{}' names {}, which the volume does not have", option,
                                   what)
                               .remedy("volume:tree() lists its faces; void face 2 is \"void:2\""));
    };
    for (const int tag : names.tags) {
        add(NamedEntity{"face", tag}, [&](FaceId f) { return is_tagged(volume.model[f], tag); });
    }
    for (const std::string& name : names.names)
        add(
            formatted("\"{}\"", name), [&](FaceId f) { return is_named(volume, f, name); }, name == "walls");
    return {found.begin(), found.end()};
}

LayerTables layer_tables(const OpenVolume& volume, std::span<const BoundaryLayer> layers)
{
    LayerTables tables;
    for (const BoundaryLayer& layer : layers) {
        for (const FaceId face : faces_named(volume, layer.walls, "boundary_layers")) {
            if (tables.of.try_emplace(face, static_cast<int>(tables.heights.size())).second) continue;
            throw InvalidInput(Message("surface.two_layers",
                                       "sweep: option 'boundary_layers' contains {} in two tables",
                                       entity_of(volume.model, face))
                                   .remedy("name it in one"));
        }
        check_room(volume.model, layer);
        tables.heights.push_back(row_heights(layer));
    }
    return tables;
}

const RimRows::Part* RimRows::part_at(EdgeId edge, double fraction) const
{
    const auto found = parts.find(edge);
    if (found == parts.end()) return nullptr;
    // Take the nearest part: because of rounding, there may be small gaps between the parts.
    return &*std::ranges::min_element(found->second, {}, [&](const Part& part) {
        return std::max(part.from - fraction, fraction - part.to);
    });
}

RimRows rim_rows(const OpenVolume& volume, std::span<const LinkingSurface> links, const LayerTables& tables)
{
    const bool any = std::ranges::any_of(
        tables.of, [&](const auto& entry) { return volume.role[entry.first.index()] == Role::wall; });
    return any ? RimReader(volume, tables).read(links) : RimRows{};
}

std::vector<double> row_places(const Model& model, EdgeId edge, bool at_end, const RimRows::End& end,
                               std::span<const double> heights)
{
    const std::vector<Vec3> line = edge_line(model, edge);
    const std::vector<double> arc = geometry::arc_lengths(line);
    const Vec3& corner = model.at(model[end.corner].point);
    std::vector<double> places;
    const std::size_t sides = line.size() - 1;
    double below = 0;
    for (std::size_t k = 0; k < sides && places.size() < heights.size(); ++k) {
        const std::size_t from = at_end ? sides - k : k, to = at_end ? from - 1 : from + 1;
        const double above = (line[to] - corner).dot(end.inward);
        while (places.size() < heights.size() && above >= heights[places.size()] && above > below) {
            const double share = (heights[places.size()] - below) / (above - below);
            places.push_back((arc[from] + share * (arc[to] - arc[from])) / arc.back());
        }
        below = above;
    }
    if (at_end) std::ranges::reverse(places);
    return places;
}

} // namespace lacuna::surface
