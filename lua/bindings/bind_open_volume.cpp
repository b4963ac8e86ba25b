// SPDX-License-Identifier: MIT
// Volume: what topology/open_volume.h knows of it. Matching, closing and sweeping add their methods to the
// class.
#include "bindings/faces.h"
#include "bindings/names.h"

#include <lacuna/cad/left_out.h>
#include <lacuna/closure/branches.h>
#include <lacuna/closure/readings.h>
#include <lacuna/closure/walls_alone.h>
#include <lacuna/core/progress.h>
#include <lacuna/sweep/assembly.h>
#include <lacuna/topology/auto_walls.h>

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

struct RoleArguments {
    const Box<ModelState>* model = nullptr; ///< held by the call
    topology::Roles roles;
    std::vector<FaceId> faces;
    bool auto_walls = false;
    bool roles_named = false;
    bool faces_named = false;
    bool full_turn = false;
    int reading = 0; ///< the number of the reading to take; 0: there must be one
    std::optional<VolumeClass> override_class;
    std::string name, material;
};

template <auto List>
void read_role(lua_State* L, int index, const Where& where, RoleArguments& arguments)
{
    read_faces(L, index, where, *arguments.model, arguments.roles.*List);
    arguments.roles_named = true;
}

void read_walls(lua_State* L, int index, const Where& where, RoleArguments& arguments)
{
    if (lua_type(L, index) == LUA_TSTRING && std::strcmp(lua_tostring(L, index), "auto") == 0) {
        arguments.auto_walls = arguments.roles_named = true;
    } else {
        read_role<&topology::Roles::walls>(L, index, where, arguments);
    }
}

void read_volume_faces(lua_State* L, int index, const Where& where, RoleArguments& arguments)
{
    read_faces(L, index, where, *arguments.model, arguments.faces);
    arguments.faces_named = true;
}

void read_reading(lua_State* L, int index, const Where& where, RoleArguments& arguments)
{
    arguments.reading = read_whole(L, index, where, 1);
}

void read_full_turn(lua_State* L, int index, const Where& where, RoleArguments& arguments)
{
    arguments.full_turn = read_boolean(L, index, where);
}

void read_class(lua_State* L, int index, const Where& where, RoleArguments& arguments)
{
    arguments.override_class = read_word(L, index, where, kClasses);
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
    {"reading", read_reading},
    {"class", read_class},
    {"full_turn", read_full_turn},
    {"name", read_name},
    {"material", read_material},
};

/// The walls named "auto": what hangs together with the rim of the one end that is named.
/// @return  what was left out, and why.
std::vector<std::string> find_walls(const topology::Model& model, topology::Roles& roles,
                                    const RunContext& context)
{
    if (roles.source.empty() && roles.target.empty())
        throw InvalidInput(
            "lua.walls_without_ends",
            "open_volume: walls = \"auto\" finds the walls from the rim of the source or the target; "
            "name one of them");
    const topology::WallChoice found = topology::find_walls(model, roles.source, roles.target, context);
    roles.walls = found.walls;
    std::vector<FaceId>& end = roles.source.empty() ? roles.target : roles.source;
    end.insert(end.end(), found.more_of_end.begin(), found.more_of_end.end());
    std::vector<std::string> reasons;
    if (found.of_cavity)
        reasons.emplace_back("the given end lies in a cavity of a solid, whose other faces are the walls");
    for (std::size_t i = 0; i < found.left_out.size(); ++i) {
        reasons.push_back("no wall: " + topology::name_of(model, found.left_out[i]) +
                          ", for two faces of the " + "volume have " +
                          topology::name_of(model, found.taken[i]) + " already");
    }
    return reasons;
}

std::vector<FaceId> all_of(const topology::Roles& roles)
{
    std::vector<FaceId> all = roles.source;
    all.insert(all.end(), roles.target.begin(), roles.target.end());
    all.insert(all.end(), roles.walls.begin(), roles.walls.end());
    return all;
}

/// The roles found for faces, or for walls named alone; nothing where they are as they were named.
std::optional<closure::Reading> reading_of(const topology::Model& model, const RoleArguments& arguments,
                                           const RunContext& context)
{
    if (!arguments.roles_named) {
        cad::require_none_left_out(model, arguments.faces, "roles");
        return closure::find_reading(model, arguments.faces, arguments.reading, context);
    }
    const topology::Roles& named = arguments.roles;
    if (!named.source.empty() || !named.target.empty() || named.walls.empty() || arguments.override_class)
        return std::nullopt;
    auto found = closure::read_walls_alone(model, named.walls, arguments.reading == 1, context);
    if (found) cad::require_none_left_out(model, named.walls, "roles");
    return found;
}

VolumeState make_volume(const topology::Model& model, RoleArguments& arguments, const RunContext& context)
{
    VolumeState state;
    if (!arguments.roles_named && !arguments.faces_named) arguments.faces = topology::all_faces(model);
    if (arguments.full_turn) {
        if (!arguments.roles_named) {
            if (!arguments.faces_named) cad::require_none_left_out(model, arguments.faces, "walls");
            arguments.roles.walls = arguments.faces;
        }
        state.volume = topology::open_volume(model, arguments.roles, context);
        state.volume.full_turn = true;
    } else if (auto found = reading_of(model, arguments, context)) {
        state.volume = std::move(found->volume);
        state.take_guess = !found->holed.valid();
        state.role_reasons = std::move(found->roles.reasons);
        state.classification = std::move(found->classification);
        state.closure = std::move(found->closure);
        state.as_read = std::move(found->sealed);
        if (!arguments.override_class) state.others = std::move(found->others);
    } else {
        if (arguments.auto_walls) {
            state.role_reasons = find_walls(model, arguments.roles, context);
            cad::require_none_left_out(model, all_of(arguments.roles), "walls");
        }
        state.volume = topology::open_volume(model, arguments.roles, context);
    }
    if (state.closure && arguments.override_class && *arguments.override_class != state.classification.value)
        throw InvalidInput("lua.class_of_found_roles",
                           "open_volume: these faces are swept between ends that closing makes, as class " +
                               std::string(topology::to_string(state.classification.value)) +
                               "; to override the class, name the roles");
    if (!state.closure) {
        state.volume.override_class = arguments.override_class;
        if (arguments.override_class) state.as_read.reset();
        state.classification = topology::classify(state.volume);
    }
    if (arguments.reading > 0 || (arguments.full_turn && !arguments.roles_named)) state.take_guess = true;
    state.name = arguments.name;
    state.material = arguments.material;
    return state;
}

/// volume = model:open_volume { source=, target=, walls= [, class=] [, name=] [, material=] }
/// volume = model:open_volume { faces= [, reading=] }, or of all faces: their roles are found
int open_volume(lua_State* L)
{
    lua_settop(L, 2);
    const Box<ModelState>& model = hold_box<ModelState>(L, 1);
    bring_up_to_date(L, *model);
    auto& arguments = temporary<RoleArguments>(L);
    arguments.model = &model;
    read_options(L, 2, "open_volume", kRoleOptions, arguments);
    if (arguments.roles_named && arguments.faces_named)
        fail(L, "open_volume: name either the roles (source, target, walls) or 'faces', whose roles are then "
                "found; not both");
    if (arguments.roles_named && arguments.reading > 1)
        fail(L, "open_volume: 'reading' is the number of one that was found; with roles named there is one, "
                "and reading = 1 takes it where its shape is a guess");
    if (arguments.full_turn &&
        (arguments.auto_walls || !arguments.roles.source.empty() || !arguments.roles.target.empty() ||
         arguments.override_class || arguments.reading > 0))
        fail(L, "open_volume: with full_turn = true there are walls alone, no source, target, class or "
                "reading: name the walls by their tags or names, or none, for all faces");
    RunContext& context = push_context(L);
    auto& box = new_box<VolumeState>(L);
    guard(L, [&] {
        report_progress(context, "roles");
        box = std::make_shared<VolumeState>(make_volume(model->model, arguments, context));
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

void set_vertex_tags(lua_State* L, const char* key, const topology::Model& model,
                     const std::vector<VertexId>& vertices)
{
    lua_createtable(L, static_cast<int>(vertices.size()), 0);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        lua_pushinteger(L, model[vertices[i]].tag);
        lua_rawseti(L, -2, to_lua(i));
    }
    lua_setfield(L, -2, key);
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
    set_vertex_tags(L, "wall_free_source", state.volume.model, found.wall_free_source);
    set_vertex_tags(L, "wall_free_target", state.volume.model, found.wall_free_target);
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
        if (state.closure)
            throw InvalidInput("lua.sealed", "override_class: the volume is sealed already; override its "
                                             "class before close()");
        state.others.reset();
        const std::optional<VolumeClass> before = state.volume.override_class;
        state.volume.override_class = wanted;
        try {
            state.classification = topology::classify(state.volume);
        } catch (...) {
            state.volume.override_class = before;
            throw;
        }
        state.as_read.reset();
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
    lua_createtable(L, static_cast<int>(edges.size()), 0);
    for (std::size_t i = 0; i < edges.size(); ++i) {
        lua_createtable(L, 0, 4); // a finalizer may close the volume, which moves its edges: no reference
        set_count(L, "tag", static_cast<std::size_t>(model[edges[i]].tag));
        set_count(L, "from", static_cast<std::size_t>(model[model[edges[i]].from].tag));
        set_count(L, "to", static_cast<std::size_t>(model[model[edges[i]].to].tag));
        set_number(L, "length", topology::edge_length(model, edges[i]));
        lua_rawseti(L, -2, to_lua(i));
    }
    return 1;
}

/// The pieces that a volume with branches or steps is cut into, and which faces they share.
std::string pieces_in_words(const VolumeState& state, const RunContext& context)
{
    if (state.closure || !closure::has_pieces(state.volume, context)) return "";
    std::vector<closure::StepPiece> pieces;
    try {
        pieces = closure::cut_into_pieces(state.volume, context);
    } catch (const Cancelled&) {
        throw;
    } catch (const Error& error) {
        return std::string("pieces: it is not cut: ") + error.what() + "\n";
    }
    if (pieces.size() < 2) return "";
    std::vector<sweep::AssemblyMember> members;
    for (const closure::StepPiece& piece : pieces) {
        const std::string name = state.name.empty() ? "piece" : state.name;
        members.push_back({&piece.volume, {}, name + "_" + std::to_string(members.size() + 1)});
    }
    std::string text = "pieces: " + std::to_string(pieces.size()) + '\n';
    for (std::size_t p = 0; p < pieces.size(); ++p) {
        text += "  " + members[p].region + ": class " +
                std::string(topology::to_string(topology::classify(pieces[p].volume).value)) + ", level " +
                std::to_string(pieces[p].level) + ", " + std::to_string(pieces[p].volume.model.faces.size()) +
                " faces\n";
    }
    for (const sweep::SharedFace& face : sweep::shared_faces(members, context)) {
        text += "  " + members[face.a].region + " and " + members[face.b].region + " share " +
                topology::name_of(pieces[face.a].volume.model, face.face_a) + '\n';
    }
    return text;
}

/// text = volume:tree()
int volume_tree(lua_State* L)
{
    const auto& state = hold<VolumeState>(L, 1);
    RunContext& context = push_context(L);
    push_text(L, [&] { return tree(state.volume) + pieces_in_words(state, context); });
    return 1;
}

/// text = volume:describe()
int describe_volume(lua_State* L)
{
    const auto& state = hold<VolumeState>(L, 1);
    push_text(L, [&] { return describe(state); });
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

const luaL_Reg kModelMethods[] = {{"open_volume", open_volume}, {nullptr, nullptr}};
const luaL_Reg kVolumeMethods[] = {
    {"classify", classify}, {"override_class", override_class}, {"free_edges", free_edges},
    {"tree", volume_tree},  {"describe", describe_volume},      {nullptr, nullptr},
};
const luaL_Reg kVolumeMeta[] = {{"__tostring", volume_to_string}, {nullptr, nullptr}};
const Field kVolumeFields[] = {{"class", volume_class}, {nullptr, nullptr}};

} // namespace

void bind_open_volume(lua_State* L)
{
    make_class<VolumeState>(L, kVolumeFields, kVolumeMeta);
    add_methods(L, kClassName<VolumeState>, kVolumeMethods);
    add_methods(L, kClassName<ModelState>, kModelMethods);
}

} // namespace lacuna::lua
