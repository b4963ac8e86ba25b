// SPDX-License-Identifier: MIT
#include <lacuna/cad/load.h>

#include <lacuna/cad/detail/exact_geometry.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/renumbered.h>
#include <lacuna/healing/shared/orient_groups.h>

#include <map>
#include <utility>

namespace lacuna::cad {

using namespace cad_protocol;

namespace {

void add_edges(topology::ModelBuilder& model, LoadReply& reply, double scale,
               const std::shared_ptr<const CadSource>& source)
{
    for (std::size_t p = 0; p < reply.vertex_tags.size(); ++p)
        model.vertices.push_back({static_cast<Index>(p), reply.vertex_tags[p], topology::Origin::given});
    for (LoadReply::Edge& cad : reply.edges) {
        topology::Edge edge;
        edge.tag = cad.tag;
        edge.from = VertexId(cad.from);
        edge.to = VertexId(cad.to);
        edge.points = std::move(cad.points);
        edge.params = std::move(cad.params);
        std::vector<topology::LeftOutFace> left_out;
        for (const Index f : cad.left_out) {
            const LoadReply::LeftOut& face = reply.left_out[index(f)];
            left_out.push_back({face.tag, source->path(), face.why});
        }
        for (Vec3& part : cad.form) part *= scale;
        geometry::PlainCurve plain{std::move(cad.form)};
        edge.curve = std::make_shared<CadCurve>(CadEntity{source, cad.curve}, std::move(plain),
                                                std::move(left_out));
        model.edges.push_back(std::move(edge));
    }
}

/// Remove points and vertices that no edge or facet uses, and set the diagonal.
void compact(topology::ModelBuilder& model)
{
    Renumbered<topology::Vertex> vertices(model.vertices);
    Renumbered<Vec3> points(model.points);
    for (topology::Edge& edge : model.edges)
        for (VertexId* end : {&edge.from, &edge.to}) *end = VertexId(index(vertices(end->index())));
    for (topology::Vertex& vertex : vertices.used) vertex.point = points(vertex.point);
    for (topology::Edge& edge : model.edges)
        for (Index& p : edge.points) p = points(p);
    for (topology::Face& face : model.faces)
        for (Triangle& t : face.triangles)
            for (Index& p : t) p = points(p);
    model.points = std::move(points.used);
    model.vertices = std::move(vertices.used);
    Eigen::AlignedBox3d bounds;
    for (const Vec3& p : model.points) bounds.extend(p);
    model.diagonal = bounds.isEmpty() ? 0 : bounds.diagonal().norm();
}

/// Make the solids of a reply regions of the model. Each has a name of its own: its label in the file if no
/// other solid has it, else the label, or "body", and its tag. The label of one of several solids is the name
/// of the faces that have none of their own and bound this solid alone.
void add_solids(topology::ModelBuilder& model, const std::vector<LoadReply::Solid>& solids)
{
    std::map<std::string, int> uses;
    for (const LoadReply::Solid& solid : solids) ++uses[solid.name];
    for (const LoadReply::Solid& solid : solids) {
        std::string name = solid.name;
        if (name.empty() || uses[name] > 1) {
            name = formatted("{}_{}", name.empty() ? "body" : name, solid.tag);
            while (uses.contains(name)) name += '_';
        }
        for (const Index f : solid.faces) {
            std::vector<std::string>& region = model.faces[index(f)].regions.emplace_back(1, name);
            if (!solid.name.empty() && solid.name != name) region.push_back(solid.name);
        }
    }
    for (topology::Face& face : model.faces) {
        if (face.regions.empty()) continue;
        const std::string& label = face.regions.front().back();
        if (!face.name.empty())
            face.groups = {face.name}; // it is the face's own name
        else if (solids.size() > 1 && face.regions.size() == 1 && uses.contains(label))
            face.name = label;
    }
}

/// The faces of each solid, then those in no solid. A face between solids is in the first of them.
std::vector<std::vector<std::size_t>> groups_to_orient(const LoadReply& reply)
{
    std::vector<std::vector<std::size_t>> groups;
    std::vector<bool> taken(reply.faces.size(), false);
    const auto take = [&](std::size_t f) {
        if (!taken[f]) groups.back().push_back(f);
        taken[f] = true;
    };
    for (const LoadReply::Solid& solid : reply.solids) {
        groups.emplace_back();
        for (const Index f : solid.faces) take(index(f));
    }
    groups.emplace_back();
    for (std::size_t f = 0; f < taken.size(); ++f) take(f);
    return groups;
}

/// Make the model of a reply, without its loops.
void build_model(topology::ModelBuilder& model, LoadReply reply, double scale,
                 const std::shared_ptr<const CadSource>& source)
{
    model.source = source->path();
    for (std::size_t n = 0; n < reply.notes.size(); ++n) {
        reply.notes[n].is_warning = n < reply.left_out.size();
        model.notes.emplace_back(std::move(reply.notes[n]));
    }
    model.points = std::move(reply.points);
    add_edges(model, reply, scale, source);
    for (LoadReply::Face& cad : reply.faces) {
        topology::Face face;
        face.tag = cad.tag;
        face.name = std::move(cad.name);
        face.kind = std::move(cad.kind);
        face.triangles = std::move(cad.triangles);
        face.uv = std::move(cad.uv);
        face.surface = std::make_shared<CadSurface>(CadEntity{source, cad.tag});
        model.faces.push_back(std::move(face));
    }
    add_solids(model, reply.solids);
    for (Vec3& p : model.points) p *= scale;
    compact(model);
}

/// Read CAD files into one model through the CAD process. Tags continue from file to file, as in Gmsh. The
/// warnings name the faces left out, except slivers, and the script commands that are skipped.
io::LoadedFiles import_cad(const std::vector<std::string>& paths, const LoadOptions& options,
                           const RunContext& context, const Limits& limits)
{
    const CadOrder order{paths, options.tolerance, options.scale, limits};
    const CadFiles files = open_cad_files(order, context);
    const std::shared_ptr<Worker> worker = Worker::current(&context, subject_of(order));
    LoadReply reply = read_cad_files(*worker, order, files, context);
    const auto source = std::make_shared<const CadSource>(worker, reply.model, order, files.digest);

    const std::vector<std::vector<std::size_t>> solids = groups_to_orient(reply);
    topology::ModelBuilder model;
    build_model(model, std::move(reply), options.scale, source);
    model.notes.insert(model.notes.end(), files.notes.begin(), files.notes.end());
    model.tolerance = options.tolerance > 0 ? options.tolerance : kFileAccuracy * model.diagonal;
    healing::orient_groups(model, solids);
    return {.model = std::move(model).finish(), .scale = options.scale};
}

} // namespace

topology::Model load(const std::vector<std::string>& paths, const LoadOptions& options,
                     const RunContext& context, const Limits& limits)
{
    return load_files(paths, options, context, limits).model;
}

io::LoadedFiles load_files(const std::vector<std::string>& paths, const LoadOptions& options,
                           const RunContext& context, const Limits& limits)
{
    const auto import = [&](const std::vector<std::string>& cad_paths, const LoadOptions& all,
                            const RunContext& run) { return import_cad(cad_paths, all, run, limits); };
    return io::load_files(paths, options, context,
                          {".step .stp .iges .igs .brep .geo .geo_unrolled", import});
}

} // namespace lacuna::cad
