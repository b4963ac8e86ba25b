// SPDX-License-Identifier: MIT
#include <lacuna/view/page.h>

#include <lacuna/closure/shared/model_facts.h>
#include <lacuna/core/message.h>
#include <lacuna/topology/shared/use_places.h>
#include <lacuna/view/detail/base64.h>
#include <lacuna/view/detail/page_file.h>

#include <algorithm>
#include <array>
#include <optional>
#include <ranges>

namespace lacuna::view {

namespace {

using topology::Model;
using topology::Origin;

const char* word(topology::Role role)
{
    return role == topology::Role::source ? "source" : role == topology::Role::target ? "target" : "walls";
}

const char* word(topology::Geometry geometry)
{
    // In the order of the enumerators.
    constexpr const char* kWords[] = {"given",
                                      "flat",
                                      "between its sides",
                                      "a strip between two loops",
                                      "following the given walls",
                                      "parallel to the other end"};
    static_assert(std::size(kWords) == static_cast<std::size_t>(topology::Geometry::parallel) + 1);
    return kWords[static_cast<std::size_t>(geometry)];
}

/// Quads and triangles of all faces, grouped by face, given quads first.
struct Sides {
    std::vector<Index> corners;
    std::vector<std::size_t> first, quads, count; ///< for each face
};

Sides sides_of(const Model& model)
{
    Sides sides;
    const auto add = [&](const auto& cell) {
        for (std::size_t k = 0; k < 4; ++k) sides.corners.push_back(cell[std::min(k, cell.size() - 1)]);
    };
    for (const topology::Face& face : model.faces) {
        sides.first.push_back(sides.corners.size() / 4);
        for (const Quad& quad : face.given_quads) add(quad);
        sides.quads.push_back(face.given_quads.size());
        for (const Triangle& triangle : topology::loose_triangles(face)) add(triangle);
        sides.count.push_back(sides.corners.size() / 4 - sides.first.back());
    }
    return sides;
}

auto tags(const Model& model, const std::vector<FaceId>& faces)
{
    return faces | std::views::transform([&](FaceId face) { return model[face].tag; });
}

/// Write the data by which a user recognises a face: its box, its neighbours, and the cylinder or sphere on
/// which it lies.
void add_facts(Json& json, const Model& model, const topology::FaceFacts& facts,
               const std::optional<topology::RoundShape>& round)
{
    if (!facts.box.isEmpty()) json.member("low", facts.box.min()).member("high", facts.box.max());
    json.member("neighbours", tags(model, facts.neighbours));
    if (!round) return;
    json.member("fits", round->is_sphere() ? "sphere" : "cylinder").member("radius", round->radius);
    if (round->axis) json.member("axis", *round->axis);
}

void add_face(Json& json, const Model& model, FaceId id, const Sides& sides, const char* role)
{
    const topology::Face& face = model[id];
    const Vec3 centre = topology::face_centroid(model, id);
    const double area = topology::face_area(model, id);
    const Vec3 normal = topology::face_area_vector(model, id);
    double reach = 0;
    for (const Triangle& triangle : face.triangles)
        for (const Index point : triangle) reach = std::max(reach, (model.at(point) - centre).norm());
    const std::size_t f = id.index();
    json.member("tag", face.tag).member("name", face.name).member("kind", face.kind);
    json.member("area", area).member("centre", centre).member("reach", reach);
    json.member("normal", area > 0 ? Vec3(normal / area) : Vec3(Vec3::Zero()));
    json.member("loops", face.loops.size()).member("groups", face.groups);
    std::vector<std::string> regions;
    for (const auto& names : face.regions)
        if (!names.empty()) regions.push_back(names.front());
    json.member("regions", regions);
    json.member("void", face.origin == Origin::made_void).member("geometry", word(face.geometry));
    json.key("role").value(role);
    json.member("first", sides.first[f]).member("quads", sides.quads[f]).member("sides", sides.count[f]);
    std::vector<std::size_t> edges; // a seam appears twice
    for (const topology::EdgeUse& use : uses_of(face)) edges.push_back(use.edge.index());
    json.member("edges", edges);
}

void add_edges(Json& json, const Model& model)
{
    std::vector<Index> points;
    json.key("edges").begin_array();
    for (const topology::Edge& edge : model.edges) {
        json.begin_object().member("tag", edge.tag).member("void", edge.origin == Origin::made_void);
        json.member("from", edge.from.index()).member("to", edge.to.index());
        json.member("first", points.size()).member("points", edge.points.size()).end_object();
        points.insert(points.end(), edge.points.begin(), edge.points.end());
    }
    json.end_array().member("edgePointCount", points.size()).member("edgePoints", pack(points, 1));
    json.key("vertices").begin_array();
    for (const topology::Vertex& vertex : model.vertices)
        json.begin_object().member("tag", vertex.tag).member("point", vertex.point).end_object();
    json.end_array();
}

void add_gaps(Json& json, const Model& model, const std::vector<topology::Gap>& gaps)
{
    json.key("gaps").begin_array();
    for (const topology::Gap& gap : gaps) {
        json.begin_object().member("edges", std::array{gap.own.index(), gap.other.index()});
        json.member("width", gap.width);
        json.member("tolerance", topology::sewing_tolerance(model, gap)).end_object();
    }
    json.end_array();
}

void add_cavities(Json& json, const Model& model, const std::vector<closure::Cavity>& cavities)
{
    json.key("cavities").begin_array();
    for (const closure::Cavity& cavity : cavities) {
        json.begin_object().member("kind", cavity.kind).member("volume", cavity.volume);
        json.member("class", std::string(topology::to_string(cavity.value)));
        json.member("faces", tags(model, cavity.faces)).end_object();
    }
    json.end_array();
}

/// @param roles  of each face of a volume; null: a model, whose faces are to be selected.
void write_faces(const Model& model, const closure::ModelFacts& found,
                 const std::vector<topology::Role>* roles, const std::vector<std::string>& facts,
                 const io::OutputPath& path, const PageOptions& options, const RunContext& context)
{
    Eigen::AlignedBox3d box;
    for (const topology::Face& face : model.faces)
        for (const Triangle& triangle : face.triangles)
            for (const Index point : triangle) box.extend(model.at(point));
    const Grid grid = grid_over(box);
    std::vector<Vec3> points = model.points;
    for (Vec3& point : points)
        point = point.cwiseMax(box.min()).cwiseMin(box.max()); // unused points may lie outside

    Json json;
    json.begin_object().member("kind", "faces");
    json.member("title", options.title.empty() ? model.source : options.title).member("path", options.path);
    std::vector<std::string> notes;
    for (const Message& note : model.notes) notes.push_back(note.text());
    json.member("facts", facts).member("notes", notes);
    add_frame(json, grid);
    add_nodes(json.key("nodes"), grid, points, 1);
    const Sides sides = sides_of(model);
    json.member("sideCount", sides.corners.size() / 4).member("sides", pack(sides.corners, 4));
    json.key("faces").begin_array();
    for (std::size_t f = 0; f < model.faces.size(); ++f) {
        check_cancelled(context);
        const FaceId id(f);
        json.begin_object();
        add_face(json, model, id, sides, roles != nullptr ? word((*roles)[f]) : nullptr);
        add_facts(json, model, found.faces[f], found.round[f]);
        if (roles == nullptr) json.member("use", closure::use_of(found, id));
        json.end_object();
    }
    json.end_array();
    add_edges(json, model);
    add_gaps(json, model, found.gaps);
    add_cavities(json, model, found.cavities);
    json.end_object();
    write_html(json, path);
}

} // namespace

void write_page(const Model& model, const io::OutputPath& path, const PageOptions& options,
                const RunContext& context)
{
    write_faces(model, closure::model_facts(model, context), nullptr,
                {formatted("{} faces", model.faces.size())}, path, options, context);
}

void write_page(const topology::OpenVolume& volume, const io::OutputPath& path, const PageOptions& options,
                const RunContext& context)
{
    const std::vector<EdgeId> free = topology::free_edges(volume);
    std::vector<std::string> facts{formatted("{} faces", volume.model.faces.size())};
    const bool source_alone = volume.faces(topology::Role::source).size() == volume.model.faces.size();
    if (free.empty())
        facts.emplace_back("sealed");
    else
        facts.push_back(
            formatted("class {}", topology::to_string(source_alone ? topology::VolumeClass::zero
                                                                   : topology::classify(volume).value)));
    closure::ModelFacts found;
    found.faces = topology::face_facts(volume.model);
    for (std::size_t f = 0; f < volume.model.faces.size(); ++f)
        found.round.push_back(topology::round_shape(volume.model, FaceId(f)));
    write_faces(volume.model, found, &volume.role, facts, path, options, context);
}

} // namespace lacuna::view
