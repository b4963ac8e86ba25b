// SPDX-License-Identifier: GPL-2.0-or-later
#include <lacuna/cad_worker/import_cad.h>

#include <lacuna/cad_worker/detail/cad_facets.h>
#include <lacuna/cad_worker/detail/gmsh_api.h>
#include <lacuna/cad_worker/detail/narrow_sides.h>
#include <lacuna/cad_worker/detail/solid_file.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/default_labels.h>
#include <lacuna/core/shared/limits.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>

namespace lacuna::cad_worker {

namespace {

/// Number of facets around a full turn. The sag is then 0.2 % of the radius, and the area of a disc is off by
/// 0.3 %.
constexpr double kSidesPerTurn = 48;
/// Longest segment, relative to the diagonal.
constexpr double kLongestSide = 1.0 / 20;
/// Limit on the grid cells of all faces together. The limit for each face is an equal share, but lies between
/// the two other values.
constexpr double kMaxCells = 400'000;
constexpr double kMaxCellsOfFace = 16'000;
constexpr double kMinCellsOfFace = 100;

void import_file(Session& session, const OpenedFile& file)
{
    using File = cad_protocol::LoadFile;
    const CapturedOutput output;
    try {
        session.run([&] {
            if (file.format == File::script) return gmsh::merge(file.at);
            const char* format = file.format == File::brep   ? "brep"
                                 : file.format == File::step ? "step"
                                                             : "iges";
            import_shapes(file.at, format);
        });
    } catch (const BackendError& error) {
        const std::string words = output.text();
        throw InvalidInput("cad.unreadable", "{}{}", error.message().parts(),
                           words.empty() ? "" : formatted(" ({})", words));
    }
}

double diagonal_of_model()
{
    double x0 = 0, y0 = 0, z0 = 0, x1 = 0, y1 = 0, z1 = 0;
    gmsh::model::getBoundingBox(-1, -1, x0, y0, z0, x1, y1, z1);
    return (Vec3(x1, y1, z1) - Vec3(x0, y0, z0)).norm();
}

/// The label of an entity in the file, without those that CAD systems give by default.
std::string label_of(int dimension, int tag)
{
    // Gmsh names a face of a product "Shapes/assembly/part/face".
    std::string name;
    gmsh::model::getEntityName(dimension, tag, name);
    name.erase(0, name.find_last_of('/') + 1);
    return is_default_label(name) ? std::string() : name;
}

/// The name of an entity's physical group, else its own.
std::string name_of(int dimension, int tag)
{
    std::vector<int> groups;
    gmsh::model::getPhysicalGroupsForEntity(dimension, tag, groups);
    for (const int group : groups) {
        std::string name;
        gmsh::model::getPhysicalName(dimension, std::abs(group), name);
        if (!name.empty()) return name;
    }
    return label_of(dimension, tag);
}

struct Cut {
    std::vector<CadFacets> faces;
    std::size_t point_count = 0;
};

/// Faces removed from the wire.
struct LeftOut {
    std::vector<CadFaceInfo> faces; ///< faces that could not be triangulated
    std::vector<int> slivers;       ///< tags of faces that are slivers
};

/// Completes the sentence "face 6 …".
constexpr const char* kNotCut = "could not be triangulated: its boundary crosses itself or is open";

/// Visit the edges of one side of a face in the wire, in order.
template <class Visit>
void each_edge(const CadWire& wire, const CadFaceInfo::Side& side, const Visit& visit)
{
    for (const std::size_t piece : wire.curves[side.curve].pieces) visit(wire.pieces[piece].edge);
}

/// Whether the curves around a face coincide in pairs within the tolerance, so that the face has no interior.
/// A sphere with a single seam, or a lune between two meridians, is not a sliver.
bool is_sliver(const CadWire& wire, const CadFaceInfo& face)
{
    std::unordered_map<std::size_t, int> uses;
    for (const CadFaceInfo::Side& side : face.sides) {
        if (side.uses > 1) return false;
        each_edge(wire, side, [&](std::size_t edge) { ++uses[edge]; });
    }
    return std::ranges::all_of(uses, [](const auto& use) { return use.second % 2 == 0; });
}

/// Place points on all edges, `refinement` times as many as the fineness requires.
void divide_all(CadWire& wire, const Fineness& fineness, std::vector<double>& refinement)
{
    refinement.assign(wire.edges.size(), 1.0);
    divide(wire, fineness, refinement);
    refinement = narrow_refinement(wire);
    if (std::ranges::any_of(refinement, [](double times) { return times > 1; }))
        divide(wire, fineness, refinement);
}

/// Remove faces from the wire. @throw BackendError  no face remains.
void leave_out(CadWire& wire, const std::vector<int>& tags, const std::string& path, LeftOut& gone)
{
    for (const int tag : tags) {
        const auto face = std::ranges::find(wire.faces, tag, &CadFaceInfo::tag);
        if (is_sliver(wire, *face))
            gone.slivers.push_back(tag);
        else
            gone.faces.push_back(std::move(*face));
        wire.faces.erase(face);
    }
    if (wire.faces.empty())
        throw BackendError(
            Message("cad.face_failed", "{}: {} {}", path, NamedEntity{"face", tags.front()}, kNotCut)
                .remedy("repair it in the CAD system"));
}

/// Divide the edges and triangulate the faces. Boundaries that intersect themselves are divided more finely.
/// Faces that still fail are removed from the wire.
Cut cut_all(CadWire& wire, FacetOptions options, const std::string& path, const Progress& progress,
            LeftOut& gone)
{
    std::vector<double> refinement;
    divide_all(wire, options.fineness, refinement);
    options.max_cells = std::clamp(kMaxCells / static_cast<double>(wire.faces.size()), kMinCellsOfFace,
                                   kMaxCellsOfFace);
    for (int division = 1;; ++division) {
        Cut cut;
        cut.point_count = wire.points.size();
        std::vector<int> failed, slivers;
        for (const CadFaceInfo& face : wire.faces) {
            auto facets = cut_into_facets(wire, face, options, static_cast<Index>(cut.point_count));
            if (!facets) {
                failed.push_back(face.tag);
                if (is_sliver(wire, face)) slivers.push_back(face.tag);
                for (const CadFaceInfo::Side& side : face.sides) {
                    each_edge(wire, side, [&](std::size_t edge) {
                        refinement[edge] = std::max(2 * refinement[edge], static_cast<double>(1 << division));
                    });
                }
                continue;
            }
            cut.point_count += facets->added.size();
            cut.faces.push_back(std::move(*facets));
            progress(static_cast<double>(cut.faces.size()) / static_cast<double>(wire.faces.size()));
        }
        if (failed.empty()) return cut;
        if (slivers.empty() && division < kMostSteps) {
            divide(wire, options.fineness, refinement);
            if (wire.points.size() <= kMaxCells) continue;
        }
        // Start again with coarse edges, because the faces that needed fine edges are gone.
        leave_out(wire, slivers.empty() ? failed : slivers, path, gone);
        divide_all(wire, options.fineness, refinement);
        division = 0;
    }
}

/// The solids and their faces, without those that were left out.
std::vector<cad_protocol::LoadReply::Solid> solids(const CadWire& wire)
{
    std::map<int, Index> place; // by tag
    for (std::size_t f = 0; f < wire.faces.size(); ++f) place[wire.faces[f].tag] = static_cast<Index>(f);
    std::vector<cad_protocol::LoadReply::Solid> found;
    for (const int tag : tags_of(3)) {
        std::vector<int> up, down;
        gmsh::model::getAdjacencies(3, tag, up, down);
        cad_protocol::LoadReply::Solid& solid = found.emplace_back();
        solid.tag = tag;
        solid.name = name_of(3, tag);
        for (const int face : down)
            if (const auto known = place.find(std::abs(face)); known != place.end())
                solid.faces.push_back(known->second);
    }
    return found;
}

/// Report the faces left out. @return for each edge of the wire, the faces left out that have this edge.
std::vector<std::vector<Index>> tell_left_out(const CadWire& wire, const LeftOut& gone,
                                              cad_protocol::LoadReply& reply)
{
    std::vector<std::vector<Index>> of_edge(wire.edges.size());
    for (const CadFaceInfo& face : gone.faces) {
        const auto place = static_cast<Index>(reply.left_out.size());
        reply.left_out.push_back({face.tag, kNotCut});
        reply.notes.push_back(
            Message("cad.face_not_cut", "{} {}. It is left out", NamedEntity{"face", face.tag}, kNotCut)
                .remedy("if it is needed, repair it in the CAD system")
                .parts());
        for (const CadFaceInfo::Side& side : face.sides) {
            each_edge(wire, side, [&](std::size_t edge) {
                std::vector<Index>& faces = of_edge[edge];
                if (faces.empty() || faces.back() != place) faces.push_back(place);
            });
        }
    }
    for (const int tag : gone.slivers) {
        reply.notes.push_back(Message("cad.narrow_face", "{} is narrower than the tolerance and is left out",
                                      NamedEntity{"face", tag})
                                  .remedy("to keep it, reduce the tolerance")
                                  .parts());
    }
    return of_edge;
}

cad_protocol::LoadReply reply_of(const CadWire& wire, Cut cut, const LeftOut& gone, CadSource& source)
{
    cad_protocol::LoadReply reply;
    std::vector<std::vector<Index>> left_out = tell_left_out(wire, gone, reply);
    reply.diagonal = source.diagonal;
    reply.points = wire.points;
    reply.vertex_tags = wire.point_tag;
    std::vector<bool> used(wire.edges.size(), false); // whether a face that is not left out uses the edge
    for (const CadFaceInfo& face : wire.faces) {
        for (const CadFaceInfo::Side& side : face.sides)
            each_edge(wire, side, [&](std::size_t edge) { used[edge] = true; });
    }
    for (std::size_t e = 0; e < wire.edges.size(); ++e) {
        if (!used[e]) continue;
        const CadEdge& cad = wire.edges[e];
        const CadPiece& piece = wire.pieces[cad.master];
        const int curve = wire.curves[piece.curve].tag;
        reply.edges.push_back({cad.tag, curve, piece.from, piece.to, cad.params, cad.points,
                               std::move(left_out[e]),
                               plain_form(curve, cad.params.front(), cad.params.back())});
    }
    for (std::size_t f = 0; f < wire.faces.size(); ++f) {
        CadFacets& facets = cut.faces[f];
        const int tag = wire.faces[f].tag;
        source.boxes[tag] = facets.box;
        reply.faces.push_back({tag, name_of(2, tag), std::move(facets.kind), std::move(facets.triangles),
                               std::move(facets.uv)});
        reply.points.insert(reply.points.end(), facets.added.begin(), facets.added.end());
    }
    reply.solids = solids(wire);
    return reply;
}

} // namespace

Imported import_cad(const std::vector<OpenedFile>& files, double tolerance, double scale,
                    const Progress& progress)
{
    Imported imported{std::make_unique<CadSource>(), {}};
    CadSource& source = *imported.source;
    for (const OpenedFile& file : files) source.path += (source.path.empty() ? "" : ", ") + file.path;
    Session session(source.path);
    set_plain_import(session, 1);
    session.set("Geometry.OCCImportLabels", 1);
    source.model = std::make_unique<GmshModel>(session);
    for (const OpenedFile& file : files) {
        progress(0);
        import_file(session, file);
    }
    source.model->activate(session); // a script may have created other models
    session.run([&] {
        if (tags_of(2).empty()) {
            throw InvalidInput(Message("cad.no_faces", "{} contains no faces", source.path)
                                   .remedy("export surfaces or solids, not only curves"));
        }
        source.scale = scale;
        source.diagonal = diagonal_of_model();

        FacetOptions facets;
        facets.tolerance = tolerance > 0 ? tolerance / scale : kFileAccuracy * source.diagonal;
        facets.fineness = {kFullTurn / kSidesPerTurn, kLongestSide * source.diagonal};
        CadWire wire = read_wire(facets.tolerance);
        LeftOut gone;
        Cut cut = cut_all(wire, facets, source.path, progress, gone);
        imported.reply = reply_of(wire, std::move(cut), gone, source);
    });
    return imported;
}

} // namespace lacuna::cad_worker
