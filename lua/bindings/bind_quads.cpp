// SPDX-License-Identifier: MIT
// model:quads and QuadMesh. Writing, buffers and pages add their methods.
#include "bindings/bind_quality.h"
#include "bindings/classes.h"
#include "bindings/lacuna_lua.h"
#include "bindings/options.h"
#include "bindings/sweep_arguments.h"

#include <lacuna/core/shared/progress.h>

namespace lacuna::lua {

using mesh::CellShape;

namespace {

/// mesh = model:quads { faces =, size = }
int make_quad_mesh(lua_State* L)
{
    lua_settop(L, 2);
    const Box<ModelState>& model = hold_model(L, 1);
    QuadsArguments& arguments = push_quads_arguments(L, 2, model);
    RunContext& context = push_context(L);
    if (arguments.threads != 0) context.threads = arguments.threads;
    return give_new<QuadMeshState>(L, [&] {
        StageClock clock(context);
        report_progress(context, "quads");
        QuadMeshState mesh{fill::quads(model->model, *arguments.faces, arguments, context), {}};
        mesh.seconds = clock.seconds();
        return mesh;
    });
}

int quad_mesh_regions(lua_State* L)
{
    push_array(L, check<QuadMeshState>(L, 1).deck.regions,
               [&](const auto& region) { push(L, region.name.c_str()); });
    return 1;
}

int quad_mesh_report(lua_State* L)
{
    const auto& state = hold<QuadMeshState>(L, 1);
    push_report(L, state.report, state.seconds);
    return 1;
}

int quad_mesh_quality(lua_State* L) { return push_quads_quality(L, check<QuadMeshState>(L, 1)); }

/// model = mesh:model(): a model whose faces keep the quads
int quad_mesh_model(lua_State* L)
{
    const auto& state = hold<QuadMeshState>(L, 1);
    RunContext& context = push_context(L);
    return give_new<ModelState>(L, [&] { return ModelState{{.model = fill::model_of(state, context)}}; });
}

int quad_mesh_to_string(lua_State* L)
{
    const auto& state = check<QuadMeshState>(L, 1);
    lua_pushfstring(L, "Mesh of %I quads, %I nodes",
                    static_cast<lua_Integer>(fill::cell_count(state, CellShape::quad4)),
                    static_cast<lua_Integer>(state.deck.points.size()));
    return 1;
}

} // namespace

int push_quads_quality(lua_State* L, const fill::FilledShell& state)
{
    lua_createtable(L, 0, 6);
    set_field(L, "min_scaled_jacobian", state.min_scaled_jacobian);
    set_field(L, "mean_scaled_jacobian", state.mean_scaled_jacobian);
    set_field(L, "area", state.area);
    set_field(L, "face_area", state.face_area);
    set_field(L, "quads", fill::cell_count(state, CellShape::quad4));
    set_field(L, "triangles", fill::cell_count(state, CellShape::tri3));
    return 1;
}

void bind_quads(lua_State* L)
{
    make_class<QuadMeshState>(L, {{"__tostring", quad_mesh_to_string}},
                              {{"nodes", mesh_nodes<QuadMeshState>},
                               {"quads", cell_count<QuadMeshState, CellShape::quad4>},
                               {"triangles", cell_count<QuadMeshState, CellShape::tri3>},
                               {"hexes", no_cells<QuadMeshState>},
                               {"layers", no_cells<QuadMeshState>},
                               {"order", mesh_order<QuadMeshState>},
                               {"regions", quad_mesh_regions},
                               {"report", quad_mesh_report}});
    add_methods<QuadMeshState>(L, {{"node", mesh_node<QuadMeshState>},
                                   {"quad", cell<QuadMeshState, CellShape::quad4>},
                                   {"groups", mesh_groups<QuadMeshState>},
                                   {"quality", quad_mesh_quality},
                                   {"model", quad_mesh_model}});
    add_methods<ModelState>(L, {{"quads", make_quad_mesh}});
}

} // namespace lacuna::lua
