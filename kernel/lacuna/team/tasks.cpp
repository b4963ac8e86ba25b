// SPDX-License-Identifier: MIT
#include <lacuna/team/tasks.h>

#include <lacuna/io/deck.h>
#include <lacuna/io/layered.h>

#include <memory>
#include <utility>

namespace lacuna::team {
namespace {

constexpr std::string_view kWriteTask = "write";

/// A mesh but for its nodes and quads, which its plan has, within a message.
template <class A, class Mesh>
void put_mesh(A& with, Mesh& mesh)
{
    with(mesh.nodes_per_layer), with(mesh.layers), with(mesh.rim);
    put_each(with, mesh.patches, [&](auto& patch) { with(patch.tag), with(patch.groups), with(patch.face); });
    with(mesh.source_patch), with(mesh.target_patch), with(mesh.wall_patch);
    with(mesh.volume_groups);
}

void put_file(Writer& writer, const LayeredFile& file)
{
    std::vector<int> metrics;
    for (const quality::Metric metric : file.quality) metrics.push_back(static_cast<int>(metric));
    writer(static_cast<std::int8_t>(file.binary)), writer(file.version), writer(metrics);
    writer(file.material), writer(file.partition.parts), writer(file.partition.ghosts);
}

LayeredFile read_file(Reader& reader)
{
    LayeredFile file;
    std::int8_t binary = 0;
    std::vector<int> metrics;
    reader(binary), reader(file.version), reader(metrics);
    reader(file.material), reader(file.partition.parts), reader(file.partition.ghosts);
    file.binary = binary != 0;
    for (const int metric : metrics) file.quality.push_back(static_cast<quality::Metric>(metric));
    return file;
}

/// Values of a metric, of some layers at a time.
io::LayeredField field_of(const mesh::LayeredMesh& layered, quality::Metric metric, const RunContext& context)
{
    return {quality::metric_name(metric), [layered, metric, &context](int first, int last) {
                mesh::HexMesh part;
                part.nodes_per_layer = layered.mesh.nodes_per_layer;
                part.layers = last - first;
                part.quads = layered.mesh.quads;
                part.nodes.resize(mesh::corner_count(part));
                layered.nodes.place(first, last + 1, part.nodes, context);
                return quality::metric_values(part, metric, context);
            }};
}

/// What each of a team does.
void write_share(const mesh::LayeredMesh& layered, const io::OutputPath& path, const LayeredFile& file,
                 const Team* team, const RunContext& context)
{
    std::vector<io::LayeredField> fields;
    for (const quality::Metric metric : file.quality) fields.push_back(field_of(layered, metric, context));
    const std::string ending = io::ending_of(path.text());
    if (ending == ".msh")
        io::write_msh(layered, path, {file.binary, file.version, {}, file.partition}, fields, context, team);
    else if (ending == ".vtu")
        io::write_vtu(layered, path, fields, context, team);
    else if (ending == ".pvtu")
        io::write_pvtu(layered, path, file.partition, fields, context, team);
    else if (ending == ".vtk")
        io::write_vtk(layered, path, {file.binary}, fields, context, team);
    else if (io::DeckFormat format{}; io::find_deck_format(ending, format) && io::is_layered(format))
        io::write_deck(layered, {.format = format, .material = file.material}, path, context, team);
    else
        throw InvalidInput("io.not_layered", path.text() + ": files of this ending are written whole alone");
}

} // namespace

bool is_layered(const std::string& ending)
{
    io::DeckFormat format{};
    return ending == ".msh" || ending == ".vtu" || ending == ".pvtu" || ending == ".vtk" ||
           (io::find_deck_format(ending, format) && io::is_layered(format));
}

bool is_layered(quality::Metric metric)
{
    return metric != quality::Metric::relative_size_squared && metric != quality::Metric::shape_and_size &&
           metric != quality::Metric::shear_and_size;
}

void write_layered(const mesh::LayeredMesh& layered, const sweep::LayerPlan& plan, const io::OutputPath& path,
                   const LayeredFile& file, const Crew* crew, const RunContext& context)
{
    if (crew == nullptr) return write_share(layered, path, file, nullptr, context);
    Writer writer;
    sweep::put(writer, plan);
    put_mesh(writer, layered.mesh);
    writer(path.text()), put_file(writer, file);
    const Team& team = crew->call(kWriteTask, std::move(writer).take());
    do_together(&team, [&] { write_share(layered, path, file, &team, context); });
}

void help(std::string_view task, const std::string& bytes, const Team& team, const RunContext& context)
{
    do_together(&team, [&] {
        if (task == sweep::kLayersTask) return sweep::help_find_in_layers(bytes, team, context);
        if (task != kWriteTask) throw ProtocolError("there is no task '" + std::string(task) + "'");
        auto plan = std::make_shared<sweep::LayerPlan>();
        mesh::HexMesh mesh;
        std::string path;
        Reader reader(bytes);
        sweep::put(reader, *plan);
        put_mesh(reader, mesh);
        reader(path);
        const LayeredFile file = read_file(reader);
        reader.finish();
        mesh.nodes = plan->source.nodes;
        mesh.quads = plan->source.quads;
        const sweep::PlacedLayers layers = sweep::placed_layers(std::move(plan), context);
        write_share({mesh, layers.nodes}, path, file, &team, context);
    });
}

} // namespace lacuna::team
