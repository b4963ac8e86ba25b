// SPDX-License-Identifier: MIT
// Mesh: counts, nodes, cells, groups.
#include "bindings/classes.h"
#include "bindings/options.h"

namespace lacuna::lua {

namespace {

int mesh_report(lua_State* L)
{
    const MeshState& state = hold<MeshState>(L, 1);
    push_report(L, state.swept.report, state.seconds);
    return 1;
}

void push_face_fidelity(lua_State* L, const sweep::FaceFidelity& face)
{
    lua_createtable(L, 0, 4);
    set_field(L, "quads", face.quads);
    set_field(L, "max_distance", face.max_distance);
    set_field(L, "mean_distance", face.mean_distance);
    set_field(L, "place", face.place);
}

} // namespace

void push_fidelity(lua_State* L, const sweep::Fidelity& fidelity)
{
    lua_createtable(L, 0, 5);
    set_field(L, "volume", fidelity.volume);
    set_field(L, "sealed_volume", fidelity.sealed_volume);
    set_field(L, "max_distance", fidelity.max_distance);
    set_field(L, "mean_distance", fidelity.mean_distance);
    lua_createtable(L, 0, static_cast<int>(fidelity.faces.size()));
    for (const sweep::FaceFidelity& face : fidelity.faces) {
        if (face.made_void)
            lua_pushfstring(L, "void:%d", face.tag);
        else
            lua_pushinteger(L, face.tag);
        push_face_fidelity(L, face);
        lua_rawset(L, -3);
    }
    lua_setfield(L, -2, "faces");
}

namespace {

int mesh_fidelity(lua_State* L)
{
    push_fidelity(L, hold<MeshState>(L, 1).swept.fidelity);
    return 1;
}

/// mesh.regions: an array with the name of the one volume
int mesh_regions(lua_State* L)
{
    return give(L, std::array{hold<MeshState>(L, 1).swept.mesh.volume_groups.front().c_str()});
}

int mesh_to_string(lua_State* L)
{
    const mesh::HexMesh& mesh = check<MeshState>(L, 1).swept.mesh;
    lua_pushfstring(L, "Mesh of %I hexes, %I nodes, %d layers", static_cast<lua_Integer>(mesh.hex_count()),
                    static_cast<lua_Integer>(mesh.node_count()), mesh.layers);
    return 1;
}

/// mesh.left_out, always empty: a volume that cannot be meshed is an error
int mesh_left_out(lua_State* L)
{
    check<MeshState>(L, 1);
    lua_newtable(L);
    return 1;
}

using mesh::CellShape;

} // namespace

void bind_mesh(lua_State* L)
{
    make_class<MeshState>(
        L, {{"__tostring", mesh_to_string}},
        {{"nodes", mesh_nodes<MeshState>},
         {"hexes", cell_count<MeshState, CellShape::hex8>},
         {"wedges", cell_count<MeshState, CellShape::wedge6>},
         {"pyramids", no_cells<MeshState>}, // assemblies may have some
         {"tets", no_cells<MeshState>},
         {"layers", field<MeshState, [](const auto& mesh) { return mesh.swept.mesh.layers; }>},
         {"regions", mesh_regions},
         {"order", mesh_order<MeshState>},
         {"report", mesh_report},
         {"fidelity", mesh_fidelity},
         {"left_out", mesh_left_out}});
    add_methods<MeshState>(L, {{"node", mesh_node<MeshState>},
                               {"hex", cell<MeshState, CellShape::hex8>},
                               {"wedge", cell<MeshState, CellShape::wedge6>},
                               {"groups", mesh_groups<MeshState>}});
}

} // namespace lacuna::lua
