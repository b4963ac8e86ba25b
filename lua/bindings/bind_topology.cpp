// SPDX-License-Identifier: MIT
// Model and Face.
#include "bindings/faces.h"
#include "bindings/names.h"

#include <lacuna/topology/shared/face_facts.h>
#include <lacuna/topology/shared/face_radius.h>

#include <algorithm>
#include <array>
#include <optional>

namespace lacuna::lua {

namespace {

// --- adding faces -------------------------------------------------------------------------------------

struct AddedFace {
    std::string name;
    std::vector<Vec3> points;
    std::vector<std::array<int, 4>> cells; ///< numbers of points, from 1; the fourth is 0 for a triangle
    bool keep_mesh = false;
};

void read_name(lua_State* L, int index, const Where& where, AddedFace& face)
{
    const char* name = read_plain_name(L, index, where);
    guard(L, [&] { face.name = name; });
}

void read_points(lua_State* L, int index, const Where& where, AddedFace& face)
{
    const char* const expected = "an array of at least three points { x, y, z }";
    if (lua_type(L, index) != LUA_TTABLE || lua_rawlen(L, index) < 3) fail_value(L, where, expected, index);
    const std::size_t count = lua_rawlen(L, index);
    guard(L, [&] { face.points.resize(count); });
    std::size_t next = 0;
    read_array(L, index, where, expected,
               [&](int element, const Where& at) { face.points[next++] = read_vector(L, element, at); });
}

void read_cells(lua_State* L, int index, const Where& where, AddedFace& face)
{
    const char* const expected = "an array of triangles { i, j, k } and quads { i, j, k, l }";
    if (lua_type(L, index) != LUA_TTABLE || lua_rawlen(L, index) == 0) fail_value(L, where, expected, index);
    const std::size_t count = lua_rawlen(L, index);
    guard(L, [&] { face.cells.resize(count); });
    std::size_t next = 0;
    read_array(L, index, where, expected, [&](int element, const Where& at) {
        const auto corners = lua_type(L, element) == LUA_TTABLE ? lua_rawlen(L, element) : 0;
        if (corners != 3 && corners != 4) fail_value(L, at, "three or four numbers of points", element);
        std::array<int, 4>& cell = face.cells[next++];
        for (std::size_t corner = 0; corner < corners; ++corner) {
            lua_rawgeti(L, element, to_lua(corner));
            if (lua_isinteger(L, -1) && lua_tointeger(L, -1) == 0)
                fail_option(L, at, "must name points, which count from 1, found 0");
            cell[corner] = read_whole(L, -1, at, 1);
            if (std::find(cell.begin(), cell.begin() + static_cast<std::ptrdiff_t>(corner), cell[corner]) !=
                cell.begin() + static_cast<std::ptrdiff_t>(corner))
                fail_option(L, at, "names point %d twice", cell[corner]);
            lua_pop(L, 1);
        }
    });
}

const Option<AddedFace> kAddFaceOptions[] = {
    {"name", read_name},
    {"points", read_points},
    {"cells", read_cells},
    {"keep_mesh", boolean<&AddedFace::keep_mesh>},
};

/// Divide a quad into two triangles along the diagonal on which they do not fold; if both or neither fold,
/// along the shorter diagonal.
std::array<Triangle, 2> halves(const Quad& q, const std::vector<Vec3>& points)
{
    const auto at = [&](int i) { return points[static_cast<std::size_t>(q[static_cast<std::size_t>(i)])]; };
    const auto fold = [&](int a, int b, int c, int d) { // whether the halves on the diagonal a-c fold
        const Vec3 one = (at(b) - at(a)).cross(at(c) - at(a)), two = (at(c) - at(a)).cross(at(d) - at(a));
        return one.dot(two) <= 0;
    };
    const bool first_folds = fold(0, 1, 2, 3), second_folds = fold(1, 2, 3, 0);
    const bool first = first_folds == second_folds ? (at(2) - at(0)).norm() <= (at(3) - at(1)).norm()
                                                   : !first_folds;
    if (first) return {Triangle{q[0], q[1], q[2]}, Triangle{q[0], q[2], q[3]}};
    return {Triangle{q[0], q[1], q[3]}, Triangle{q[1], q[2], q[3]}};
}

void add(ModelState& state, const AddedFace& face)
{
    healing::FacetSoup& soup = state.added;
    const int label = state.added_faces++;
    const auto offset = static_cast<Index>(soup.points.size());
    soup.points.insert(soup.points.end(), face.points.begin(), face.points.end());
    soup.label_name.push_back(face.name);
    soup.label_keeps_nodes.push_back(face.keep_mesh ? 1 : 0);
    const auto add_triangle = [&](const Triangle& triangle) {
        soup.triangles.push_back(triangle);
        soup.triangle_label.push_back(label);
    };
    for (const std::array<int, 4>& cell : face.cells) {
        const Quad q{offset + cell[0] - 1, offset + cell[1] - 1, offset + cell[2] - 1, offset + cell[3] - 1};
        if (cell[3] == 0) {
            add_triangle({q[0], q[1], q[2]});
        } else if (face.keep_mesh) {
            soup.quads.push_back(q);
            soup.quad_label.push_back(label);
        } else {
            for (const Triangle& triangle : halves(q, soup.points)) add_triangle(triangle);
        }
    }
    state.stale = true;
}

// --- Model ----------------------------------------------------------------------------------------------

struct NewModel {
    double tolerance = 0;
};

const Option<NewModel> kModelOptions[] = {
    {"tolerance", positive<&NewModel::tolerance>},
};

/// model = lacuna.model([{ tolerance = }])
int new_model(lua_State* L)
{
    NewModel options;
    read_options(L, 1, "model", kModelOptions, options);
    auto& box = new_box<ModelState>(L);
    guard(L, [&] {
        box = std::make_shared<ModelState>();
        box->hand_made = true;
        box->tolerance = options.tolerance;
    });
    return 1;
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
    guard(L, [&] { add(*state, face); });
    push_face(L, state, FaceId(static_cast<Index>(state->added_faces - 1)));
    return 1;
}

/// faces = model:faces([selector])
int faces(lua_State* L)
{
    lua_settop(L, 2);
    const Box<ModelState>& state = hold_model(L, 1);
    auto& selector = temporary<Selector>(L);
    read_selector(L, 2, "faces", selector);
    auto& found = temporary<std::vector<FaceId>>(L);
    guard(L, [&] { found = select(state->model, selector); });
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
        lua_pushfstring(L, "Model of %d faces of the recipe", state.added_faces);
    } else {
        lua_pushfstring(L, "Model of %d faces from %s", static_cast<int>(state.model.faces.size()),
                        state.model.source.c_str());
    }
    return 1;
}

int model_tolerance(lua_State* L) { return give(L, hold_model(L, 1)->model.tolerance); }
int model_diagonal(lua_State* L) { return give(L, hold_model(L, 1)->model.diagonal); }

const luaL_Reg kTopologyModelMethods[] = {
    {"faces", faces}, {"face", face}, {"face_from", face_from}, {"add_face", add_face}, {nullptr, nullptr},
};
const luaL_Reg kModelMeta[] = {{"__tostring", model_to_string}, {nullptr, nullptr}};
const Field kModelFields[] = {
    {"tolerance", model_tolerance},
    {"diagonal", model_diagonal},
    {nullptr, nullptr},
};

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

int face_tag(lua_State* L) { return give(L, this_face(L).tag); }

template <std::string topology::Face::*Member>
int face_text(lua_State* L)
{
    const std::string& text = this_face(L).*Member;
    lua_pushlstring(L, text.data(), text.size());
    return 1;
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
    push_vector(L, Of(held.model, held.face));
    return 1;
}

int face_loops(lua_State* L) { return give(L, this_face(L).loops.size()); }

int face_edges(lua_State* L)
{
    std::size_t uses = 0;
    for (const topology::Loop& loop : this_face(L).loops) uses += loop.uses.size();
    return give(L, uses);
}

int face_has_mesh(lua_State* L)
{
    lua_pushboolean(L, !this_face(L).given_quads.empty());
    return 1;
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
        if (shape.axis) push_vector(L, *shape.axis);
        return shape.axis.has_value();
    });
}

/// { {x, y, z}, {x, y, z} }
int face_box(lua_State* L)
{
    const HeldFace held = hold_face(L);
    Eigen::AlignedBox3d box;
    for (const Triangle& t : held.model[held.face].triangles)
        for (const Index p : t) box.extend(held.model.at(p));
    push_array(L, std::array<Vec3, 2>{box.min(), box.max()}, [&](const Vec3& end) { push_vector(L, end); });
    return 1;
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
    push_array(L, tags, [&](const auto& item) { lua_pushinteger(L, item); });
    return 1;
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
    lua_pushboolean(L, alike && face_now(**a) == face_now(**b) && face_now(**a).valid());
    return 1;
}

const Field kFaceFields[] = {
    {"tag", face_tag},
    {"name", face_text<&topology::Face::name>},
    {"kind", face_text<&topology::Face::kind>},
    {"area", face_area},
    {"normal", face_vector<mean_normal>},
    {"centroid", face_vector<topology::face_centroid>},
    {"loops", face_loops},
    {"edges", face_edges},
    {"has_mesh", face_has_mesh},
    {"radius", face_radius},
    {"axis", face_axis},
    {"box", face_box},
    {"neighbours", face_neighbours},
    {nullptr, nullptr},
};
const luaL_Reg kFaceMeta[] = {{"__tostring", face_to_string}, {"__eq", face_equal}, {nullptr, nullptr}};

const luaL_Reg kTopologyFunctions[] = {{"model", new_model}, {nullptr, nullptr}};

} // namespace

void bind_topology(lua_State* L)
{
    make_class<ModelState>(L, kModelFields, kModelMeta);
    add_methods(L, kClassName<ModelState>, kTopologyModelMethods);
    bind_info(L);
    make_class<FaceHandle>(L, kFaceFields, kFaceMeta);
    luaL_setfuncs(L, kTopologyFunctions, 0);
}

} // namespace lacuna::lua
