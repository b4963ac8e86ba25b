// SPDX-License-Identifier: MIT
// Volume: what topology/open_volume.h knows of it. Matching, closing and sweeping add their methods to the
// class.
#include "bindings/faces.h"
#include "bindings/names.h"

#include <lacuna/fill/describe.h>

#include <cctype>
#include <cstring>
#include <utility>

namespace lacuna::lua {

namespace {

using topology::VolumeClass;

const Word<VolumeClass> kClasses[] = {
    {"I", VolumeClass::I},   {"II", VolumeClass::II}, {"III", VolumeClass::III},
    {"IV", VolumeClass::IV}, {"V", VolumeClass::V},   {"closed", VolumeClass::closed},
};

// --- roles ----------------------------------------------------------------------------------------------

struct RoleArguments : fill::RoleRequest {
    const Box<ModelState>* model = nullptr; ///< held by the call
};

template <auto List>
void read_role(lua_State* L, int index, const Where& where, RoleArguments& arguments)
{
    if (!arguments.roles) arguments.roles.emplace();
    read_faces(L, index, where, *arguments.model, (*arguments.roles).*List);
}

void read_walls(lua_State* L, int index, const Where& where, RoleArguments& arguments)
{
    if (lua_type(L, index) == LUA_TSTRING && std::strcmp(lua_tostring(L, index), "auto") == 0) {
        arguments.find_walls = true;
        if (!arguments.roles) arguments.roles.emplace();
    } else {
        read_role<&topology::Roles::walls>(L, index, where, arguments);
    }
}

void read_volume_faces(lua_State* L, int index, const Where& where, RoleArguments& arguments)
{
    read_faces(L, index, where, *arguments.model, arguments.faces.emplace());
}

void read_name(lua_State* L, int index, const Where& where, RoleArguments& arguments)
{
    const char* name = read_plain_name(L, index, where);
    guard(L, [&] { arguments.name = name; });
}

/// A name, as Abaqus has them, or a number, as Nastran has.
void read_material(lua_State* L, int index, const Where& where, RoleArguments& arguments)
{
    if (lua_type(L, index) == LUA_TNUMBER) {
        const int number = read_whole(L, index, where, 1);
        guard(L, [&] { arguments.material = std::to_string(number); });
        return;
    }
    if (lua_type(L, index) != LUA_TSTRING)
        fail_value(L, where, "the name or the number of a material", index);
    const char* name = read_string(L, index, where);
    for (const char* c = name; *c != '\0'; ++c)
        if (std::iscntrl(static_cast<unsigned char>(*c)) != 0 || *c == '"' || *c == ',')
            fail_value(L, where, "a name without quotes, commas and control characters", index);
    guard(L, [&] { arguments.material = name; });
}

const Option<RoleArguments> kRoleOptions[] = {
    {"source", read_role<&topology::Roles::source>},
    {"target", read_role<&topology::Roles::target>},
    {"walls", read_walls},
    {"faces", read_volume_faces},
    {"reading", count<&RoleArguments::reading>},
    {"class", word<&RoleArguments::override_class, kClasses>},
    {"full_turn", boolean<&RoleArguments::full_turn>},
    {"name", read_name},
    {"material", read_material},
};

/// volume = model:open_volume { source=, target=, walls= [, class=] [, name=] [, material=] }
/// volume = model:open_volume { faces= [, reading=] }, or of all faces: their roles are found
int open_volume(lua_State* L)
{
    lua_settop(L, 2);
    const Box<ModelState>& model = hold_model(L, 1);
    auto& arguments = temporary<RoleArguments>(L);
    arguments.model = &model;
    read_options(L, 2, "open_volume", kRoleOptions, arguments);
    const fill::RoleRequest& request = arguments;
    if (request.roles && request.faces)
        fail(L, "open_volume: name either the roles (source, target, walls) or 'faces', whose roles are then "
                "found; not both");
    if (request.roles && request.reading > 1)
        fail(L, "open_volume: 'reading' is the number of one that was found; with roles named there is one, "
                "and reading = 1 takes it where its shape is a guess");
    const bool ends = request.roles && (!request.roles->source.empty() || !request.roles->target.empty());
    if (request.full_turn && (request.find_walls || ends || request.override_class || request.reading > 0))
        fail(L, "open_volume: with full_turn = true there are walls alone, no source, target, class or "
                "reading: name the walls by their tags or names, or none, for all faces");
    RunContext& context = push_context(L);
    auto& box = new_box<VolumeState>(L);
    guard(L, [&] {
        box = std::make_shared<VolumeState>();
        *box = fill::open(model->model, request, context);
        box->decks = model->decks;
        box->scale = model->scale;
    });
    return 1;
}

// --- Volume ---------------------------------------------------------------------------------------------

int volume_class(lua_State* L)
{
    const std::string_view name = topology::to_string(check<VolumeState>(L, 1).classification.value);
    lua_pushlstring(L, name.data(), name.size());
    return 1;
}

/// { class=, free_loops=, wall_free_source=, wall_free_target=, reasons= } = volume:classify()
int classify(lua_State* L)
{
    const auto& state = hold<VolumeState>(L, 1);
    const topology::Classification& found = state.classification;
    lua_createtable(L, 0, 5);
    volume_class(L);
    lua_setfield(L, -2, "class");
    set_count(L, "free_loops", found.free_loops.size());
    set_tags(L, "wall_free_source", state.volume.model, found.wall_free_source);
    set_tags(L, "wall_free_target", state.volume.model, found.wall_free_target);
    set_strings(L, "reasons", found.reasons);
    return 1;
}

/// volume = volume:override_class(name)
int override_class(lua_State* L)
{
    lua_settop(L, 2);
    auto& state = hold<VolumeState>(L, 1);
    const VolumeClass wanted = read_word(L, 2, {"override_class", nullptr}, kClasses);
    guard(L, [&] {
        const Busy busy(state, "override_class");
        state = fill::override_class(state, wanted);
    });
    lua_settop(L, 1);
    return 1;
}

/// { {tag=, from=, to=, length=}, ... } = volume:free_edges()
int free_edges(lua_State* L)
{
    const auto& state = hold<VolumeState>(L, 1);
    const topology::Model& model = state.volume.model;
    auto& edges = temporary<std::vector<EdgeId>>(L);
    guard(L, [&] { edges = topology::free_edges(state.volume); });
    // A finalizer may close the volume, which moves its edges: no reference to one is kept.
    push_array(L, edges, [&](EdgeId edge) { push_edge(L, model, edge); });
    return 1;
}

/// text = volume:tree()
int volume_tree(lua_State* L)
{
    const auto& state = hold<VolumeState>(L, 1);
    RunContext& context = push_context(L);
    push_text(L, [&] { return fill::tree(state, context); });
    return 1;
}

/// text = volume:describe()
int describe_volume(lua_State* L)
{
    const auto& state = hold<VolumeState>(L, 1);
    push_text(L, [&] { return fill::describe(state); });
    return 1;
}

int volume_to_string(lua_State* L)
{
    const auto& state = hold<VolumeState>(L, 1);
    volume_class(L);
    lua_pushfstring(L, "Volume of class %s, %d faces, %s", lua_tostring(L, -1),
                    static_cast<int>(state.volume.model.faces.size()), state.closure ? "sealed" : "open");
    return 1;
}

const luaL_Reg kVolumeModelMethods[] = {{"open_volume", open_volume}, {nullptr, nullptr}};
const luaL_Reg kVolumeVolumeMethods[] = {
    {"classify", classify}, {"override_class", override_class}, {"free_edges", free_edges},
    {"tree", volume_tree},  {"describe", describe_volume},      {nullptr, nullptr},
};
const luaL_Reg kVolumeMeta[] = {{"__tostring", volume_to_string}, {nullptr, nullptr}};
const Field kVolumeFields[] = {{"class", volume_class}, {nullptr, nullptr}};

} // namespace

void bind_open_volume(lua_State* L)
{
    make_class<VolumeState>(L, kVolumeFields, kVolumeMeta);
    add_methods(L, kClassName<VolumeState>, kVolumeVolumeMethods);
    add_methods(L, kClassName<ModelState>, kVolumeModelMethods);
}

} // namespace lacuna::lua
