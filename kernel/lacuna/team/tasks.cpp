// SPDX-License-Identifier: MIT
#include <lacuna/team/shared/tasks.h>

#include <lacuna/io/mesh_file.h>
#include <lacuna/quality/shared/layered.h>

#include <algorithm>
#include <deque>
#include <memory>
#include <span>
#include <utility>

namespace lacuna::team {
namespace {

constexpr std::string_view kWriteTask = "write", kPartsTask = "write parts";

/// Serialise a mesh without its nodes and quads, which are sent with its layer plan.
template <class A, class Mesh>
void put_mesh(A& with, Mesh& mesh)
{
    with(mesh.nodes_per_layer), with(mesh.layers), with(mesh.rim);
    with(mesh.patches), with(mesh.source_patch), with(mesh.target_patch), with(mesh.wall_patch);
    with(mesh.volume_groups);
}

/// A mesh received from rank 0, with the plan that computes its nodes.
struct Received {
    mesh::HexMesh mesh;
    sweep::PlacedLayers layers;
};
Received read_mesh(Reader& reader, const RunContext& context)
{
    auto plan = std::make_shared<sweep::LayerPlan>();
    Received received;
    sweep::put(reader, *plan);
    put_mesh(reader, received.mesh);
    received.mesh.nodes = plan->source.nodes;
    received.mesh.quads = plan->source.quads;
    received.mesh.middles = sweep::middles_of(*plan, received.mesh);
    received.layers = sweep::placed_layers(std::move(plan), context);
    return received;
}

mesh::NodeNumbers read_numbers(Reader& reader, const mesh::HexMesh& mesh)
{
    Index first = 0;
    std::vector<std::pair<Index, Index>> known;
    reader(first), reader(known);
    return {first, std::move(known), mesh::corner_count(mesh)};
}

/// Values of a metric, computed for a range of layers at a time.
/// @param average_volume  mean volume of all cells, for metrics that are relative to it
io::LayeredField field_of(const mesh::LayeredMesh& layered, quality::Metric metric, double average_volume,
                          const RunContext& context)
{
    return {quality::metric_name(metric), [layered, metric, average_volume, &context](int first, int last) {
                const mesh::HexMesh part = mesh::make_layers(layered, first, last, {}, context);
                return quality::metric_values(part, metric, context, average_volume);
            }};
}

/// The work of one process of the team.
void write_share(const mesh::LayeredMesh& layered, const io::OutputPath& path, const LayeredFile& file,
                 const Team* team, const RunContext& context)
{
    const bool needs_average = std::any_of(
        file.quality.begin(), file.quality.end(),
        [](quality::Metric metric) { return quality::metric_info(metric).needs_average_volume; });
    const double average = needs_average ? quality::mean_volume(layered, context, team) : 1;
    std::vector<io::LayeredField> fields;
    for (const quality::Metric metric : file.quality)
        fields.push_back(field_of(layered, metric, average, context));
    io::write_mesh(io::needed_mesh_format("sweep_to", path.text()), layered, path,
                   {.binary = file.binary,
                    .version = file.version,
                    .partition = file.partition,
                    .all_groups = file.all_groups,
                    .unit = file.unit},
                   {.material = file.material}, fields, context, team);
}

void write_share(std::span<const mesh::LayeredPart> parts, const io::OutputPath& path,
                 const LayeredFile& file, const Team* team, const RunContext& context)
{
    io::write_parts(
        io::needed_mesh_format("sweep_to", path.text()), parts, path,
        {.binary = file.binary, .version = file.version, .all_groups = file.all_groups, .unit = file.unit},
        {}, context, team);
}

void help_write_parts(const std::string& bytes, const Team& team, const RunContext& context)
{
    Reader reader(bytes);
    std::uint64_t count = 0;
    reader(count);
    std::deque<Received> received;
    std::deque<mesh::NodeNumbers> numbers;
    std::vector<mesh::LayeredPart> parts;
    for (std::uint64_t p = 0; p < count; ++p) {
        received.push_back(read_mesh(reader, context));
        numbers.push_back(read_numbers(reader, received.back().mesh));
        parts.push_back({received.back().mesh, &received.back().layers.nodes, numbers.back()});
    }
    std::string path;
    LayeredFile file;
    reader(path), reader(file);
    reader.finish();
    write_share(parts, path, file, &team, context);
}

} // namespace

void write_layered(const mesh::LayeredMesh& layered, const sweep::LayerPlan& plan, const io::OutputPath& path,
                   const LayeredFile& file, const Crew* crew, const RunContext& context)
{
    if (crew == nullptr) return write_share(layered, path, file, nullptr, context);
    Writer writer;
    sweep::put(writer, plan);
    put_mesh(writer, layered.mesh);
    writer(path.text()), writer(file);
    const Team& team = crew->call(kWriteTask, std::move(writer).take());
    do_together(&team, [&] { write_share(layered, path, file, &team, context); });
}

void write_parts(const sweep::SweptAssembly& assembly, const io::OutputPath& path, const LayeredFile& file,
                 const Crew* crew, const RunContext& context)
{
    std::vector<mesh::LayeredPart> parts;
    bool all = true;
    for (std::size_t p = 0; p < assembly.parts.size(); ++p) {
        const sweep::Swept& part = assembly.parts[p];
        parts.push_back({part.mesh, part.layers ? &*part.layers : nullptr, assembly.numbering[p]});
        all = all && part.layers.has_value();
    }
    if (crew == nullptr || !all) return write_share(parts, path, file, nullptr, context);
    Writer writer;
    writer(static_cast<std::uint64_t>(parts.size()));
    for (std::size_t p = 0; p < parts.size(); ++p) {
        sweep::put(writer, *assembly.parts[p].plan);
        put_mesh(writer, parts[p].mesh);
        writer(parts[p].numbers.first()), writer(parts[p].numbers.known());
    }
    writer(path.text()), writer(file);
    const Team& team = crew->call(kPartsTask, std::move(writer).take());
    do_together(&team, [&] { write_share(parts, path, file, &team, context); });
}

void help(std::string_view task, const std::string& bytes, const Team& team, const RunContext& context)
{
    do_together(&team, [&] {
        if (task == sweep::kLayersTask) return sweep::help_find_in_layers(bytes, team, context);
        if (task == kPartsTask) return help_write_parts(bytes, team, context);
        if (task != kWriteTask) throw ProtocolError(formatted("there is no task '{}'", task));
        Reader reader(bytes);
        const Received received = read_mesh(reader, context);
        std::string path;
        LayeredFile file;
        reader(path), reader(file);
        reader.finish();
        write_share({received.mesh, received.layers.nodes}, path, file, &team, context);
    });
}

} // namespace lacuna::team
