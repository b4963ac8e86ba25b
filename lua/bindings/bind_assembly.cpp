// SPDX-License-Identifier: MIT
// Assembly: several volumes meshed as one, and its mesh. Sweeping and writing add their methods.
#include "bindings/classes.h"
#include "bindings/full_turns.h"
#include "bindings/options.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace lacuna::lua {

WholeCells whole_cells(const sweep::SweptAssembly& swept)
{
    WholeCells whole;
    whole.nodes.resize(swept.nodes);
    std::size_t columns = 0;
    for (std::size_t p = 0; p < swept.parts.size(); ++p) {
        const mesh::HexMesh& mesh = swept.parts[p].mesh;
        const std::vector<Index>& number = swept.number[p];
        for (std::size_t n = 0; n < number.size(); ++n) whole.nodes[index(number[n])] = mesh.node(n);
        const mesh::CellKinds kinds(mesh);
        for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
            Hex hex = mesh.hex(kinds.cell(c));
            for (Index& n : hex) n = number[index(n)];
            whole.hexes.push_back(hex);
            whole.column.push_back(static_cast<Index>(columns + kinds.cell(c) % mesh.quads.size()));
            if (mesh.order() == 1) continue;
            mesh::CellNodes cell = mesh::cell_nodes(mesh, kinds.cell(c));
            for (std::size_t n = 0; n < cell.count; ++n) cell.node[n] = number[index(cell.node[n])];
            whole.curved.push_back(cell);
        }
        columns += mesh.quads.size();
    }
    return whole;
}

namespace {

/// assembly = lacuna.assembly { volume or mesh, ... }
int make_assembly(lua_State* L)
{
    lua_settop(L, 1);
    if (lua_type(L, 1) == LUA_TTABLE) {
        for (lua_pushnil(L); lua_next(L, 1) != 0; lua_pop(L, 1))
            if (lua_type(L, -2) == LUA_TSTRING)
                fail(L, "assembly: there is no option '%s'; give volumes alone", lua_tostring(L, -2));
    }
    auto& entries = temporary<std::vector<AssemblyState::Entry>>(L);
    read_array(L, 1, {"assembly", "volumes"}, "an array of volumes and meshes",
               [&](int at, const Where& where) {
                   auto& entry = temporary<AssemblyState::Entry>(L);
                   if (const Box<VolumeState>* volume = test_box<VolumeState>(L, at)) entry.volume = *volume;
                   if (const Box<MeshState>* mesh = test_box<MeshState>(L, at)) entry.mesh = *mesh;
                   if (const Box<AssemblyMeshState>* all = test_box<AssemblyMeshState>(L, at))
                       entry.meshes = *all;
                   if (!entry.volume && !entry.mesh && !entry.meshes)
                       fail_value(L, where, "a Volume, a Mesh or an AssemblyMesh", at);
                   if (std::find(entries.begin(), entries.end(), entry) != entries.end())
                       fail_option(L, where,
                                   entry.volume ? "is a volume that is in the array already"
                                                : "is a mesh that is in the array already");
                   guard(L, [&] { entries.push_back(entry); });
               });
    if (entries.empty()) fail(L, "assembly: give volumes: lacuna.assembly { volume, volume, ... }");
    auto& box = new_box<AssemblyState>(L);
    guard(L, [&] { box = std::make_shared<AssemblyState>(AssemblyState{entries}); });
    return 1;
}

int assembly_to_string(lua_State* L)
{
    const auto& entries = check<AssemblyState>(L, 1).entries;
    const auto volumes = std::count_if(entries.begin(), entries.end(), [](const AssemblyState::Entry& entry) {
        return entry.volume != nullptr;
    });
    lua_pushfstring(L, "Assembly of %I volumes", static_cast<lua_Integer>(volumes));
    const auto meshes = static_cast<lua_Integer>(entries.size()) - static_cast<lua_Integer>(volumes);
    if (meshes == 0) return 1;
    lua_pushfstring(L, meshes == 1 ? " and %I mesh" : " and %I meshes", meshes);
    lua_concat(L, 2);
    return 1;
}

// --- its mesh -------------------------------------------------------------------------------------------

/// Sum of a count over the parts.
template <class Count>
std::size_t sum(const AssemblyMeshState& state, Count count)
{
    std::size_t all = 0;
    for (const sweep::Swept& part : state.swept.parts) all += (part.mesh.*count)();
    return all;
}

int mesh_nodes(lua_State* L)
{
    lua_pushinteger(L, static_cast<lua_Integer>(check<AssemblyMeshState>(L, 1).swept.nodes));
    return 1;
}

int mesh_hexes(lua_State* L)
{
    const auto& state = check<AssemblyMeshState>(L, 1);
    lua_pushinteger(L, static_cast<lua_Integer>(sum(state, &mesh::HexMesh::hex_count)));
    return 1;
}

int mesh_wedges(lua_State* L)
{
    const auto& state = check<AssemblyMeshState>(L, 1);
    lua_pushinteger(L, static_cast<lua_Integer>(sum(state, &mesh::HexMesh::wedge_count)));
    return 1;
}

int mesh_order(lua_State* L)
{
    lua_pushinteger(L, check<AssemblyMeshState>(L, 1).swept.parts.front().mesh.order());
    return 1;
}

/// { [region] = layers }
int mesh_layers(lua_State* L)
{
    const auto& state = hold<AssemblyMeshState>(L, 1);
    lua_createtable(L, 0, static_cast<int>(state.regions.size()));
    for (std::size_t p = 0; p < state.regions.size(); ++p) {
        lua_getfield(L, -1, state.regions[p].c_str()); // pieces of a full turn are one region
        const lua_Integer before = lua_tointeger(L, -1);
        lua_pop(L, 1);
        lua_pushinteger(L, before + state.swept.parts[p].mesh.layers);
        lua_setfield(L, -2, state.regions[p].c_str());
    }
    return 1;
}

int mesh_regions(lua_State* L)
{
    const auto& state = hold<AssemblyMeshState>(L, 1);
    lua_createtable(L, static_cast<int>(state.regions.size()), 0);
    lua_Integer next = 1;
    for (std::size_t p = 0; p < state.regions.size(); ++p) {
        if (!begins_region(state, p)) continue;
        lua_pushstring(L, state.regions[p].c_str());
        lua_rawseti(L, -2, next++);
    }
    return 1;
}

/// { { region =, code =, message = }, ... }
int mesh_left_out(lua_State* L)
{
    const auto& state = hold<AssemblyMeshState>(L, 1);
    lua_createtable(L, static_cast<int>(state.left_out.size()), 0);
    for (std::size_t i = 0; i < state.left_out.size(); ++i) {
        const sweep::LeftOut& out = state.left_out[i];
        lua_createtable(L, 0, 3);
        lua_pushlstring(L, out.region.data(), out.region.size());
        lua_setfield(L, -2, "region");
        lua_pushlstring(L, out.code.data(), out.code.size());
        lua_setfield(L, -2, "code");
        lua_pushlstring(L, out.message.data(), out.message.size());
        lua_setfield(L, -2, "message");
        lua_rawseti(L, -2, to_lua(i));
    }
    return 1;
}

/// { { a =, b =, face_a =, face_b =, edge =, edge_of =, least =, width =, … }, … }: regions, tags, lengths
void push_near_misses(lua_State* L, const AssemblyMeshState& state)
{
    const std::vector<sweep::NearMiss>& misses = state.swept.near_misses;
    lua_createtable(L, static_cast<int>(misses.size()), 0);
    for (std::size_t i = 0; i < misses.size(); ++i) {
        const sweep::NearMiss& miss = misses[i];
        lua_createtable(L, 0, 12);
        set_string(L, "a", state.regions[miss.a].c_str());
        set_string(L, "b", state.regions[miss.b].c_str());
        lua_pushinteger(L, miss.tag_a);
        lua_setfield(L, -2, "face_a");
        lua_pushinteger(L, miss.tag_b);
        lua_setfield(L, -2, "face_b");
        if (miss.edge) {
            lua_pushinteger(L, miss.edge_tag);
            lua_setfield(L, -2, "edge");
            set_string(L, "edge_of", state.regions[miss.edge_of].c_str());
            set_number(L, "length", miss.length);
        } else {
            set_number(L, "area", miss.area);
        }
        set_number(L, "least", miss.least);
        set_number(L, "width", miss.width);
        set_number(L, "tolerance", miss.tolerance);
        lua_pushboolean(L, static_cast<int>(miss.reach_in));
        lua_setfield(L, -2, "reach_in");
        set_string(L, "message", miss.message.c_str());
        lua_rawseti(L, -2, to_lua(i));
    }
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
    push_near_misses(L, state);
    lua_setfield(L, -2, "near_misses");
    set_report_meta(L, state.seconds);
    return 1;
}

/// { volume=, sealed_volume=, max_distance=, mean_distance=, regions = { [region] = a Mesh's } }
int mesh_fidelity(lua_State* L)
{
    const auto& state = hold<AssemblyMeshState>(L, 1);
    sweep::Fidelity whole;
    for (const sweep::Swept& part : state.swept.parts) {
        whole.volume += part.fidelity.volume;
        whole.sealed_volume += part.fidelity.sealed_volume;
        whole.max_distance = std::max(whole.max_distance, part.fidelity.max_distance);
        whole.mean_distance += part.fidelity.mean_distance / static_cast<double>(state.regions.size());
    }
    push_fidelity(L, whole);
    lua_pushnil(L); // tags of faces are each volume's own
    lua_setfield(L, -2, "faces");
    lua_createtable(L, 0, static_cast<int>(state.regions.size()));
    for (std::size_t p = 0; p < state.regions.size(); ++p) {
        if (!begins_region(state, p)) continue;
        sweep::Fidelity own = state.swept.parts[p].fidelity;
        for (std::size_t q = p + 1; q < state.regions.size(); ++q) {
            if (state.regions[q] != state.regions[p]) continue;
            const sweep::Fidelity& other = state.swept.parts[q].fidelity;
            const double all = own.sealed_volume + other.sealed_volume;
            own.mean_distance =
                (own.mean_distance * own.sealed_volume + other.mean_distance * other.sealed_volume) / all;
            own.max_distance = std::max(own.max_distance, other.max_distance);
            own.volume += other.volume;
            own.sealed_volume = all;
        }
        push_fidelity(L, own);
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
        const mesh::HexMesh& mesh = state.swept.parts[p].mesh;
        for (const double x : mesh.node(static_cast<std::size_t>(found - number.begin())))
            lua_pushnumber(L, x);
        return 3;
    }
    return 0;
}

/// Push the corners of the i-th of the cells that `count` counts, the parts' one after the other.
/// @param behind  counts the cells of a part that come before those.
template <class Count, class Behind>
int push_cell(lua_State* L, const char* call, Count count, Behind behind)
{
    lua_settop(L, 2);
    const auto& state = check<AssemblyMeshState>(L, 1);
    std::size_t cell = check_number(L, call, sum(state, count));
    std::size_t p = 0;
    while (cell >= (state.swept.parts[p].mesh.*count)()) cell -= (state.swept.parts[p++].mesh.*count)();
    const mesh::HexMesh& mesh = state.swept.parts[p].mesh;
    const Hex hex = mesh.hex(mesh::CellKinds(mesh).cell(behind(mesh) + cell));
    const auto push = [&](Index corner) { lua_pushinteger(L, to_lua(state.swept.number[p][index(corner)])); };
    if (!mesh::is_wedge(hex)) {
        for (const Index corner : hex) push(corner);
        return 8;
    }
    for (const Index corner : mesh::wedge_of(hex)) push(corner);
    return 6;
}

/// n1, ..., n8 = mesh:hex(i): the parts' cells one after the other
int hex(lua_State* L)
{
    return push_cell(L, "hex", &mesh::HexMesh::hex_count,
                     [](const mesh::HexMesh&) { return std::size_t{0}; });
}

/// n1, ..., n6 = mesh:wedge(i)
int wedge(lua_State* L)
{
    return push_cell(L, "wedge", &mesh::HexMesh::wedge_count,
                     [](const mesh::HexMesh& mesh) { return mesh.hex_count(); });
}

/// { {name=, dim=, cells=}, ... } = mesh:groups()
int groups(lua_State* L)
{
    const auto& state = hold<AssemblyMeshState>(L, 1);
    auto& quads = temporary<std::map<std::string, std::size_t>>(L);
    auto& regions = temporary<std::vector<std::pair<std::string, std::size_t>>>(L); // as first met
    guard(L, [&] {
        for (const sweep::Swept& part : state.swept.parts) {
            const std::string& region = part.mesh.volume_groups.front();
            auto known = std::ranges::find(regions, region, &std::pair<std::string, std::size_t>::first);
            if (known == regions.end()) known = regions.insert(known, {region, 0});
            known->second += part.mesh.cell_count();
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
    for (const auto& [name, cells] : regions) {
        if (name == "volume") continue; // the pieces of one volume without a name
        push_group(L, name, 3, cells);
        lua_rawseti(L, -2, next++);
    }
    push_group(L, "volume", 3, sum(state, &mesh::HexMesh::cell_count));
    lua_rawseti(L, -2, next);
    return 1;
}

int mesh_to_string(lua_State* L)
{
    const auto& state = check<AssemblyMeshState>(L, 1);
    lua_pushfstring(L, "Mesh of %I hexes, %I nodes, %I regions",
                    static_cast<lua_Integer>(sum(state, &mesh::HexMesh::hex_count)),
                    static_cast<lua_Integer>(state.swept.nodes),
                    static_cast<lua_Integer>(state.regions.size()));
    return 1;
}

const luaL_Reg kAssemblyMeta[] = {{"__tostring", assembly_to_string}, {nullptr, nullptr}};
const Field kAssemblyFields[] = {{nullptr, nullptr}};
const luaL_Reg kMethods[] = {
    {"node", node}, {"hex", hex}, {"wedge", wedge}, {"groups", groups}, {nullptr, nullptr}};
const luaL_Reg kMeta[] = {{"__tostring", mesh_to_string}, {nullptr, nullptr}};
const Field kFields[] = {
    {"wedges", mesh_wedges}, {"order", mesh_order},       {"nodes", mesh_nodes},
    {"hexes", mesh_hexes},   {"layers", mesh_layers},     {"regions", mesh_regions},
    {"report", mesh_report}, {"fidelity", mesh_fidelity}, {"left_out", mesh_left_out},
    {nullptr, nullptr},
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
