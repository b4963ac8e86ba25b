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
#include <lacuna/io/shared/solid_nodes.h>
#include <lacuna/quality/shared/second_order.h>

#include <algorithm>

namespace lacuna::lua {

namespace {

using team::WriteRequest;

/// false, true (the scaled Jacobian), the name of a metric or several
void read_quality(lua_State* L, int index, const Where& where, WriteRequest& request)
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
    guard(L, [&] { request.quality.emplace(chosen, chosen + count); });
}

void read_with(lua_State* L, int index, const Where& where, WriteRequest& request)
{
    const char* const expected = "a Model or an array of Models";
    const auto add = [&](int at, const Where& element) {
        const Box<ModelState>* model = test_box<ModelState>(L, at);
        if (model == nullptr || !*model) fail_value(L, element, expected, at);
        const Box<ModelState>& held = hold_model(L, at);
        guard(L, [&] { request.with.push_back(held); });
    };
    read_each(L, index, where, add);
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
    read_each(L, index, where, add);
}

template <class Arguments>
void read_without(lua_State* L, int index, const Where& where, Arguments& arguments)
{
    read_parts(L, index, where, arguments.without);
}

/// A count, or "processes".
void read_partitions(lua_State* L, int index, const Where& where, WriteRequest& request)
{
    const char* const words[] = {"processes"};
    if (lua_type(L, index) == LUA_TSTRING)
        request.partitions = static_cast<int>(read_word(L, index, where, words, 1)); // 0
    else
        request.partitions = read_whole(L, index, where, 1);
}

void read_ghosts(lua_State* L, int index, const Where& where, WriteRequest& request)
{
    request.ghosts = read_whole(L, index, where, 0);
}

const Option<WriteRequest> kWriteOptions[] = {
    {"version", msh_version<&WriteRequest::version>},
    {"binary", boolean<&WriteRequest::binary>},
    {"quality", read_quality},
    {"with", read_with},
    {"without", read_without<WriteRequest>},
    {"renumber", boolean<&WriteRequest::renumber>},
    {"first_node", count<&WriteRequest::first_node>},
    {"first_cell", count<&WriteRequest::first_cell>},
    {"element", capitals<&WriteRequest::element>},
    {"interfaces", boolean<&WriteRequest::interfaces>},
    {"orientation", boolean<&WriteRequest::orientation>},
    {"gmsh_options", boolean<&WriteRequest::gmsh_options>},
    {"partitions", read_partitions},
    {"ghosts", read_ghosts},
    {"groups", word<&WriteRequest::all_groups, kMshGroups>},
};

/// Options of files that are written a layer at a time.
const Option<WriteRequest> kLayeredOptions[] = {
    {"version", msh_version<&WriteRequest::version>},
    {"binary", boolean<&WriteRequest::binary>},
    {"quality", read_quality},
    {"partitions", read_partitions},
    {"ghosts", read_ghosts},
    {"interfaces", boolean<&WriteRequest::interfaces>},
    {"gmsh_options", boolean<&WriteRequest::gmsh_options>},
    {"groups", word<&WriteRequest::all_groups, kMshGroups>},
};

/// Options of meshes of quads.
const Option<WriteRequest> kQuadsWriteOptions[] = {
    {"version", msh_version<&WriteRequest::version>},
    {"binary", boolean<&WriteRequest::binary>},
    {"groups", word<&WriteRequest::all_groups, kMshGroups>},
    {"gmsh_options", boolean<&WriteRequest::gmsh_options>},
};

/// mesh:write(path [, options])
template <class State, const auto& Options>
int write(lua_State* L)
{
    lua_settop(L, 3);
    auto& mesh = hold<State>(L, 1);
    const io::OutputPath& path = push_output_path(L, 2, "write");
    auto& request = temporary<WriteRequest>(L);
    read_options(L, 3, "write", Options, request);
    const RunContext& context = push_context(L);
    const Host& lent = host(L);
    guard(L, [&] {
        if constexpr (std::is_same_v<State, QuadMeshState>)
            team::write(mesh, request, path, context);
        else
            team::write(mesh, request, path, lent.crew, context);
    });
    return 0;
}

const Option<io::FacetFileOptions> kFacetOptions[] = {
    {"binary", boolean<&io::FacetFileOptions::binary>},
    {"groups", word<&io::FacetFileOptions::all_groups, kMshGroups>}};

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

struct LoadArguments : io::LoadOptions {
    cad::Limits limits{};
};

const Option<LoadArguments> kLoadOptions[] = {
    {"tolerance", positive<&LoadArguments::tolerance>},
    {"feature_angle", degrees<&LoadArguments::feature_angle>},
    {"keep_mesh", boolean<&LoadArguments::keep_mesh>},
    {"keep_noise", boolean<&LoadArguments::keep_noise>},
    {"scale", positive<&LoadArguments::scale>},
    {"unit", text<&LoadArguments::unit>},
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
    if (array_length(L, index) > 0)
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
    const Host& lent = host(L);
    arguments.limits.may_raise = !lent.sandboxed;
    RunContext& context = push_context(L);
    lua_gc(L, LUA_GCCOLLECT); // for Lua a model is a few bytes, so it would let unused models pile up
    return give_new<ModelState>(L, [&] {
        for (const std::string& path : paths) check_input_path(lent, path);
        report_progress(context, "reading");
        return ModelState{cad::load_files(paths, arguments, context, arguments.limits)};
    });
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

} // namespace

WriteRequest& push_layered_write(lua_State* L, int index, const io::OutputPath& path)
{
    auto& request = temporary<WriteRequest>(L);
    read_options(L, index, "sweep_to: write", kLayeredOptions, request);
    guard(L, [&] { team::require_layered(request, path); });
    return request;
}

void bind_io(lua_State* L)
{
    set_functions(L, {{"check", check_file}, {"load", load}});
    add_methods<MeshState>(L, {{"write", write<MeshState, kWriteOptions>}});
    add_methods<AssemblyMeshState>(L, {{"write", write<AssemblyMeshState, kWriteOptions>}});
    add_methods<QuadMeshState>(L, {{"write", write<QuadMeshState, kQuadsWriteOptions>}});
    add_methods<VolumeState>(L, {{"write_facets", write_facets}});
}

} // namespace lacuna::lua
