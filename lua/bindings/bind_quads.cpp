// SPDX-License-Identifier: MIT
// model:quads and QuadMesh. Writing, buffers and pages add their methods.
#include "bindings/bind_quality.h"
#include "bindings/classes.h"
#include "bindings/lacuna_lua.h"
#include "bindings/options.h"
#include "bindings/sweep_arguments.h"

#include <algorithm>

namespace lacuna::lua {

namespace {

/// mesh = model:quads { faces =, size = }
int make_quad_mesh(lua_State* L)
{
    lua_settop(L, 2);
    const Box<ModelState>& model = hold_model(L, 1);
    QuadsArguments& arguments = push_quads_arguments(L, 2, model);
    RunContext& context = push_context(L);
    if (arguments.threads != 0) context.threads = arguments.threads;
    auto& box = new_box<QuadMeshState>(L);
    guard(L, [&] {
        StageClock clock(context);
        report_progress(context, "quads");
        box = std::make_shared<QuadMeshState>(
            QuadMeshState{fill::quads(model->model, *arguments.faces, arguments, context), {}});
        box->seconds = clock.seconds();
    });
    return 1;
}

/// Number of quads, or of triangles.
template <int Corners>
std::size_t quad_mesh_count(const fill::FilledShell& state)
{
    std::size_t count = 0;
    for (const io::DeckBlock& block : state.deck.blocks)
        if (io::shape_info(block.shape).corners == Corners) count += block.count();
    return count;
}

template <int Corners>
int quad_mesh_cells(lua_State* L)
{
    return give(L, quad_mesh_count<Corners>(check<QuadMeshState>(L, 1)));
}

int quad_mesh_nodes(lua_State* L) { return give(L, check<QuadMeshState>(L, 1).deck.points.size()); }

int quad_mesh_none(lua_State* L)
{
    check<QuadMeshState>(L, 1);
    return give(L, std::size_t{0});
}

int quad_mesh_order(lua_State* L)
{
    const std::vector<io::DeckBlock>& blocks = check<QuadMeshState>(L, 1).deck.blocks;
    return give(L, std::ranges::any_of(blocks,
                                       [](const auto& block) {
                                           return io::shape_info(block.shape).nodes >
                                                  io::shape_info(block.shape).corners;
                                       })
                       ? 2
                       : 1);
}

int quad_mesh_regions(lua_State* L)
{
    push_array(L, check<QuadMeshState>(L, 1).deck.regions,
               [&](const auto& region) { lua_pushstring(L, region.name.c_str()); });
    return 1;
}

int quad_mesh_report(lua_State* L)
{
    const auto& state = hold<QuadMeshState>(L, 1);
    push_report(L, state.report, state.seconds);
    return 1;
}

/// x, y, z = mesh:node(i)
int quad_mesh_node(lua_State* L)
{
    lua_settop(L, 2);
    const auto& state = check<QuadMeshState>(L, 1);
    const Vec3& place = state.deck.points[check_number(L, "node", state.deck.points.size())];
    for (const double coordinate : place) lua_pushnumber(L, coordinate);
    return 3;
}

/// n1, ..., n4 = mesh:quad(i): the corners, also of quads of order 2
int quad_mesh_quad(lua_State* L)
{
    lua_settop(L, 2);
    const auto& state = check<QuadMeshState>(L, 1);
    const std::size_t number = check_number(L, "quad", quad_mesh_count<4>(state));
    for (const io::DeckBlock& block : state.deck.blocks)
        if (io::shape_info(block.shape).corners == 4)
            for (const Index corner : block.element(number).first(4)) lua_pushinteger(L, to_lua(corner));
    return 4;
}

/// { { name=, dim=2, cells= }, ... } = mesh:groups()
int quad_mesh_groups(lua_State* L)
{
    const auto& state = hold<QuadMeshState>(L, 1);
    auto& groups = temporary<std::vector<fill::Group>>(L);
    guard(L, [&] {
        for (const io::DeckRegion& region : state.deck.regions) groups.push_back({region.name, 2, 0});
        for (const io::DeckBlock& block : state.deck.blocks)
            for (const Index region : block.regions) ++groups[index(region)].cells;
        for (const io::DeckSet& set : state.deck.sets) groups.push_back({set.name, 2, set.members.size()});
    });
    push_groups(L, groups);
    return 1;
}

int quad_mesh_quality(lua_State* L) { return push_quads_quality(L, check<QuadMeshState>(L, 1)); }

/// model = mesh:model(): a model whose faces keep the quads
int quad_mesh_model(lua_State* L)
{
    const auto& state = hold<QuadMeshState>(L, 1);
    RunContext& context = push_context(L);
    auto& box = new_box<ModelState>(L);
    guard(L, [&] {
        box = std::make_shared<ModelState>();
        box->model = fill::model_of(state, context);
    });
    return 1;
}

int quad_mesh_to_string(lua_State* L)
{
    const auto& state = check<QuadMeshState>(L, 1);
    lua_pushfstring(L, "Mesh of %I quads, %I nodes", static_cast<lua_Integer>(quad_mesh_count<4>(state)),
                    static_cast<lua_Integer>(state.deck.points.size()));
    return 1;
}

const luaL_Reg kQuadsModelMethods[] = {{"quads", make_quad_mesh}, {nullptr, nullptr}};
const luaL_Reg kQuadMeshMethods[] = {{"node", quad_mesh_node},     {"quad", quad_mesh_quad},
                                     {"groups", quad_mesh_groups}, {"quality", quad_mesh_quality},
                                     {"model", quad_mesh_model},   {nullptr, nullptr}};
const luaL_Reg kQuadMeshMeta[] = {{"__tostring", quad_mesh_to_string}, {nullptr, nullptr}};
const Field kQuadMeshFields[] = {
    {"nodes", quad_mesh_nodes},     {"quads", quad_mesh_cells<4>}, {"triangles", quad_mesh_cells<3>},
    {"hexes", quad_mesh_none},      {"layers", quad_mesh_none},    {"order", quad_mesh_order},
    {"regions", quad_mesh_regions}, {"report", quad_mesh_report},  {nullptr, nullptr},
};

} // namespace

int push_quads_quality(lua_State* L, const fill::FilledShell& state)
{
    lua_createtable(L, 0, 6);
    set_number(L, "min_scaled_jacobian", state.min_scaled_jacobian);
    set_number(L, "mean_scaled_jacobian", state.mean_scaled_jacobian);
    set_number(L, "area", state.area);
    set_number(L, "face_area", state.face_area);
    set_count(L, "quads", quad_mesh_count<4>(state));
    set_count(L, "triangles", quad_mesh_count<3>(state));
    return 1;
}

void bind_quads(lua_State* L)
{
    make_class<QuadMeshState>(L, kQuadMeshFields, kQuadMeshMeta);
    add_methods(L, kClassName<QuadMeshState>, kQuadMeshMethods);
    add_methods(L, kClassName<ModelState>, kQuadsModelMethods);
}

} // namespace lacuna::lua
