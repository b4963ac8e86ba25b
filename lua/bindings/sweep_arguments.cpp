// SPDX-License-Identifier: MIT
#include "bindings/sweep_arguments.h"

#include "bindings/faces.h"
#include "bindings/lacuna_lua.h"
#include "bindings/options.h"
#include "bindings/recipe_function.h"

#include <lacuna/cad/load.h>

#include <string_view>

namespace lacuna::lua {

namespace {

using sweep::Quads;
using sweep::Spacing;

// --- layers ---------------------------------------------------------------------------------------------

const Word<Spacing> kSpacings[] = {
    {"geometric", Spacing::geometric},
    {"bell", Spacing::bell},
    {"both_ends", Spacing::both_ends},
};

const Option<sweep::LayerSpec> kLayerOptions[] = {
    {"count", count<&sweep::LayerSpec::count>},
    {"bias", positive<&sweep::LayerSpec::bias>},
    {"mode", word<&sweep::LayerSpec::spacing, kSpacings>},
};

void read_heights(lua_State* L, int index, const Where& where, sweep::LayerSpec& spec)
{
    read_items(L, index, where, "", spec.heights, read_number);
}

void read_layers(lua_State* L, int index, const Where& where, SweepArguments& arguments)
{
    sweep::LayerSpec& spec = arguments.layers;
    int whole = 0;
    if (lua_type(L, index) == LUA_TNUMBER && lua_tointegerx(L, index, &whole) > 0 && whole) {
        spec.count = read_whole(L, index, where, 1);
    } else if (lua_type(L, index) == LUA_TTABLE && lua_rawlen(L, index) > 0) {
        read_heights(L, index, where, spec);
    } else if (lua_type(L, index) == LUA_TTABLE) {
        read_options(L, index, "sweep: layers", kLayerOptions, spec);
        if (spec.count == 0) fail_option(L, where, "has no 'count': { count =, bias =, mode = }");
    } else {
        fail_value(L, where,
                   "a positive whole number, an array of increasing heights in (0, 1] or a table "
                   "{ count =, bias =, mode = }",
                   index);
    }
}

// --- size -----------------------------------------------------------------------------------------------

template <auto Field, class Arguments>
void read_size(lua_State* L, int index, const Where& where, Arguments& arguments)
{
    read_field(L, index, where, arguments.functions, arguments.*Field, read_positive,
               "a positive number or a function(x, y, z) that returns one");
}

// --- boundary layers and intervals ----------------------------------------------------------------------

/// A Face, a tag, a name or a selector of faces of the volume.
void read_face_name(lua_State* L, int index, const Where& where, const VolumeState& volume,
                    surface::FaceNames& names)
{
    if (const Box<FaceHandle>* handle = test_box<FaceHandle>(L, index)) {
        if (!*handle) fail_option(L, where, "is a face that was released");
        guard(L, [&] { names.tags.push_back((*handle)->model->model[face_of(**handle)].tag); });
        return;
    }
    switch (lua_type(L, index)) {
    case LUA_TNUMBER: {
        const int tag = read_whole(L, index, where, 0);
        guard(L, [&] { names.tags.push_back(tag); });
        return;
    }
    case LUA_TSTRING: {
        const char* name = read_string(L, index, where);
        guard(L, [&] { names.names.emplace_back(name); });
        return;
    }
    case LUA_TTABLE:
        break;
    default:
        fail_value(L, where, "a Face, a tag, a name, a selector or an array of those", index);
    }
    lua_pushnil(L);
    if (lua_next(L, index) == 0) fail_option(L, where, "names no face");
    lua_pop(L, 2);
    auto& wanted = temporary<Selector>(L);
    read_selector(L, index, where.call, wanted);
    bool any = false;
    guard(L, [&] {
        for (const FaceId face : topology::select(volume.volume.model, wanted)) {
            if (volume.volume.model[face].origin != topology::Origin::given) continue;
            names.tags.push_back(volume.volume.model[face].tag);
            any = true;
        }
    });
    if (!any) fail_option(L, where, "selects no face of the volume");
}

void read_face_names(lua_State* L, int index, const Where& where, const VolumeState& volume,
                     surface::FaceNames& names)
{
    read_each(L, index, where,
              [&](int element, const Where& at) { read_face_name(L, element, at, volume, names); });
}

struct LayerArguments : surface::BoundaryLayer {
    const VolumeState* volume = nullptr;
};

void read_layer_walls(lua_State* L, int index, const Where& where, LayerArguments& arguments)
{
    read_face_names(L, index, where, *arguments.volume, arguments.walls);
}

const Option<LayerArguments> kBoundaryLayerOptions[] = {
    {"walls", read_layer_walls},
    {"first", positive<&LayerArguments::first>},
    {"growth", positive<&LayerArguments::growth>},
    {"count", count<&LayerArguments::count>},
};

void read_boundary_layer(lua_State* L, int index, const Where& where, SweepArguments& arguments)
{
    if (lua_type(L, index) != LUA_TTABLE)
        fail_value(L, where, "a table { walls =, first =, growth =, count = } or an array of those", index);
    auto& one = temporary<LayerArguments>(L);
    one.volume = arguments.volume;
    read_options(L, index, "sweep: boundary_layers", kBoundaryLayerOptions, one);
    if (one.walls.tags.empty() && one.walls.names.empty())
        fail_option(L, where, "has no 'walls': { walls =, first =, growth =, count = }");
    if (one.first == 0) fail_option(L, where, "has no 'first', the thickness of the first row");
    guard(L, [&] { arguments.boundary_layers.push_back(one); });
}

void read_boundary_layers(lua_State* L, int index, const Where& where, SweepArguments& arguments)
{
    read_each(L, index, where,
              [&](int element, const Where& at) { read_boundary_layer(L, element, at, arguments); });
}

/// Whether the value is { vertex, vertex }.
bool is_pair_of_tags(lua_State* L, int index)
{
    if (array_length(L, index) != 2) return false;
    bool numbers = true;
    for (int i = 1; i <= 2; ++i) {
        numbers = lua_rawgeti(L, index, i) == LUA_TNUMBER && numbers;
        lua_pop(L, 1);
    }
    return numbers;
}

/// { edge or { vertex, vertex } or wall or "sweep", count [, bias] }
void read_interval(lua_State* L, int index, const Where& where, SweepArguments& arguments)
{
    using Of = surface::Interval::Of;
    const char* const expected =
        "a table { edge tag, { vertex, vertex }, wall or \"sweep\"; count [, bias] }";
    if (array_length(L, index) < 1) fail_value(L, where, expected, index);
    auto& interval = temporary<surface::Interval>(L);
    const int top = lua_gettop(L);
    const auto read_either = [&](int place, const char* key) {
        if (lua_rawgeti(L, index, place) != LUA_TNIL) return true;
        lua_pop(L, 1);
        return lua_getfield(L, index, key) != LUA_TNIL;
    };
    if (!read_either(2, "count")) fail_option(L, where, "has no count: { …, count [, bias] }");
    interval.count = read_whole(L, lua_gettop(L), where, 1);
    lua_settop(L, top);
    if (read_either(3, "bias")) interval.bias = read_positive(L, lua_gettop(L), where);
    lua_settop(L, top);
    const int what = push_element(L, index, 1);
    if (lua_type(L, what) == LUA_TNUMBER) {
        interval.of = Of::edge;
        interval.edge = read_whole(L, what, where, 0);
    } else if (is_pair_of_tags(L, what)) {
        interval.of = Of::vertices;
        interval.vertices = {read_whole(L, push_element(L, what, 1), where, 0),
                             read_whole(L, push_element(L, what, 2), where, 0)};
    } else if (lua_type(L, what) == LUA_TSTRING && std::string_view(lua_tostring(L, what)) == "sweep") {
        interval.of = Of::sweep;
    } else {
        interval.of = Of::wall;
        read_face_names(L, what, where, *arguments.volume, interval.walls);
    }
    guard(L, [&] { arguments.intervals.push_back(interval); });
}

void read_intervals(lua_State* L, int index, const Where& where, SweepArguments& arguments)
{
    read_array(L, index, where, "an array of { edge, { vertex, vertex }, wall or \"sweep\"; count [, bias] }",
               [&](int element, const Where& at) { read_interval(L, element, at, arguments); });
}

/// { a, b [, translate = {x,y,z} or rotate = { point, direction, degrees }] }
void read_periodic_pair(lua_State* L, int index, const Where& where, SweepArguments& arguments)
{
    const char* const expected = "a table { face, face [, translate = {x, y, z} or rotate = { point, "
                                 "direction, degrees }] }, with names, tags, Faces or arrays of those";
    if (array_length(L, index) != 2) fail_value(L, where, expected, index);
    auto& held = temporary<std::vector<surface::PeriodicPair>>(
        L); // its matrix is aligned more than Lua's data
    guard(L, [&] { held.resize(1); });
    surface::PeriodicPair& pair = held.front();
    const int top = lua_gettop(L);
    for (int side = 1; side <= 2; ++side) {
        read_face_names(L, push_element(L, index, side), where, *arguments.volume,
                        side == 1 ? pair.a : pair.b);
        lua_settop(L, top);
    }
    for (lua_pushnil(L); lua_next(L, index) != 0; lua_pop(L, 1)) {
        if (lua_type(L, -2) != LUA_TSTRING) continue;
        const std::string_view key = lua_tostring(L, -2);
        if (pair.onto || (key != "translate" && key != "rotate")) fail_value(L, where, expected, index);
        const int value = lua_gettop(L);
        Eigen::Isometry3d onto = Eigen::Isometry3d::Identity();
        if (key == "translate") {
            onto.translation() = read_vector(L, value, where);
        } else {
            if (array_length(L, value) != 3) fail_value(L, where, expected, index);
            const auto [point, direction, angle] = read_turn(L, value, where);
            onto = Eigen::Translation3d(point) * Eigen::AngleAxisd(angle, direction.normalized()) *
                   Eigen::Translation3d(-point);
        }
        pair.onto = onto;
    }
    guard(L, [&] { arguments.periodic.push_back(pair); });
}

void read_periodic(lua_State* L, int index, const Where& where, SweepArguments& arguments)
{
    read_array(L, index, where, "an array of { face, face }",
               [&](int element, const Where& at) { read_periodic_pair(L, element, at, arguments); });
}

// --- the rest -------------------------------------------------------------------------------------------

const Word<Quads> kQuads[] = {
    {"auto", Quads::automatic}, {"paved", Quads::paved}, {"mapped", Quads::mapped},
    {"gmsh", Quads::gmsh},      {"keep", Quads::keep},
};

const Word<sweep::Fallback> kFallbacks[] = {
    {"none", sweep::Fallback::none},
    {"wedges", sweep::Fallback::wedges},
    {"leave_out", sweep::Fallback::leave_out},
    {"mixed", sweep::Fallback::mixed},
};

template <class Arguments>
void read_order(lua_State* L, int index, const Where& where, Arguments& arguments)
{
    arguments.order = read_whole(L, index, where, 1);
    if (arguments.order > 2) fail_value(L, where, "1 or 2", index);
}

template <class Arguments>
void read_curvature(lua_State* L, int index, const Where& where, Arguments& arguments)
{
    arguments.curvature = read_whole(L, index, where, 0);
    arguments.volume_share = 0; // a given number of sides for a turn replaces the default
}

const Option<sweep::ImproveOptions> kImproveOptions[] = {
    {"iterations", count<&sweep::ImproveOptions::iterations>},
    {"seconds", positive<&sweep::ImproveOptions::seconds>},
};

void read_improve(lua_State* L, int index, const Where& where, SweepArguments& arguments)
{
    if (lua_type(L, index) == LUA_TTABLE) {
        read_options(L, index, "sweep: improve", kImproveOptions, arguments.improving);
    } else if (lua_type(L, index) == LUA_TBOOLEAN) {
        arguments.improve = read_boolean(L, index, where);
    } else {
        fail_value(L, where, "true, false or a table { iterations =, seconds = }", index);
    }
}

const Option<SweepArguments> kSweepOptions[] = {
    {"layers", read_layers},
    {"size", read_size<&SweepArguments::size>},
    {"curvature", read_curvature},
    {"gap", count<&SweepArguments::gap>},
    {"max_deviation", positive<&SweepArguments::max_deviation>},
    {"quads", word<&SweepArguments::quads, kQuads>},
    {"wedges", boolean<&SweepArguments::wedges>},
    {"fallback", word<&SweepArguments::fallback, kFallbacks>},
    {"rows", count<&SweepArguments::rows>},
    {"row_height", read_size<&SweepArguments::row_height>},
    {"boundary_layers", read_boundary_layers},
    {"intervals", read_intervals},
    {"periodic", read_periodic},
    {"order", read_order},
    {"serendipity", boolean<&SweepArguments::second_order, &sweep::SecondOrderOptions::serendipity>},
    {"min_scaled_jacobian", number<&SweepArguments::min_scaled_jacobian>},
    {"improve", read_improve},
    {"threads", count<&SweepArguments::threads>},
};

void read_quads_faces(lua_State* L, int index, const Where& where, QuadsArguments& arguments)
{
    read_faces(L, index, where, *arguments.model, arguments.faces.emplace());
}

const Option<QuadsArguments> kQuadsOptions[] = {
    {"faces", read_quads_faces},
    {"size", read_size<&QuadsArguments::size>},
    {"curvature", read_curvature},
    {"gap", count<&QuadsArguments::gap>},
    {"quads", word<&QuadsArguments::quads, kQuads>},
    {"order", read_order},
    {"serendipity", boolean<&QuadsArguments::second_order, &sweep::SecondOrderOptions::serendipity>},
    {"threads", count<&QuadsArguments::threads>},
};

} // namespace

QuadsArguments& push_quads_arguments(lua_State* L, int index, const Box<ModelState>& model)
{
    lua_newtable(L);
    auto& arguments = temporary<QuadsArguments>(L);
    arguments.functions = lua_gettop(L) - 1;
    arguments.model = &model;
    read_options(L, index, "quads", kQuadsOptions, arguments);
    guard(L, [&] {
        arguments.quad_mesher = cad::recombine;
        if (!arguments.faces) arguments.faces = topology::all_faces(model->model);
    });
    return arguments;
}

SweepArguments& push_sweep_arguments(lua_State* L, int index, const char* call, const VolumeState& volume)
{
    lua_newtable(L);
    auto& arguments = temporary<SweepArguments>(L);
    arguments.functions = lua_gettop(L) - 1;
    arguments.volume = &volume;
    read_options(L, index, call, kSweepOptions, arguments);
    guard(L, [&] {
        arguments.quad_mesher = cad::recombine;
        arguments.tet_mesher = cad::fill_skin;
    });
    if (arguments.fallback == sweep::Fallback::mixed && std::string_view(call) == "sweep_to")
        fail(L, "sweep_to: fallback = \"mixed\" needs the whole mesh in memory: use sweep and write");
    // A row height without a number of rows means one row.
    if (arguments.row_height && arguments.rows == 0) arguments.rows = 1;
    guard(L, [&] {
        RunContext context;
        context.threads = arguments.threads;
        sweep::check(arguments, context);
    });
    return arguments;
}

} // namespace lacuna::lua
