// SPDX-License-Identifier: MIT
// Buffer: many numbers at once, for hosts and for recipes that walk over a whole mesh.
#include "bindings/bind_buffer.h"

#include "bindings/bind_quality.h"
#include "bindings/classes.h"
#include "bindings/options.h"

#include <utility>
#include <vector>

namespace lacuna::lua {

namespace {

static_assert(sizeof(Vec3) == 3 * sizeof(double), "coordinates lie one after the other");
static_assert(sizeof(Index) == 4, "hosts are told of int32");

BufferState of_wholes(std::vector<Index> numbers, std::size_t columns)
{
    static constexpr Index kNone = 0; // data of an empty buffer; null would mean real numbers
    const auto kept = std::make_shared<const std::vector<Index>>(std::move(numbers));
    return {kept, nullptr, kept->empty() ? &kNone : kept->data(), kept->size(), columns};
}

BufferState of_reals(std::vector<double> numbers)
{
    const auto kept = std::make_shared<const std::vector<double>>(std::move(numbers));
    return {kept, kept->empty() ? nullptr : kept->data(), nullptr, kept->size(), 1};
}

BufferState of_points(std::vector<Vec3> points)
{
    const auto kept = std::make_shared<const std::vector<Vec3>>(std::move(points));
    return {kept, kept->empty() ? nullptr : kept->front().data(), nullptr, 3 * kept->size(), 3};
}

/// Corners of each kind of cell.
const Word<std::size_t> kKindsOfCells[] = {{"hex", 8}, {"wedge", 6}, {"pyramid", 5}, {"tet", 4}};

std::size_t read_kind(lua_State* L, int index, const char* call)
{
    return lua_isnoneornil(L, index) ? 8 : read_word(L, index, {call, nullptr}, kKindsOfCells);
}

/// Nodes of all cells of a kind, from 1, in the order of mesh:hex(i) and mesh:wedge(i).
BufferState cells_of(const mesh::HexMesh& mesh, std::size_t corners)
{
    if (corners < 6) return of_wholes({}, corners); // only assemblies have pyramids and tetrahedra
    const bool wedges = corners == 6;
    const mesh::CellKinds kinds(mesh);
    const std::size_t first = wedges ? mesh.hex_count() : 0;
    const std::size_t count = wedges ? mesh.wedge_count() : mesh.hex_count();
    const std::size_t columns = wedges ? 6 : mesh.order() == 1 ? 8 : mesh.middles.full ? 27 : 20;
    std::vector<Index> nodes;
    nodes.reserve(count * columns);
    for (std::size_t i = 0; i < count; ++i) {
        const mesh::CellNodes cell = mesh::cell_nodes(mesh, kinds.cell(first + i));
        for (const Index node : cell.all()) nodes.push_back(node + 1);
    }
    return of_wholes(std::move(nodes), columns);
}

/// buffer = mesh:coordinates(): x, y, z of every node
int coordinates(lua_State* L)
{
    lua_settop(L, 1);
    const auto& mesh = hold_box<MeshState>(L, 1);
    auto& box = new_box<BufferState>(L);
    guard(L, [&] {
        const mesh::HexMesh& hexes = mesh->swept.mesh;
        if (hexes.middles.empty()) { // the memory of the mesh, which the buffer keeps alive
            box = std::make_shared<BufferState>(
                BufferState{mesh, hexes.nodes.empty() ? nullptr : hexes.nodes.front().data(), nullptr,
                            3 * hexes.nodes.size(), 3});
            return;
        }
        std::vector<Vec3> points = hexes.nodes;
        points.insert(points.end(), hexes.middles.nodes.begin(), hexes.middles.nodes.end());
        box = std::make_shared<BufferState>(of_points(std::move(points)));
    });
    return 1;
}

/// buffer = mesh:cells(["hex" | "wedge" | "pyramid" | "tet"]): node numbers from 1
int cells(lua_State* L)
{
    lua_settop(L, 2);
    const auto& mesh = hold<MeshState>(L, 1);
    const std::size_t corners = read_kind(L, 2, "cells");
    auto& box = new_box<BufferState>(L);
    guard(L, [&] { box = std::make_shared<BufferState>(cells_of(mesh.swept.mesh, corners)); });
    return 1;
}

int assembly_coordinates(lua_State* L)
{
    lua_settop(L, 1);
    const auto& mesh = hold<AssemblyMeshState>(L, 1);
    auto& box = new_box<BufferState>(L);
    guard(L, [&] { box = std::make_shared<BufferState>(of_points(whole_cells(mesh).nodes)); });
    return 1;
}

/// As `cells_of()` above.
BufferState cells_of(const AssemblyMeshState& mesh, std::size_t corners)
{
    const WholeCells whole = whole_cells(mesh);
    std::vector<Index> nodes;
    std::size_t columns = corners;
    for (std::size_t c = 0; c < whole.hexes.size(); ++c) {
        const mesh::CellNodes cell = mesh::distinct_corners(whole.hexes[c]);
        if (cell.count != corners) continue;
        const mesh::CellNodes& all = whole.curved.empty() ? cell : whole.curved[c];
        columns = all.count;
        for (const Index node : all) nodes.push_back(node + 1);
    }
    return of_wholes(std::move(nodes), columns);
}

/// buffer = mesh:cells(["hex" | "wedge" | "pyramid" | "tet"]), of an assembly
int assembly_cells(lua_State* L)
{
    lua_settop(L, 2);
    const auto& mesh = hold<AssemblyMeshState>(L, 1);
    const std::size_t corners = read_kind(L, 2, "cells");
    auto& box = new_box<BufferState>(L);
    guard(L, [&] { box = std::make_shared<BufferState>(cells_of(mesh, corners)); });
    return 1;
}

struct FieldArguments {
    quality::Metric metric = quality::Metric::scaled_jacobian;
    std::size_t corners = 8; ///< of the kind of cells
};

/// Read the arguments [metric [, kind]] at index 2 and 3.
FieldArguments read_field(lua_State* L)
{
    FieldArguments read;
    if (!lua_isnil(L, 2)) read.metric = read_metric(L, 2, {"field", nullptr});
    read.corners = read_kind(L, 3, "field");
    return read;
}

/// Refuse metrics that are defined for hexahedra only: their values for other cells would be 0.
void require_defined(const FieldArguments& of)
{
    using enum quality::Metric;
    if (of.corners == 8 || of.metric == scaled_jacobian || of.metric == jacobian || of.metric == volume)
        return;
    throw InvalidInput(
        Message("lua.bad_value", "field: '{}' is defined for hexahedra only", quality::metric_name(of.metric))
            .remedy("use \"scaled_jacobian\", \"jacobian\" or \"volume\""));
}

/// buffer = mesh:field([metric [, kind]]): the metric's value for every row of mesh:cells(kind)
int field(lua_State* L)
{
    lua_settop(L, 3);
    const auto& state = hold<MeshState>(L, 1);
    const FieldArguments of = read_field(L);
    auto& box = new_box<BufferState>(L);
    RunContext& context = push_context(L);
    guard(L, [&] {
        require_defined(of);
        const mesh::HexMesh& mesh = state.swept.mesh;
        std::vector<double> values, all;
        if (of.corners >= 6) all = quality::metric_values(mesh, of.metric, context);
        const mesh::CellKinds kinds(mesh);
        const std::size_t first = of.corners == 8 ? 0 : mesh.hex_count();
        const std::size_t last = of.corners == 8 ? mesh.hex_count() : all.size();
        for (std::size_t c = first; c < last; ++c) values.push_back(all[kinds.cell(c)]);
        box = std::make_shared<BufferState>(of_reals(std::move(values)));
    });
    lua_pop(L, 1);
    return 1;
}

/// The same for the mesh of an assembly.
int assembly_field(lua_State* L)
{
    lua_settop(L, 3);
    const auto& mesh = hold<AssemblyMeshState>(L, 1);
    const FieldArguments of = read_field(L);
    auto& box = new_box<BufferState>(L);
    RunContext& context = push_context(L);
    guard(L, [&] {
        require_defined(of);
        const WholeCells whole = whole_cells(mesh);
        const std::vector<double> all = quality::metric_values(whole.nodes, whole.hexes, of.metric, context);
        std::vector<double> values;
        for (std::size_t c = 0; c < all.size(); ++c)
            if (mesh::distinct_corners(whole.hexes[c]).count == of.corners) values.push_back(all[c]);
        box = std::make_shared<BufferState>(of_reals(std::move(values)));
    });
    lua_pop(L, 1);
    return 1;
}

int quads_coordinates(lua_State* L)
{
    lua_settop(L, 1);
    const auto& mesh = hold<QuadMeshState>(L, 1);
    auto& box = new_box<BufferState>(L);
    guard(L, [&] { box = std::make_shared<BufferState>(of_points(mesh.deck.points)); });
    return 1;
}

const Word<std::size_t> kKindsOfQuads[] = {{"quad", 4}, {"triangle", 3}};

/// buffer = quad_mesh:cells(["quad" | "triangle"]): node numbers from 1
int quads_cells(lua_State* L)
{
    lua_settop(L, 2);
    const auto& mesh = hold<QuadMeshState>(L, 1);
    const std::size_t corners = lua_isnil(L, 2) ? 4 : read_word(L, 2, {"cells", nullptr}, kKindsOfQuads);
    auto& box = new_box<BufferState>(L);
    guard(L, [&] {
        std::vector<Index> nodes;
        std::size_t columns = corners;
        for (const io::DeckBlock& block : mesh.deck.blocks) {
            if (static_cast<std::size_t>(io::shape_info(block.shape).corners) != corners) continue;
            columns = static_cast<std::size_t>(io::shape_info(block.shape).nodes);
            for (const Index node : block.nodes) nodes.push_back(node + 1);
        }
        box = std::make_shared<BufferState>(of_wholes(std::move(nodes), columns));
    });
    return 1;
}

void push_at(lua_State* L, const BufferState& buffer, std::size_t at)
{
    if (buffer.is_real())
        lua_pushnumber(L, buffer.reals[at]);
    else
        lua_pushinteger(L, buffer.wholes[at]);
}

int push_row(lua_State* L, const BufferState& buffer, std::size_t row)
{
    const auto columns = static_cast<int>(buffer.columns);
    luaL_checkstack(L, columns, "too many columns");
    for (std::size_t c = 0; c < buffer.columns; ++c) push_at(L, buffer, row * buffer.columns + c);
    return columns;
}

/// ... = buffer:row(i)
int row(lua_State* L)
{
    lua_settop(L, 2);
    const BufferState& buffer = check<BufferState>(L, 1);
    return push_row(L, buffer, check_number(L, "row", buffer.rows()));
}

/// Upvalues: the buffer; the number of the last row, 0 at the start.
int next_row(lua_State* L)
{
    const BufferState& buffer = check<BufferState>(L, lua_upvalueindex(1));
    const auto next = static_cast<std::size_t>(lua_tointeger(L, lua_upvalueindex(2)));
    if (next >= buffer.rows()) return 0;
    lua_pushinteger(L, to_lua(next));
    lua_copy(L, -1, lua_upvalueindex(2));
    return 1 + push_row(L, buffer, next);
}

/// for i, ... in buffer:each() do
int each(lua_State* L)
{
    lua_settop(L, 1);
    check<BufferState>(L, 1);
    lua_pushinteger(L, 0);
    lua_pushcclosure(L, next_row, 2);
    return 1;
}

/// text = buffer:bytes(): the numbers as in memory, for string.unpack and files
int bytes(lua_State* L)
{
    const BufferState& buffer = check<BufferState>(L, 1);
    lua_pushlstring(L, static_cast<const char*>(buffer.data()), buffer.numbers * buffer.size());
    return 1;
}

int length(lua_State* L) { return give(L, check<BufferState>(L, 1).rows()); }

int columns(lua_State* L) { return give(L, check<BufferState>(L, 1).columns); }

int type(lua_State* L)
{
    lua_pushstring(L, check<BufferState>(L, 1).is_real() ? "float64" : "int32");
    return 1;
}

int to_string(lua_State* L)
{
    const BufferState& buffer = check<BufferState>(L, 1);
    lua_pushfstring(L, "Buffer of %I rows of %I %s", static_cast<lua_Integer>(buffer.rows()),
                    static_cast<lua_Integer>(buffer.columns), buffer.is_real() ? "float64" : "int32");
    return 1;
}

const luaL_Reg kBufferMethods[] = {{"row", row}, {"each", each}, {"bytes", bytes}, {nullptr, nullptr}};
const luaL_Reg kBufferMeta[] = {{"__len", length}, {"__tostring", to_string}, {nullptr, nullptr}};
const Field kBufferFields[] = {{"rows", length}, {"columns", columns}, {"type", type}, {nullptr, nullptr}};
const luaL_Reg kBufferMeshMethods[] = {
    {"coordinates", coordinates}, {"cells", cells}, {"field", field}, {nullptr, nullptr}};
const luaL_Reg kBufferQuadsMethods[] = {
    {"coordinates", quads_coordinates}, {"cells", quads_cells}, {nullptr, nullptr}};
const luaL_Reg kBufferAssemblyMethods[] = {{"coordinates", assembly_coordinates},
                                           {"cells", assembly_cells},
                                           {"field", assembly_field},
                                           {nullptr, nullptr}};

} // namespace

void bind_buffer(lua_State* L)
{
    make_class<BufferState>(L, kBufferFields, kBufferMeta);
    add_methods(L, kClassName<BufferState>, kBufferMethods);
    add_methods(L, kClassName<MeshState>, kBufferMeshMethods);
    add_methods(L, kClassName<AssemblyMeshState>, kBufferAssemblyMethods);
    add_methods(L, kClassName<QuadMeshState>, kBufferQuadsMethods);
}

} // namespace lacuna::lua
