// SPDX-License-Identifier: MIT
// Pages: model:view(path), volume:view(path), mesh:view(path), lacuna.view(file, path).
// Pictures: picture(path) of the same three.
#include "bindings/classes.h"
#include "bindings/faces.h"
#include "bindings/io_paths.h"
#include "bindings/lacuna_lua.h"
#include "bindings/options.h"

#include <lacuna/cad/load.h>
#include <lacuna/io/deck.h>
#include <lacuna/io/deck_file.h>
#include <lacuna/view/page.h>
#include <lacuna/view/picture.h>

#include <algorithm>

namespace lacuna::lua {

namespace {

template <class Options>
void read_title(lua_State* L, int index, const Where& where, Options& options)
{
    const char* title = read_string(L, index, where);
    guard(L, [&] { options.title = title; });
}

const Option<view::PageOptions> kPageOptions[] = {{"title", read_title}};

/// The output path of a page or picture, as a temporary. Raises an error if it has another ending.
const io::OutputPath& push_path(lua_State* L, int index, const char* call, const char* ending)
{
    const io::OutputPath& path = push_output_path(L, index, call);
    guard(L, [&] {
        if (io::ending_of(path.text()) != ending)
            throw InvalidInput("view.ending", "{}: expected a file that ends with {}, found {}", call,
                               needed(ending), found(path.text()));
    });
    return path;
}
/// The file that a recipe on the page can load; empty if there is not exactly one.
std::string loadable(const ModelState& state)
{
    return state.hand_made || state.decks.size() > 1 ? "" : state.model.source;
}

std::vector<view::Region> regions_of(const MeshState& state)
{
    const mesh::HexMesh& mesh = state.swept.mesh;
    return {{&mesh, mesh.volume_groups.empty() ? "volume" : mesh.volume_groups.front()}};
}

std::vector<view::Region> regions_of(const AssemblyMeshState& state)
{
    std::vector<view::Region> regions;
    for (std::size_t p = 0; p < state.regions.size(); ++p)
        regions.push_back({&state.swept.parts[p].mesh, state.regions[p]});
    return regions;
}

void write_page(ModelState& state, const io::OutputPath& path, view::PageOptions& options,
                const RunContext& context)
{
    refresh(state, context);
    options.path = loadable(state);
    view::write_page(state.model, path, options, context);
}
void write_page(const VolumeState& state, const io::OutputPath& path, const view::PageOptions& options,
                const RunContext& context)
{
    view::write_page(state.volume, path, options, context);
}
void write_page(AssemblyMeshState& state, const io::OutputPath& path, const view::PageOptions& options,
                const RunContext& context)
{
    fill::hold_nodes(state, context);
    if (state.tets.empty()) return view::write_page(regions_of(state), path, options, context);
    view::write_page(fill::whole_deck(state, {.format = io::DeckFormat::msh}, false, context), path, options,
                     context);
}
void write_page(const MeshState& state, const io::OutputPath& path, const view::PageOptions& options,
                const RunContext& context)
{
    view::write_page(regions_of(state), path, options, context);
}

void write_page(const QuadMeshState& state, const io::OutputPath& path, const view::PageOptions& options,
                const RunContext& context)
{
    view::write_page(fill::model_of(state, context), path, options, context);
}

/// x:view(path [, options])
template <class State>
int view_page(lua_State* L)
{
    lua_settop(L, 3);
    auto& state = hold<State>(L, 1);
    const io::OutputPath& path = push_path(L, 2, "view", ".html");
    auto& options = temporary<view::PageOptions>(L);
    read_options(L, 3, "view", kPageOptions, options);
    RunContext& context = push_context(L);
    guard(L, [&] { write_page(state, path, options, context); });
    return 0;
}

// --- pictures -------------------------------------------------------------------------------------------

const Word<view::ColourBy> kColours[] = {
    {"quality", view::ColourBy::quality}, {"layer", view::ColourBy::layer},
    {"groups", view::ColourBy::group},    {"region", view::ColourBy::region},
    {"origin", view::ColourBy::origin},
};

struct Direction {
    double x, y, z;
};
const Word<Direction> kDirections[] = {
    {"iso", {1, -1.6, 0.9}}, {"front", {0, -1, 0}}, {"back", {0, 1, 0}},    {"left", {-1, 0, 0}},
    {"right", {1, 0, 0}},    {"top", {0, 0, 1}},    {"bottom", {0, 0, -1}},
};

void read_direction(lua_State* L, int index, const Where& where, view::PictureOptions& options)
{
    if (lua_type(L, index) == LUA_TTABLE) {
        options.direction = read_vector(L, index, where);
        return;
    }
    const auto [x, y, z] = read_word(L, index, where, kDirections);
    options.direction = {x, y, z};
}

void read_cut(lua_State* L, int index, const Where& where, view::PictureOptions& options)
{
    const auto [point, normal] = read_point_and_normal(L, index, where);
    options.cut = {point, normal};
}

void read_shown_layers(lua_State* L, int index, const Where& where, view::PictureOptions& options)
{
    if (lua_type(L, index) != LUA_TTABLE || lua_rawlen(L, index) != 2)
        fail_value(L, where, "an array of two numbers of layers, from and to", index);
    std::array<int, 2> layers{};
    std::size_t next = 0;
    read_array(L, index, where, "",
               [&](int element, const Where& at) { layers[next++] = read_whole(L, element, at, 1); });
    options.layers = layers;
}

const Option<view::PictureOptions> kPictureOptions[] = {
    {"width", count<&view::PictureOptions::width>},
    {"height", count<&view::PictureOptions::height>},
    {"view", read_direction},
    {"colour", word<&view::PictureOptions::colour, kColours>},
    {"cut", read_cut},
    {"layers", read_shown_layers},
    {"edges", boolean<&view::PictureOptions::edges>},
    {"legend", boolean<&view::PictureOptions::legend>},
    {"title", read_title},
};
/// Options for pictures of faces, which have no cells.
const Option<view::PictureOptions> kFacePictureOptions[] = {
    {"width", count<&view::PictureOptions::width>},
    {"height", count<&view::PictureOptions::height>},
    {"view", read_direction},
    {"facets", boolean<&view::PictureOptions::facets>},
    {"legend", boolean<&view::PictureOptions::legend>},
    {"title", read_title},
};

void draw(ModelState& state, const io::OutputPath& path, const view::PictureOptions& options,
          const RunContext& context)
{
    refresh(state, context);
    view::write_picture(state.model, path, options, context);
}

void draw(const VolumeState& state, const io::OutputPath& path, const view::PictureOptions& options,
          const RunContext& context)
{
    view::write_picture(state.volume, path, options, context);
}

void draw(AssemblyMeshState& state, const io::OutputPath& path, const view::PictureOptions& options,
          const RunContext& context)
{
    fill::hold_nodes(state, context);
    if (state.tets.empty()) return view::write_picture(regions_of(state), path, options, context);
    view::write_picture(fill::whole_deck(state, {.format = io::DeckFormat::msh}, false, context), path,
                        options, context);
}
void draw(const MeshState& state, const io::OutputPath& path, const view::PictureOptions& options,
          const RunContext& context)
{
    view::write_picture(regions_of(state), path, options, context);
}

void draw(const QuadMeshState& state, const io::OutputPath& path, const view::PictureOptions& options,
          const RunContext& context)
{
    view::write_picture(fill::model_of(state, context), path, options, context);
}

/// x:picture(path [, options])
template <class State, const auto& Table>
int picture(lua_State* L)
{
    lua_settop(L, 3);
    auto& state = hold<State>(L, 1);
    const io::OutputPath& path = push_path(L, 2, "picture", ".png");
    auto& options = temporary<view::PictureOptions>(L);
    read_options(L, 3, "picture", Table, options);
    RunContext& context = push_context(L);
    guard(L, [&] { draw(state, path, options, context); });
    return 0;
}

// --- of a file ------------------------------------------------------------------------------------------

enum class Show { automatic, faces, cells };
const Word<Show> kShows[] = {{"auto", Show::automatic}, {"faces", Show::faces}, {"cells", Show::cells}};

struct ViewFile {
    view::PageOptions page;
    Show show = Show::automatic;
};

void read_file_title(lua_State* L, int index, const Where& where, ViewFile& options)
{
    read_title(L, index, where, options.page);
}

const Option<ViewFile> kFileOptions[] = {{"title", read_file_title}, {"show", word<&ViewFile::show, kShows>}};

bool is_deck(const std::string& file)
{
    const io::Format* const format = io::find_format(file);
    return format != nullptr && format->is_read && format->is_mesh;
}

/// @return  true if the page shows cells, false if it shows faces
bool view_file(const std::string& file, const io::OutputPath& path, ViewFile& options,
               const cad::Limits& limits, const RunContext& context)
{
    if (options.page.title.empty()) options.page.title = file.substr(file.rfind('/') + 1);
    if (options.show == Show::cells || (options.show == Show::automatic && is_deck(file))) {
        const io::Deck deck = io::read_deck(file, context);
        // A deck with solid elements is shown as a mesh, whatever its format.
        if (options.show == Show::cells || deck.element_count(3) > 0) {
            view::write_page(deck, path, options.page, context);
            return true;
        }
    }
    options.page.path = file;
    view::write_page(cad::load_files({file}, {}, context, limits).model, path, options.page, context);
    return false;
}

/// "cells" or "faces" = lacuna.view(file, path [, options])
int view(lua_State* L)
{
    lua_settop(L, 3);
    const char* file = read_string(L, 1, {"view", nullptr});
    const io::OutputPath& path = push_path(L, 2, "view", ".html");
    auto& options = temporary<ViewFile>(L);
    read_options(L, 3, "view", kFileOptions, options);
    const Host& lent = host(L);
    cad::Limits limits{};
    limits.may_raise = !lent.sandboxed;
    RunContext& context = push_context(L);
    bool cells = false;
    guard(L, [&] {
        check_input_path(lent, file);
        cells = view_file(file, path, options, limits, context);
    });
    lua_pushstring(L, cells ? "cells" : "faces");
    return 1;
}

const luaL_Reg kViewModelMethods[] = {{"view", view_page<ModelState>},
                                      {"picture", picture<ModelState, kFacePictureOptions>},
                                      {nullptr, nullptr}};
const luaL_Reg kViewVolumeMethods[] = {{"view", view_page<VolumeState>},
                                       {"picture", picture<VolumeState, kFacePictureOptions>},
                                       {nullptr, nullptr}};
const luaL_Reg kViewMeshMethods[] = {
    {"view", view_page<MeshState>}, {"picture", picture<MeshState, kPictureOptions>}, {nullptr, nullptr}};
const luaL_Reg kViewAssemblyMethods[] = {{"view", view_page<AssemblyMeshState>},
                                         {"picture", picture<AssemblyMeshState, kPictureOptions>},
                                         {nullptr, nullptr}};
const luaL_Reg kViewQuadsMethods[] = {{"view", view_page<QuadMeshState>},
                                      {"picture", picture<QuadMeshState, kFacePictureOptions>},
                                      {nullptr, nullptr}};
const luaL_Reg kViewFunctions[] = {{"view", view}, {nullptr, nullptr}};

} // namespace

void bind_view(lua_State* L)
{
    luaL_setfuncs(L, kViewFunctions, 0);
    add_methods(L, kClassName<ModelState>, kViewModelMethods);
    add_methods(L, kClassName<VolumeState>, kViewVolumeMethods);
    add_methods(L, kClassName<MeshState>, kViewMeshMethods);
    add_methods(L, kClassName<AssemblyMeshState>, kViewAssemblyMethods);
    add_methods(L, kClassName<QuadMeshState>, kViewQuadsMethods);
}

} // namespace lacuna::lua
