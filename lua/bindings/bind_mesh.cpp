// SPDX-License-Identifier: MIT
// Mesh: counts, nodes, cells, groups.
#include "bindings/classes.h"
#include "bindings/options.h"

namespace lacuna::lua {

namespace {

int mesh_nodes(lua_State* L) { return give(L, check<MeshState>(L, 1).swept.mesh.node_count()); }

int mesh_layers(lua_State* L) { return give(L, check<MeshState>(L, 1).swept.mesh.layers); }

int mesh_report(lua_State* L)
{
    const MeshState& state = hold<MeshState>(L, 1);
    push_report(L, state.swept.report, state.seconds);
    return 1;
}

void push_face_fidelity(lua_State* L, const sweep::FaceFidelity& face)
{
    lua_createtable(L, 0, 4);
    set_count(L, "quads", face.quads);
    set_number(L, "max_distance", face.max_distance);
    set_number(L, "mean_distance", face.mean_distance);
    set_vector(L, "place", face.place);
}

} // namespace

void push_fidelity(lua_State* L, const sweep::Fidelity& fidelity)
{
    lua_createtable(L, 0, 5);
    set_number(L, "volume", fidelity.volume);
    set_number(L, "sealed_volume", fidelity.sealed_volume);
    set_number(L, "max_distance", fidelity.max_distance);
    set_number(L, "mean_distance", fidelity.mean_distance);
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
    const auto& groups = hold<MeshState>(L, 1).swept.mesh.volume_groups;
    lua_createtable(L, 1, 0);
    lua_pushstring(L, groups.front().c_str());
    lua_rawseti(L, -2, 1);
    return 1;
}

/// x, y, z = mesh:node(i)
int node(lua_State* L)
{
    lua_settop(L, 2);
    const mesh::HexMesh& mesh = check<MeshState>(L, 1).swept.mesh;
    const Vec3& place = mesh.node(check_number(L, "node", mesh.node_count()));
    for (const double coordinate : place) lua_pushnumber(L, coordinate);
    return 3;
}

/// n1, ..., n8 = mesh:hex(i): the corners, also of cells of order 2
int hex(lua_State* L)
{
    lua_settop(L, 2);
    const mesh::HexMesh& mesh = check<MeshState>(L, 1).swept.mesh;
    const std::size_t number = check_number(L, "hex", mesh.hex_count());
    for (const Index corner : mesh.hex(mesh::CellKinds(mesh).cell(number)))
        lua_pushinteger(L, to_lua(corner));
    return 8;
}

/// n1, ..., n6 = mesh:wedge(i)
int wedge(lua_State* L)
{
    lua_settop(L, 2);
    const mesh::HexMesh& mesh = check<MeshState>(L, 1).swept.mesh;
    const std::size_t number = check_number(L, "wedge", mesh.wedge_count());
    const std::size_t cell = mesh::CellKinds(mesh).cell(mesh.hex_count() + number);
    for (const Index corner : mesh::wedge_of(mesh.hex(cell))) lua_pushinteger(L, to_lua(corner));
    return 6;
}

int mesh_to_string(lua_State* L)
{
    const mesh::HexMesh& mesh = check<MeshState>(L, 1).swept.mesh;
    lua_pushfstring(L, "Mesh of %I hexes, %I nodes, %d layers", static_cast<lua_Integer>(mesh.hex_count()),
                    static_cast<lua_Integer>(mesh.node_count()), mesh.layers);
    return 1;
}

const luaL_Reg kMeshMeshMethods[] = {
    {"node", node}, {"hex", hex}, {"wedge", wedge}, {"groups", mesh_groups<MeshState>}, {nullptr, nullptr}};
const luaL_Reg kMeshMeta[] = {{"__tostring", mesh_to_string}, {nullptr, nullptr}};
/// mesh.left_out, always empty: a volume that cannot be meshed is an error
int mesh_left_out(lua_State* L)
{
    check<MeshState>(L, 1);
    lua_newtable(L);
    return 1;
}

template <auto Count>
int cell_count(lua_State* L)
{
    return give(L, (check<MeshState>(L, 1).swept.mesh.*Count)());
}

/// A sweep makes no pyramids and tetrahedra; assemblies may have some.
int no_cells(lua_State* L)
{
    check<MeshState>(L, 1);
    return give(L, std::size_t{0});
}

const Field kMeshFields[] = {
    {"nodes", mesh_nodes},
    {"hexes", cell_count<&mesh::HexMesh::hex_count>},
    {"wedges", cell_count<&mesh::HexMesh::wedge_count>},
    {"pyramids", no_cells},
    {"tets", no_cells},
    {"layers", mesh_layers},
    {"regions", mesh_regions},
    {"order", mesh_order<MeshState>},
    {"report", mesh_report},
    {"fidelity", mesh_fidelity},
    {"left_out", mesh_left_out},
    {nullptr, nullptr},
};

} // namespace

void bind_mesh(lua_State* L)
{
    make_class<MeshState>(L, kMeshFields, kMeshMeta);
    add_methods(L, kClassName<MeshState>, kMeshMeshMethods);
}

} // namespace lacuna::lua
