// SPDX-License-Identifier: MIT
// Volume: opening, classes and free edges (topology/open_volume.h). Matching, closing and sweeping add their
// methods to the class.
#include "bindings/faces.h"
#include "bindings/recipe_function.h"

#include <lacuna/fill/describe.h>

#include <cctype>
#include <cstring>
#include <utility>

namespace lacuna::lua {

namespace {

using topology::VolumeClass;

const Word<VolumeClass> kClasses[] = {
    {"I", VolumeClass::I},    {"II", VolumeClass::II}, {"III", VolumeClass::III},
    {"IV", VolumeClass::IV},  {"V", VolumeClass::V},   {"closed", VolumeClass::closed},
    {"0", VolumeClass::zero},
};

// --- roles ----------------------------------------------------------------------------------------------

struct RoleArguments : fill::RoleRequest {
    const Box<ModelState>* model = nullptr; ///< on the stack during the call
    int functions = 0;                      ///< index of a table that keeps functions for the call
    Box<ModelState> of;                     ///< the model of the face that `along` leads to
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

/// A name, as in Abaqus, or a number, as in Nastran.
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

// --- along ----------------------------------------------------------------------------------------------

using closure::Along;

struct AlongArguments {
    RoleArguments* roles = nullptr;
    const char* course = nullptr; ///< the option that gives the path
    Along along;
    std::optional<double> angle;
    std::optional<bool> fixed;
};

/// Set the path to the kind that an option gives; only one option may give a path.
template <class Course>
Course& set_course(lua_State* L, const Where& where, AlongArguments& arguments)
{
    if (arguments.course != nullptr)
        fail_option(L, where, "is one path, and '%s' is another; give one of them", arguments.course);
    arguments.course = where.key;
    guard(L, [&] { arguments.along.course.emplace<Course>(); });
    return *std::get_if<Course>(&arguments.along.course);
}

void read_along_vector(lua_State* L, int index, const Where& where, AlongArguments& arguments)
{
    set_course<Along::Vector>(L, where, arguments).way = read_vector(L, index, where);
}

/// Read a path around a line from an array of `size` elements: a point, a direction, and values that the
/// caller reads.
template <class Course>
Course& read_line(lua_State* L, int index, const Where& where, AlongArguments& arguments, std::size_t size,
                  const char* expected)
{
    if (array_length(L, index) != size) fail_value(L, where, expected, index);
    auto& course = set_course<Course>(L, where, arguments);
    course.point = read_vector(L, push_element(L, index, 1), where);
    course.direction = read_vector(L, push_element(L, index, 2), where);
    return course;
}

void read_along_axis(lua_State* L, int index, const Where& where, AlongArguments& arguments)
{
    read_line<Along::Axis>(L, index, where, arguments, 2,
                           "an axis { point, direction }, as { { 0, 0, 0 }, { 0, 0, 1 } }");
}

void read_along_helix(lua_State* L, int index, const Where& where, AlongArguments& arguments)
{
    auto& helix = read_line<Along::Helix>(L, index, where, arguments, 4,
                                          "a helix { point, direction, pitch, turns }");
    helix.pitch = read_number(L, push_element(L, index, 3), where);
    helix.turns = read_number(L, push_element(L, index, 4), where);
}

/// A function, an array of points or an array of tags of edges.
void read_along_path(lua_State* L, int index, const Where& where, AlongArguments& arguments)
{
    const char* const expected = "an array of points {x, y, z}, an array of tags of edges or a function(t) "
                                 "that returns x, y, z";
    auto& path = set_course<Along::Path>(L, where, arguments);
    if (lua_type(L, index) == LUA_TFUNCTION) {
        const RecipeFunction function = keep_function(L, index, arguments.roles->functions, where);
        guard(L, [&] { path.curve = [function](double at) { return function.point(at); }; });
        return;
    }
    if (array_length(L, index) == 0) fail_value(L, where, expected, index);
    const bool edges = lua_type(L, push_element(L, index, 1)) == LUA_TNUMBER;
    lua_pop(L, 1);
    if (edges)
        read_items(L, index, where, expected, path.edges, read_tag);
    else
        read_items(L, index, where, expected, path.points, read_vector);
}

void read_thickness(lua_State* L, int index, const Where& where, AlongArguments& arguments,
                    std::function<double(const Vec3&)>& thickness)
{
    read_field(L, index, where, arguments.roles->functions, thickness, read_number,
               "a number or a function(x, y, z) that returns one");
}

void read_along_normals(lua_State* L, int index, const Where& where, AlongArguments& arguments)
{
    auto& normals = set_course<Along::Normals>(L, where, arguments);
    if (lua_type(L, index) != LUA_TTABLE) {
        read_thickness(L, index, where, arguments, normals.outside);
        return;
    }
    if (lua_rawlen(L, index) != 2) fail_value(L, where, "a thickness or two, { inside, outside }", index);
    read_thickness(L, push_element(L, index, 1), where, arguments, normals.inside);
    read_thickness(L, push_element(L, index, 2), where, arguments, normals.outside);
}

void read_along_to(lua_State* L, int index, const Where& where, AlongArguments& arguments)
{
    auto& to = set_course<Along::ToFace>(L, where, arguments);
    RoleArguments& roles = *arguments.roles;
    to.face = read_any_face(L, index, where, *roles.model, roles.of);
    to.model = &roles.of->model;
}

template <auto Profile>
void read_profile(lua_State* L, int index, const Where& where, AlongArguments& arguments)
{
    if (lua_type(L, index) == LUA_TFUNCTION) {
        const RecipeFunction function = keep_function(L, index, arguments.roles->functions, where);
        guard(L, [&] {
            (arguments.along.*Profile).emplace().at = [function](double height) {
                return function.value({height});
            };
        });
    } else if (lua_type(L, index) == LUA_TNUMBER) {
        (arguments.along.*Profile).emplace().last = read_number(L, index, where);
    } else {
        fail_value(L, where, "a number or a function of the height", index);
    }
}

const Word<bool> kFrames[] = {{"minimal", false}, {"fixed", true}};

const Option<AlongArguments> kAlongOptions[] = {
    {"vector", read_along_vector},
    {"axis", read_along_axis},
    {"angle", number<&AlongArguments::angle>},
    {"path", read_along_path},
    {"frame", word<&AlongArguments::fixed, kFrames>},
    {"helix", read_along_helix},
    {"normals", read_along_normals},
    {"to", read_along_to},
    {"twist", read_profile<&Along::twist>},
    {"scale", read_profile<&Along::scale>},
};

void read_along(lua_State* L, int index, const Where& where, RoleArguments& roles)
{
    if (lua_type(L, index) != LUA_TTABLE)
        fail_value(L, where, "a table with a path, as { vector = { 0, 0, 1 } }", index);
    auto& arguments = temporary<AlongArguments>(L);
    arguments.roles = &roles;
    read_options(L, index, "open_volume: along", kAlongOptions, arguments);
    if (arguments.course == nullptr)
        fail_option(L, where, "has no path: give 'vector', 'axis', 'path', 'helix', 'normals' or 'to'");
    auto* const axis = std::get_if<Along::Axis>(&arguments.along.course);
    auto* const path = std::get_if<Along::Path>(&arguments.along.course);
    if ((axis == nullptr) != !arguments.angle)
        fail_option(L, where,
                    axis ? "has no 'angle' of the turn: { axis = { point, direction }, angle = 90 }"
                         : "has an 'angle' without an 'axis'");
    if (path == nullptr && arguments.fixed) fail_option(L, where, "has a 'frame' without a 'path'");
    if (axis != nullptr) axis->angle = *arguments.angle;
    if (path != nullptr) path->fixed = arguments.fixed.value_or(false);
    guard(L, [&] { roles.along = std::move(arguments.along); });
}

const Option<RoleArguments> kRoleOptions[] = {
    {"source", read_role<&topology::Roles::source>},
    {"target", read_role<&topology::Roles::target>},
    {"walls", read_walls},
    {"faces", read_volume_faces},
    {"reading", count<&RoleArguments::reading>},
    {"class", word<&RoleArguments::override_class, kClasses>},
    {"full_turn", boolean<&RoleArguments::full_turn>},
    {"name", plain_name<&RoleArguments::name>},
    {"material", read_material},
    {"along", read_along},
    {"glued", boolean<&RoleArguments::glued>},
    {"fill_to", plane<&RoleArguments::fill_to>},
};

/// A volume with the decks, the scale and the unit of its model.
fill::Volume of_model(const ModelState& model, fill::Volume volume)
{
    volume.decks = model.decks;
    volume.scale = model.scale;
    volume.unit = model.unit;
    return volume;
}

/// volume = model:open_volume { source=, target=, walls= [, class=] [, name=] [, material=] }
/// volume = model:open_volume { source=, along= }
/// volume = model:open_volume { faces= [, reading=] }, or of all faces: their roles are found
int open_volume(lua_State* L)
{
    lua_settop(L, 2);
    const Box<ModelState>& model = hold_model(L, 1);
    lua_newtable(L);
    auto& arguments = temporary<RoleArguments>(L);
    arguments.functions = lua_gettop(L) - 1;
    arguments.model = &model;
    read_options(L, 2, "open_volume", kRoleOptions, arguments);
    const fill::RoleRequest& request = arguments;
    if (request.roles && request.faces)
        fail(L, "open_volume: give either the roles (source, target, walls) or 'faces', whose roles are "
                "detected; not both");
    if (request.roles && request.reading > 1)
        fail(L, "open_volume: 'reading' selects one of several detected volumes; with named roles "
                "there is only reading = 1, which accepts a guessed shape");
    const bool ends = request.roles && (!request.roles->source.empty() || !request.roles->target.empty());
    if (request.full_turn && (request.find_walls || ends || request.override_class || request.reading > 0))
        fail(L, "open_volume: full_turn = true takes walls only, no source, target, class or reading; "
                "name the walls by tag or name, or give none for all faces");
    RunContext& context = push_context(L);
    auto& box = new_box<VolumeState>(L);
    guard(L, [&] {
        box = std::make_shared<VolumeState>();
        arguments.decks = model->decks;
        arguments.scale = model->scale;
        *box = of_model(*model, fill::open(model->model, request, context));
    });
    return 1;
}

/// { volume, … } = model:bodies()
int bodies(lua_State* L)
{
    lua_settop(L, 1);
    const Box<ModelState>& model = hold_model(L, 1);
    RunContext& context = push_context(L);
    auto& volumes = temporary<std::vector<Box<VolumeState>>>(L);
    guard(L, [&] {
        for (fill::Volume& volume : fill::open_bodies(model->model, context)) {
            volumes.push_back(std::make_shared<VolumeState>());
            *volumes.back() = of_model(*model, std::move(volume));
        }
    });
    push_array(L, volumes, [&](const auto& item) { new_box<VolumeState>(L) = item; });
    return 1;
}

// --- Volume ---------------------------------------------------------------------------------------------

std::string_view class_name(const VolumeState& state)
{
    return topology::to_string(state.classification.value);
}

/// { class=, free_loops=, wall_free_source=, wall_free_target=, reasons= } = volume:classify()
int classify(lua_State* L)
{
    const auto& state = hold<VolumeState>(L, 1);
    const topology::Classification& found = state.classification;
    lua_createtable(L, 0, 5);
    set_field(L, "class", class_name(state));
    set_field(L, "free_loops", found.free_loops.size());
    set_tags(L, "wall_free_source", state.volume.model, found.wall_free_source);
    set_tags(L, "wall_free_target", state.volume.model, found.wall_free_target);
    set_field(L, "reasons", found.reasons);
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
    // Keep no reference to an edge: a finalizer may close the volume, which moves its edges.
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
    const bool sealed = state.closure || topology::free_edges(state.volume).empty();
    give(L, class_name(state));
    lua_pushfstring(L, "Volume of class %s, %d faces, %s", lua_tostring(L, -1),
                    static_cast<int>(state.volume.model.faces.size()), sealed ? "sealed" : "open");
    return 1;
}

} // namespace

void bind_open_volume(lua_State* L)
{
    make_class<VolumeState>(L, {{"__tostring", volume_to_string}},
                            {{"class", field<VolumeState, class_name>}});
    add_methods<VolumeState>(L, {{"classify", classify},
                                 {"override_class", override_class},
                                 {"free_edges", free_edges},
                                 {"tree", volume_tree},
                                 {"describe", describe_volume}});
    add_methods<ModelState>(L, {{"open_volume", open_volume}, {"bodies", bodies}});
}

} // namespace lacuna::lua
