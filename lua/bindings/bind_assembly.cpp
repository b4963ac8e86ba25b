// SPDX-License-Identifier: MIT
// Assembly: several volumes meshed as one, and its mesh. Sweeping and writing add their methods.
#include "bindings/classes.h"
#include "bindings/options.h"

#include <algorithm>
#include <string_view>

namespace lacuna::lua {

/// { { a =, b =, face_a =, face_b =, edge =, edge_of =, least =, width =, … }, … }: regions, tags, lengths
void set_near_misses(lua_State* L, const fill::FilledParts& mesh)
{
    const std::vector<sweep::NearMiss>& misses = mesh.swept.near_misses;
    set_array(L, "near_misses", misses, [&](const auto& miss) {
        lua_createtable(L, 0, 12);
        set_field(L, "a", mesh.regions[miss.a].c_str());
        set_field(L, "b", mesh.regions[miss.b].c_str());
        set_field(L, "face_a", miss.tag_a);
        set_field(L, "face_b", miss.tag_b);
        if (miss.edge) {
            set_field(L, "edge", miss.edge_tag);
            set_field(L, "edge_of", mesh.regions[miss.edge_of].c_str());
            set_field(L, "length", miss.length);
        } else {
            set_field(L, "area", miss.area);
        }
        set_field(L, "least", miss.least);
        set_field(L, "width", miss.width);
        set_field(L, "tolerance", miss.tolerance);
        set_field(L, "reach_in", miss.reach_in);
        set_field(L, "message", miss.message.text());
    });
}

namespace {

/// assembly = lacuna.assembly { volume or mesh, ... }
int make_assembly(lua_State* L)
{
    lua_settop(L, 1);
    if (lua_type(L, 1) == LUA_TTABLE) {
        for (lua_pushnil(L); lua_next(L, 1) != 0; lua_pop(L, 1))
            if (lua_type(L, -2) == LUA_TSTRING)
                fail(L, "assembly: there is no option '%s'; give only volumes", lua_tostring(L, -2));
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
    return give_new<AssemblyState>(L, [&] { return AssemblyState{entries}; });
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

// --- interfaces -----------------------------------------------------------------------------------------

/// "all", a group, a number of layers, or an array of groups, numbers and pairs of regions
void read_interface_faces(lua_State* L, int index, const Where& where, fill::InterfaceFaces& faces)
{
    const char* const expected =
        "\"all\", a group, a number of layers, or an array of groups, numbers and pairs "
        "of regions { a, b }";
    const auto add = [&](int at, const Where& element) {
        if (lua_type(L, at) == LUA_TSTRING) {
            const char* name = read_string(L, at, element);
            guard(L, [&] {
                if (name == std::string_view("all"))
                    faces.all = true;
                else
                    faces.groups.emplace_back(name);
            });
            return;
        }
        if (lua_type(L, at) == LUA_TNUMBER) {
            const int level = read_whole(L, at, element, 1);
            guard(L, [&] { faces.levels.push_back(level); });
            return;
        }
        if (lua_type(L, at) != LUA_TTABLE || lua_rawlen(L, at) != 2) fail_value(L, element, expected, at);
        lua_rawgeti(L, at, 1);
        lua_rawgeti(L, at, 2);
        if (lua_type(L, -1) != LUA_TSTRING || lua_type(L, -2) != LUA_TSTRING)
            fail_value(L, element, expected, at);
        const char *a = lua_tostring(L, -2), *b = lua_tostring(L, -1);
        guard(L, [&] { faces.pairs.emplace_back(a, b); });
    };
    if (lua_type(L, index) != LUA_TTABLE) return add(index, where);
    read_array(L, index, where, expected, add);
}

const Option<fill::InterfaceFaces> kInterfaceOptions[] = {
    {"faces", read_interface_faces},
    {"element", capitals<&fill::InterfaceFaces::element>},
    {"name", plain_name<&fill::InterfaceFaces::region>}};

/// mesh = lacuna.split_interface(mesh, { faces =, element =, name = })
int split_interface(lua_State* L)
{
    lua_settop(L, 2);
    const Box<AssemblyMeshState>* const mesh = test_box<AssemblyMeshState>(L, 1);
    const Box<MeshState>* const one = test_box<MeshState>(L, 1);
    if ((mesh == nullptr || !*mesh) && (one == nullptr || !*one))
        fail_value(L, {"split_interface", "mesh"}, "a mesh of hexahedra", 1);
    auto& faces = temporary<fill::InterfaceFaces>(L);
    read_options(L, 2, "split_interface", kInterfaceOptions, faces);
    RunContext& context = push_context(L);
    return give_new<AssemblyMeshState>(L, [&] {
        return AssemblyMeshState{
            fill::split_interface(mesh != nullptr ? **mesh : fill::as_parts(**one), faces, context)};
    });
}

int interface_cells(lua_State* L)
{
    std::size_t count = 0;
    for (const fill::SplitInterface& split : check<AssemblyMeshState>(L, 1).interfaces)
        count += split.cells.size();
    return give(L, count);
}

// --- contacts -------------------------------------------------------------------------------------------

/// { { a =, b =, name =, type =, gap =, faces = { { tag, tag }, ... }, least =, width =, area = }, ... }
void push_contacts(lua_State* L, const std::vector<fill::Contact>& contacts)
{
    push_array(L, contacts, [&](const auto& contact) {
        lua_createtable(L, 0, 11);
        set_field(L, "a", contact.regions[0]);
        set_field(L, "b", contact.regions[1]);
        set_field(L, "name", contact.pair.name);
        set_field(L, "type", contact.pair.tied ? "tie" : "contact");
        set_field(L, "gap", contact.gap);
        set_field(L, "least", contact.least);
        set_field(L, "width", contact.width);
        set_field(L, "area", contact.area);
        if (!contact.pair.groups[0].empty()) {
            set_field(L, "slave", contact.pair.groups[0]);
            set_field(L, "master", contact.pair.groups[1]);
        }
        set_field(L, "faces", contact.faces);
    });
}

template <class Of>
void read_gap(lua_State* L, int index, const Where& where, Of& of)
{
    of.gap = read_number(L, index, where);
    if (of.gap < 0) fail_value(L, where, "a distance, 0 or larger", index);
}
const Option<fill::ContactRequest> kFindOptions[] = {{"gap", read_gap<fill::ContactRequest>}};

/// Read { gap = } at index 2, and push the contacts that `find` returns.
template <class Find>
int push_found_contacts(lua_State* L, const Find& find)
{
    auto& request = temporary<fill::ContactRequest>(L);
    read_options(L, 2, "contacts", kFindOptions, request);
    RunContext& context = push_context(L);
    auto& contacts = temporary<std::vector<fill::Contact>>(L);
    guard(L, [&] { contacts = find(request, context); });
    push_contacts(L, contacts);
    return 1;
}

/// contacts = assembly:contacts { gap = }
int assembly_contacts(lua_State* L)
{
    lua_settop(L, 2);
    const auto& assembly = hold<AssemblyState>(L, 1);
    return push_found_contacts(L, [&](const fill::ContactRequest& request, const RunContext& context) {
        std::vector<fill::Member> members;
        for (const AssemblyState::Entry& entry : assembly.entries) members.push_back(entry.member());
        return fill::contacts(members, request, context);
    });
}

/// contacts = model:contacts { gap = }
int model_contacts(lua_State* L)
{
    lua_settop(L, 2);
    const Box<ModelState>& model = hold_model(L, 1);
    return push_found_contacts(L, [&](const fill::ContactRequest& request, const RunContext& context) {
        refresh(*model, context);
        return fill::contacts(model->model, request, context);
    });
}

int mesh_contacts(lua_State* L)
{
    push_contacts(L, hold<AssemblyMeshState>(L, 1).contacts);
    return 1;
}

using Pair = fill::ContactRequest::Pair;
const Word<bool> kContactTypes[] = {{"tie", true}, {"contact", false}};

template <std::size_t Side>
void read_region(lua_State* L, int index, const Where& where, Pair& pair)
{
    const char* const name = read_plain_name(L, index, where);
    guard(L, [&] { pair.regions[Side] = name; });
}
void ignore(lua_State*, int, const Where&, Pair&) {}

/// The options from `least` on are ignored. The tables that `contacts()` returns have them, and can be passed
/// as pairs.
const Option<Pair> kPairOptions[] = {
    {"a", read_region<0>},
    {"b", read_region<1>},
    {"name", plain_name<&Pair::name>},
    {"gap", read_gap<Pair>},
    {"type", word<&Pair::tied, kContactTypes>},
    {"least", ignore},
    {"width", ignore},
    {"area", ignore},
    {"faces", ignore},
    {"slave", ignore},
    {"master", ignore},
};

void read_pairs(lua_State* L, int index, const Where& where, fill::ContactRequest& request)
{
    read_array(L, index, where, "an array of pairs { a =, b =, type =, gap =, name = }",
               [&](int at, const Where& element) {
                   auto& pair = temporary<Pair>(L);
                   pair.gap = request.gap;
                   pair.tied = request.tied;
                   if (lua_type(L, at) != LUA_TTABLE) fail_value(L, element, "a table { a =, b = }", at);
                   read_options(L, at, "sweep: contacts", kPairOptions, pair);
                   if (pair.regions[0].empty() || pair.regions[1].empty())
                       fail_option(L, element, "must name two regions: { a = \"lid\", b = \"base\" }");
                   guard(L, [&] { request.pairs.push_back(pair); });
               });
}

/// `pairs` is read last: a pair without a gap or a type takes those of the request.
const Option<fill::ContactRequest> kContactOptions[] = {
    {"gap", read_gap<fill::ContactRequest>},
    {"type", word<&fill::ContactRequest::tied, kContactTypes>},
    {"pairs", read_pairs}};

// --- its mesh -------------------------------------------------------------------------------------------

std::vector<fill::Region>& push_regions(lua_State* L, const AssemblyMeshState& state)
{
    auto& regions = temporary<std::vector<fill::Region>>(L);
    guard(L, [&] { regions = fill::regions(state); });
    return regions;
}

/// { [region] = layers }
int mesh_layers(lua_State* L)
{
    const std::vector<fill::Region>& regions = push_regions(L, hold<AssemblyMeshState>(L, 1));
    lua_createtable(L, 0, static_cast<int>(regions.size()));
    for (const fill::Region& region : regions) set_field(L, region.name.c_str(), region.layers);
    return 1;
}

int mesh_regions(lua_State* L)
{
    const std::vector<fill::Region>& regions = push_regions(L, hold<AssemblyMeshState>(L, 1));
    push_array(L, regions, [&](const auto& item) { push(L, item.name.c_str()); });
    return 1;
}

/// { { region =, code =, message = }, ... }
int mesh_left_out(lua_State* L)
{
    const auto& state = hold<AssemblyMeshState>(L, 1);
    push_array(L, state.left_out, [&](const auto& out) {
        lua_createtable(L, 0, 3);
        set_field(L, "region", out.region);
        set_field(L, "code", out.message.code());
        set_field(L, "message", out.message.text());
    });
    return 1;
}

int mesh_report(lua_State* L)
{
    const auto& state = hold<AssemblyMeshState>(L, 1);
    auto& lines = temporary<std::vector<std::string>>(L);
    guard(L, [&] { lines = fill::report(state); });
    push_report(L, lines, state.seconds);
    set_near_misses(L, state);
    return 1;
}

/// { volume=, sealed_volume=, max_distance=, mean_distance=, regions = { [region] = the same for one } }
int mesh_fidelity(lua_State* L)
{
    const auto& state = hold<AssemblyMeshState>(L, 1);
    const std::vector<fill::Region>& regions = push_regions(L, state);
    push_fidelity(L, fill::fidelity(state));
    lua_pushnil(L); // face tags are unique only within a volume
    lua_setfield(L, -2, "faces");
    lua_createtable(L, 0, static_cast<int>(regions.size()));
    for (const fill::Region& region : regions) {
        push_fidelity(L, region.fidelity);
        lua_setfield(L, -2, region.name.c_str());
    }
    lua_setfield(L, -2, "regions");
    return 1;
}

int mesh_to_string(lua_State* L)
{
    const auto& state = hold<AssemblyMeshState>(L, 1);
    const auto count = [&](mesh::CellShape shape) {
        return static_cast<lua_Integer>(fill::cell_count(state, shape));
    };
    const auto regions = static_cast<lua_Integer>(push_regions(L, state).size());
    lua_pushfstring(L, "Mesh of %I hexes, %I nodes, %I regions", count(mesh::CellShape::hex8),
                    static_cast<lua_Integer>(state.swept.nodes), regions);
    if (state.tets.empty()) return 1;
    lua_pushfstring(L, ", %I pyramids, %I tetrahedra", count(mesh::CellShape::pyramid5),
                    count(mesh::CellShape::tet4));
    lua_concat(L, 2);
    return 1;
}

} // namespace

fill::ContactRequest& push_contact_request(lua_State* L, int index)
{
    auto& request = temporary<fill::ContactRequest>(L);
    if (lua_getfield(L, index, "contacts") != LUA_TNIL)
        read_options(L, lua_gettop(L), "sweep: contacts", kContactOptions, request);
    return request;
}

void bind_assembly(lua_State* L)
{
    using mesh::CellShape;
    using State = AssemblyMeshState;
    make_class<AssemblyState>(L, {{"__tostring", assembly_to_string}});
    make_class<State>(L, {{"__tostring", mesh_to_string}},
                      {{"nodes", mesh_nodes<State>},
                       {"hexes", cell_count<State, CellShape::hex8>},
                       {"wedges", cell_count<State, CellShape::wedge6>},
                       {"pyramids", cell_count<State, CellShape::pyramid5>},
                       {"tets", cell_count<State, CellShape::tet4>},
                       {"order", mesh_order<State>},
                       {"layers", mesh_layers},
                       {"regions", mesh_regions},
                       {"report", mesh_report},
                       {"fidelity", mesh_fidelity},
                       {"left_out", mesh_left_out},
                       {"interface_cells", interface_cells},
                       {"contacts", mesh_contacts}});
    add_methods<State>(L, {{"node", mesh_node<State>},
                           {"hex", cell<State, CellShape::hex8>},
                           {"wedge", cell<State, CellShape::wedge6>},
                           {"pyramid", cell<State, CellShape::pyramid5>},
                           {"tet", cell<State, CellShape::tet4>},
                           {"groups", mesh_groups<State>}});
    add_methods<AssemblyState>(L, {{"contacts", assembly_contacts}});
    add_methods<ModelState>(L, {{"contacts", model_contacts}});
    set_functions(L, {{"assembly", make_assembly}, {"split_interface", split_interface}});
}

} // namespace lacuna::lua
