// SPDX-License-Identifier: MIT
#include "bindings/classes.h"
#include "bindings/faces.h"
#include "bindings/options.h"

#include <optional>
#include <utility>

namespace lacuna::lua {

namespace {

using closure::Cap;
using closure::CloseOptions;
using closure::EdgeShape;
using closure::Holes;

const Word<EdgeShape> kEdgeShapes[] = {
    {"straight", EdgeShape::straight},
    {"follow", EdgeShape::follow},
    {"smooth", EdgeShape::smooth},
    {"auto", EdgeShape::automatic},
};

const Word<Cap> kCaps[] = {{"flat", Cap::flat}, {"parallel", Cap::parallel}, {"auto", Cap::automatic}};

const Word<Holes> kHoles[] = {{"cover", Holes::cover}, {"through", Holes::through}};

/// Void edges { from, to [, points] }: two vertex tags and an array of points {x, y, z}.
void read_void_edges(lua_State* L, int index, const Where& where, CloseOptions& options)
{
    const std::size_t count = array_length(L, index);
    guard(L, [&] { options.void_edges.resize(count); });
    std::size_t next = 0;
    read_array(L, index, where, "an array of void edges { from, to, points }",
               [&](int element, const Where& at) {
                   const std::size_t size = array_length(L, element);
                   if (size != 2 && size != 3) fail_value(L, at, "a void edge { from, to, points }", element);
                   closure::VoidEdge& edge = options.void_edges[next++];
                   edge.from = read_whole(L, push_element(L, element, 1), at, 1);
                   edge.to = read_whole(L, push_element(L, element, 2), at, 1);
                   if (size < 3) return;
                   read_items(L, push_element(L, element, 3), {at.call, lua_pushfstring(L, "%s[3]", at.key)},
                              "an array of points {x, y, z}", edge.points, read_vector);
               });
}

const Option<CloseOptions> kCloseOptions[] = {{"edge_shape", word<&CloseOptions::edge_shape, kEdgeShapes>},
                                              {"void_edges", read_void_edges},
                                              {"cap", word<&CloseOptions::cap, kCaps>},
                                              {"holes", word<&CloseOptions::holes, kHoles>}};

void push_closure(lua_State* L, const topology::Model& model, const closure::Closure& closed)
{
    lua_createtable(L, 0, 6);
    set_field(L, "void_edges", closed.void_edges.size());
    set_field(L, "void_faces", closed.void_faces.size());
    set_field(L, "watertight", closed.watertight);
    set_field(L, "algorithms", closed.algorithms);
    set_tags(L, "void_edge_tags", model, closed.void_edges);
    set_tags(L, "void_face_tags", model, closed.void_faces);
}

/// { void_edges=, void_faces=, watertight=, algorithms= } = volume:close([options])
int close(lua_State* L)
{
    lua_settop(L, 2);
    auto& state = hold<VolumeState>(L, 1);
    const bool by_hand = has_options(L, 2, "close");
    auto& options = temporary<CloseOptions>(L);
    read_options(L, 2, "close", kCloseOptions, options);
    RunContext& context = push_context(L);
    guard(L, [&] {
        const Busy busy(state, "close");
        state = fill::close(state, by_hand ? std::optional(options) : std::nullopt, context);
    });
    push_closure(L, state.volume.model, *state.closure);
    return 1;
}

/// boolean = volume:is_watertight()
int is_watertight(lua_State* L)
{
    const auto& state = hold<VolumeState>(L, 1);
    bool watertight = false;
    guard(L, [&] { watertight = closure::is_watertight(state.volume); });
    return give(L, watertight);
}

// --- cutting ------------------------------------------------------------------------------------------

/// The surface that cuts a volume: a plane, a face, or one found automatically.
struct CutArguments {
    const Box<ModelState>* model = nullptr; ///< the volume's own faces; on the stack during the call
    std::optional<geometry::Plane> plane;
    bool automatic = false;
    Box<ModelState> of; ///< the model of `face`
    FaceId face;
};

void read_cutting_face(lua_State* L, int index, const Where& where, CutArguments& arguments)
{
    arguments.face = read_any_face(L, index, where, *arguments.model, arguments.of);
}

const Option<CutArguments> kClosureCutOptions[] = {{"plane", plane<&CutArguments::plane>},
                                                   {"face", read_cutting_face},
                                                   {"auto", boolean<&CutArguments::automatic>}};

/// The faces of a volume as a model of their own, on top of the stack.
Box<ModelState>& push_model(lua_State* L, const VolumeState& state)
{
    auto& box = new_box<ModelState>(L);
    guard(L, [&] {
        box = std::make_shared<ModelState>();
        box->model = state.volume.model;
        box->decks = state.decks;
        box->scale = state.scale;
        box->unit = state.unit;
    });
    return box;
}

/// model = volume:model()
int volume_model(lua_State* L)
{
    push_model(L, hold<VolumeState>(L, 1));
    return 1;
}

/// { volume, ... } = volume:cut { plane = | face = }; without options, where the volume needs cuts
int cut(lua_State* L)
{
    lua_settop(L, 2);
    const auto& state = hold<VolumeState>(L, 1);
    auto& arguments = temporary<CutArguments>(L);
    if (!lua_isnil(L, 2)) {
        arguments.model = &push_model(L, state);
        read_options(L, 2, "cut", kClosureCutOptions, arguments);
        if (arguments.plane.has_value() + (arguments.of != nullptr) + arguments.automatic != 1)
            fail(L, "cut: give one of 'plane', 'face' and auto = true; for a volume with steps, give no "
                    "options");
    }
    RunContext& context = push_context(L);
    auto& pieces = temporary<std::vector<Box<VolumeState>>>(L);
    guard(L, [&] {
        const fill::Cut where{arguments.plane, arguments.of ? &arguments.of->model : nullptr, arguments.face,
                              arguments.automatic};
        for (fill::Volume& piece : fill::cut(state, where, context)) {
            pieces.push_back(std::make_shared<VolumeState>());
            *pieces.back() = std::move(piece);
        }
    });
    push_array(L, pieces, [&](const auto& item) { new_box<VolumeState>(L) = item; });
    return 1;
}

} // namespace

void bind_closure(lua_State* L)
{
    add_methods<VolumeState>(
        L, {{"close", close}, {"cut", cut}, {"is_watertight", is_watertight}, {"model", volume_model}});
}

} // namespace lacuna::lua
