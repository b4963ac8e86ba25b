// SPDX-License-Identifier: MIT
#include "bindings/faces.h"

#include <lacuna/core/error.h>
#include <lacuna/core/shared/list_text.h>
#include <lacuna/healing/shared/grow_face.h>
#include <lacuna/topology/shared/names_of.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <iterator>
#include <optional>

namespace lacuna::lua {

namespace {

const char* const kKinds[] = {"plane", "cylinder", "cone",    "sphere",
                              "torus", "bspline",  "surface", "discrete"};

void read_tags(lua_State* L, int index, const Where& where, Selector& selector)
{
    guard(L, [&] { selector.tags.emplace(1); });
    if (lua_type(L, index) == LUA_TTABLE)
        read_items(L, index, where, "", *selector.tags, read_tag);
    else
        selector.tags->front() = read_tag(L, index, where);
}

void read_kind(lua_State* L, int index, const Where& where, Selector& selector)
{
    const std::size_t kind = read_word(L, index, where, kKinds, std::size(kKinds));
    guard(L, [&] { selector.kind = kKinds[kind]; });
}

void read_facing(lua_State* L, int index, const Where& where, Selector& selector)
{
    const Vec3 facing = read_vector(L, index, where);
    if (!(facing.norm() > 0)) fail_option(L, where, "must be a direction, found { 0, 0, 0 }");
    selector.facing = facing.normalized();
}

/// { min, max }, of which max may be math.huge.
std::array<double, 2> read_range(lua_State* L, int index, const Where& where, const char* expected)
{
    std::array<double, 2> range{};
    if (array_length(L, index) != 2) fail_value(L, where, expected, index);
    for (double& bound : range) {
        const int at = push_element(L, index, &bound == &range[0] ? 1 : 2);
        if (lua_type(L, at) != LUA_TNUMBER || std::isnan(lua_tonumber(L, at)))
            fail_value(L, where, "two numbers", at);
        bound = lua_tonumber(L, at);
    }
    lua_pop(L, 2);
    if (range[0] > range[1])
        fail_option(L, where, "must be in increasing order, found { %f, %f }", range[0], range[1]);
    return range;
}

void read_area(lua_State* L, int index, const Where& where, Selector& selector)
{
    selector.area = read_range(L, index, where, "the smallest and the largest area, { min, max }");
}

void read_radius(lua_State* L, int index, const Where& where, Selector& selector)
{
    selector.radius = read_range(L, index, where, "the smallest and the largest radius, { min, max }");
}

void read_box(lua_State* L, int index, const Where& where, Selector& selector)
{
    const char* const expected = "two corners, { {x, y, z}, {x, y, z} }";
    if (array_length(L, index) != 2) fail_value(L, where, expected, index);
    Eigen::AlignedBox3d box;
    read_array(L, index, where, expected,
               [&](int element, const Where& at) { box.extend(read_vector(L, element, at)); });
    selector.box = box;
}

void read_touching(lua_State* L, int index, const Where& where, Selector& selector)
{
    if (const Box<FaceHandle>* handle = test_box<FaceHandle>(L, index); handle && *handle) {
        guard(L, [&] {
            selector.touching = face_of(**handle);
            selector.touching_model = &(*handle)->model->model;
        });
    } else if (lua_type(L, index) == LUA_TNUMBER) {
        selector.touching_tag = read_whole(L, index, where, 0);
    } else if (lua_type(L, index) == LUA_TSTRING) {
        const char* name = lua_tostring(L, index);
        guard(L, [&] { selector.touching_name = name; });
    } else {
        fail_value(L, where, "a Face, a tag or a name", index);
    }
}

const Option<Selector> kSelectorOptions[] = {
    {"tags", read_tags},
    {"name", text<&Selector::name>},
    {"kind", read_kind},
    {"facing", read_facing},
    {"near", vector<&Selector::near>},
    {"area", read_area},
    {"box", read_box},
    {"touching", read_touching},
    {"free", boolean<&Selector::free>},
    {"region", text<&Selector::region>},
    {"radius", read_radius},
    {"normal_within", degrees<&Selector::normal_within>},
    {"within", positive<&Selector::within>},
};

/// Append the faces that `pick` returns. If there are none, raise an error with the reason and the model's
/// faces.
/// @param tag  of the wanted face, if one is wanted by its tag.
template <class Pick>
void append(lua_State* L, const Where& where, const topology::Model& model, std::vector<FaceId>& faces,
            const char* why, std::optional<int> tag, Pick&& pick)
{
    bool any = false;
    guard(L, [&] {
        for (const FaceId face : pick()) {
            any = true;
            // Both tags of a face that the file lists twice may be named.
            const bool again = tag && !model[face].repeated_tags.empty() &&
                               std::ranges::count(faces, face) > 0;
            if (!again) faces.push_back(face);
        }
    });
    if (any) return;
    const char* const subject = push_subject(L, where);
    guard(L, [&] {
        const std::vector<FaceId> there = topology::all_faces(model);
        const Argument all = there.empty() ? Argument("no faces")
                                           : Argument(topology::entities_of(model, there));
        if (tag)
            throw InvalidInput("lua.bad_value", "{} names {}, which {}; the model has {}", subject,
                               NamedEntity{"face", *tag}, why, all);
        throw InvalidInput("lua.bad_value", "{} {}; the model has {}", subject, why, all);
    });
}

/// Push " (did you mean ...?)" with the nearest name of a face; an empty text if no name is near.
const char* push_meant_name(lua_State* L, const topology::Model& model, const char* wanted)
{
    return push_text(L, [&] {
        std::string best;
        std::size_t least = std::strlen(wanted) / 2 + 1; // fewer letters than this may differ
        for (const topology::Face& face : model.faces) {
            const std::size_t apart = edit_distance(wanted, face.name.c_str());
            if (face.name.empty() || apart >= least) continue;
            least = apart;
            best = face.name;
        }
        return best.empty() ? best : " (did you mean \"" + best + "\"?)";
    });
}

/// Push the reason why there is no face with a tag: the note of loading about it, if there is one.
const char* push_why_missing(lua_State* L, const topology::Model& model, int tag)
{
    return push_text(L, [&] {
        const auto note = std::ranges::find_if(model.notes, [&](const Message& of) {
            return !of.entities().empty() && of.entities().front() == NamedEntity{"face", tag};
        });
        return note == model.notes.end() ? std::string("is not there") : "was not read: " + note->text();
    });
}

void read_one_face(lua_State* L, int index, const Where& where, const Box<ModelState>& state,
                   std::vector<FaceId>& faces)
{
    const topology::Model& model = state->model;
    if (const Box<FaceHandle>* handle = test_box<FaceHandle>(L, index)) {
        if (!*handle || (*handle)->model != state) fail_option(L, where, "is a face of another model");
        bring_up_to_date(L, *state); // a finalizer may have added the face since the call began
        guard(L, [&] { faces.push_back(face_of(**handle)); });
        return;
    }
    auto& wanted = temporary<Selector>(L);
    const char* none = nullptr;
    std::optional<int> missing;
    switch (lua_type(L, index)) {
    case LUA_TNUMBER: {
        const int tag = read_whole(L, index, where, 0);
        guard(L, [&] { wanted.tags = {tag}; });
        missing = tag;
        none = push_why_missing(L, model, tag);
        break;
    }
    case LUA_TSTRING: {
        const char* name = read_string(L, index, where);
        guard(L, [&] { wanted.name = name; });
        none = lua_pushfstring(L, "names \"%s\", but no face has that name%s", name,
                               push_meant_name(L, model, name));
        break;
    }
    case LUA_TTABLE:
        read_selector(L, index, where.key ? lua_pushfstring(L, "%s: %s", where.call, where.key) : where.call,
                      wanted);
        none = "selects no face";
        break;
    default:
        fail_value(L, where, "a Face, a tag, a name, a selector or an array of those", index);
    }
    append(L, where, model, faces, none, missing, [&] { return topology::select(model, wanted); });
}

/// Metatable field of an array that a selector returned empty: the selector as text.
constexpr const char* kFoundNothing = "lacuna.found_nothing";

struct GrowArguments {
    Selector selector;
    double angle = healing::GrowOptions{}.angle;
};

const Option<GrowArguments> kGrowOptions[] = {
    {"near", vector<&GrowArguments::selector, &Selector::near>},
    {"angle", degrees<&GrowArguments::angle>},
    {"region", text<&GrowArguments::selector, &Selector::region>},
    {"free", boolean<&GrowArguments::selector, &Selector::free>},
};

} // namespace

PointAndNormal read_point_and_normal(lua_State* L, int index, const Where& where)
{
    int entries = 0;
    if (lua_type(L, index) == LUA_TTABLE)
        for (lua_pushnil(L); lua_next(L, index); lua_pop(L, 1)) ++entries;
    const auto read = [&](int number, const char* key) {
        if (entries != 2 ||
            (lua_getfield(L, index, key) == LUA_TNIL && lua_rawgeti(L, index, number) == LUA_TNIL))
            fail_value(L, where,
                       "a plane { point, normal }, as { { 0, 0, 1 }, { 0, 0, 1 } } or "
                       "{ point = { 0, 0, 1 }, normal = { 0, 0, 1 } }",
                       index);
        return read_vector(L, lua_gettop(L), where);
    };
    const int top = lua_gettop(L);
    const PointAndNormal plane{read(1, "point"), read(2, "normal")};
    lua_settop(L, top);
    if (!(plane.normal.stableNorm() > 0)) fail_option(L, where, "has a normal of length 0");
    return plane;
}

geometry::Plane read_plane(lua_State* L, int index, const Where& where)
{
    const auto [point, normal] = read_point_and_normal(L, index, where);
    return geometry::plane_across(point, normal.stableNormalized());
}

FaceId grow_face(lua_State* L, int index, const Box<ModelState>& state)
{
    auto& arguments = temporary<GrowArguments>(L);
    read_options(L, index, "face_from", kGrowOptions, arguments);
    if (!arguments.selector.near) fail(L, "face_from: option 'near' is missing: a point, { x, y, z }");
    if (state->hand_made)
        fail(L, "face_from: needs a loaded model; the faces of this one were added by the recipe");
    RunContext& context = push_context(L);
    FaceId face;
    guard(L, [&] {
        const Vec3 near = *std::exchange(arguments.selector.near, std::nullopt);
        const std::vector<FaceId> among = topology::select(state->model, arguments.selector);
        healing::GrownFace grown = healing::grow_face(state->model, near, among, {arguments.angle}, context);
        face = grown.face;
        state->moves.push_back(std::move(grown.now));
        state->model = std::move(grown.model);
    });
    return face;
}

void read_selector(lua_State* L, int index, const char* call, Selector& selector)
{
    read_options(L, index, call, kSelectorOptions, selector);
    if (selector.within && !selector.near)
        fail(L, "%s: option 'within' is a distance from 'near', which is missing", call);
}

void read_faces(lua_State* L, int index, const Where& where, const Box<ModelState>& model,
                std::vector<FaceId>& faces)
{
    index = lua_absindex(L, index);
    if (lua_type(L, index) == LUA_TTABLE) {
        lua_pushnil(L);
        const bool empty = lua_next(L, index) == 0;
        const bool array = empty || lua_type(L, -2) == LUA_TNUMBER;
        if (!empty) lua_pop(L, 2);
        if (array) {
            if (empty && luaL_getmetafield(L, index, kFoundNothing) != LUA_TNIL)
                fail_option(L, where,
                            "is the empty result of model:faces{ %s }; for a role without faces, give {}",
                            lua_tostring(L, -1));
            read_array(L, index, where, "", [&](int element, const Where& at) {
                if (lua_type(L, element) == LUA_TTABLE && lua_rawlen(L, element) > 0)
                    fail_value(L, at, "a Face, a tag, a name or a selector", element);
                read_one_face(L, element, at, model, faces);
            });
            return;
        }
    }
    read_one_face(L, index, where, model, faces);
}

FaceId read_any_face(lua_State* L, int index, const Where& where, const Box<ModelState>& model,
                     Box<ModelState>& of)
{
    FaceId face;
    if (const Box<FaceHandle>* const handle = test_box<FaceHandle>(L, index); handle != nullptr && *handle) {
        guard(L, [&] {
            of = (*handle)->model;
            face = face_of(**handle);
        });
        return face;
    }
    auto& faces = temporary<std::vector<FaceId>>(L);
    read_faces(L, index, where, model, faces);
    if (faces.size() != 1) fail_option(L, where, "selects several faces; give one");
    of = model;
    return faces.front();
}

void mark_found_nothing(lua_State* L, int selector)
{
    const int array = lua_gettop(L);
    auto& words = temporary<std::vector<std::string>>(L);
    lua_pushnil(L);
    while (lua_next(L, selector) != 0) {
        const bool text = lua_type(L, -1) == LUA_TSTRING;
        const bool plain = text || lua_type(L, -1) == LUA_TNUMBER || lua_type(L, -1) == LUA_TBOOLEAN;
        const char* value = plain ? luaL_tolstring(L, -1, nullptr) : (lua_pushnil(L), "…");
        if (const char* key = lua_type(L, -3) == LUA_TSTRING ? lua_tostring(L, -3) : nullptr) {
            guard(L, [&] {
                words.push_back(std::string(key) + " = " + (text ? "\"" : "") + value + (text ? "\"" : ""));
            });
        }
        lua_pop(L, 2);
    }
    lua_createtable(L, 0, 1);
    push_text(L, [&] {
        std::ranges::sort(words);
        return full_list(words, std::identity());
    });
    lua_setfield(L, -2, kFoundNothing);
    lua_setmetatable(L, array);
    lua_settop(L, array);
}

const char* push_names(lua_State* L, const topology::Model& model, const std::vector<FaceId>& faces)
{
    return push_text(
        L, [&] { return faces.empty() ? "no faces" : formatted("{}", topology::entities_of(model, faces)); });
}

} // namespace lacuna::lua
