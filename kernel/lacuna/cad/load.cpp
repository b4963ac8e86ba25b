// SPDX-License-Identifier: MIT
#include <lacuna/cad/load.h>

#include <lacuna/cad/detail/import_cad.h>
#include <lacuna/cad/detail/import_facets.h>
#include <lacuna/cad/detail/input_file.h>
#include <lacuna/core/error.h>
#include <lacuna/healing/stitch.h>

#include <cmath>
#include <filesystem>
#include <iterator>

namespace lacuna::cad {

namespace {

constexpr std::string_view kKnownEndings =
    ".step .stp .iges .igs .brep .geo .geo_unrolled .stl .obj .msh .bdf .nas .unv .vtk .mesh";

void check_file(const std::string& path)
{
    namespace fs = std::filesystem;
    std::error_code ignored;
    if (!fs::exists(path, ignored)) {
        throw InvalidInput("cad.missing_file",
                           "there is no file " + path + "; check the name and the folder");
    }
    if (fs::is_directory(path, ignored)) {
        throw InvalidInput("cad.is_directory", path + " is a folder; name a file in it");
    }
    if (!is_cad_ending(ending_of(path)) && !is_facet_ending(ending_of(path))) {
        throw InvalidInput("cad.unknown_ending", path + ": the ending \"" + ending_of(path) +
                                                     "\" is unknown; files are read that end in " +
                                                     std::string(kKnownEndings));
    }
    if (fs::file_size(path, ignored) == 0) {
        throw InvalidInput("cad.empty_file", path + " is empty; export it anew");
    }
}

void check_options(const LoadOptions& options)
{
    if (!(options.scale > 0) || !std::isfinite(options.scale)) {
        throw InvalidInput("cad.scale",
                           "the scale must be a number above 0, not " + std::to_string(options.scale));
    }
    if (!(options.tolerance >= 0) || !std::isfinite(options.tolerance)) {
        throw InvalidInput("cad.tolerance", "the tolerance must be a length of 0 or more, not " +
                                                std::to_string(options.tolerance));
    }
}

/// Put the entities of `more` after those of `model`; face, edge and vertex tags count on.
void append(topology::Model& model, topology::Model more)
{
    const auto highest = [](const auto& entities) {
        int tag = 0;
        for (const auto& entity : entities) tag = std::max(tag, entity.tag);
        return tag;
    };
    const auto points = static_cast<Index>(model.points.size());
    const std::size_t vertices = model.vertices.size();
    const int vertex_tag = highest(model.vertices);
    const int edge_tag = highest(model.edges);
    const int face_tag = highest(model.faces);
    for (topology::Vertex& vertex : more.vertices) {
        vertex.point += points;
        vertex.tag += vertex_tag;
    }
    for (topology::Edge& edge : more.edges) {
        edge.tag += edge_tag;
        edge.from = VertexId(edge.from.index() + vertices);
        edge.to = VertexId(edge.to.index() + vertices);
        for (Index& p : edge.points) p += points;
    }
    for (topology::Face& face : more.faces) {
        face.tag += face_tag;
        face.loops.clear();
        for (Triangle& t : face.triangles) {
            for (Index& p : t) p += points;
        }
        for (Quad& q : face.given_quads) {
            for (Index& p : q) p += points;
        }
    }
    const auto move_in = [](auto& to, auto& from) {
        to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
    };
    move_in(model.points, more.points);
    move_in(model.vertices, more.vertices);
    move_in(model.edges, more.edges);
    move_in(model.faces, more.faces);
    Eigen::AlignedBox3d bounds;
    for (const Vec3& p : model.points) bounds.extend(p);
    model.diagonal = bounds.diagonal().norm();
    model.tolerance = std::max(model.tolerance, more.tolerance);
    model.source += ", " + more.source;
    move_in(model.notes, more.notes);
}

/// What reading the files has not joined: T-junctions, faces of different files, faces listed twice.
void stitch(topology::Model& model, const RunContext& context)
{
    constexpr double kMostTolerance = 0.01; // of the diagonal: more than this joins what was drawn apart
    if (model.tolerance > kMostTolerance * model.diagonal) {
        throw InvalidInput("cad.tolerance", "the tolerance " + std::to_string(model.tolerance) +
                                                " is more than a hundredth of the model's diagonal (" +
                                                std::to_string(model.diagonal) +
                                                "), so faces would fall together; give a smaller one");
    }
    const healing::StitchReport report = healing::stitch(model, model.tolerance);
    if (report.changed()) log_line(context, report.summary());
    model.notes.insert(model.notes.end(), report.notes.begin(), report.notes.end());
    for (const std::string& note : model.notes) log_line(context, note);
}

} // namespace

topology::Model load(const std::vector<std::string>& paths, const LoadOptions& options,
                     const RunContext& context)
{
    check_options(options);
    if (paths.empty()) throw InvalidInput("cad.no_file", "no file was named; name at least one");
    for (const std::string& path : paths) check_file(path);
    std::vector<std::string> cad, facets;
    for (const std::string& path : paths) (is_cad_ending(ending_of(path)) ? cad : facets).push_back(path);
    topology::Model model;
    if (!cad.empty()) model = import_cad(cad, options, context);
    if (!facets.empty() && cad.empty())
        model = import_facets(facets, options, context);
    else if (!facets.empty())
        append(model, import_facets(facets, options, context));
    topology::build_loops(model);
    stitch(model, context);
    return model;
}

} // namespace lacuna::cad
