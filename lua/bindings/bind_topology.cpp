// SPDX-License-Identifier: MIT
// Model and Face.
#include "bindings/faces.h"

#include <lacuna/topology/shared/bodies.h>
#include <lacuna/topology/shared/face_facts.h>
#include <lacuna/topology/shared/face_radius.h>

#include <algorithm>
#include <array>
#include <optional>

namespace lacuna::lua {

namespace {

// --- adding faces -------------------------------------------------------------------------------------

using healing::AddedFace;

void read_points(lua_State* L, int index, const Where& where, AddedFace& face)
{
    const char* const expected = "an array of at least three points { x, y, z }";
    if (array_length(L, index) < 3) fail_value(L, where, expected, index);
    read_items(L, index, where, expected, face.points, read_vector);
}

std::array<int, 4> read_cell(lua_State* L, int index, const Where& where)
{
    const std::size_t corners = array_length(L, index);
    if (corners != 3 && corners != 4) fail_value(L, where, "three or four numbers of points", index);
    std::array<int, 4> cell{};
    for (std::size_t c = 0; c < corners; ++c) {
        lua_rawgeti(L, index, to_lua(c));
        if (lua_isinteger(L, -1) && lua_tointeger(L, -1) == 0)
            fail_option(L, where, "must name points, which count from 1, found 0");
        const int point = read_whole(L, -1, where, 1);
        if (std::ranges::find(cell, point) != cell.end())
            fail_option(L, where, "names point %d twice", point);
        cell[c] = point;
        lua_pop(L, 1);
    }
    return cell;
}

void read_cells(lua_State* L, int index, const Where& where, AddedFace& face)
{
    const char* const expected = "an array of triangles { i, j, k } and quads { i, j, k, l }";
    if (array_length(L, index) == 0) fail_value(L, where, expected, index);
    read_items(L, index, where, expected, face.cells, read_cell);
}

const Option<AddedFace> kAddFaceOptions[] = {
    {"name", plain_name<&AddedFace::name>},
    {"points", read_points},
    {"cells", read_cells},
    {"keep_mesh", boolean<&AddedFace::keep_mesh>},
};

// --- Model ----------------------------------------------------------------------------------------------

const Option<healing::AddedFaces> kModelOptions[] = {
    {"tolerance", positive<&healing::AddedFaces::tolerance>}};

/// model = lacuna.model([{ tolerance = }])
int new_model(lua_State* L)
{
    lua_settop(L, 1);
    auto& added = temporary<healing::AddedFaces>(L);
    read_options(L, 1, "model", kModelOptions, added);
    return give_new<ModelState>(L, [&] { return ModelState{.hand_made = true, .added = added}; });
}

/// face = model:add_face { name=, points=, cells= [, keep_mesh=] }
int add_face(lua_State* L)
{
    lua_settop(L, 2);
    const Box<ModelState>& state = hold_box<ModelState>(L, 1);
    if (!state->hand_made)
        fail(L, "add_face: faces are added to a model made by lacuna.model(); this one was read from %s",
             state->model.source.c_str());
    if (!has_options(L, 2, "add_face"))
        fail_value(L, {"add_face", nullptr}, "a table { name =, points =, cells = }", 2);
    auto& face = temporary<AddedFace>(L);
    read_options(L, 2, "add_face", kAddFaceOptions, face);
    if (face.points.empty()) fail(L, "add_face: option 'points' is missing: an array of points { x, y, z }");
    if (face.cells.empty())
        fail(L, "add_face: option 'cells' is missing: an array of { i, j, k } or { i, j, k, l }");
    const auto count = static_cast<int>(face.points.size());
    for (std::size_t c = 0; c < face.cells.size(); ++c)
        for (const int number : face.cells[c])
            if (number > count)
                fail(L, "add_face: option 'cells[%I]' names point %d; there are %d points", to_lua(c), number,
                     count);
    guard(L, [&] {
        add(state->added, face);
        state->stale = true;
    });
    push_face(L, state, FaceId(static_cast<Index>(state->added.count - 1)));
    return 1;
}

/// faces = model:faces([selector | tag | name])
int faces(lua_State* L)
{
    lua_settop(L, 2);
    const Box<ModelState>& state = hold_model(L, 1);
    auto& selector = temporary<Selector>(L);
    auto& found = temporary<std::vector<FaceId>>(L);
    if (lua_isnoneornil(L, 2) || lua_istable(L, 2)) {
        read_selector(L, 2, "faces", selector);
        guard(L, [&] { found = topology::select(state->model, selector); });
    } else {
        read_faces(L, 2, {"faces", nullptr}, state, found);
    }
    push_array(L, found, [&](const auto& item) { push_face(L, state, item); });
    if (found.empty() && lua_istable(L, 2)) mark_found_nothing(L, 2);
    return 1;
}

/// face = model:face(tag | name | selector)
int face(lua_State* L)
{
    lua_settop(L, 2);
    const Box<ModelState>& state = hold_model(L, 1);
    auto& found = temporary<std::vector<FaceId>>(L);
    read_faces(L, 2, {"face", nullptr}, state, found);
    if (found.size() != 1)
        fail(
            L,
            "face: the argument must select one face, but selects %d: %s; narrow it, or use model:faces(...)",
            static_cast<int>(found.size()), push_names(L, state->model, found));
    push_face(L, state, found.front());
    return 1;
}

/// face = model:face_from { near = [, angle =] [, region =] [, free =] }
int face_from(lua_State* L)
{
    lua_settop(L, 2);
    const Box<ModelState>& state = hold_model(L, 1);
    const FaceId face = grow_face(L, 2, state);
    push_face(L, state, face);
    return 1;
}

int model_to_string(lua_State* L)
{
    const auto& state = hold<ModelState>(L, 1);
    if (state.hand_made) {
        lua_pushfstring(L, "Model of %d faces of the recipe", state.added.count);
    } else {
        lua_pushfstring(L, "Model of %d faces from %s", static_cast<int>(state.model.faces.size()),
                        state.model.source.c_str());
    }
    return 1;
}

/// A field whose value `Get` takes from the model.
template <auto Get>
int model_field(lua_State* L)
{
    return give(L, Get(hold_model(L, 1)->model));
}

/// Names of the closed bodies.
int model_regions(lua_State* L)
{
    const Box<ModelState>& state = hold_model(L, 1);
    RunContext& context = push_context(L);
    auto& names = temporary<std::vector<std::string>>(L);
    guard(L, [&] {
        for (topology::Body& body : topology::bodies(state->model, context))
            names.push_back(std::move(body.name));
    });
    return give(L, names);
}

// --- Face -----------------------------------------------------------------------------------------------

/// The Face at index 1, held until the call ends, and its model, brought up to date.
struct HeldFace {
    const topology::Model& model;
    FaceId face;
};
HeldFace hold_face(lua_State* L)
{
    const auto& handle = hold<FaceHandle>(L, 1);
    FaceId face;
    bring_up_to_date(L, *handle.model);
    guard(L, [&] { face = face_of(handle); });
    return {handle.model->model, face};
}

const topology::Face& this_face(lua_State* L)
{
    const HeldFace held = hold_face(L);
    return held.model[held.face];
}

/// A field whose value `Get` takes from the face.
template <auto Get>
int face_field(lua_State* L)
{
    return give(L, Get(this_face(L)));
}

int face_area(lua_State* L)
{
    const HeldFace held = hold_face(L);
    return give(L, topology::face_area(held.model, held.face));
}

template <Vec3 (*Of)(const topology::Model&, FaceId)>
int face_vector(lua_State* L)
{
    const HeldFace held = hold_face(L);
    return give(L, Of(held.model, held.face));
}

/// Push a property of the sphere or cylinder that fits a face's facets; nil if none fits.
template <class Push>
int fitted(lua_State* L, const Push& push)
{
    const HeldFace held = hold_face(L);
    auto& shape = temporary<std::optional<topology::RoundShape>>(L);
    guard(L, [&] { shape = topology::round_shape(held.model, held.face); });
    if (!shape || !push(*shape)) lua_pushnil(L);
    return 1;
}

int face_radius(lua_State* L)
{
    return fitted(L, [L](const topology::RoundShape& shape) {
        lua_pushnumber(L, shape.radius);
        return true;
    });
}

int face_axis(lua_State* L)
{
    return fitted(L, [L](const topology::RoundShape& shape) {
        if (shape.axis) push(L, *shape.axis);
        return shape.axis.has_value();
    });
}

/// { {x, y, z}, {x, y, z} }
int face_box(lua_State* L)
{
    const HeldFace held = hold_face(L);
    const auto box = topology::box_of(held.model, held.face);
    return give(L, std::array<Vec3, 2>{box.min(), box.max()});
}

/// Tags of the faces that share an edge with it.
int face_neighbours(lua_State* L)
{
    const HeldFace held = hold_face(L);
    auto& tags = temporary<std::vector<int>>(L);
    guard(L, [&] {
        const auto facts = topology::face_facts(held.model);
        for (const FaceId other : facts[held.face.index()].neighbours) tags.push_back(held.model[other].tag);
    });
    return give(L, tags);
}

int face_to_string(lua_State* L)
{
    const HeldFace held = hold_face(L);
    push_text(L, [&] { return topology::name_of(held.model, held.face); });
    return 1;
}

int face_equal(lua_State* L)
{
    const Box<FaceHandle>* a = test_box<FaceHandle>(L, 1);
    const Box<FaceHandle>* b = test_box<FaceHandle>(L, 2);
    const bool alike = a && b && *a && *b && (*a)->model == (*b)->model;
    return give(L, alike && face_now(**a) == face_now(**b) && face_now(**a).valid());
}

} // namespace

void bind_topology(lua_State* L)
{
    using topology::Face;
    make_class<ModelState>(L, {{"__tostring", model_to_string}},
                           {{"tolerance", model_field<[](const auto& model) { return model.tolerance; }>},
                            {"diagonal", model_field<[](const auto& model) { return model.diagonal; }>},
                            {"regions", model_regions}});
    add_methods<ModelState>(
        L, {{"faces", faces}, {"face", face}, {"face_from", face_from}, {"add_face", add_face}});
    bind_info(L);
    make_class<FaceHandle>(
        L, {{"__tostring", face_to_string}, {"__eq", face_equal}},
        {{"tag", face_field<[](const Face& face) { return face.tag; }>},
         {"name", face_field<[](const Face& face) { return std::string_view(face.name); }>},
         {"kind", face_field<[](const Face& face) { return std::string_view(face.kind); }>},
         {"area", face_area},
         {"normal", face_vector<topology::mean_normal>},
         {"centroid", face_vector<topology::face_centroid>},
         {"loops", face_field<[](const Face& face) { return face.loops.size(); }>},
         {"edges", face_field<topology::edge_count>},
         {"has_mesh", face_field<[](const Face& face) { return !face.given_quads.empty(); }>},
         {"radius", face_radius},
         {"axis", face_axis},
         {"box", face_box},
         {"neighbours", face_neighbours}});
    set_functions(L, {{"model", new_model}});
}

} // namespace lacuna::lua
