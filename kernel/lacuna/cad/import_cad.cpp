// SPDX-License-Identifier: GPL-2.0-or-later
#include <lacuna/cad/detail/import_cad.h>

#include <lacuna/cad/detail/cad_facets.h>
#include <lacuna/cad/detail/gmsh_api.h>
#include <lacuna/healing/orient_groups.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <numbers>
#include <unordered_map>

namespace lacuna::cad {

namespace {

/// Facets to a full turn. The chord then misses the arc by 0.2 % of the radius, a disc 0.3 % of its area.
constexpr double kSidesPerTurn = 48;
/// No side is longer than this part of the diagonal.
constexpr double kLongestSide = 1.0 / 20;
/// Cells all faces may have together, and any one of them.
constexpr double kMaxCells = 400'000;
constexpr double kMaxCellsOfFace = 16'000;
constexpr double kMinCellsOfFace = 100;
/// How often borders are divided anew, twice as fine, where they cross themselves.
constexpr int kDivisions = 6;

std::string joined(const std::vector<std::string>& paths)
{
    std::string all;
    for (const std::string& path : paths) all += (all.empty() ? "" : ", ") + path;
    return all;
}

/// The first of a file, where its kind is written.
std::string head_of(const std::string& path)
{
    std::ifstream file(path, std::ios::binary);
    std::string head(4096, '\0');
    file.read(head.data(), static_cast<std::streamsize>(head.size()));
    head.resize(static_cast<std::size_t>(file.gcount()));
    return head;
}

[[noreturn]] void throw_not_of_kind(const std::string& path, const std::string& kind)
{
    throw InvalidInput("cad.unreadable", path + " does not hold what its ending promises: this is no " +
                                             kind +
                                             " file; check the file, or give it the ending of what it holds");
}

/// Open CASCADE is asked only about files that begin as they should.
void check_head(const std::string& path, const std::string& ending)
{
    const std::string head = head_of(path);
    if (ending == ".step" || ending == ".stp") {
        if (head.find("ISO-10303-21") == std::string::npos) throw_not_of_kind(path, "STEP");
    } else if (ending == ".iges" || ending == ".igs") {
        // Every line of an IGES file has its section's letter in column 73.
        if (head.size() < 73 || (head[72] != 'S' && head[72] != 'C' && head[72] != 'B'))
            throw_not_of_kind(path, "IGES");
    } else if (ending == ".brep") {
        if (head.find("CASCADE Topology") == std::string::npos &&
            head.find("DBRep_DrawableShape") == std::string::npos) {
            throw_not_of_kind(path, "BREP");
        }
    }
}

/// Tags and coordinates must be those of a plain import, whatever the host has set.
void set_import_defaults(Session& session)
{
    for (const char* off :
         {"Geometry.OCCFixDegenerated", "Geometry.OCCFixSmallEdges", "Geometry.OCCFixSmallFaces",
          "Geometry.OCCSewFaces", "Geometry.OCCMakeSolids", "Geometry.OCCBoundsUseStl"}) {
        session.set(off, 0);
    }
    session.set("Geometry.OCCScaling", 1);
    session.set("Geometry.OCCAutoFix", 1);
    session.set("Geometry.OCCImportLabels", 1);
    session.set("Geometry.OCCTargetUnit", std::string{});
}

/// Options that scripts are wont to set, which would outlast them.
void keep_options(Session& session)
{
    for (const char* option : {"Mesh.MeshSizeMin",
                               "Mesh.MeshSizeMax",
                               "Mesh.MeshSizeFactor",
                               "Mesh.MeshSizeFromCurvature",
                               "Mesh.MeshSizeFromPoints",
                               "Mesh.MeshSizeExtendFromBoundary",
                               "Mesh.Algorithm",
                               "Mesh.Algorithm3D",
                               "Mesh.ElementOrder",
                               "Mesh.RecombineAll",
                               "Mesh.RecombinationAlgorithm",
                               "Mesh.SubdivisionAlgorithm",
                               "Mesh.Smoothing",
                               "Mesh.Optimize",
                               "Mesh.OptimizeNetgen",
                               "Mesh.SaveAll",
                               "Mesh.Binary",
                               "Mesh.MshFileVersion",
                               "Geometry.Tolerance",
                               "Geometry.AutoCoherence",
                               "General.Terminal",
                               "General.Verbosity",
                               "General.NumThreads"}) {
        session.keep(option);
    }
}

void import_file(Session& session, const std::string& path)
{
    const std::string ending = io::ending_of(path);
    check_head(path, ending);
    const bool script = ending == ".geo" || ending == ".geo_unrolled";
    const std::string format = ending == ".brep" ? "brep" : ending.starts_with(".st") ? "step" : "iges";
    const CapturedOutput output;
    try {
        session.run([&] {
            if (script) {
                keep_options(session);
                return gmsh::merge(path);
            }
            gmsh::vectorpair all;
            gmsh::model::occ::importShapes(path, all, false, format);
            gmsh::model::occ::synchronize();
        });
    } catch (const BackendError& error) {
        const std::string words = output.text();
        throw InvalidInput("cad.unreadable",
                           std::string(error.what()) + (words.empty() ? "" : " (" + words + ")"));
    }
}

double diagonal_of_model()
{
    double x0 = 0, y0 = 0, z0 = 0, x1 = 0, y1 = 0, z1 = 0;
    gmsh::model::getBoundingBox(-1, -1, x0, y0, z0, x1, y1, z1);
    return (Vec3(x1, y1, z1) - Vec3(x0, y0, z0)).norm();
}

std::string name_of_face(int tag)
{
    std::vector<int> groups;
    gmsh::model::getPhysicalGroupsForEntity(2, tag, groups);
    for (const int group : groups) {
        std::string name;
        gmsh::model::getPhysicalName(2, std::abs(group), name);
        if (!name.empty()) return name;
    }
    // A product's face is called "Shapes/assembly/part/face".
    std::string name;
    gmsh::model::getEntityName(2, tag, name);
    return name.substr(name.find_last_of('/') + 1);
}

struct Cut {
    std::vector<CadFacets> faces;
    std::size_t point_count = 0;
};

/// Divide the edges and cut the faces, finer around those whose border crosses itself.
Cut cut_all(CadWire& wire, FacetOptions options, const std::string& path, const RunContext& context)
{
    std::vector<double> refinement(wire.edges.size(), 1.0);
    options.max_cells = std::clamp(kMaxCells / static_cast<double>(wire.faces.size()), kMinCellsOfFace,
                                   kMaxCellsOfFace);
    for (int division = 1;; ++division) {
        divide(wire, options.fineness, refinement);
        Cut cut;
        cut.point_count = wire.points.size();
        const CadFaceInfo* failed = nullptr;
        for (const CadFaceInfo& face : wire.faces) {
            check_cancelled(context);
            auto facets = cut_into_facets(wire, face, options, static_cast<Index>(cut.point_count));
            if (!facets) {
                failed = &face;
                for (const CadFaceInfo::Side& side : face.sides) {
                    for (const std::size_t p : wire.curves[side.curve].pieces)
                        refinement[wire.pieces[p].edge] = 1 << division;
                }
                continue;
            }
            cut.point_count += facets->added.size();
            cut.faces.push_back(std::move(*facets));
            if (context.progress) {
                context.progress("load", static_cast<double>(cut.faces.size()) /
                                             static_cast<double>(wire.faces.size()));
            }
        }
        if (failed == nullptr) return cut;
        if (division == kDivisions) {
            throw BackendError(
                "cad.face_failed",
                path + ": face " + std::to_string(failed->tag) +
                    " could not be cut into facets: its boundary crosses itself or does not close; "
                    "repair the face in the CAD system");
        }
    }
}

void add_edges(topology::Model& model, const CadWire& wire, const std::shared_ptr<const CadSource>& source)
{
    std::vector<VertexId> vertex_at(wire.point_tag.size());
    for (std::size_t p = 0; p < wire.point_tag.size(); ++p) {
        vertex_at[p] = VertexId(model.vertices.size());
        model.vertices.push_back({static_cast<Index>(p), wire.point_tag[p], topology::Origin::given});
    }
    for (const CadEdge& cad : wire.edges) {
        const CadPiece& piece = wire.pieces[cad.master];
        topology::Edge edge;
        edge.tag = cad.tag;
        edge.from = vertex_at[static_cast<std::size_t>(piece.from)];
        edge.to = vertex_at[static_cast<std::size_t>(piece.to)];
        edge.points = cad.points;
        edge.params = cad.params;
        edge.curve = std::make_shared<CadCurve>(source, wire.curves[piece.curve].tag);
        model.edges.push_back(std::move(edge));
    }
}

/// Leave out points and vertices that no edge and no facet uses, and set the diagonal.
void compact(topology::Model& model)
{
    std::vector<Index> place(model.points.size(), -1);
    std::vector<Vec3> points;
    Eigen::AlignedBox3d bounds;
    const auto keep = [&](Index& p) {
        Index& now = place[static_cast<std::size_t>(p)];
        if (now < 0) {
            now = static_cast<Index>(points.size());
            points.push_back(model.at(p));
            bounds.extend(points.back());
        }
        p = now;
    };
    std::vector<VertexId> vertex(model.vertices.size());
    std::vector<topology::Vertex> vertices;
    const auto keep_vertex = [&](VertexId& v) {
        VertexId& now = vertex[v.index()];
        if (!now.valid()) {
            now = VertexId(vertices.size());
            vertices.push_back(model[v]);
            keep(vertices.back().point);
        }
        v = now;
    };
    for (topology::Edge& edge : model.edges) {
        keep_vertex(edge.from);
        keep_vertex(edge.to);
    }
    for (topology::Edge& edge : model.edges) {
        for (Index& p : edge.points) keep(p);
    }
    for (topology::Face& face : model.faces) {
        for (Triangle& t : face.triangles) {
            for (Index& p : t) keep(p);
        }
    }
    model.points = std::move(points);
    model.vertices = std::move(vertices);
    model.diagonal = bounds.isEmpty() ? 0 : bounds.diagonal().norm();
}

/// The faces of each solid, and those of none.
std::vector<std::vector<std::size_t>> solids(const CadWire& wire)
{
    std::unordered_map<int, std::size_t> face_of_tag;
    for (std::size_t f = 0; f < wire.faces.size(); ++f) face_of_tag[wire.faces[f].tag] = f;
    std::vector<bool> taken(wire.faces.size(), false);
    std::vector<std::vector<std::size_t>> groups;
    gmsh::vectorpair volumes;
    gmsh::model::getEntities(volumes, 3);
    for (const auto& volume : volumes) {
        std::vector<int> up, down;
        gmsh::model::getAdjacencies(3, volume.second, up, down);
        std::vector<std::size_t> group;
        for (const int tag : down) {
            const auto face = face_of_tag.find(std::abs(tag));
            if (face == face_of_tag.end() || taken[face->second]) continue;
            taken[face->second] = true;
            group.push_back(face->second);
        }
        groups.push_back(std::move(group));
    }
    std::vector<std::size_t> loose;
    for (std::size_t f = 0; f < taken.size(); ++f) {
        if (!taken[f]) loose.push_back(f);
    }
    groups.push_back(std::move(loose));
    return groups;
}

topology::Model build_model(const CadWire& wire, Cut cut, const std::shared_ptr<const CadSource>& source)
{
    topology::Model model;
    model.source = source->path;
    model.points = wire.points;
    add_edges(model, wire, source);
    for (std::size_t f = 0; f < wire.faces.size(); ++f) {
        CadFacets& facets = cut.faces[f];
        topology::Face face;
        face.tag = wire.faces[f].tag;
        face.name = name_of_face(face.tag);
        face.kind = facets.kind;
        face.triangles = std::move(facets.triangles);
        face.uv = std::move(facets.uv);
        face.surface = std::make_shared<CadSurface>(source, face.tag, facets.box);
        model.points.insert(model.points.end(), facets.added.begin(), facets.added.end());
        model.faces.push_back(std::move(face));
    }
    for (Vec3& p : model.points) p *= source->scale;
    compact(model);
    return model;
}

} // namespace

topology::Model import_cad(const std::vector<std::string>& paths, const LoadOptions& options,
                           const RunContext& context)
{
    Session session(joined(paths));
    set_import_defaults(session);
    auto gmsh_model = std::make_shared<GmshModel>(session);
    for (const std::string& path : paths) {
        check_cancelled(context);
        import_file(session, path);
    }
    gmsh_model->activate(session); // a script may have made others
    return session.run([&] {
        gmsh::vectorpair faces;
        gmsh::model::getEntities(faces, 2);
        if (faces.empty()) {
            throw InvalidInput("cad.no_faces",
                               joined(paths) +
                                   " holds no faces; export surfaces or solids, not curves alone");
        }
        auto source = std::make_shared<CadSource>();
        source->model = gmsh_model;
        source->path = joined(paths);
        source->scale = options.scale;
        source->diagonal = diagonal_of_model();

        FacetOptions facets;
        facets.tolerance = options.tolerance > 0 ? options.tolerance / options.scale
                                                 : 1e-6 * source->diagonal;
        facets.fineness = {2 * std::numbers::pi / kSidesPerTurn, kLongestSide * source->diagonal};
        CadWire wire = read_wire(facets.tolerance);
        Cut cut = cut_all(wire, facets, source->path, context);
        topology::Model model = build_model(wire, std::move(cut), source);
        model.tolerance = options.tolerance > 0 ? options.tolerance : 1e-6 * model.diagonal;
        healing::orient_groups(model, solids(wire));
        return model;
    });
}

} // namespace lacuna::cad
