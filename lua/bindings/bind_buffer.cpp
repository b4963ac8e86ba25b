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

BufferState of_rows(fill::CellRows rows)
{
    static constexpr Index kNone = 0; // data of an empty buffer; null would mean real numbers
    const auto kept = std::make_shared<const std::vector<Index>>(std::move(rows.nodes));
    return {kept, nullptr, kept->empty() ? &kNone : kept->data(), kept->size(), rows.columns};
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

using mesh::CellShape;
const Word<CellShape> kSolids[] = {{"hex", CellShape::hex8},
                                   {"wedge", CellShape::wedge6},
                                   {"pyramid", CellShape::pyramid5},
                                   {"tet", CellShape::tet4}};
const Word<CellShape> kFacets[] = {{"quad", CellShape::quad4}, {"triangle", CellShape::tri3}};

/// The shape that is named at `index`; by default the first one.
template <const auto& Shapes>
CellShape read_shape(lua_State* L, int index, const char* call)
{
    return lua_isnil(L, index) ? Shapes[0].value : read_word(L, index, {call, nullptr}, Shapes);
}

/// buffer = mesh:coordinates(): x, y, z of every node
template <class State>
int coordinates(lua_State* L)
{
    lua_settop(L, 1);
    const auto& mesh = hold_box<State>(L, 1);
    return give_new<BufferState>(L, [&] {
        if constexpr (std::is_same_v<State, MeshState>) {
            const mesh::HexMesh& own =
                mesh->swept.mesh; // if order 1: its memory, which the buffer keeps alive
            if (own.middles.empty() && !own.nodes.empty())
                return BufferState{mesh, own.nodes.front().data(), nullptr, 3 * own.nodes.size(), 3};
        }
        return of_points(fill::points(*mesh));
    });
}

/// buffer = mesh:cells(["hex" | "wedge" | "pyramid" | "tet"]): node numbers from 1
template <class State, const auto& Shapes>
int cells(lua_State* L)
{
    lua_settop(L, 2);
    const auto& mesh = hold<State>(L, 1);
    const CellShape shape = read_shape<Shapes>(L, 2, "cells");
    return give_new<BufferState>(L, [&] { return of_rows(fill::cell_rows(mesh, shape)); });
}

/// buffer = mesh:field([metric [, kind]]): the metric's value for every row of mesh:cells(kind)
template <class State>
int field_values(lua_State* L)
{
    lua_settop(L, 3);
    const auto& mesh = hold<State>(L, 1);
    const quality::Metric metric = lua_isnil(L, 2) ? quality::Metric::scaled_jacobian
                                                   : read_metric(L, 2, {"field", nullptr});
    const CellShape shape = read_shape<kSolids>(L, 3, "field");
    const RunContext& context = push_context(L);
    return give_new<BufferState>(L,
                                 [&] { return of_reals(fill::cell_values(mesh, metric, shape, context)); });
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

int to_string(lua_State* L)
{
    const BufferState& buffer = check<BufferState>(L, 1);
    lua_pushfstring(L, "Buffer of %I rows of %I %s", static_cast<lua_Integer>(buffer.rows()),
                    static_cast<lua_Integer>(buffer.columns), buffer.is_real() ? "float64" : "int32");
    return 1;
}

} // namespace

void bind_buffer(lua_State* L)
{
    make_class<BufferState>(
        L, {{"__len", length}, {"__tostring", to_string}},
        {{"rows", length},
         {"columns", field<BufferState, [](const auto& buffer) { return buffer.columns; }>},
         {"type", field<BufferState, [](const auto& buffer) {
              return std::string_view(buffer.is_real() ? "float64" : "int32");
          }>}});
    add_methods<BufferState>(L, {{"row", row}, {"each", each}, {"bytes", bytes}});
    add_methods<MeshState>(L, {{"coordinates", coordinates<MeshState>},
                               {"cells", cells<MeshState, kSolids>},
                               {"field", field_values<MeshState>}});
    add_methods<AssemblyMeshState>(L, {{"coordinates", coordinates<AssemblyMeshState>},
                                       {"cells", cells<AssemblyMeshState, kSolids>},
                                       {"field", field_values<AssemblyMeshState>}});
    add_methods<QuadMeshState>(
        L, {{"coordinates", coordinates<QuadMeshState>}, {"cells", cells<QuadMeshState, kFacets>}});
}

} // namespace lacuna::lua
