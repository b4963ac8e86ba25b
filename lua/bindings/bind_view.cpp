// SPDX-License-Identifier: MIT
// Pages: model:view(path), volume:view(path), mesh:view(path), lacuna.view(file, path).
#include "bindings/classes.h"
#include "bindings/io_paths.h"
#include "bindings/lacuna_lua.h"
#include "bindings/options.h"

#include <lacuna/cad/load.h>
#include <lacuna/io/deck.h>
#include <lacuna/io/deck_file.h>
#include <lacuna/view/page.h>

#include <algorithm>

namespace lacuna::lua {

namespace {

void read_title(lua_State* L, int index, const Where& where, view::PageOptions& options)
{
    const char* title = read_string(L, index, where);
    guard(L, [&] { options.title = title; });
}

const Option<view::PageOptions> kPageOptions[] = {{"title", read_title}};

/// Where a page goes, as a temporary. Raises where its ending is another than .html.
const io::OutputPath& push_page_path(lua_State* L, int index)
{
    const io::OutputPath& path = push_output_path(L, index, "view");
    guard(L, [&] {
        const std::string ending = io::ending_of(path.text());
        if (ending != ".html" && ending != ".htm")
            throw InvalidInput("view.ending",
                               "view: a page is a file that ends with .html, found " + path.text());
    });
    return path;
}

/// One file by its name: what a recipe on the page can load.
std::string loadable(const ModelState& state)
{
    return state.hand_made || state.decks.size() > 1 ? "" : state.model.source;
}

/// model:view(path [, options])
int view_model(lua_State* L)
{
    lua_settop(L, 3);
    const Box<ModelState>& state = hold_box<ModelState>(L, 1);
    const io::OutputPath& path = push_page_path(L, 2);
    auto& options = temporary<view::PageOptions>(L);
    read_options(L, 3, "view", kPageOptions, options);
    RunContext& context = push_context(L);
    guard(L, [&] {
        refresh(*state);
        options.path = loadable(*state);
        view::write_page(state->model, path, options, context);
    });
    return 0;
}

/// volume:view(path [, options])
int view_volume(lua_State* L)
{
    lua_settop(L, 3);
    const auto& state = hold<VolumeState>(L, 1);
    const io::OutputPath& path = push_page_path(L, 2);
    auto& options = temporary<view::PageOptions>(L);
    read_options(L, 3, "view", kPageOptions, options);
    RunContext& context = push_context(L);
    guard(L, [&] { view::write_page(state.volume, path, options, context); });
    return 0;
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

/// mesh:view(path [, options]), of one volume or an assembly
template <class State>
int view_mesh(lua_State* L)
{
    lua_settop(L, 3);
    const auto& state = hold<State>(L, 1);
    const io::OutputPath& path = push_page_path(L, 2);
    auto& options = temporary<view::PageOptions>(L);
    read_options(L, 3, "view", kPageOptions, options);
    RunContext& context = push_context(L);
    guard(L, [&] { view::write_page(regions_of(state), path, options, context); });
    return 0;
}

// --- of a file ------------------------------------------------------------------------------------------

enum class Show { automatic, faces, cells };
const Word<Show> kShows[] = {{"auto", Show::automatic}, {"faces", Show::faces}, {"cells", Show::cells}};

struct ViewFile {
    view::PageOptions page;
    Show show = Show::automatic;
};

void read_show(lua_State* L, int index, const Where& where, ViewFile& options)
{
    options.show = read_word(L, index, where, kShows);
}

void read_file_title(lua_State* L, int index, const Where& where, ViewFile& options)
{
    read_title(L, index, where, options.page);
}

const Option<ViewFile> kFileOptions[] = {{"title", read_file_title}, {"show", read_show}};

/// Meshes are shown as cells where they have solids; decks, whose voids are to be filled, by their faces.
bool shows_cells(const io::Deck& deck)
{
    switch (deck.format) {
    case io::DeckFormat::msh:
    case io::DeckFormat::vtk:
    case io::DeckFormat::vtu:
    case io::DeckFormat::medit:
        return deck.element_count(3) > 0;
    default:
        return false;
    }
}

bool is_deck(const std::string& ending)
{
    io::DeckFormat format;
    return io::find_deck_format(ending, format) || ending == ".mesh";
}

void view_file(const std::string& file, const io::OutputPath& path, ViewFile& options,
               const cad::Limits& limits, const RunContext& context)
{
    if (options.page.title.empty()) options.page.title = file;
    if (options.show == Show::cells || (options.show == Show::automatic && is_deck(io::ending_of(file)))) {
        const io::Deck deck = io::read_deck(file);
        if (options.show == Show::cells || shows_cells(deck))
            return view::write_page(deck, path, options.page, context);
    }
    options.page.path = file;
    view::write_page(cad::load_files({file}, {}, context, limits).model, path, options.page, context);
}

/// lacuna.view(file, path [, options])
int view(lua_State* L)
{
    lua_settop(L, 3);
    const char* file = read_string(L, 1, {"view", nullptr});
    const io::OutputPath& path = push_page_path(L, 2);
    auto& options = temporary<ViewFile>(L);
    read_options(L, 3, "view", kFileOptions, options);
    const Host& lent = host(L);
    cad::Limits limits{};
    limits.may_raise = !lent.sandboxed;
    RunContext& context = push_context(L);
    guard(L, [&] {
        check_input_path(lent, file);
        view_file(file, path, options, limits, context);
    });
    return 0;
}

const luaL_Reg kModelMethods[] = {{"view", view_model}, {nullptr, nullptr}};
const luaL_Reg kVolumeMethods[] = {{"view", view_volume}, {nullptr, nullptr}};
const luaL_Reg kMeshMethods[] = {{"view", view_mesh<MeshState>}, {nullptr, nullptr}};
const luaL_Reg kAssemblyMethods[] = {{"view", view_mesh<AssemblyMeshState>}, {nullptr, nullptr}};
const luaL_Reg kFunctions[] = {{"view", view}, {nullptr, nullptr}};

} // namespace

void bind_view(lua_State* L)
{
    luaL_setfuncs(L, kFunctions, 0);
    add_methods(L, kClassName<ModelState>, kModelMethods);
    add_methods(L, kClassName<VolumeState>, kVolumeMethods);
    add_methods(L, kClassName<MeshState>, kMeshMethods);
    add_methods(L, kClassName<AssemblyMeshState>, kAssemblyMethods);
}

} // namespace lacuna::lua
