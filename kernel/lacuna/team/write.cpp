// SPDX-License-Identifier: MIT
#include <lacuna/team/shared/write.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/progress.h>
#include <lacuna/io/leave_out.h>
#include <lacuna/io/shared/mixed_deck.h>
#include <lacuna/team/shared/tasks.h>

#include <algorithm>
#include <filesystem>
#include <span>
#include <string_view>
#include <utility>

namespace lacuna::team {
namespace {

using io::Format;

/// The metrics to write as cell fields.
std::vector<quality::Metric> metrics_of(const WriteRequest& request)
{
    if (request.quality) return *request.quality;
    if (request.version == 2.2) return {};
    return {quality::Metric::scaled_jacobian};
}

/// Whether a format always writes a mesh in pieces, as .pvtu does.
bool is_pieces(const Format& format)
{
    return format.has_option("partitions") && !format.has_option("version");
}

io::PartitionOptions partition_of(const WriteRequest& request, const Format& format, const Crew* crew)
{
    const int processes = crew != nullptr ? crew->size : 1;
    if (!request.partitions) return {is_pieces(format) ? processes : 0, request.ghosts};
    return {*request.partitions == 0 ? processes : *request.partitions, request.ghosts};
}

io::MeshFileOptions file_options(const WriteRequest& request, const std::string& unit,
                                 const io::PartitionOptions& partition = {})
{
    return {.binary = request.binary.value_or(true),
            .version = request.version.value_or(4.1),
            .partition = partition,
            .all_groups = request.all_groups.value_or(false),
            .interfaces = request.interfaces,
            .unit = unit,
            .orientation = request.orientation};
}

io::MeshDeckOptions deck_options(const WriteRequest& request, const Format& format,
                                 const std::string& material)
{
    return {format.deck, request.element, request.first_node, request.first_cell, material};
}

/// The name of a requested option that the format does not have; null: there is none.
const char* idle_option(const Format& format, const WriteRequest& request)
{
    const bool joins = !request.with.empty(), numbered = format.is_numbered || joins;
    struct Row {
        bool given;
        const char* name;
        bool has = true; ///< whether it has an effect, if the format has it
    };
    const Row rows[] = {{request.orientation, "orientation", !joins},
                        {request.version.has_value(), "version"},
                        {request.binary.has_value(), "binary"},
                        {!request.element.empty(), "element"},
                        {request.gmsh_options, "gmsh_options"},
                        {request.all_groups.has_value(), "groups"},
                        {joins, "with"},
                        {request.interfaces, "interfaces"},
                        {request.quality.has_value(), "quality", !numbered},
                        {request.partitions.has_value(), "partitions", !numbered},
                        {request.ghosts > 0, "ghosts", !numbered}};
    for (const Row& row : rows)
        if (row.given && !(row.has && format.has_option(row.name))) return row.name;
    if (request.renumber && !joins) return "renumber";
    if (!request.without.empty() && !joins) return "without";
    if (request.first_node != 0 && !numbered) return "first_node";
    if (request.first_cell != 0 && !numbered) return "first_cell";
    // Ghost cells need parts: those requested for an .msh, or the pieces of a format that is always in
    // pieces.
    return request.ghosts > 0 && !request.partitions && !is_pieces(format) ? "ghosts" : nullptr;
}

/// The format of a path. Refuses options that it does not have.
const Format& format_of(const WriteRequest& request, const io::OutputPath& path)
{
    const Format& format = io::needed_mesh_format("write", path.text());
    const char* const idle = idle_option(format, request);
    if (idle == nullptr) return format;
    const bool exists = format.has_option(idle);
    if (exists && request.with.empty())
        throw InvalidInput(Message("lua.idle_option", "write: option '{}' of {} files needs option '{}'",
                                   idle, format.ending,
                                   idle == std::string_view("ghosts") ? "partitions" : "with")
                               .remedy("give both, or leave '{}' out", idle));
    throw InvalidInput(Message("lua.idle_option", "write: {} files cannot have option '{}'{}", format.ending,
                               idle, exists ? " together with option 'with'" : "")
                           .remedy("leave '{}' out", idle));
}

void write_options_beside(const WriteRequest& request, const io::OutputPath& path)
{
    const std::string name = std::filesystem::path(path.text()).filename().string();
    if (request.gmsh_options) io::write_msh_options(path.beside(name + ".opt"));
}

/// The scaled Jacobian of some cells: the value stored when the mesh was certified, otherwise computed.
void copy_scaled_jacobians(const sweep::Swept& swept, std::span<const std::uint32_t> cells, double* out)
{
    const std::vector<float>* kept = swept.quality.of_cells.get();
    if (kept == nullptr || kept->size() != swept.mesh.cell_count())
        return quality::scaled_jacobians(swept.mesh, cells, out);
    for (const std::uint32_t cell : cells) *out++ = static_cast<double>((*kept)[cell]);
}

/// The fields asked for, one value per cell.
std::vector<io::CellField> fields_of(const sweep::Swept& swept, const WriteRequest& request,
                                     const RunContext& context)
{
    std::vector<io::CellField> fields;
    for (const quality::Metric metric : metrics_of(request)) {
        io::CellField& field = fields.emplace_back();
        field.name = quality::metric_name(metric);
        // The scaled Jacobian, a field of every file, is computed while another thread writes, so it takes no
        // memory.
        if (metric == quality::Metric::scaled_jacobian && swept.mesh.order() == 1)
            field.make = [&swept](std::span<const std::uint32_t> cells, double* out) {
                copy_scaled_jacobians(swept, cells, out);
            };
        else
            field.values = quality::metric_values(swept.mesh, metric, context);
    }
    return fields;
}

/// The decks from which models were read, as one deck.
io::Deck deck_with(const WriteRequest& request, const RunContext& context)
{
    std::vector<io::DeckInScale> decks;
    for (const auto& model : request.with) {
        if (model->decks.empty())
            throw InvalidInput("lua.no_deck",
                               "write: with: expected a model that was loaded from a finite element mesh, "
                               "found {}",
                               model->model.source.empty() ? "one without a file" : model->model.source);
        for (const auto& deck : model->decks) decks.push_back({deck.get(), model->scale});
    }
    if (decks.size() == 1) return *decks.front().deck;
    return io::merge_decks(decks, {request.renumber.value_or(false)}, context);
}

/// Write the decks of `with` without the parts of `without`, joined with the mesh that fills their voids.
void write_joined(const fill::FilledParts& mesh, const WriteRequest& request, const Format& format,
                  const io::OutputPath& path, const RunContext& context)
{
    io::Deck deck = io::skin_as_sets(deck_with(request, context), format.deck);
    io::LeftOut split;
    if (!request.without.empty()) {
        split = io::leave_out(deck, request.without);
        for (std::size_t n = deck.notes.size(); n < split.kept.notes.size(); ++n)
            log_line(context, split.kept.notes[n]);
        deck = std::move(split.kept);
    }
    const io::LoadedFiles& model = *request.with.front();
    fill::JoinedDeck joined = fill::joined_deck(deck, model.model, model.scale, mesh,
                                                deck_options(request, format, {}), split.gone.get(), context);
    io::MeshFileOptions options = file_options(request, mesh.unit);
    options.periodic = std::move(joined.periodic);
    io::write_deck(joined.deck, format, path, context, options);
}

/// Write a mesh that has tetrahedra. Its parts become one deck.
void write_mixed(const fill::FilledParts& mesh, const WriteRequest& request, const Format& format,
                 const io::OutputPath& path, io::MeshFileOptions options, const io::MeshDeckOptions& deck,
                 const RunContext& context)
{
    if (!mesh.interfaces.empty() && (format.is_folder || !request.with.empty()))
        throw InvalidInput(Message("lua.split_write",
                                   "write: a mesh with cells of zero thickness cannot be {}",
                                   format.is_folder ? "written as polyMesh" : "joined to a deck")
                               .remedy("{}", format.is_folder ? "write another format" : "leave out 'with'"));
    if (request.partitions || is_pieces(format))
        throw InvalidInput(
            Message("lua.mixed_write",
                    "write: a mesh with tetrahedra or a split interface is written as one file")
                .remedy("{}", is_pieces(format) ? "write a .vtu file" : "leave out 'partitions'"));
    if (request.orientation && !mesh.tets.empty())
        throw InvalidInput(Message("lua.mixed_write", "write: tetrahedra have no sweep direction")
                               .remedy("leave out 'orientation'"));
    if (!request.with.empty()) return write_joined(mesh, request, format, path, context);
    for (const sweep::Swept& part : mesh.swept.parts) options.oriented.push_back(&part.mesh);
    io::write_deck(fill::whole_deck(mesh, deck, request.interfaces, context), format, path, context, options);
}

/// Log a note on the sets of nodes that are missing in files written a layer at a time.
void note_columns(const std::vector<io::ColumnSet>& columns, const io::OutputPath& path,
                  const RunContext& context)
{
    if (!columns.empty())
        log_line(context,
                 formatted("note: {}: {} sets of nodes are not written a layer at a time; mesh:write "
                           "writes them",
                           path.text(), columns.size()));
}

bool is_layered(const sweep::Swept& part) { return part.layers.has_value(); }

void write_pieces(const fill::FilledParts& mesh, const WriteRequest& request, const Format& format,
                  const io::OutputPath& path, const Crew* crew, const RunContext& context)
{
    io::MeshFileOptions options = file_options(request, mesh.unit, partition_of(request, format, crew));
    io::MeshDeckOptions deck = deck_options(request, format, {});
    if (request.with.empty()) {
        options.periodic = mesh.swept.periodic;
        deck.columns = mesh.columns;
        for (const fill::Contact& contact : mesh.contacts) deck.contacts.push_back(contact.pair);
        const auto named = std::ranges::find_if_not(mesh.materials, &std::string::empty);
        if (named != mesh.materials.end() && format.is_numbered)
            log_line(context, formatted("note: {}: the materials of several regions, such as {}, are not "
                                        "written; assign them to the element sets of the regions",
                                        path.text(), *named));
    }
    if (!mesh.tets.empty() || !mesh.interfaces.empty())
        return write_mixed(mesh, request, format, path, std::move(options), deck, context);
    if (std::ranges::all_of(mesh.swept.parts, is_layered)) { // which processes can share
        note_columns(mesh.columns, path, context);
        return write_parts(mesh.swept, path,
                           {.binary = options.binary,
                            .version = options.version,
                            .all_groups = options.all_groups,
                            .unit = mesh.unit},
                           crew, context);
    }
    if (!request.with.empty()) return write_joined(mesh, request, format, path, context);
    std::vector<mesh::LayeredPart> parts;
    for (std::size_t p = 0; p < mesh.regions.size(); ++p)
        parts.push_back(
            {mesh.swept.parts[p].mesh, mesh.swept.parts[p].skin().layers, mesh.swept.numbering[p]});
    io::write_parts(format, parts, path, options, deck, context);
}

} // namespace

void write(const fill::FilledVolume& mesh, const WriteRequest& request, const io::OutputPath& path,
           const Crew* crew, const RunContext& context)
{
    const Format& format = format_of(request, path);
    refuse_interfaces(request);
    report_progress(context, "writing " + path.text());
    const sweep::Swept& swept = mesh.swept;
    io::MeshFileOptions options = file_options(request, mesh.unit, partition_of(request, format, crew));
    if (swept.layers) {
        note_columns(mesh.columns, path, context);
        write_layered({swept.mesh, *swept.layers}, *swept.plan, path,
                      {options.binary, options.version, metrics_of(request), mesh.material, options.partition,
                       options.all_groups, mesh.unit},
                      crew, context);
    } else if (!request.with.empty()) {
        write_joined(fill::as_parts(mesh), request, format, path, context);
    } else {
        if (format.has_option("quality")) options.fields = fields_of(swept, request, context);
        io::MeshDeckOptions deck = deck_options(request, format, mesh.material);
        deck.columns = mesh.columns;
        io::write_mesh(format, swept.mesh, path, options, deck, context);
    }
    write_options_beside(request, path);
}

void write(fill::FilledParts& mesh, const WriteRequest& request, const io::OutputPath& path, const Crew* crew,
           const RunContext& context)
{
    if (!may_be_layered_of_parts(request, path) || request.orientation || !request.with.empty())
        fill::hold_nodes(mesh, context);
    if (request.quality)
        throw InvalidInput(
            Message("lua.idle_option", "write: meshes of assemblies are written without 'quality'")
                .remedy("leave it out"));
    const Format& format = format_of(request, path);
    for (const sweep::LeftOut& out : mesh.left_out)
        log_line(context, formatted("note: {} has a hole, because a volume was left out: {}", path.text(),
                                    out.message.text()));
    write_pieces(mesh, request, format, path, crew, context);
    write_options_beside(request, path);
}

void write(const fill::FilledShell& mesh, const WriteRequest& request, const io::OutputPath& path,
           const RunContext& context)
{
    const Format& format = format_of(request, path);
    if (format.deck == io::DeckFormat::vtu && is_pieces(format))
        throw InvalidInput(Message("io.no_such_element", "write: quads are written as one file")
                               .remedy("write a .vtu file"));
    io::write_deck(mesh.deck, format, path, context, file_options(request, {}));
    write_options_beside(request, path);
}

std::vector<std::string> write_swept(fill::Filled& filled, const WriteRequest& request,
                                     const io::OutputPath& path, const Crew* crew, const RunContext& context)
{
    if (auto* const whole = std::get_if<fill::FilledVolume>(&filled.mesh)) {
        if (!whole->swept.layers)
            whole->swept.report.emplace_back(
                "sweep_to: the whole mesh was held in memory, because its nodes are not those of plain "
                "layers: they were moved to improve cells, or belong to boundary layers");
        write(*whole, request, path, crew, context);
        return whole->swept.report;
    }
    auto& mesh = std::get<fill::FilledParts>(filled.mesh);
    const auto held = mesh.swept.parts.size() -
                      static_cast<std::size_t>(std::ranges::count_if(mesh.swept.parts, is_layered));
    if (held > 0)
        mesh.swept.report.push_back(formatted(
            "sweep_to: {} of {} parts were held in memory, because their nodes are not those of plain "
            "layers, or the file cannot be written one layer at a time",
            held, mesh.swept.parts.size()));
    write(mesh, request, path, crew, context);
    return fill::report(mesh);
}

void require_layered(const WriteRequest& request, const io::OutputPath& path)
{
    const Format* const format = io::find_format(path.text());
    if (format == nullptr || !format->streamed)
        throw InvalidInput("lua.not_layered",
                           "sweep_to: {} cannot be written one layer at a time; use one of {}", path.text(),
                           io::endings_of([](const Format& of) { return of.streamed; }));
    static_cast<void>(format_of(request, path));
}

void refuse_interfaces(const WriteRequest& request)
{
    if (request.interfaces)
        throw InvalidInput(
            Message("lua.idle_option", "write: meshes of one volume have no option 'interfaces'")
                .remedy("leave it out"));
}

bool may_be_layered_of_parts(const WriteRequest& request, const io::OutputPath& path)
{
    const Format* const format = io::find_format(path.text());
    return format != nullptr && format->streamed_parts && !request.partitions && !request.interfaces;
}

} // namespace lacuna::team
