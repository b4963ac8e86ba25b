// SPDX-License-Identifier: MIT
// Pages: model:view(path), volume:view(path), mesh:view(path), lacuna.view(file, path).
// Pictures: picture(path) of the same three, lacuna.picture(file, path).
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

namespace lacuna::lua {

namespace {

enum class Show { automatic, faces, cells };
const Word<Show> kShows[] = {{"auto", Show::automatic}, {"faces", Show::faces}, {"cells", Show::cells}};

template <class Options>
struct OfFile : Options {
    Show show = Show::automatic;
};
using PageOfFile = OfFile<view::PageOptions>;
using PictureOfFile = OfFile<view::PictureOptions>;

const Option<PageOfFile> kPageOptions[] = {{"title", text<&PageOfFile::title>},
                                           {"show", word<&PageOfFile::show, kShows>}};
/// Options that are only for files; the part that pages and pictures of an object show is known.
constexpr std::string_view kOfFiles[] = {"show"};

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

// Call `show` with the part of an object that pages and pictures show.
template <class Show>
void with_shown(ModelState& state, const RunContext& context, const Show& show)
{
    refresh(state, context);
    show(state.model);
}
template <class Show>
void with_shown(const VolumeState& state, const RunContext& /*context*/, const Show& show)
{
    show(state.volume);
}
template <class Show>
void with_shown(const MeshState& state, const RunContext& /*context*/, const Show& show)
{
    show(regions_of(state));
}
template <class Show>
void with_shown(AssemblyMeshState& state, const RunContext& context, const Show& show)
{
    fill::hold_nodes(state, context);
    if (state.tets.empty()) return show(regions_of(state));
    show(fill::whole_deck(state, {.format = io::DeckFormat::msh}, false, context));
}
template <class Show>
void with_shown(const QuadMeshState& state, const RunContext& context, const Show& show)
{
    show(fill::model_of(state, context));
}

/// x:view(path [, options])
template <class State>
int view_page(lua_State* L)
{
    lua_settop(L, 3);
    auto& state = hold<State>(L, 1);
    const io::OutputPath& path = push_path(L, 2, "view", ".html");
    auto& options = temporary<PageOfFile>(L);
    read_options(L, 3, "view", kPageOptions, options, kOfFiles);
    RunContext& context = push_context(L);
    guard(L, [&] {
        if constexpr (std::is_same_v<State, ModelState>) options.path = loadable(state);
        with_shown(state, context,
                   [&](const auto& shown) { view::write_page(shown, path, options, context); });
    });
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

void read_direction(lua_State* L, int index, const Where& where, auto& options)
{
    if (lua_type(L, index) == LUA_TTABLE) {
        options.direction = read_vector(L, index, where);
        return;
    }
    const auto [x, y, z] = read_word(L, index, where, kDirections);
    options.direction = {x, y, z};
}

void read_cut(lua_State* L, int index, const Where& where, auto& options)
{
    const auto [point, normal] = read_point_and_normal(L, index, where);
    options.cut = {point, normal};
}

void read_shown_layers(lua_State* L, int index, const Where& where, auto& options)
{
    if (array_length(L, index) != 2)
        fail_value(L, where, "an array of two numbers of layers, from and to", index);
    std::array<int, 2> layers{};
    std::size_t next = 0;
    read_array(L, index, where, "",
               [&](int element, const Where& at) { layers[next++] = read_whole(L, element, at, 1); });
    options.layers = layers;
}

const Option<PictureOfFile> kPictureOptions[] = {
    {"width", count<&PictureOfFile::width>},
    {"height", count<&PictureOfFile::height>},
    {"view", read_direction},
    {"facets", boolean<&PictureOfFile::facets>},
    {"colour", word<&PictureOfFile::colour, kColours>},
    {"cut", read_cut},
    {"layers", read_shown_layers},
    {"edges", boolean<&PictureOfFile::edges>},
    {"legend", boolean<&PictureOfFile::legend>},
    {"title", text<&PictureOfFile::title>},
    {"show", word<&PictureOfFile::show, kShows>},
};
// What the pictures of cells and of faces, which have no cells, leave out.
constexpr std::string_view kNotOfCells[] = {"facets", "show"};
constexpr std::string_view kNotOfFaces[] = {"colour", "cut", "layers", "edges", "show"};

/// x:picture(path [, options])
template <class State, const auto& LeftOut>
int picture(lua_State* L)
{
    lua_settop(L, 3);
    auto& state = hold<State>(L, 1);
    const io::OutputPath& path = push_path(L, 2, "picture", ".png");
    auto& options = temporary<PictureOfFile>(L);
    read_options(L, 3, "picture", kPictureOptions, options, LeftOut);
    RunContext& context = push_context(L);
    guard(L, [&] {
        with_shown(state, context,
                   [&](const auto& shown) { view::write_picture(shown, path, options, context); });
    });
    return 0;
}

// --- of a file ------------------------------------------------------------------------------------------

bool is_deck(const std::string& file)
{
    const io::Format* const format = io::find_format(file);
    return format != nullptr && format->is_read && format->is_mesh;
}

void draw(const io::Deck& deck, const io::OutputPath& path, const view::PageOptions& options,
          const std::string& /*file*/, const RunContext& context)
{
    view::write_page(deck, path, options, context);
}
void draw(const topology::Model& model, const io::OutputPath& path, view::PageOptions& options,
          const std::string& file, const RunContext& context)
{
    options.path = file;
    view::write_page(model, path, options, context);
}
void draw(const io::Deck& deck, const io::OutputPath& path, const view::PictureOptions& options,
          const std::string& file, const RunContext& context)
{
    if (options.facets)
        throw InvalidInput("view.not_drawn",
                           "picture: {} is drawn as cells; leave out 'facets', or add "
                           "show = \"faces\"",
                           file);
    view::write_picture(deck, path, options, context);
}
void draw(const topology::Model& model, const io::OutputPath& path, const view::PictureOptions& options,
          const std::string& file, const RunContext& context)
{
    if (options.cut || options.layers || !options.edges || options.colour != view::ColourBy::quality)
        throw InvalidInput("view.not_drawn",
                           "picture: {} is drawn as faces, which have no cells; leave out "
                           "'colour', 'cut', 'layers' and 'edges'",
                           file);
    view::write_picture(model, path, options, context);
}

/// @return  true if cells are drawn, false if faces are
template <class Options>
bool draw_file(const std::string& file, const io::OutputPath& path, Options& options,
               const cad::Limits& limits, const RunContext& context)
{
    if (options.title.empty()) options.title = file.substr(file.rfind('/') + 1);
    if (options.show == Show::cells || (options.show == Show::automatic && is_deck(file))) {
        const io::Deck deck = io::read_deck(file, context);
        // A deck with solid elements is shown as a mesh, whatever its format.
        if (options.show == Show::cells || deck.element_count(3) > 0) {
            draw(deck, path, options, file, context);
            return true;
        }
    }
    draw(cad::load_files({file}, {}, context, limits).model, path, options, file, context);
    return false;
}

/// "cells" or "faces" = call(file, path [, options])
template <class Options>
int file_drawn(lua_State* L, const char* call, const char* ending, const auto& table)
{
    lua_settop(L, 3);
    const char* file = read_string(L, 1, {call, nullptr});
    const io::OutputPath& path = push_path(L, 2, call, ending);
    auto& options = temporary<Options>(L);
    read_options(L, 3, call, table, options);
    const Host& lent = host(L);
    cad::Limits limits{};
    limits.may_raise = !lent.sandboxed;
    RunContext& context = push_context(L);
    bool cells = false;
    guard(L, [&] {
        check_input_path(lent, file);
        cells = draw_file(file, path, options, limits, context);
    });
    lua_pushstring(L, cells ? "cells" : "faces");
    return 1;
}

/// lacuna.view
int view(lua_State* L) { return file_drawn<PageOfFile>(L, "view", ".html", kPageOptions); }
/// lacuna.picture
int picture_of_file(lua_State* L) { return file_drawn<PictureOfFile>(L, "picture", ".png", kPictureOptions); }

template <class State, const auto& LeftOut>
void add_views(lua_State* L)
{
    add_methods<State>(L, {{"view", view_page<State>}, {"picture", picture<State, LeftOut>}});
}

} // namespace

void bind_view(lua_State* L)
{
    set_functions(L, {{"view", view}, {"picture", picture_of_file}});
    add_views<ModelState, kNotOfFaces>(L);
    add_views<VolumeState, kNotOfFaces>(L);
    add_views<MeshState, kNotOfCells>(L);
    add_views<AssemblyMeshState, kNotOfCells>(L);
    add_views<QuadMeshState, kNotOfFaces>(L);
}

} // namespace lacuna::lua
