// SPDX-License-Identifier: MIT
#include "bindings/bind_quality.h"
#include "bindings/cad_limits.h"
#include "bindings/io_paths.h"
#include "bindings/lacuna_lua.h"
#include "bindings/options.h"

#include <lacuna/cad/load.h>
#include <lacuna/io/deck.h>
#include <lacuna/io/deck_file.h>
#include <lacuna/io/facets.h>
#include <lacuna/io/load_facets.h>
#include <lacuna/io/msh.h>
#include <lacuna/io/vtk.h>
#include <lacuna/quality/second_order.h>

#include <algorithm>

namespace lacuna::lua {

namespace {

struct WriteArguments {
    io::MshOptions msh;
    bool version_given = false, binary_given = false;
    std::vector<quality::Metric> quality{quality::Metric::scaled_jacobian};
    bool quality_given = false;
    io::MeshDeckOptions deck;
    bool element_given = false;
    Box<ModelState> with; ///< null: the mesh alone
};

/// Metrics to be written. Version 2.2 is for readers that know no other, some of which (meshio 5) refuse a
/// file with $ElementData: there only where it is asked for.
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

quality::Metric read_metric(lua_State* L, int index, const Where& where)
{
    const char* names[quality::kMetricCount];
    for (std::size_t i = 0; i < quality::kMetricCount; ++i) names[i] = quality::metric_infos()[i].name;
    return static_cast<quality::Metric>(read_word(L, index, where, names, quality::kMetricCount));
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

template <io::DeckTag io::MeshDeckOptions::*Member>
void read_first(lua_State* L, int index, const Where& where, WriteArguments& arguments)
{
    arguments.deck.*Member = read_whole(L, index, where, 1);
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
    const Box<ModelState>* model = test_box<ModelState>(L, index);
    if (model == nullptr || !*model) fail_value(L, where, "a Model", index);
    arguments.with = *model;
}

const Option<WriteArguments> kWriteOptions[] = {
    {"version", read_version},
    {"binary", read_binary},
    {"quality", read_quality},
    {"with", read_with},
    {"first_node", read_first<&io::MeshDeckOptions::first_node>},
    {"first_cell", read_first<&io::MeshDeckOptions::first_cell>},
    {"element", read_element},
};

/// The one deck a model was read from.
const io::Deck& deck_with(const ModelState& model)
{
    if (model.decks.size() != 1)
        throw InvalidInput("lua.no_deck",
                           "write: with: expected a model that was loaded from one finite element "
                           "mesh, found one of " +
                               std::to_string(model.decks.size()));
    return *model.decks.front();
}

void write_deck(const mesh::HexMesh& mesh, const io::OutputPath& path, const WriteArguments& arguments,
                const RunContext& context)
{
    io::MeshDeckOptions options = arguments.deck;
    io::find_deck_format(io::ending_of(path.text()), options.format);
    const io::DeckFormat format = options.format;
    if (!arguments.with) return io::write_deck(io::deck_of(mesh, options), format, path, context);
    const io::Deck& deck = deck_with(*arguments.with);
    io::write_deck(io::join_deck(deck, arguments.with->model, arguments.with->scale, mesh, options), format,
                   path, context);
}

/// A format by its ending, and which options it has.
struct Format {
    const char* ending;
    bool has_version, has_binary, is_deck, has_element;
    void (*write)(const mesh::HexMesh& mesh, const io::OutputPath& path, const WriteArguments& arguments,
                  const RunContext& context);
};

const Format kFormats[] = {
    {".msh", true, true, false, false,
     [](const auto& mesh, const auto& path, const auto& arguments, const auto& context) {
         io::write_msh(mesh, path, arguments.msh, context);
     }},
    {".vtu", false, false, false, false,
     [](const auto& mesh, const auto& path, const auto& arguments, const auto& context) {
         io::write_vtu(mesh, path, {arguments.msh.fields}, context);
     }},
    {".vtk", false, true, false, false,
     [](const auto& mesh, const auto& path, const auto& arguments, const auto& context) {
         io::write_vtk(mesh, path, {arguments.msh.binary, arguments.msh.fields}, context);
     }},
    {".inp", false, false, true, true, write_deck},
    {".bdf", false, false, true, false, write_deck},
    {".nas", false, false, true, false, write_deck},
    {".dat", false, false, true, false, write_deck},
    {".unv", false, false, true, false, write_deck},
};

/// An option that was given and that the format does not have; null: none.
const char* idle_option(const Format& format, const WriteArguments& arguments)
{
    if (arguments.version_given && !format.has_version) return "version";
    if (arguments.binary_given && !format.has_binary) return "binary";
    if (arguments.quality_given && format.is_deck) return "quality";
    if (arguments.element_given && !format.has_element) return "element";
    if (arguments.with && !format.is_deck) return "with";
    if (arguments.deck.first_node != 0 && !format.is_deck) return "first_node";
    if (arguments.deck.first_cell != 0 && !format.is_deck) return "first_cell";
    return nullptr;
}

const Format& format_of(const std::string& path, const WriteArguments& arguments)
{
    std::string known;
    for (const Format& format : kFormats) {
        known += std::string(" ") + format.ending;
        if (io::ending_of(path) != format.ending) continue;
        if (const char* idle = idle_option(format, arguments))
            throw InvalidInput("lua.idle_option", std::string("write: ") + format.ending +
                                                      " files have no option '" + idle + "'; leave it out");
        return format;
    }
    throw InvalidInput("lua.unknown_ending",
                       "write: the ending of " + path + " says no format; meshes are written as" + known);
}

/// mesh:write(path [, options])
int write(lua_State* L)
{
    lua_settop(L, 3);
    const auto& state = hold<MeshState>(L, 1);
    const io::OutputPath& path = push_output_path(L, 2, "write");
    auto& arguments = temporary<WriteArguments>(L);
    read_options(L, 3, "write", kWriteOptions, arguments);
    RunContext& context = push_context(L);
    guard(L, [&] {
        const mesh::HexMesh& mesh = state.swept.mesh;
        const Format& format = format_of(path.text(), arguments);
        if (arguments.with) refresh(*arguments.with);
        for (const quality::Metric metric :
             format.is_deck ? std::vector<quality::Metric>{} : metrics_of(arguments))
            arguments.msh.fields.push_back(
                {quality::metric_name(metric), quality::metric_values(mesh, metric, context)});
        format.write(mesh, path, arguments, context);
    });
    return 0;
}

/// A method the kernel has nothing for yet, and what does instead.
template <class T>
int not_yet(lua_State* L, const char* name, const char* instead)
{
    lua_settop(L, 2);
    check<T>(L, 1);
    push_output_path(L, 2, name);
    fail(L, "%s is not available yet; %s", name, instead);
}

int view(lua_State* L) { return not_yet<MeshState>(L, "view", "write a .msh and open it in Gmsh"); }

const Option<io::FacetFileOptions> kFacetOptions[] = {{"binary", boolean<&io::FacetFileOptions::binary>}};

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
};

void read_tolerance(lua_State* L, int index, const Where& where, LoadArguments& arguments)
{
    arguments.load.tolerance = read_positive(L, index, where);
}

void read_feature_angle(lua_State* L, int index, const Where& where, LoadArguments& arguments)
{
    arguments.load.feature_angle = read_positive(L, index, where);
    if (arguments.load.feature_angle > 180) fail_value(L, where, "degrees in (0, 180]", index);
}

void read_keep_mesh(lua_State* L, int index, const Where& where, LoadArguments& arguments)
{
    arguments.load.keep_mesh = read_boolean(L, index, where);
}

void read_scale(lua_State* L, int index, const Where& where, LoadArguments& arguments)
{
    arguments.load.scale = read_positive(L, index, where);
}

const Option<LoadArguments> kLoadOptions[] = {
    {"tolerance", read_tolerance},     {"feature_angle", read_feature_angle},
    {"keep_mesh", read_keep_mesh},     {"scale", read_scale},
    {"cad_seconds", read_cad_seconds}, {"cad_megabytes", read_cad_megabytes},
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
    LoadArguments arguments;
    read_options(L, 2, "load", kLoadOptions, arguments);
    const Host& lent = host(L);
    arguments.limits.may_raise = !lent.sandboxed;
    RunContext& context = push_context(L);
    lua_gc(L, LUA_GCCOLLECT); // to Lua a model is a few bytes: it would let old ones pile up
    auto& box = new_box<ModelState>(L);
    guard(L, [&] {
        for (const std::string& path : paths) check_input_path(lent, path);
        box = std::make_shared<ModelState>();
        io::LoadedFiles loaded = cad::load_files(paths, arguments.load, context, arguments.limits);
        box->model = std::move(loaded.model);
        box->decks = std::move(loaded.decks);
        box->scale = loaded.scale;
    });
    return 1;
}

/// All hexahedra of a deck, of any order; other solids cannot be judged, and their number is an error.
std::vector<mesh::CellNodes> hexes_of(const io::Deck& deck)
{
    std::vector<mesh::CellNodes> hexes;
    for (const io::DeckBlock& block : deck.blocks) {
        if (block.shape != io::DeckShape::hex8 && block.shape != io::DeckShape::hex20 &&
            block.shape != io::DeckShape::hex27)
            continue;
        for (std::size_t e = 0; e < block.count(); ++e) {
            mesh::CellNodes& nodes = hexes.emplace_back();
            nodes.count = block.element(e).size();
            std::copy(block.element(e).begin(), block.element(e).end(), nodes.node.begin());
        }
    }
    if (hexes.empty())
        throw InvalidInput("lua.no_hexahedra",
                           "check: " + deck.path + " holds no hexahedra" +
                               (deck.element_count(3) > 0
                                    ? ", only " + std::to_string(deck.element_count(3)) + " other solids"
                                    : ""));
    return hexes;
}

/// quality = lacuna.check(path): of the hexahedra of a file
int check_file(lua_State* L)
{
    lua_settop(L, 1);
    const char* path = read_string(L, 1, {"check", nullptr});
    const Host& lent = host(L);
    RunContext& context = push_context(L);
    auto& source = temporary<QualitySource>(L);
    const int at = lua_gettop(L);
    guard(L, [&] {
        check_input_path(lent, path);
        io::Deck deck = io::read_deck(path);
        const std::vector<mesh::CellNodes> cells = hexes_of(deck);
        source.nodes = std::move(deck.points);
        source.quality = quality::measure_cells(source.nodes, cells, context);
        source.hexes.resize(cells.size());
        for (std::size_t c = 0; c < cells.size(); ++c)
            std::copy_n(cells[c].node.begin(), 8, source.hexes[c].begin());
    });
    push_quality(L, at);
    return 1;
}

const luaL_Reg kMeshMethods[] = {{"write", write}, {"view", view}, {nullptr, nullptr}};
const luaL_Reg kVolumeMethods[] = {{"write_facets", write_facets}, {nullptr, nullptr}};

const luaL_Reg kFunctions[] = {{"check", check_file}, {"load", load}, {nullptr, nullptr}};

} // namespace

void bind_io(lua_State* L)
{
    luaL_setfuncs(L, kFunctions, 0);
    add_methods(L, kClassName<MeshState>, kMeshMethods);
    add_methods(L, kClassName<VolumeState>, kVolumeMethods);
}

} // namespace lacuna::lua
