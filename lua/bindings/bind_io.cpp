// SPDX-License-Identifier: MIT
#include "bindings/bind_quality.h"
#include "bindings/cad_limits.h"
#include "bindings/io_paths.h"
#include "bindings/lacuna_lua.h"
#include "bindings/options.h"
#include "bindings/write_mesh.h"

#include <lacuna/cad/load.h>
#include <lacuna/core/shared/progress.h>
#include <lacuna/io/deck.h>
#include <lacuna/io/deck_file.h>
#include <lacuna/io/facets.h>
#include <lacuna/io/leave_out.h>
#include <lacuna/io/load_facets.h>
#include <lacuna/io/mesh_file.h>
#include <lacuna/io/shared/mixed_deck.h>
#include <lacuna/io/shared/solid_nodes.h>
#include <lacuna/quality/shared/second_order.h>
#include <lacuna/team/shared/tasks.h>

#include <algorithm>
#include <map>
#include <variant>

namespace lacuna::lua {

struct WriteArguments {
    io::MeshFileOptions msh;
    bool version_given = false, binary_given = false;
    std::vector<quality::Metric> quality{quality::Metric::scaled_jacobian};
    bool quality_given = false;
    io::MeshDeckOptions deck;
    bool element_given = false;
    std::vector<Box<ModelState>> with; ///< models whose decks the mesh joins, the volume's first; empty: the
                                       ///< mesh alone
    std::vector<std::string> without;  ///< parts of these decks that the mesh replaces
    bool renumber = false, renumber_given = false;
    bool gmsh_options = false;                         ///< also write a file beside a .msh with Gmsh's
                                                       ///< display options
    bool groups_given = false;                         ///< the option `groups` of a .msh was given
    bool partitions_given = false, by_process = false; ///< by_process: one part for each process
};

namespace {

/// Metrics to write. Version 2.2 is for readers that know no other version. Some of these (meshio 5) refuse a
/// file with $ElementData, so such a file gets metrics only on request.
std::vector<quality::Metric> metrics_of(const WriteArguments& arguments)
{
    if (!arguments.quality_given && arguments.msh.version == 2.2) return {};
    return arguments.quality;
}

void read_version(lua_State* L, int index, const Where& where, WriteArguments& arguments)
{
    const double version = read_number(L, index, where);
    if (version != 4.1 && version != 2.2) fail_value(L, where, "4.1 or 2.2", index);
    arguments.msh.version = version;
    arguments.version_given = true;
}

void read_binary(lua_State* L, int index, const Where& where, WriteArguments& arguments)
{
    arguments.msh.binary = read_boolean(L, index, where);
    arguments.binary_given = true;
}

/// false, true (the scaled Jacobian), the name of a metric or several
void read_quality(lua_State* L, int index, const Where& where, WriteArguments& arguments)
{
    const int type = lua_type(L, index);
    if (type != LUA_TBOOLEAN && type != LUA_TSTRING && type != LUA_TTABLE)
        fail_value(L, where, "true, false, the name of a metric or an array of names", index);
    quality::Metric chosen[quality::kMetricCount];
    std::size_t count = 0;
    const auto add = [&](quality::Metric metric) {
        if (std::find(chosen, chosen + count, metric) == chosen + count) chosen[count++] = metric;
    };
    if (type == LUA_TSTRING)
        add(read_metric(L, index, where));
    else if (type == LUA_TTABLE)
        read_array(L, index, where, "an array of names of metrics",
                   [&](int at, const Where& element) { add(read_metric(L, at, element)); });
    else if (lua_toboolean(L, index))
        add(quality::Metric::scaled_jacobian);
    arguments.quality_given = true;
    guard(L, [&] { arguments.quality.assign(chosen, chosen + count); });
}

void read_element(lua_State* L, int index, const Where& where, WriteArguments& arguments)
{
    const char* word = read_string(L, index, where);
    guard(L, [&] {
        arguments.deck.element = word;
        for (char& c : arguments.deck.element)
            c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    });
    arguments.element_given = true;
}

void read_with(lua_State* L, int index, const Where& where, WriteArguments& arguments)
{
    const char* const expected = "a Model or an array of Models";
    const auto add = [&](int at, const Where& element) {
        const Box<ModelState>* model = test_box<ModelState>(L, at);
        if (model == nullptr || !*model) fail_value(L, element, expected, at);
        guard(L, [&] { arguments.with.push_back(*model); });
    };
    if (lua_type(L, index) != LUA_TTABLE) return add(index, where);
    read_array(L, index, where, expected, add);
    if (arguments.with.empty()) fail_value(L, where, expected, index);
}

/// A name, the number of a property, or an array of these.
void read_parts(lua_State* L, int index, const Where& where, std::vector<std::string>& parts)
{
    const char* const expected = "the name or number of a region, property or set, or an array of them";
    const auto add = [&](int at, const Where& element) {
        const bool is_part = lua_type(L, at) == LUA_TSTRING || lua_isinteger(L, at);
        if (!is_part) fail_value(L, element, expected, at);
        const lua_Integer number = lua_isinteger(L, at) ? lua_tointeger(L, at) : 0;
        const char* name = lua_type(L, at) == LUA_TSTRING ? read_string(L, at, element) : nullptr;
        if (name != nullptr && std::string_view(name).size() != lua_rawlen(L, at))
            fail_value(L, element, expected, at);
        guard(L, [&] { parts.push_back(name != nullptr ? std::string(name) : std::to_string(number)); });
    };
    if (lua_type(L, index) != LUA_TTABLE) return add(index, where);
    read_array(L, index, where, expected, add);
    if (parts.empty()) fail_value(L, where, expected, index);
}

template <class Arguments>
void read_without(lua_State* L, int index, const Where& where, Arguments& arguments)
{
    read_parts(L, index, where, arguments.without);
}

void read_renumber(lua_State* L, int index, const Where& where, WriteArguments& arguments)
{
    arguments.renumber = read_boolean(L, index, where);
    arguments.renumber_given = true;
}

/// A count, or "processes".
void read_partitions(lua_State* L, int index, const Where& where, WriteArguments& arguments)
{
    arguments.partitions_given = true;
    arguments.by_process = lua_type(L, index) == LUA_TSTRING;
    if (!arguments.by_process) {
        arguments.msh.partition.parts = static_cast<int>(read_whole(L, index, where, 1));
        return;
    }
    const char* const words[] = {"processes"};
    read_word(L, index, where, words, 1);
}

void read_ghosts(lua_State* L, int index, const Where& where, WriteArguments& arguments)
{
    arguments.msh.partition.ghosts = static_cast<int>(read_whole(L, index, where, 0));
}

const Word<bool> kIoGroups[] = {{"one", false}, {"all", true}};

void read_groups(lua_State* L, int index, const Where& where, WriteArguments& arguments)
{
    arguments.msh.all_groups = read_word(L, index, where, kIoGroups);
    arguments.groups_given = true;
}

/// Whether a format always writes a mesh in pieces, as .pvtu does.
bool is_pieces(const io::Format& format)
{
    return format.has_option("partitions") && !format.has_option("version");
}

/// Set the number of parts to the number of processes, if asked to or if a .pvtu is written without a number.
void count_parts(WriteArguments& arguments, const io::OutputPath& path, const Crew* crew)
{
    const bool open = !arguments.partitions_given && is_pieces(io::needed_mesh_format("write", path.text()));
    if (arguments.by_process || open) arguments.msh.partition.parts = crew != nullptr ? crew->size : 1;
}

const Option<WriteArguments> kIoWriteOptions[] = {
    {"version", read_version},
    {"binary", read_binary},
    {"quality", read_quality},
    {"with", read_with},
    {"without", read_without<WriteArguments>},
    {"renumber", read_renumber},
    {"first_node", count<&WriteArguments::deck, &io::MeshDeckOptions::first_node>},
    {"first_cell", count<&WriteArguments::deck, &io::MeshDeckOptions::first_cell>},
    {"element", read_element},
    {"interfaces", boolean<&WriteArguments::msh, &io::MeshFileOptions::interfaces>},
    {"orientation", boolean<&WriteArguments::msh, &io::MeshFileOptions::orientation>},
    {"gmsh_options", boolean<&WriteArguments::gmsh_options>},
    {"partitions", read_partitions},
    {"ghosts", read_ghosts},
    {"groups", read_groups},
};

/// Options of files that are written a layer at a time.
const Option<WriteArguments> kLayeredOptions[] = {
    {"version", read_version},
    {"binary", read_binary},
    {"quality", read_quality},
    {"partitions", read_partitions},
    {"ghosts", read_ghosts},
    {"interfaces", boolean<&WriteArguments::msh, &io::MeshFileOptions::interfaces>},
    {"gmsh_options", boolean<&WriteArguments::gmsh_options>},
    {"groups", read_groups},
};

/// The decks from which models were read, as one deck. If there are several, `merged` holds the result.
const io::Deck& deck_with(const WriteArguments& arguments, io::Deck& merged, const RunContext& context)
{
    std::vector<io::DeckInScale> decks;
    for (const Box<ModelState>& model : arguments.with) {
        if (model->decks.empty())
            throw InvalidInput("lua.no_deck",
                               "write: with: expected a model that was loaded from a finite element mesh, "
                               "found {}",
                               model->model.source.empty() ? "one without a file" : model->model.source);
        for (const auto& deck : model->decks) decks.push_back({deck.get(), model->scale});
    }
    if (decks.size() == 1) return *decks.front().deck;
    merged = io::merge_decks(decks, {arguments.renumber}, context);
    return merged;
}

/// The decks of `with` without the parts of `without`, joined with the mesh that fills their voids.
fill::JoinedDeck joined_deck(const fill::FilledParts& mesh, const io::Format& format,
                             const WriteArguments& arguments, const RunContext& context)
{
    io::MeshDeckOptions options = arguments.deck;
    options.format = format.deck;
    io::Deck merged;
    const io::Deck deck = io::skin_as_sets(deck_with(arguments, merged, context), options.format);
    io::LeftOut split;
    const bool without = !arguments.without.empty();
    if (without) {
        split = io::leave_out(deck, arguments.without);
        for (std::size_t n = deck.notes.size(); n < split.kept.notes.size(); ++n)
            log_line(context, split.kept.notes[n]);
    }
    const ModelState& model = *arguments.with.front();
    return fill::joined_deck(without ? split.kept : deck, model.model, model.scale, mesh, options,
                             split.gone.get(), context);
}

/// Write the decks of `with`, joined with a mesh.
void write_joined(const fill::FilledParts& mesh, const io::Format& format, const io::OutputPath& path,
                  WriteArguments& arguments, const RunContext& context)
{
    for (const Box<ModelState>& model : arguments.with) refresh(*model, context);
    fill::JoinedDeck joined = joined_deck(mesh, format, arguments, context);
    arguments.msh.periodic = std::move(joined.periodic);
    io::write_deck(joined.deck, format, path, context, arguments.msh);
}

/// An option that was given but that the format does not have; null: none.
const char* idle_option(const io::Format& format, const WriteArguments& arguments)
{
    const bool joins = !arguments.with.empty(), numbered = format.is_numbered || joins;
    const std::pair<bool, const char*> of_meshes[] = {{arguments.quality_given, "quality"},
                                                      {arguments.partitions_given, "partitions"},
                                                      {arguments.msh.partition.ghosts > 0, "ghosts"}};
    const std::pair<bool, const char*> of_decks[] = {{arguments.renumber_given, "renumber"},
                                                     {!arguments.without.empty(), "without"},
                                                     {arguments.deck.first_node != 0, "first_node"},
                                                     {arguments.deck.first_cell != 0, "first_cell"}};
    const std::pair<bool, const char*> of_all[] = {
        {arguments.version_given, "version"},     {arguments.binary_given, "binary"},
        {arguments.element_given, "element"},     {arguments.gmsh_options, "gmsh_options"},
        {arguments.groups_given, "groups"},       {joins, "with"},
        {arguments.msh.interfaces, "interfaces"}, {arguments.msh.orientation, "orientation"}};
    if (arguments.msh.orientation && joins) return "orientation";
    for (const auto& [given, name] : of_all)
        if (given && !format.has_option(name)) return name;
    for (const auto& [given, name] : of_meshes)
        if (given && (numbered || !format.has_option(name))) return name;
    for (const auto& [given, name] : of_decks) {
        const bool first = std::string_view(name).starts_with("first");
        if (given && !(first ? numbered : joins)) return name;
    }
    // Ghosts need parts: those asked for in an .msh, or the pieces of a format that always writes pieces.
    const bool parted = arguments.partitions_given || is_pieces(format);
    return arguments.msh.partition.ghosts > 0 && !parted ? "ghosts" : nullptr;
}

const io::Format& format_of(const std::string& path, const WriteArguments& arguments)
{
    const io::Format& format = io::needed_mesh_format("write", path);
    const char* const idle = idle_option(format, arguments);
    if (idle == nullptr) return format;
    const bool unparted = idle == std::string_view("ghosts") && format.has_option("ghosts");
    throw InvalidInput(Message("lua.idle_option", "write: {} files {}have no option '{}'{}", format.ending,
                               arguments.with.empty() ? "" : "with = model ", idle,
                               unparted ? " without 'partitions'" : "")
                           .remedy("leave it out"));
}

/// The scaled Jacobian of some cells: the value stored when the mesh was certified, otherwise computed.
void copy_scaled_jacobians(const sweep::Swept& swept, std::span<const std::uint32_t> cells, double* out)
{
    const std::vector<float>* kept = swept.quality.of_cells.get();
    if (kept == nullptr || kept->size() != swept.mesh.cell_count())
        return quality::scaled_jacobians(swept.mesh, cells, out);
    for (const std::uint32_t cell : cells) *out++ = static_cast<double>((*kept)[cell]);
}

/// Add the fields asked for, one value per cell; decks have none.
void add_fields(const sweep::Swept& swept, const io::Format& format, WriteArguments& arguments,
                const RunContext& context)
{
    const mesh::HexMesh& mesh = swept.mesh;
    if (!format.has_option("quality") || !arguments.with.empty()) return;
    for (const quality::Metric metric : metrics_of(arguments)) {
        io::CellField& field = arguments.msh.fields.emplace_back();
        field.name = quality::metric_name(metric);
        // The scaled Jacobian, which every file has, is computed while another thread writes, and takes no
        // memory.
        if (metric == quality::Metric::scaled_jacobian && mesh.order() == 1)
            field.make = [&swept](std::span<const std::uint32_t> cells, double* out) {
                copy_scaled_jacobians(swept, cells, out);
            };
        else
            field.values = quality::metric_values(mesh, metric, context);
    }
}

/// mesh:write(path [, options])
int write(lua_State* L)
{
    lua_settop(L, 3);
    const auto& state = hold<MeshState>(L, 1);
    const io::OutputPath& path = push_output_path(L, 2, "write");
    auto& arguments = temporary<WriteArguments>(L);
    read_options(L, 3, "write", kIoWriteOptions, arguments);
    RunContext& context = push_context(L);
    const Host& lent = host(L);
    guard(L, [&] {
        const io::Format& format = format_of(path.text(), arguments);
        count_parts(arguments, path, lent.crew);
        refuse_interfaces(arguments);
        arguments.deck.material = state.material;
        arguments.deck.columns = state.columns;
        arguments.msh.unit = state.unit;
        report_progress(context, "writing " + path.text());
        add_fields(state.swept, format, arguments, context);
        if (!arguments.with.empty())
            write_joined(fill::as_parts(state), format, path, arguments, context);
        else
            io::write_mesh(format, state.swept.mesh, path, arguments.msh, arguments.deck, context);
        write_options_beside(lent, path, arguments);
    });
    return 0;
}

/// Write a mesh that has tetrahedra. Its parts become one deck.
void write_mixed(const fill::FilledParts& state, const io::OutputPath& path, WriteArguments& arguments,
                 const RunContext& context)
{
    const io::Format& format = io::needed_mesh_format("write", path.text());
    if (!state.interfaces.empty() && (format.is_folder || !arguments.with.empty()))
        throw InvalidInput(Message("lua.split_write",
                                   "write: a mesh with cells of zero thickness cannot be "
                                   "{}",
                                   format.is_folder ? "written as polyMesh" : "joined to a deck")
                               .remedy("{}", format.is_folder ? "write another format" : "leave out 'with'"));
    if (arguments.partitions_given || is_pieces(format))
        throw InvalidInput(
            Message("lua.mixed_write", "write: a mesh with tetrahedra or a split interface is written as one "
                                       "file")
                .remedy("{}", is_pieces(format) ? "write a .vtu file" : "leave out 'partitions'"));
    if (arguments.msh.orientation && !state.tets.empty())
        throw InvalidInput(Message("lua.mixed_write", "write: tetrahedra have no sweep direction")
                               .remedy("leave out 'orientation'"));
    if (!arguments.with.empty()) return write_joined(state, format, path, arguments, context);
    arguments.deck.format = format.deck;
    for (const sweep::Swept& part : state.swept.parts) arguments.msh.oriented.push_back(&part.mesh);
    io::write_deck(fill::whole_deck(state, arguments.deck, arguments.msh.interfaces, context), format, path,
                   context, arguments.msh);
}

/// Note sets of nodes that files written a layer at a time do not hold.
void note_columns(const std::vector<io::ColumnSet>& columns, const io::OutputPath& path,
                  const RunContext& context)
{
    if (!columns.empty())
        log_line(context,
                 formatted("note: {}: {} sets of nodes are not written a layer at a time; mesh:write "
                           "writes them",
                           path.text(), columns.size()));
}

/// Write the mesh of an assembly, in parts if asked to.
void write_parts(const fill::FilledParts& state, const io::OutputPath& path, WriteArguments& arguments,
                 const Crew* crew, const RunContext& context)
{
    if (!state.tets.empty() || !state.interfaces.empty()) return write_mixed(state, path, arguments, context);
    const auto layered = [](const sweep::Swept& part) { return part.layers.has_value(); };
    if (std::ranges::all_of(state.swept.parts, layered)) { // which processes can share
        note_columns(state.columns, path, context);
        return team::write_parts(state.swept, path,
                                 {.binary = arguments.msh.binary,
                                  .version = arguments.msh.version,
                                  .all_groups = arguments.msh.all_groups,
                                  .unit = state.unit},
                                 crew, context);
    }
    const io::Format& format = io::needed_mesh_format("write", path.text());
    if (!arguments.with.empty()) return write_joined(state, format, path, arguments, context);
    std::vector<mesh::LayeredPart> parts;
    for (std::size_t p = 0; p < state.regions.size(); ++p)
        parts.push_back(
            {state.swept.parts[p].mesh, state.swept.parts[p].skin().layers, state.swept.numbering[p]});
    io::write_parts(format, parts, path, arguments.msh, arguments.deck, context);
}

/// assembly_mesh:write(path [, options])
int write_assembly(lua_State* L)
{
    lua_settop(L, 3);
    auto& state = hold<AssemblyMeshState>(L, 1);
    const io::OutputPath& path = push_output_path(L, 2, "write");
    auto& arguments = temporary<WriteArguments>(L);
    read_options(L, 3, "write", kIoWriteOptions, arguments);
    RunContext& context = push_context(L);
    const Host& lent = host(L);
    guard(L, [&] {
        if (!may_be_layered_of_parts(arguments, path) || arguments.msh.orientation || !arguments.with.empty())
            fill::hold_nodes(state, context);
        write_pieces(state, path, arguments, lent.crew, context);
        write_options_beside(lent, path, arguments);
    });
    return 0;
}

/// Options of meshes of quads.
const Option<WriteArguments> kQuadsWriteOptions[] = {
    {"version", read_version},
    {"binary", read_binary},
    {"groups", read_groups},
    {"gmsh_options", boolean<&WriteArguments::gmsh_options>},
};

/// quad_mesh:write(path [, options])
int write_quads(lua_State* L)
{
    lua_settop(L, 3);
    const auto& state = hold<QuadMeshState>(L, 1);
    const io::OutputPath& path = push_output_path(L, 2, "write");
    auto& arguments = temporary<WriteArguments>(L);
    read_options(L, 3, "write", kQuadsWriteOptions, arguments);
    RunContext& context = push_context(L);
    const Host& lent = host(L);
    guard(L, [&] {
        const io::Format& format = format_of(path.text(), arguments);
        if (format.deck == io::DeckFormat::vtu && is_pieces(format))
            throw InvalidInput(Message("io.no_such_element", "write: quads are written as one file")
                                   .remedy("write a .vtu file"));
        io::write_deck(state.deck, format, path, context, arguments.msh);
        write_options_beside(lent, path, arguments);
    });
    return 0;
}

const Option<io::FacetFileOptions> kFacetOptions[] = {
    {"binary", boolean<&io::FacetFileOptions::binary>},
    {"groups", word<&io::FacetFileOptions::all_groups, kIoGroups>}};

/// volume:write_facets(path [, options])
int write_facets(lua_State* L)
{
    lua_settop(L, 3);
    const auto& state = hold<VolumeState>(L, 1);
    const io::OutputPath& path = push_output_path(L, 2, "write_facets");
    io::FacetFileOptions options;
    read_options(L, 3, "write_facets", kFacetOptions, options);
    RunContext& context = push_context(L);
    guard(L, [&] { io::write_facets(state.volume, path, options, context); });
    return 0;
}

struct LoadArguments {
    io::LoadOptions load;
    cad::Limits limits{};
    std::vector<std::string> without{};
};

void read_feature_angle(lua_State* L, int index, const Where& where, LoadArguments& arguments)
{
    arguments.load.feature_angle = read_positive(L, index, where);
    if (arguments.load.feature_angle > 180) fail_value(L, where, "degrees in (0, 180]", index);
}

void read_unit(lua_State* L, int index, const Where& where, LoadArguments& arguments)
{
    const char* unit = read_string(L, index, where);
    guard(L, [&] { arguments.load.unit = unit; });
}

const Option<LoadArguments> kLoadOptions[] = {
    {"tolerance", positive<&LoadArguments::load, &io::LoadOptions::tolerance>},
    {"feature_angle", read_feature_angle},
    {"keep_mesh", boolean<&LoadArguments::load, &io::LoadOptions::keep_mesh>},
    {"keep_noise", boolean<&LoadArguments::load, &io::LoadOptions::keep_noise>},
    {"scale", positive<&LoadArguments::load, &io::LoadOptions::scale>},
    {"unit", read_unit},
    {"cad_seconds", read_cad_seconds},
    {"cad_megabytes", read_cad_megabytes},
    {"without", read_without<LoadArguments>},
};

/// The path or the array of paths at `index`, as a temporary.
std::vector<std::string>& push_paths(lua_State* L, int index)
{
    const Where where{"load", "path"};
    auto& paths = temporary<std::vector<std::string>>(L);
    const auto add = [&](int element, const Where& at) {
        const char* path = read_string(L, element, at);
        guard(L, [&] { paths.emplace_back(path); });
    };
    if (lua_type(L, index) == LUA_TTABLE && lua_rawlen(L, index) > 0)
        read_array(L, index, where, "", add);
    else if (lua_type(L, index) == LUA_TSTRING)
        add(index, {"load", nullptr});
    else
        fail_value(L, {"load", nullptr}, "the path of a file or an array of paths", index);
    return paths;
}

/// model = lacuna.load(path | {paths} [, options])
int load(lua_State* L)
{
    lua_settop(L, 2);
    auto& paths = push_paths(L, 1);
    auto& arguments = temporary<LoadArguments>(L);
    read_options(L, 2, "load", kLoadOptions, arguments);
    guard(L, [&] { arguments.load.without = arguments.without; });
    const Host& lent = host(L);
    arguments.limits.may_raise = !lent.sandboxed;
    RunContext& context = push_context(L);
    lua_gc(L, LUA_GCCOLLECT); // for Lua a model is a few bytes, so it would let unused models pile up
    auto& box = new_box<ModelState>(L);
    guard(L, [&] {
        for (const std::string& path : paths) check_input_path(lent, path);
        report_progress(context, "reading");
        box = std::make_shared<ModelState>();
        io::LoadedFiles loaded = cad::load_files(paths, arguments.load, context, arguments.limits);
        box->model = std::move(loaded.model);
        box->decks = std::move(loaded.decks);
        box->scale = loaded.scale;
        box->unit = std::move(loaded.unit);
    });
    return 1;
}

/// All solids of a deck, of any order.
std::vector<mesh::CellNodes> solids_of(const io::Deck& deck)
{
    std::vector<mesh::CellNodes> solids;
    for (const io::DeckBlock& block : deck.blocks)
        if (io::shape_info(block.shape).dimension == 3)
            for (std::size_t e = 0; e < block.count(); ++e) solids.push_back(io::solid_nodes(block, e));
    return solids;
}

int check_file(lua_State* L)
{
    lua_settop(L, 1);
    const char* path = read_string(L, 1, {"check", nullptr});
    const Host& lent = host(L);
    RunContext& context = push_context(L);
    auto& source = temporary<QualitySource>(L);
    const int at = lua_gettop(L);
    auto& shell = temporary<std::optional<fill::FilledShell>>(L);
    guard(L, [&] {
        check_input_path(lent, path);
        io::Deck deck = io::read_deck(path, context);
        const std::vector<mesh::CellNodes> cells = solids_of(deck);
        if (cells.empty()) {
            const auto is_quad = [](const io::DeckBlock& block) {
                return io::shape_info(block.shape).corners == 4;
            };
            if (std::ranges::none_of(deck.blocks, is_quad))
                throw InvalidInput("lua.no_hexahedra", "check: {} contains neither solids nor quads",
                                   deck.path);
            shell = fill::measured_quads(deck, context);
            return;
        }
        source.nodes = std::move(deck.points);
        source.quality = quality::measure_cells(source.nodes, cells, context);
        source.hexes.resize(cells.size());
        for (std::size_t c = 0; c < cells.size(); ++c)
            std::copy_n(cells[c].node.begin(), 8, source.hexes[c].begin());
    });
    if (shell) return push_quads_quality(L, *shell);
    push_quality(L, at);
    return 1;
}

const luaL_Reg kIoMeshMethods[] = {{"write", write}, {nullptr, nullptr}};
const luaL_Reg kIoVolumeMethods[] = {{"write_facets", write_facets}, {nullptr, nullptr}};

const luaL_Reg kIoFunctions[] = {{"check", check_file}, {"load", load}, {nullptr, nullptr}};

} // namespace

WriteArguments& push_layered_write(lua_State* L, int index, const io::OutputPath& path)
{
    auto& arguments = temporary<WriteArguments>(L);
    read_options(L, index, "sweep_to: write", kLayeredOptions, arguments);
    guard(L, [&] {
        const io::Format* const format = io::find_format(path.text());
        if (format == nullptr || !format->streamed)
            throw InvalidInput("lua.not_layered",
                               "sweep_to: {} cannot be written one layer at a time; "
                               "use one of {}",
                               path.text(), io::endings_of([](const io::Format& of) { return of.streamed; }));
        format_of(path.text(), arguments); // refuses options that the format does not have
    });
    return arguments;
}

bool may_be_layered_of_parts(const WriteArguments& arguments, const io::OutputPath& path)
{
    const io::Format* const format = io::find_format(path.text());
    return format != nullptr && format->streamed_parts && !arguments.partitions_given &&
           !arguments.msh.interfaces;
}

void refuse_interfaces(const WriteArguments& arguments)
{
    if (arguments.msh.interfaces)
        throw InvalidInput(
            Message("lua.idle_option", "write: meshes of one volume have no option 'interfaces'")
                .remedy("leave it out"));
}

void write_options_beside(const Host& lent, const io::OutputPath& mesh, const WriteArguments& arguments)
{
    if (arguments.gmsh_options) io::write_msh_options(output_path(lent, mesh.text() + ".opt"));
}

void write_layered(const fill::FilledVolume& filled, const io::OutputPath& path, WriteArguments& arguments,
                   const Crew* crew, const RunContext& context)
{
    const sweep::Swept& swept = filled.swept;
    arguments.deck.material = filled.material;
    arguments.msh.unit = filled.unit;
    count_parts(arguments, path, crew);
    const mesh::HexMesh& mesh = swept.mesh;
    report_progress(context, "writing " + path.text());
    if (!swept.layers) {
        const io::Format& format = format_of(path.text(), arguments);
        arguments.deck.columns = filled.columns;
        add_fields(swept, format, arguments, context);
        return io::write_mesh(format, mesh, path, arguments.msh, arguments.deck, context);
    }
    note_columns(filled.columns, path, context);
    team::write_layered({mesh, *swept.layers}, *swept.plan, path,
                        {arguments.msh.binary, arguments.msh.version, metrics_of(arguments), filled.material,
                         arguments.msh.partition, arguments.msh.all_groups, filled.unit},
                        crew, context);
}

void write_pieces(const fill::FilledParts& state, const io::OutputPath& path, WriteArguments& arguments,
                  const Crew* crew, const RunContext& context)
{
    if (arguments.quality_given)
        throw InvalidInput(
            Message("lua.idle_option", "write: meshes of assemblies are written without 'quality'")
                .remedy("leave it out"));
    static_cast<void>(format_of(path.text(), arguments)); // refuses options that the format does not have
    count_parts(arguments, path, crew);
    arguments.msh.unit = state.unit;
    if (arguments.with.empty()) {
        arguments.msh.periodic = state.swept.periodic;
        arguments.deck.columns = state.columns;
        for (const fill::Contact& contact : state.contacts) arguments.deck.contacts.push_back(contact.pair);
    }
    for (const sweep::LeftOut& out : state.left_out)
        log_line(context, formatted("note: {} has a hole, because a volume was left out: {}", path.text(),
                                    out.message.text()));
    write_parts(state, path, arguments, crew, context);
}

void bind_io(lua_State* L)
{
    luaL_setfuncs(L, kIoFunctions, 0);
    add_methods(L, kClassName<MeshState>, kIoMeshMethods);
    const luaL_Reg assembly[] = {{"write", write_assembly}, {nullptr, nullptr}};
    add_methods(L, kClassName<AssemblyMeshState>, assembly);
    const luaL_Reg quads[] = {{"write", write_quads}, {nullptr, nullptr}};
    add_methods(L, kClassName<QuadMeshState>, quads);
    add_methods(L, kClassName<VolumeState>, kIoVolumeMethods);
}

} // namespace lacuna::lua
