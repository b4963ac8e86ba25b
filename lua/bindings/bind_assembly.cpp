// SPDX-License-Identifier: MIT
// Assembly: several volumes meshed as one, and its mesh. Sweeping and writing add their methods.
#include "bindings/classes.h"
#include "bindings/options.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace lacuna::lua {

WholeCells whole_cells(const sweep::SweptAssembly& swept)
{
    WholeCells whole;
    whole.nodes.resize(swept.nodes);
    for (std::size_t p = 0; p < swept.parts.size(); ++p) {
        const mesh::HexMesh& mesh = swept.parts[p].mesh;
        const std::vector<Index>& number = swept.number[p];
        for (std::size_t n = 0; n < number.size(); ++n) whole.nodes[index(number[n])] = mesh.nodes[n];
        for (std::size_t c = 0; c < mesh.hex_count(); ++c) {
            Hex hex = mesh.hex(c);
            for (Index& n : hex) n = number[index(n)];
            whole.hexes.push_back(hex);
        }
    }
    return whole;
}

namespace {

/// assembly = lacuna.assembly { volume, volume, ... }
int make_assembly(lua_State* L)
{
    lua_settop(L, 1);
    if (lua_type(L, 1) == LUA_TTABLE) {
        for (lua_pushnil(L); lua_next(L, 1) != 0; lua_pop(L, 1))
            if (lua_type(L, -2) == LUA_TSTRING)
                fail(L, "assembly: there is no option '%s'; give volumes alone", lua_tostring(L, -2));
    }
    auto& volumes = temporary<std::vector<Box<VolumeState>>>(L);
    read_array(L, 1, {"assembly", "volumes"}, "an array of volumes", [&](int at, const Where& where) {
        Box<VolumeState>* const volume = test_box<VolumeState>(L, at);
        if (volume == nullptr || !*volume) fail_value(L, where, "a Volume", at);
        if (std::find(volumes.begin(), volumes.end(), *volume) != volumes.end())
            fail_option(L, where, "is a volume that is in the array already");
        guard(L, [&] { volumes.push_back(*volume); });
    });
    if (volumes.empty()) fail(L, "assembly: give volumes: lacuna.assembly { volume, volume, ... }");
    auto& box = new_box<AssemblyState>(L);
    guard(L, [&] { box = std::make_shared<AssemblyState>(AssemblyState{volumes}); });
    return 1;
}

int assembly_to_string(lua_State* L)
{
    lua_pushfstring(L, "Assembly of %I volumes",
                    static_cast<lua_Integer>(check<AssemblyState>(L, 1).volumes.size()));
    return 1;
}

// --- its mesh -------------------------------------------------------------------------------------------

std::size_t hex_count(const AssemblyMeshState& state)
{
    std::size_t count = 0;
    for (const sweep::Swept& part : state.swept.parts) count += part.mesh.hex_count();
    return count;
}

int mesh_nodes(lua_State* L)
{
    lua_pushinteger(L, static_cast<lua_Integer>(check<AssemblyMeshState>(L, 1).swept.nodes));
    return 1;
}

int mesh_hexes(lua_State* L)
{
    lua_pushinteger(L, static_cast<lua_Integer>(hex_count(check<AssemblyMeshState>(L, 1))));
    return 1;
}

/// { [region] = layers }
int mesh_layers(lua_State* L)
{
    const auto& state = hold<AssemblyMeshState>(L, 1);
    lua_createtable(L, 0, static_cast<int>(state.regions.size()));
    for (std::size_t p = 0; p < state.regions.size(); ++p) {
        lua_pushinteger(L, state.swept.parts[p].mesh.layers);
        lua_setfield(L, -2, state.regions[p].c_str());
    }
    return 1;
}

int mesh_regions(lua_State* L)
{
    const auto& state = hold<AssemblyMeshState>(L, 1);
    lua_createtable(L, static_cast<int>(state.regions.size()), 0);
    for (std::size_t p = 0; p < state.regions.size(); ++p) {
        lua_pushstring(L, state.regions[p].c_str());
        lua_rawseti(L, -2, to_lua(p));
    }
    return 1;
}

int mesh_report(lua_State* L)
{
    const auto& state = hold<AssemblyMeshState>(L, 1);
    lua_newtable(L);
    lua_Integer next = 1;
    for (const std::string& line : state.swept.report) {
        lua_pushlstring(L, line.data(), line.size());
        lua_rawseti(L, -2, next++);
    }
    for (std::size_t p = 0; p < state.regions.size(); ++p) {
        for (const std::string& line : state.swept.parts[p].report) {
            lua_pushfstring(L, "%s: %s", state.regions[p].c_str(), line.c_str());
            lua_rawseti(L, -2, next++);
        }
    }
    set_report_meta(L, state.seconds);
    return 1;
}

/// { volume=, sealed_volume=, max_distance=, mean_distance=, regions = { [region] = the same } }
int mesh_fidelity(lua_State* L)
{
    const auto& state = hold<AssemblyMeshState>(L, 1);
    const auto push = [&](const sweep::Fidelity& fidelity) {
        lua_createtable(L, 0, 5);
        set_number(L, "volume", fidelity.volume);
        set_number(L, "sealed_volume", fidelity.sealed_volume);
        set_number(L, "max_distance", fidelity.max_distance);
        set_number(L, "mean_distance", fidelity.mean_distance);
    };
    sweep::Fidelity whole;
    for (const sweep::Swept& part : state.swept.parts) {
        whole.volume += part.fidelity.volume;
        whole.sealed_volume += part.fidelity.sealed_volume;
        whole.max_distance = std::max(whole.max_distance, part.fidelity.max_distance);
        whole.mean_distance += part.fidelity.mean_distance / static_cast<double>(state.regions.size());
    }
    push(whole);
    lua_createtable(L, 0, static_cast<int>(state.regions.size()));
    for (std::size_t p = 0; p < state.regions.size(); ++p) {
        push(state.swept.parts[p].fidelity);
        lua_setfield(L, -2, state.regions[p].c_str());
    }
    lua_setfield(L, -2, "regions");
    return 1;
}

/// x, y, z = mesh:node(i)
int node(lua_State* L)
{
    lua_settop(L, 2);
    const auto& state = check<AssemblyMeshState>(L, 1);
    const std::size_t wanted = check_number(L, "node", state.swept.nodes);
    for (std::size_t p = 0; p < state.swept.number.size(); ++p) {
        const std::vector<Index>& number = state.swept.number[p];
        const auto found = std::find(number.begin(), number.end(), static_cast<Index>(wanted));
        if (found == number.end()) continue;
        for (const double x :
             state.swept.parts[p].mesh.nodes[static_cast<std::size_t>(found - number.begin())])
            lua_pushnumber(L, x);
        return 3;
    }
    return 0;
}

/// n1, ..., n8 = mesh:hex(i): the parts' cells one after the other
int hex(lua_State* L)
{
    lua_settop(L, 2);
    const auto& state = check<AssemblyMeshState>(L, 1);
    std::size_t cell = check_number(L, "hex", hex_count(state));
    std::size_t p = 0;
    while (cell >= state.swept.parts[p].mesh.hex_count()) cell -= state.swept.parts[p++].mesh.hex_count();
    for (const Index corner : state.swept.parts[p].mesh.hex(cell))
        lua_pushinteger(L, to_lua(state.swept.number[p][index(corner)]));
    return 8;
}

/// { {name=, dim=, cells=}, ... } = mesh:groups()
int groups(lua_State* L)
{
    const auto& state = hold<AssemblyMeshState>(L, 1);
    auto& quads = temporary<std::map<std::string, std::size_t>>(L);
    guard(L, [&] {
        for (const sweep::Swept& part : state.swept.parts) {
            for (std::size_t i = 0; i < part.mesh.skin_count(); ++i)
                for (const std::string& name : part.mesh.patches[index(skin_quad(part.mesh, i).patch)].groups)
                    ++quads[name];
        }
    });
    lua_newtable(L);
    lua_Integer next = 1;
    for (const auto& [name, cells] : quads) {
        push_group(L, name, 2, cells);
        lua_rawseti(L, -2, next++);
    }
    for (std::size_t p = 0; p < state.regions.size(); ++p) {
        push_group(L, state.regions[p], 3, state.swept.parts[p].mesh.hex_count());
        lua_rawseti(L, -2, next++);
    }
    push_group(L, "volume", 3, hex_count(state));
    lua_rawseti(L, -2, next);
    return 1;
}

int mesh_to_string(lua_State* L)
{
    const auto& state = check<AssemblyMeshState>(L, 1);
    lua_pushfstring(L, "Mesh of %I hexes, %I nodes, %I regions", static_cast<lua_Integer>(hex_count(state)),
                    static_cast<lua_Integer>(state.swept.nodes),
                    static_cast<lua_Integer>(state.regions.size()));
    return 1;
}

const luaL_Reg kAssemblyMeta[] = {{"__tostring", assembly_to_string}, {nullptr, nullptr}};
const Field kAssemblyFields[] = {{nullptr, nullptr}};
const luaL_Reg kMethods[] = {{"node", node}, {"hex", hex}, {"groups", groups}, {nullptr, nullptr}};
const luaL_Reg kMeta[] = {{"__tostring", mesh_to_string}, {nullptr, nullptr}};
const Field kFields[] = {
    {"nodes", mesh_nodes},   {"hexes", mesh_hexes},       {"layers", mesh_layers}, {"regions", mesh_regions},
    {"report", mesh_report}, {"fidelity", mesh_fidelity}, {nullptr, nullptr},
};

} // namespace

void bind_assembly(lua_State* L)
{
    make_class<AssemblyState>(L, kAssemblyFields, kAssemblyMeta);
    make_class<AssemblyMeshState>(L, kFields, kMeta);
    add_methods(L, kClassName<AssemblyMeshState>, kMethods);
    lua_pushcfunction(L, make_assembly);
    lua_setfield(L, -2, "assembly");
}

} // namespace lacuna::lua
