// SPDX-License-Identifier: MIT
#include "bindings/classes.h"
#include "bindings/faces.h"
#include "bindings/fixed_members.h"
#include "bindings/full_turns.h"
#include "bindings/io_paths.h"
#include "bindings/lacuna_lua.h"
#include "bindings/options.h"
#include "bindings/write_mesh.h"

#include <lacuna/cad/left_out.h>
#include <lacuna/cad/load.h>
#include <lacuna/closure/branches.h>
#include <lacuna/closure/piece_ends.h>
#include <lacuna/io/deck_middles.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <span>
#include <string_view>
#include <thread>
#include <tuple>
#include <type_traits>

namespace lacuna::lua {

namespace {

using sweep::Quads;
using sweep::Spacing;

struct SweepArguments {
    sweep::SweepOptions options;
    int threads = 0;
    int size_function = 0; ///< stack index of a Lua function, 0 for none
    int row_height_function = 0;
    const VolumeState* volume = nullptr; ///< that selectors choose the faces of
    std::string name;                    ///< of that volume
    std::set<std::string> own;           ///< options that were given for it alone, and name its faces
};

// --- layers ---------------------------------------------------------------------------------------------

const Word<Spacing> kSpacings[] = {
    {"geometric", Spacing::geometric},
    {"bell", Spacing::bell},
    {"both_ends", Spacing::both_ends},
};

void read_spacing(lua_State* L, int index, const Where& where, sweep::LayerSpec& spec)
{
    spec.spacing = read_word(L, index, where, kSpacings);
}

const Option<sweep::LayerSpec> kLayerOptions[] = {
    {"count", count<&sweep::LayerSpec::count>},
    {"bias", positive<&sweep::LayerSpec::bias>},
    {"mode", read_spacing},
};

void read_heights(lua_State* L, int index, const Where& where, sweep::LayerSpec& spec)
{
    const std::size_t size = lua_rawlen(L, index);
    guard(L, [&] { spec.heights.resize(size); });
    std::size_t next = 0;
    read_array(L, index, where, "",
               [&](int element, const Where& at) { spec.heights[next++] = read_number(L, element, at); });
}

void read_layers(lua_State* L, int index, const Where& where, SweepArguments& arguments)
{
    sweep::LayerSpec& spec = arguments.options.layers;
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
                   "a positive whole number, an array of rising heights in (0, 1] or a table "
                   "{ count =, bias =, mode = }",
                   index);
    }
}

// --- size -----------------------------------------------------------------------------------------------

/// A length, or a Lua function of place: where that stands is settled by push_arguments().
void read_field(lua_State* L, int index, const Where& where, surface::SizeField& field, int& function)
{
    if (lua_type(L, index) == LUA_TFUNCTION) {
        function = 1;
    } else if (lua_type(L, index) == LUA_TNUMBER) {
        const double length = read_positive(L, index, where);
        guard(L, [&] { field = [length](const Vec3&) { return length; }; });
    } else {
        fail_value(L, where, "a positive number or a function(x, y, z) that returns one", index);
    }
}

void read_size(lua_State* L, int index, const Where& where, SweepArguments& arguments)
{
    read_field(L, index, where, arguments.options.size, arguments.size_function);
}

void read_row_height(lua_State* L, int index, const Where& where, SweepArguments& arguments)
{
    read_field(L, index, where, arguments.options.row_height, arguments.row_height_function);
}

void read_rows(lua_State* L, int index, const Where& where, SweepArguments& arguments)
{
    arguments.options.rows = read_whole(L, index, where, 1);
}

// --- boundary layers and intervals ----------------------------------------------------------------------

/// A Face, a tag, a name or a selector of faces of the volume.
void read_face_name(lua_State* L, int index, const Where& where, const VolumeState& volume,
                    surface::FaceNames& names)
{
    if (const Box<FaceHandle>* handle = test_box<FaceHandle>(L, index)) {
        if (!*handle) fail_option(L, where, "is a face that was closed");
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
        for (const FaceId face : select(volume.volume.model, wanted)) {
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
    if (lua_type(L, index) == LUA_TTABLE && lua_rawlen(L, index) > 0) {
        read_array(L, index, where, "",
                   [&](int element, const Where& at) { read_face_name(L, element, at, volume, names); });
        return;
    }
    read_face_name(L, index, where, volume, names);
}

struct LayerArguments {
    surface::BoundaryLayer layer;
    const VolumeState* volume = nullptr;
};

void read_layer_walls(lua_State* L, int index, const Where& where, LayerArguments& arguments)
{
    read_face_names(L, index, where, *arguments.volume, arguments.layer.walls);
}

void read_first(lua_State* L, int index, const Where& where, LayerArguments& arguments)
{
    arguments.layer.first = read_positive(L, index, where);
}

void read_growth(lua_State* L, int index, const Where& where, LayerArguments& arguments)
{
    arguments.layer.growth = read_positive(L, index, where);
}

void read_count(lua_State* L, int index, const Where& where, LayerArguments& arguments)
{
    arguments.layer.count = read_whole(L, index, where, 1);
}

const Option<LayerArguments> kBoundaryLayerOptions[] = {
    {"walls", read_layer_walls},
    {"first", read_first},
    {"growth", read_growth},
    {"count", read_count},
};

void read_boundary_layer(lua_State* L, int index, const Where& where, SweepArguments& arguments)
{
    if (lua_type(L, index) != LUA_TTABLE)
        fail_value(L, where, "a table { walls =, first =, growth =, count = } or an array of those", index);
    auto& one = temporary<LayerArguments>(L);
    one.volume = arguments.volume;
    read_options(L, index, "sweep: boundary_layers", kBoundaryLayerOptions, one);
    if (one.layer.walls.tags.empty() && one.layer.walls.names.empty())
        fail_option(L, where, "has no 'walls': { walls =, first =, growth =, count = }");
    if (one.layer.first == 0) fail_option(L, where, "has no 'first', the thickness of the first row");
    guard(L, [&] { arguments.options.boundary_layers.push_back(one.layer); });
}

void read_boundary_layers(lua_State* L, int index, const Where& where, SweepArguments& arguments)
{
    if (lua_type(L, index) == LUA_TTABLE && lua_rawlen(L, index) > 0) {
        read_array(L, index, where, "",
                   [&](int element, const Where& at) { read_boundary_layer(L, element, at, arguments); });
        return;
    }
    read_boundary_layer(L, index, where, arguments);
}

/// Whether the value is { vertex, vertex }.
bool is_pair_of_tags(lua_State* L, int index)
{
    if (lua_type(L, index) != LUA_TTABLE || lua_rawlen(L, index) != 2) return false;
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
    if (lua_type(L, index) != LUA_TTABLE || lua_rawlen(L, index) < 1) fail_value(L, where, expected, index);
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
    lua_rawgeti(L, index, 1);
    const int what = lua_gettop(L);
    if (lua_type(L, what) == LUA_TNUMBER) {
        interval.of = Of::edge;
        interval.edge = read_whole(L, what, where, 0);
    } else if (is_pair_of_tags(L, what)) {
        interval.of = Of::vertices;
        for (int i = 0; i < 2; ++i) {
            lua_rawgeti(L, what, i + 1);
            interval.vertices[static_cast<std::size_t>(i)] = read_whole(L, lua_gettop(L), where, 0);
            lua_pop(L, 1);
        }
    } else if (lua_type(L, what) == LUA_TSTRING && std::string_view(lua_tostring(L, what)) == "sweep") {
        interval.of = Of::sweep;
    } else {
        interval.of = Of::wall;
        read_face_names(L, what, where, *arguments.volume, interval.walls);
    }
    guard(L, [&] { arguments.options.intervals.push_back(interval); });
}

void read_intervals(lua_State* L, int index, const Where& where, SweepArguments& arguments)
{
    read_array(L, index, where, "an array of { edge, { vertex, vertex }, wall or \"sweep\"; count [, bias] }",
               [&](int element, const Where& at) { read_interval(L, element, at, arguments); });
}

/// Calls back a recipe's function. The kernel samples sizes on the thread that called it; were it ever to ask
/// from another, Lua, which knows no threads, would be lost: so that is refused.
struct LuaSize {
    lua_State* state;
    int function;
    std::thread::id thread;
    const char* option = "size";

    double operator()(const Vec3& place) const
    {
        lua_State* const L = state;
        if (std::this_thread::get_id() != thread || !lua_checkstack(L, 8))
            throw Error("lua.size_function", std::string("the function of option '") + option +
                                                 "' cannot be called here; give a number");
        lua_pushvalue(L, function);
        for (const double coordinate : place) lua_pushnumber(L, coordinate);
        if (lua_pcall(L, 3, 1, 0) != LUA_OK) {
            keep_callback_error(L);
            throw CallbackFailed{};
        }
        const double size = lua_type(L, -1) == LUA_TNUMBER ? lua_tonumber(L, -1) : std::nan("");
        lua_pop(L, 1);
        return size; // the kernel refuses what is no length
    }
};

// --- the rest -------------------------------------------------------------------------------------------

const Word<Quads> kQuads[] = {
    {"auto", Quads::automatic}, {"paved", Quads::paved}, {"mapped", Quads::mapped},
    {"gmsh", Quads::gmsh},      {"keep", Quads::keep},
};

void read_quads(lua_State* L, int index, const Where& where, SweepArguments& arguments)
{
    arguments.options.quads = read_word(L, index, where, kQuads);
}

void read_wedges(lua_State* L, int index, const Where& where, SweepArguments& arguments)
{
    arguments.options.wedges = read_boolean(L, index, where);
}

const Word<sweep::Fallback> kFallbacks[] = {
    {"wedges", sweep::Fallback::wedges},
    {"leave_out", sweep::Fallback::leave_out},
};

void read_fallback(lua_State* L, int index, const Where& where, SweepArguments& arguments)
{
    arguments.options.fallback = read_word(L, index, where, kFallbacks);
}

void read_order(lua_State* L, int index, const Where& where, SweepArguments& arguments)
{
    arguments.options.order = read_whole(L, index, where, 1);
    if (arguments.options.order > 2) fail_value(L, where, "1 or 2", index);
}

void read_serendipity(lua_State* L, int index, const Where& where, SweepArguments& arguments)
{
    arguments.options.second_order.serendipity = read_boolean(L, index, where);
}

void read_min_scaled_jacobian(lua_State* L, int index, const Where& where, SweepArguments& arguments)
{
    arguments.options.min_scaled_jacobian = read_number(L, index, where);
}

void read_curvature(lua_State* L, int index, const Where& where, SweepArguments& arguments)
{
    arguments.options.curvature = read_whole(L, index, where, 0);
    arguments.options.volume_share = 0; // who names the sides for a turn gets those
}

void read_gap(lua_State* L, int index, const Where& where, SweepArguments& arguments)
{
    arguments.options.gap = read_whole(L, index, where, 1);
}

void read_max_deviation(lua_State* L, int index, const Where& where, SweepArguments& arguments)
{
    arguments.options.max_deviation = read_positive(L, index, where);
}

const Word<sweep::Interior> kInteriors[] = {
    {"auto", sweep::Interior::automatic},
    {"affine", sweep::Interior::affine},
    {"residual", sweep::Interior::residual},
    {"normals", sweep::Interior::normals},
};

void read_interior(lua_State* L, int index, const Where& where, SweepArguments& arguments)
{
    arguments.options.interior = read_word(L, index, where, kInteriors);
}

const Option<sweep::ImproveOptions> kImproveOptions[] = {
    {"iterations", count<&sweep::ImproveOptions::iterations>},
    {"seconds", positive<&sweep::ImproveOptions::seconds>},
};

void read_improve(lua_State* L, int index, const Where& where, SweepArguments& arguments)
{
    if (lua_type(L, index) == LUA_TTABLE) {
        read_options(L, index, "sweep: improve", kImproveOptions, arguments.options.improving);
    } else if (lua_type(L, index) == LUA_TBOOLEAN) {
        arguments.options.improve = read_boolean(L, index, where);
    } else {
        fail_value(L, where, "true, false or a table { iterations =, seconds = }", index);
    }
}

const Option<SweepArguments> kSweepOptions[] = {
    {"layers", read_layers},
    {"size", read_size},
    {"curvature", read_curvature},
    {"gap", read_gap},
    {"max_deviation", read_max_deviation},
    {"quads", read_quads},
    {"wedges", read_wedges},
    {"fallback", read_fallback},
    {"rows", read_rows},
    {"row_height", read_row_height},
    {"boundary_layers", read_boundary_layers},
    {"intervals", read_intervals},
    {"order", read_order},
    {"serendipity", read_serendipity},
    {"min_scaled_jacobian", read_min_scaled_jacobian},
    {"improve", read_improve},
    {"interior", read_interior},
    {"threads", count<&SweepArguments::threads>},
};

/// Leave the function of an option on the stack, if it is one, for the field to call.
void push_field(lua_State* L, int index, const char* option, int function, surface::SizeField& field)
{
    if (!function) return;
    lua_getfield(L, index, option);
    const int place = lua_gettop(L);
    guard(L, [&] { field = LuaSize{L, place, std::this_thread::get_id(), option}; });
}

/// Read the options at `index`; leaves what they need on the stack.
SweepArguments& push_arguments(lua_State* L, int index, const char* call, const VolumeState& volume)
{
    auto& arguments = temporary<SweepArguments>(L);
    arguments.volume = &volume;
    read_options(L, index, call, kSweepOptions, arguments);
    push_field(L, index, "size", arguments.size_function, arguments.options.size);
    push_field(L, index, "row_height", arguments.row_height_function, arguments.options.row_height);
    guard(L, [&] { arguments.options.quad_mesher = cad::recombine; });
    // A height alone stands for one row of it.
    if (arguments.options.row_height && arguments.options.rows == 0) arguments.options.rows = 1;
    guard(L, [&] {
        RunContext context;
        context.threads = arguments.threads;
        sweep::check(arguments.options, context);
    });
    return arguments;
}

/// Nodes of the decks a volume's faces came from, where `ask(deck, tolerance, scale)` finds them; the first
/// deck that has one gives it.
template <class Ask>
std::vector<Vec3> from_decks(const VolumeState& state, std::size_t count, const Ask& ask)
{
    constexpr double kTogether =
        1e-9; // of the diagonal: kept nodes are the decks' to the bit, but for the scale
    std::vector<Vec3> found(count, Vec3::Constant(std::numeric_limits<double>::quiet_NaN()));
    for (const auto& deck : state.decks) {
        const std::vector<Vec3> own = ask(*deck, kTogether * state.volume.model.diagonal, state.scale);
        for (std::size_t i = 0; i < found.size(); ++i)
            if (!found[i].allFinite()) found[i] = own[i];
    }
    return found;
}

/// Middle nodes of sides and of quads that the decks give.
void take_given_middles(const VolumeState& state, sweep::SecondOrderOptions& options)
{
    options.given = [&state](std::span<const Vec3> from, std::span<const Vec3> to) {
        return from_decks(state, from.size(), [&](const io::Deck& deck, double tolerance, double scale) {
            return io::middles_between(deck, from, to, tolerance, scale);
        });
    };
    options.given_centres = [&state](std::span<const std::array<Vec3, 4>> quads) {
        return from_decks(state, quads.size(), [&](const io::Deck& deck, double tolerance, double scale) {
            return io::centres_of(deck, quads, tolerance, scale);
        });
    };
}

/// Do something to a volume of an assembly; where it fails and may be left out, say so.
/// @return  whether it was done.
template <class Do>
bool do_or_leave_out(std::vector<sweep::LeftOut>& left_out, const std::string& region,
                     const SweepArguments& arguments, const Do& what)
{
    if (arguments.options.fallback != sweep::Fallback::leave_out) {
        what();
        return true;
    }
    try {
        what();
        return true;
    } catch (const Cancelled&) {
        throw;
    } catch (const Error& error) {
        left_out.push_back({region, error.code(), region + ": " + error.what()});
        return false;
    }
}

/// A member of an assembly: a volume with its options, or a mesh that stays as it is.
struct ToMesh {
    Box<VolumeState> volume;
    const SweepArguments* arguments = nullptr;
    std::unique_ptr<FixedMember> fixed;
    bool left_out = false; ///< its faces may be named all the same
};

/// A volume of an assembly with its options, or the pieces of one with branches or steps.
void add_members(std::vector<ToMesh>& members, const Box<VolumeState>& volume, const std::string& name,
                 const SweepArguments& arguments, const RunContext& context)
{
    if (!closure::has_pieces(volume->volume, context)) {
        members.push_back({volume, &arguments, nullptr, false});
        return;
    }
    int number = 0;
    for (closure::StepPiece& piece : closure::cut_into_pieces(volume->volume, context)) {
        members.push_back({std::make_shared<VolumeState>(), &arguments, nullptr, false});
        VolumeState& own = *members.back().volume;
        own.volume = std::move(piece.volume);
        own.level = piece.level;
        own.turn_from = piece.turn_from;
        own.turn_to = piece.turn_to;
        if (piece.turn_to - piece.turn_from < 1) own.turn_of = name;
        own.name = name + "_" + std::to_string(++number);
        own.material = volume->material;
    }
}

/// The options that name faces.
constexpr std::array<const char*, 2> kOfFaces{"boundary_layers", "intervals"};

/// Give each word of those and the faces that it names.
template <class Options, class Do>
void for_each_names(Options& options, const Do& give)
{
    for (auto& layer : options.boundary_layers) give(kOfFaces[0], layer.walls);
    for (auto& interval : options.intervals)
        if (interval.of == surface::Interval::Of::wall) give(kOfFaces[1], interval.walls);
}

/// Options for many volumes name faces that one alone has: leave out those that this one has not.
void keep_known_faces(sweep::AssemblyMember& member)
{
    for_each_names(member.options, [&](const char*, surface::FaceNames& names) {
        std::erase_if(names.tags, [&](int tag) { return !surface::has_face(*member.volume, tag); });
        std::erase_if(names.names,
                      [&](const auto& name) { return !surface::has_face(*member.volume, name); });
    });
    const auto is_empty = [](const surface::FaceNames& names) {
        return names.tags.empty() && names.names.empty();
    };
    std::erase_if(member.options.boundary_layers, [&](auto& layer) { return is_empty(layer.walls); });
    std::erase_if(member.options.intervals, [&](auto& interval) {
        return interval.of == surface::Interval::Of::wall && is_empty(interval.walls);
    });
}

constexpr const char* kWhereFacesAre = "; volume:tree() lists faces";

/// "; the nearest is …": of the names of faces of some volumes.
std::string nearest_face_name(const std::vector<ToMesh>& all, const std::string& wanted,
                              const SweepArguments* of)
{
    std::set<std::string> known;
    for (const ToMesh& one : all) {
        if (!one.volume || (of != nullptr && one.arguments != of)) continue;
        for (const topology::Face& face : one.volume->volume.model.faces) {
            if (!face.name.empty() && face.origin == topology::Origin::given) known.insert(face.name);
            known.insert(face.groups.begin(), face.groups.end());
        }
    }
    if (known.empty()) return kWhereFacesAre;
    std::vector<const char*> keys;
    keys.reserve(known.size());
    for (const std::string& name : known) keys.push_back(name.c_str());
    return "; the nearest is \"" + std::string(keys[nearest(wanted.c_str(), keys.data(), keys.size())]) +
           "\"";
}

/// Refuse a face that is named and that no volume has; of options of one volume, that one.
void check_known_faces(const std::vector<ToMesh>& all)
{
    std::set<std::tuple<const SweepArguments*, std::string, std::string>> seen;
    const auto check = [&](const ToMesh& by, const std::string& option, bool own, const std::string& what,
                           const auto& face) {
        const SweepArguments* const of = own ? by.arguments : nullptr;
        if (!seen.emplace(of, option, what).second) return;
        const bool known = std::ranges::any_of(all, [&](const ToMesh& one) {
            return one.volume && (of == nullptr || one.arguments == of) &&
                   surface::has_face(one.volume->volume, face);
        });
        if (known) return;
        std::string advice = kWhereFacesAre;
        if constexpr (std::is_same_v<std::decay_t<decltype(face)>, std::string>)
            advice = nearest_face_name(all, face, of);
        const std::string name = own ? by.arguments->name : "";
        throw InvalidInput("surface.no_such_face",
                           "sweep: option '" + option + "'" + (own ? " of " + name : "") + " names " + what +
                               ", which " + (own ? name : "no volume of the assembly") + " has" +
                               (own ? " not" : "") + advice);
    };
    for (const ToMesh& one : all) {
        if (!one.volume) continue;
        for_each_names(one.arguments->options,
                       [&](const std::string& option, const surface::FaceNames& names) {
                           const bool own = one.arguments->own.contains(option);
                           for (const int tag : names.tags)
                               check(one, option, own, "face " + std::to_string(tag), tag);
                           for (const std::string& name : names.names)
                               check(one, option, own, '"' + name + '"', name);
                       });
    }
}

/// A turn of fewer layers would have one of 120° and more, which no hexahedron spans.
constexpr int kLeastPerTurn = 4;

/// A piece of a full turn has its share of the layers asked for.
void share_layers(const VolumeState& state, sweep::LayerSpec& layers)
{
    const double share = state.turn_to - state.turn_from;
    if (share == 1) return;
    if (!layers.heights.empty() || layers.bias != 1)
        throw InvalidInput(
            "sweep.full_turn_layers",
            "layers of a full turn have no first and no last: give their count alone, or "
            "sweep the pieces that volume:cut() gives with 'heights' or a 'bias' of their own");
    if (layers.count == 0) return;
    if (layers.count < kLeastPerTurn)
        throw InvalidInput("sweep.full_turn_layers", "a full turn needs " + std::to_string(kLeastPerTurn) +
                                                         " layers at least; asked for are " +
                                                         std::to_string(layers.count));
    const auto until = [&](double turn) { return static_cast<int>(std::lround(turn * layers.count)); };
    layers.count = std::max(1, until(state.turn_to) - until(state.turn_from));
}

/// Say in the report which faces of the file are missing in a volume, and what stands there.
void tell_left_out(const VolumeState& state, std::vector<std::string>& report)
{
    for (const std::string& missing : cad::left_out_in_words(state.volume))
        report.push_back("closed: " + missing);
}

/// Layers asked for are those of the pieces that go from end to end.
std::shared_ptr<AssemblyMeshState> sweep_members(const std::vector<ToMesh>& all,
                                                 std::vector<sweep::LeftOut> left_out,
                                                 const RunContext& context)
{
    std::vector<sweep::AssemblyMember> members;
    std::vector<std::string> materials;
    std::vector<std::unique_ptr<Busy>> busy;
    auto mesh = std::make_shared<AssemblyMeshState>();
    for (std::size_t m = 0; m < all.size(); ++m) {
        const std::string number = "volume_" + std::to_string(m + 1);
        if (const FixedMember* fixed = all[m].fixed.get()) {
            const mesh::HexMesh& own = fixed->swept.mesh;
            materials.push_back(fixed->material);
            members.push_back(
                {&fixed->skin.volume, {}, fixed->region.empty() ? number : fixed->region, &fixed->swept, {}});
            members.back().options.order = own.order();
            members.back().options.second_order.serendipity = own.order() > 1 && !own.middles.full;
            continue;
        }
        VolumeState& state = *all[m].volume;
        busy.push_back(std::make_unique<Busy>(state, "sweep"));
        const std::string region = state.name.empty() ? number : state.name;
        const auto close = [&] {
            close_volume(state, {}, context);
            closure::check_ends(state.volume, region);
        };
        if (all[m].left_out || !do_or_leave_out(left_out, region, *all[m].arguments, close)) continue;
        materials.push_back(state.material);
        members.push_back({&state.volume, all[m].arguments->options, region, nullptr, state.turn_of});
        if (state.level > 0) members.back().options.layers = {};
        share_layers(state, members.back().options.layers);
    }
    check_known_faces(all);
    for (sweep::AssemblyMember& member : members) keep_known_faces(member);
    if (members.empty() && !left_out.empty())
        throw NotSweepable(left_out.front().code, left_out.front().message);
    mesh->swept = sweep::sweep_assembly(members, context);
    std::vector<std::string> turns; // of each part
    for (const std::size_t m : mesh->swept.member) {
        turns.push_back(members[m].turn_of);
        mesh->regions.push_back(members[m].region);
        mesh->materials.push_back(materials[m]);
    }
    join_turns(*mesh, turns);
    for (const ToMesh& one : all)
        if (one.volume && !one.left_out) tell_left_out(*one.volume, mesh->swept.report);
    for (const sweep::LeftOut& out : left_out)
        mesh->swept.report.push_back("left out: " + out.message + " [" + out.code + "]");
    mesh->left_out = std::move(left_out);
    mesh->left_out.insert(mesh->left_out.end(), mesh->swept.left_out.begin(), mesh->swept.left_out.end());
    return mesh;
}

/// A volume whose roles were found, swept the other ways that enclose the same where one fails.
struct OtherWays {
    std::size_t next = 0;
    std::vector<std::string> failed;   ///< a line for each way
    std::exception_ptr first;          ///< why the likeliest failed
    std::optional<VolumeState> before; ///< the volume with the likeliest roles
};

/// The ends of a volume as a person knows them.
std::string ends_in_words(const topology::OpenVolume& volume)
{
    const auto list = [&](topology::Role role) {
        constexpr std::size_t kMost = 6; // what a person reads in a line
        const std::vector<FaceId> faces = volume.faces(role);
        std::string text = faces.empty() ? "what is missing" : "";
        for (std::size_t i = 0; i < std::min(kMost, faces.size()); ++i)
            text += (i == 0 ? "" : ", ") + topology::name_of(volume.model, faces[i]);
        return text + (faces.size() > kMost ? ", …" : "");
    };
    return "from " + list(topology::Role::source) + " to " + list(topology::Role::target);
}

/// Turn to the next way to sweep a volume. Called where one has failed, with its exception at hand.
/// @throw  what the first way failed by, where there is no other; the volume is as it was then.
void take_next_way(VolumeState& state, OtherWays& ways, const Error& why, const RunContext& context)
{
    if (!ways.first) {
        if (!state.others) throw;
        ways.first = std::current_exception();
        ways.before = state;
    }
    ways.failed.push_back("roles: swept " + ends_in_words(state.volume) + " it fails: " + why.what() + " [" +
                          why.code() + "]");
    log_line(context, ways.failed.back());
    const closure::OtherSweeps& others = *ways.before->others;
    if (ways.next == others.ways.size()) {
        const std::exception_ptr first = ways.first;
        const char* const busy = state.busy;
        state = std::move(*ways.before);
        state.busy = busy;
        std::rethrow_exception(first);
    }
    state.volume = closure::other_sweep(others, ways.next++);
    state.closure = others.closure;
    state.classification = topology::classify(state.volume);
    state.match.reset();
}

/// Sweep a volume one way; where that fails turn to the next.
/// @return  whether it is swept.
template <class Sweep>
bool sweep_or_turn(VolumeState& state, OtherWays& ways, const RunContext& context, const Sweep& sweep)
{
    try {
        std::vector<std::string>& report = sweep();
        if (!ways.failed.empty())
            ways.failed.push_back("roles: swept " + ends_in_words(state.volume) +
                                  " instead, which encloses the same volume");
        report.insert(report.begin(), ways.failed.begin(), ways.failed.end());
        return true;
    } catch (const NotSweepable& error) {
        take_next_way(state, ways, error, context);
    } catch (const NotClosed& error) {
        take_next_way(state, ways, error, context);
    }
    return false;
}

/// Sweep the pieces of a volume with branches or steps as an assembly.
bool sweep_steps(lua_State* L, const Box<VolumeState>& volume, SweepArguments& arguments, OtherWays& ways,
                 RunContext& context)
{
    auto& box = new_box<AssemblyMeshState>(L);
    bool done = false;
    guard(L, [&] {
        arguments.name = volume->name.empty() ? "the volume" : volume->name;
        arguments.own.insert(kOfFaces.begin(), kOfFaces.end());
        const Busy busy(*volume, "sweep");
        StageClock clock(context);
        done = sweep_or_turn(*volume, ways, context, [&]() -> std::vector<std::string>& {
            std::vector<ToMesh> pieces;
            add_members(pieces, volume, volume->name.empty() ? "piece" : volume->name, arguments, context);
            box = sweep_members(pieces, {}, context);
            return box->swept.report;
        });
        if (done) box->seconds = clock.seconds();
    });
    return done;
}

/// Say in the report what closing took though something else may have been meant, and there and in the log
/// what a match was unsure of that void edges were drawn by.
void tell_match(const VolumeState& state, std::vector<std::string>& report, const RunContext& context)
{
    tell_left_out(state, report);
    if (!state.closure) return;
    if (state.match && !state.closure->void_edges.empty()) {
        for (const std::string& note : state.match->notes) {
            report.push_back("match: " + note);
            if (context.log) context.log(report.back());
        }
    }
    for (const std::string& note : state.closure->notes) report.push_back("closed: " + note);
}

/// Sweep a volume as it is.
bool sweep_whole(lua_State* L, VolumeState& state, SweepArguments& arguments, OtherWays& ways,
                 RunContext& context)
{
    lua_gc(L, LUA_GCCOLLECT); // to Lua a mesh is a few bytes: it would let old ones pile up
    auto& box = new_box<MeshState>(L);
    bool done = false;
    guard(L, [&] {
        const Busy busy(state, "sweep");
        StageClock clock(context);
        done = sweep_or_turn(state, ways, context, [&]() -> std::vector<std::string>& {
            close_volume(state, {}, context);
            closure::check_ends(state.volume, state.name.empty() ? "the volume" : state.name);
            box = std::make_shared<MeshState>();
            if (!state.decks.empty()) take_given_middles(state, arguments.options.second_order);
            box->swept = sweep::sweep(state.volume, arguments.options, context);
            tell_match(state, box->swept.report, context);
            if (!state.name.empty()) box->swept.mesh.volume_groups = {state.name};
            box->material = state.material;
            return box->swept.report;
        });
        if (done) box->seconds = clock.seconds();
    });
    return done;
}

/// mesh = volume:sweep(options)
int sweep_volume(lua_State* L)
{
    lua_settop(L, 2);
    const Box<VolumeState>& volume = hold_box<VolumeState>(L, 1);
    VolumeState& state = *volume;
    SweepArguments& arguments = push_arguments(L, 2, "sweep", state);
    RunContext& context = push_context(L);
    if (arguments.threads != 0) context.threads = arguments.threads;
    auto& ways = temporary<OtherWays>(L);
    for (;;) {
        const int top = lua_gettop(L);
        bool steps = false;
        guard(L, [&] { steps = closure::has_pieces(state.volume, context); });
        if (steps ? sweep_steps(L, volume, arguments, ways, context)
                  : sweep_whole(L, state, arguments, ways, context))
            return 1;
        lua_settop(L, top);
    }
}

/// Take `write` out of a table of options: a copy without it stands at `index` then, and it on top.
void push_write_options(lua_State* L, int index)
{
    if (lua_type(L, index) != LUA_TTABLE) {
        lua_pushnil(L);
        return;
    }
    lua_newtable(L);
    for (lua_pushnil(L); lua_next(L, index) != 0;) {
        lua_pushvalue(L, -2);
        lua_insert(L, -2);
        lua_rawset(L, -4);
    }
    lua_pushliteral(L, "write");
    lua_rawget(L, -2);
    lua_pushliteral(L, "write");
    lua_pushnil(L);
    lua_rawset(L, -4);
    lua_insert(L, -2);
    lua_replace(L, index);
    if (lua_type(L, -1) != LUA_TNIL && lua_type(L, -1) != LUA_TTABLE)
        fail_value(L, {"sweep_to", "write"}, "a table of options { version =, binary =, quality = }", -1);
}

/// What sweep_to tells of a mesh, as fields of its report on top of the stack.
struct Told {
    std::size_t nodes = 0, hexes = 0, wedges = 0;
    int layers = 0;
    double least = 1; ///< scaled Jacobian
    bool streamed = false;
    int processes = 1;
};

void set_told(lua_State* L, const Told& told)
{
    set_count(L, "nodes", told.nodes);
    set_count(L, "hexes", told.hexes);
    set_count(L, "wedges", told.wedges);
    set_count(L, "layers", static_cast<std::size_t>(told.layers));
    set_number(L, "min_scaled_jacobian", told.least);
    set_boolean(L, "streamed", told.streamed);
    set_count(L, "processes", static_cast<std::size_t>(told.processes));
}

/// What sweep_to returns of a volume that was swept in pieces, whose mesh is on top: its report.
void push_report_of_pieces(lua_State* L)
{
    const int mesh = lua_gettop(L);
    const auto& state = hold<AssemblyMeshState>(L, mesh);
    lua_getfield(L, mesh, "report");
    Told told{.nodes = state.swept.nodes};
    for (const sweep::Swept& part : state.swept.parts) {
        told.hexes += part.mesh.hex_count();
        told.wedges += part.mesh.wedge_count();
        told.layers = std::max(told.layers, part.mesh.layers);
        told.least = std::min(told.least, part.min_scaled_jacobian);
    }
    set_told(L, told);
}

/// Sweep a volume as it is and write it, a layer at a time where that goes.
/// @return  whether it is swept
bool sweep_whole_to(lua_State* L, VolumeState& state, SweepArguments& arguments, OtherWays& ways,
                    const io::OutputPath& path, WriteArguments& file, const Crew* crew, RunContext& context)
{
    auto& swept = temporary<sweep::Swept>(L);
    auto& seconds = temporary<StageSeconds>(L);
    bool done = false;
    guard(L, [&] {
        const Busy busy(state, "sweep_to");
        StageClock clock(context);
        done = sweep_or_turn(state, ways, context, [&]() -> std::vector<std::string>& {
            close_volume(state, {}, context);
            closure::check_ends(state.volume, state.name.empty() ? "the volume" : state.name);
            if (!state.decks.empty()) take_given_middles(state, arguments.options.second_order);
            arguments.options.layered = true;
            arguments.options.crew = crew;
            swept = sweep::sweep(state.volume, arguments.options, context);
            tell_match(state, swept.report, context);
            return swept.report;
        });
        if (!done) return;
        if (!state.name.empty()) swept.mesh.volume_groups = {state.name};
        if (!swept.layers)
            swept.report.push_back(
                "sweep_to: the whole mesh was held in memory, since its nodes are more than "
                "placed layers: moved to improve cells, of order 2 or of boundary layers");
        write_layered(swept, state.material, path, file, crew, context);
        seconds = clock.seconds();
    });
    if (!done) return false;
    lua_createtable(L, static_cast<int>(swept.report.size()), 8);
    for (std::size_t i = 0; i < swept.report.size(); ++i) {
        lua_pushlstring(L, swept.report[i].data(), swept.report[i].size());
        lua_rawseti(L, -2, to_lua(i));
    }
    const mesh::HexMesh& mesh = swept.mesh;
    set_told(L, {.nodes = mesh::corner_count(mesh) + mesh.middles.nodes.size(),
                 .hexes = mesh.hex_count(),
                 .wedges = mesh.wedge_count(),
                 .layers = mesh.layers,
                 .least = swept.min_scaled_jacobian,
                 .streamed = swept.layers.has_value(),
                 .processes = swept.layers && crew != nullptr ? crew->size : 1});
    set_report_meta(L, seconds);
    return true;
}

/// report = volume:sweep_to(path, options)
int sweep_to(lua_State* L)
{
    lua_settop(L, 3);
    const Box<VolumeState>& volume = hold_box<VolumeState>(L, 1);
    VolumeState& state = *volume;
    const io::OutputPath& path = push_output_path(L, 2, "sweep_to");
    push_write_options(L, 3);
    WriteArguments& file = push_layered_write(L, lua_gettop(L), path);
    SweepArguments& arguments = push_arguments(L, 3, "sweep_to", state);
    RunContext& context = push_context(L);
    if (arguments.threads != 0) context.threads = arguments.threads;
    const Crew* const crew = host(L).crew;
    lua_gc(L, LUA_GCCOLLECT);
    auto& ways = temporary<OtherWays>(L);
    for (;;) {
        const int top = lua_gettop(L);
        bool steps = false;
        guard(L, [&] { steps = closure::has_pieces(state.volume, context); });
        if (steps && sweep_steps(L, volume, arguments, ways, context)) {
            const auto& pieces = check<AssemblyMeshState>(L, -1); // which stays on the stack
            guard(L, [&] { write_pieces(pieces, path, file, crew, context); });
            push_report_of_pieces(L);
            return 1;
        }
        if (!steps && sweep_whole_to(L, state, arguments, ways, path, file, crew, context)) return 1;
        lua_settop(L, top);
    }
}

// --- several volumes as one ---------------------------------------------------------------------------

/// The options of one volume: those for all, which have words as keys, and what [volume] says over them. Left
/// on the stack.
void push_options_of(lua_State* L, int index, const Box<VolumeState>& volume)
{
    lua_newtable(L);
    const int merged = lua_gettop(L);
    const auto lay_over = [&](int from) {
        for (lua_pushnil(L); lua_next(L, from) != 0;) {
            if (lua_type(L, -2) == LUA_TSTRING) {
                lua_pushvalue(L, -2);
                lua_insert(L, -2);
                lua_rawset(L, merged);
            } else {
                lua_pop(L, 1);
            }
        }
    };
    lay_over(index);
    for (lua_pushnil(L); lua_next(L, index) != 0; lua_pop(L, 1)) {
        const Box<VolumeState>* const key = test_box<VolumeState>(L, -2);
        if (key == nullptr || *key != volume) continue;
        lay_over(lua_absindex(L, -1));
    }
}

/// Refuse keys that are neither words nor volumes of the assembly, and keys of a volume's options that are no
/// words.
void check_volume_keys(lua_State* L, int index, const AssemblyState& assembly)
{
    for (lua_pushnil(L); lua_next(L, index) != 0; lua_pop(L, 1)) {
        if (lua_type(L, -2) == LUA_TSTRING) continue;
        const Box<VolumeState>* const key = test_box<VolumeState>(L, -2);
        const auto is_key = [key](const AssemblyState::Entry& entry) { return entry.volume == *key; };
        if (key == nullptr || !*key || std::ranges::none_of(assembly.entries, is_key))
            fail(L, "sweep: the keys of the options are words, or volumes of the assembly");
        if (lua_type(L, -1) != LUA_TTABLE) fail_value(L, {"sweep", "[volume]"}, "a table of options", -1);
        const int own = lua_gettop(L);
        for (lua_pushnil(L); lua_next(L, own) != 0; lua_pop(L, 1)) {
            if (lua_type(L, -2) == LUA_TSTRING) continue;
            fail(L,
                 "sweep: the keys of one volume's options are words; found a %s: give each volume's options "
                 "in the table of the whole",
                 test_box<VolumeState>(L, -2) != nullptr ? "volume" : luaL_typename(L, -2));
        }
    }
}

/// Which options that name faces a volume has of its own.
void read_own(lua_State* L, int index, const Box<VolumeState>& volume, SweepArguments& arguments)
{
    for (lua_pushnil(L); lua_next(L, index) != 0; lua_pop(L, 1)) {
        const Box<VolumeState>* const key = test_box<VolumeState>(L, -2);
        if (key == nullptr || *key != volume) continue;
        for (const char* option : kOfFaces) {
            if (lua_getfield(L, -1, option) != LUA_TNIL) guard(L, [&] { arguments.own.insert(option); });
            lua_pop(L, 1);
        }
    }
}

/// mesh = assembly:sweep(options)
int sweep_assembly(lua_State* L)
{
    lua_settop(L, 2);
    const auto& assembly = hold<AssemblyState>(L, 1);
    if (lua_isnoneornil(L, 2)) {
        lua_newtable(L);
        lua_replace(L, 2);
    }
    if (lua_type(L, 2) != LUA_TTABLE) fail_value(L, {"sweep", nullptr}, "a table of options", 2);
    check_volume_keys(L, 2, assembly);
    auto& arguments = temporary<std::vector<SweepArguments*>>(L);
    for (const AssemblyState::Entry& entry : assembly.entries) {
        if (!entry.volume) continue;
        luaL_checkstack(L, 16, "too many volumes");
        push_options_of(L, 2, entry.volume);
        SweepArguments& own = push_arguments(L, lua_gettop(L), "sweep", *entry.volume);
        read_own(L, 2, entry.volume, own);
        guard(L, [&] { arguments.push_back(&own); });
    }
    RunContext& context = push_context(L);
    if (!arguments.empty() && arguments.front()->threads != 0) context.threads = arguments.front()->threads;
    lua_gc(L, LUA_GCCOLLECT);
    auto& box = new_box<AssemblyMeshState>(L);
    guard(L, [&] {
        StageClock clock(context);
        std::vector<ToMesh> members;
        std::vector<sweep::LeftOut> left_out;
        auto own = arguments.begin();
        for (std::size_t m = 0; m < assembly.entries.size(); ++m) {
            const AssemblyState::Entry& entry = assembly.entries[m];
            for (std::unique_ptr<FixedMember>& fixed : fixed_members(entry, context))
                members.push_back({nullptr, nullptr, std::move(fixed), false});
            if (!entry.volume) continue;
            SweepArguments& options = **own++;
            const std::string name = entry.volume->name.empty() ? "volume_" + std::to_string(m + 1)
                                                                : entry.volume->name;
            options.name = name;
            const auto add = [&] { add_members(members, entry.volume, name, options, context); };
            if (!do_or_leave_out(left_out, name, options, add))
                members.push_back({entry.volume, &options, nullptr, true});
        }
        box = sweep_members(members, std::move(left_out), context);
        box->seconds = clock.seconds();
    });
    return 1;
}

const luaL_Reg kAssemblyMethods[] = {{"sweep", sweep_assembly}, {nullptr, nullptr}};
const luaL_Reg kVolumeMethods[] = {{"sweep", sweep_volume}, {"sweep_to", sweep_to}, {nullptr, nullptr}};

} // namespace

void bind_sweep(lua_State* L) { add_methods(L, kClassName<VolumeState>, kVolumeMethods); }

void bind_assembly_sweep(lua_State* L) { add_methods(L, kClassName<AssemblyState>, kAssemblyMethods); }

} // namespace lacuna::lua
