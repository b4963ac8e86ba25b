// SPDX-License-Identifier: MIT
#include "bindings/faces.h"

#include <lacuna/core/error.h>
#include <lacuna/core/shared/list_text.h>
#include <lacuna/geometry/shared/facet_tree.h>
#include <lacuna/healing/shared/grow_face.h>
#include <lacuna/topology/shared/face_radius.h>
#include <lacuna/topology/shared/names_of.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <iterator>
#include <numbers>
#include <optional>
#include <string_view>

namespace lacuna::lua {

namespace {

const char* const kKinds[] = {"plane", "cylinder", "cone",    "sphere",
                              "torus", "bspline",  "surface", "discrete"};

void read_tags(lua_State* L, int index, const Where& where, Selector& selector)
{
    const auto count = lua_type(L, index) == LUA_TTABLE ? lua_rawlen(L, index) : 1;
    guard(L, [&] { selector.tags.emplace(count); });
    if (lua_type(L, index) != LUA_TTABLE) {
        selector.tags->front() = read_whole(L, index, where, 0);
        return;
    }
    std::size_t next = 0;
    read_array(L, index, where, "a tag or an array of tags", [&](int element, const Where& at) {
        (*selector.tags)[next++] = read_whole(L, element, at, 0);
    });
}

template <auto Member>
void read_text(lua_State* L, int index, const Where& where, Selector& selector)
{
    const char* text = read_string(L, index, where);
    guard(L, [&] { selector.*Member = text; });
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

void read_near(lua_State* L, int index, const Where& where, Selector& selector)
{
    selector.near = read_vector(L, index, where);
}

/// { min, max }, of which max may be math.huge.
std::array<double, 2> read_range(lua_State* L, int index, const Where& where, const char* expected)
{
    std::array<double, 2> range{};
    if (lua_type(L, index) != LUA_TTABLE || lua_rawlen(L, index) != 2) fail_value(L, where, expected, index);
    for (int i = 0; i < 2; ++i) {
        lua_rawgeti(L, index, i + 1);
        if (lua_type(L, -1) != LUA_TNUMBER || std::isnan(lua_tonumber(L, -1)))
            fail_value(L, where, "two numbers", -1);
        range[static_cast<std::size_t>(i)] = lua_tonumber(L, -1);
        lua_pop(L, 1);
    }
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
    if (lua_type(L, index) != LUA_TTABLE || lua_rawlen(L, index) != 2) fail_value(L, where, expected, index);
    Eigen::AlignedBox3d box;
    read_array(L, index, where, expected,
               [&](int element, const Where& at) { box.extend(read_vector(L, element, at)); });
    selector.box = box;
}

void read_free(lua_State* L, int index, const Where& where, Selector& selector)
{
    selector.free = read_boolean(L, index, where);
}

void read_normal_within(lua_State* L, int index, const Where& where, Selector& selector)
{
    selector.normal_within = read_positive(L, index, where);
    if (selector.normal_within > 180) fail_value(L, where, "degrees in (0, 180]", index);
}

void read_touching(lua_State* L, int index, const Where& where, Selector& selector)
{
    if (const Box<FaceHandle>* handle = test_box<FaceHandle>(L, index); handle && *handle) {
        guard(L, [&] {
            selector.touching = face_of(**handle);
            selector.touching_model = (*handle)->model;
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
    {"name", read_text<&Selector::name>},
    {"kind", read_kind},
    {"facing", read_facing},
    {"near", read_near},
    {"area", read_area},
    {"box", read_box},
    {"touching", read_touching},
    {"free", read_free},
    {"region", read_text<&Selector::region>},
    {"radius", read_radius},
    {"normal_within", read_normal_within},
    {"within", positive<&Selector::within>},
};

/// Squared distance from a place to the facets of a face.
double distance(const topology::Model& model, FaceId face, const Vec3& place)
{
    double least = std::numeric_limits<double>::infinity();
    for (const Triangle& t : model[face].triangles) {
        const auto hit = geometry::closest_on_triangle(place,
                                                       {model.at(t[0]), model.at(t[1]), model.at(t[2])});
        least = std::min(least, hit.distance2);
    }
    return least;
}

bool is_called(const topology::Face& face, const std::string& name)
{
    return face.name == name || std::ranges::find(face.groups, name) != face.groups.end();
}

bool bounds(const topology::Face& face, const std::string& region)
{
    return std::ranges::any_of(
        face.regions, [&](const auto& names) { return std::ranges::find(names, region) != names.end(); });
}

/// Whether all of a face is in a box, within the model's tolerance.
bool lies_in(const topology::Model& model, const topology::Face& face, const Eigen::AlignedBox3d& box)
{
    const Vec3 slack = Vec3::Constant(model.tolerance);
    const Eigen::AlignedBox3d wide(box.min() - slack, box.max() + slack);
    return std::ranges::all_of(face.triangles, [&](const Triangle& t) {
        return std::ranges::all_of(t, [&](Index p) { return wide.contains(model.at(p)); });
    });
}

/// The tag of the face that was kept where the file lists a face twice; empty for any other face.
std::optional<int> kept_of_two(const topology::Model& model, int tag)
{
    for (const Message& note : model.notes) {
        if (note.code() != "healing.repeated_face") continue;
        const auto kept = static_cast<int>(note.entities().back().tag);
        if (kept == tag || note.entities().front().tag == tag) return kept;
    }
    return std::nullopt;
}

/// The faces that `touching` names, which are not selected themselves, and their edges.
struct Touched {
    std::vector<bool> face, edge;
};
Touched touched(const topology::Model& model, const Selector& selector)
{
    Touched found{std::vector<bool>(model.faces.size()), std::vector<bool>(model.edges.size())};
    if (selector.touching_model && &selector.touching_model->model != &model)
        throw InvalidInput("lua.other_model", "option 'touching' is a face of another model");
    bool any = false;
    for (std::size_t f = 0; f < model.faces.size(); ++f) {
        const topology::Face& face = model.faces[f];
        found.face[f] = selector.touching_model ? selector.touching == FaceId(f)
                        : selector.touching_tag ? face.tag == *selector.touching_tag
                                                : is_called(face, selector.touching_name);
        any = any || found.face[f];
        if (!found.face[f]) continue;
        for (const topology::Loop& loop : face.loops)
            for (const topology::EdgeUse& use : loop.uses) found.edge[use.edge.index()] = true;
    }
    if (!any)
        throw InvalidInput("lua.no_face", "option 'touching' names a face that the model does not "
                                          "have");
    return found;
}

void keep_touching(const topology::Model& model, const Selector& selector, std::vector<FaceId>& faces)
{
    const Touched by = touched(model, selector);
    std::erase_if(faces, [&](FaceId f) {
        if (by.face[f.index()]) return true;
        for (const topology::Loop& loop : model[f].loops)
            for (const topology::EdgeUse& use : loop.uses)
                if (by.edge[use.edge.index()]) return false;
        return true;
    });
}

bool matches(const topology::Model& model, FaceId id, const Selector& selector)
{
    const topology::Face& face = model[id];
    if (selector.tags && std::ranges::find(*selector.tags, face.tag) == selector.tags->end()) return false;
    if (!selector.name.empty() && !is_called(face, selector.name)) return false;
    if (!selector.region.empty() && !bounds(face, selector.region)) return false;
    if (selector.free && *selector.free != (face.regions.size() < 2)) return false;
    if (!selector.kind.empty() && face.kind != selector.kind) return false;
    if (selector.facing) {
        const double within = std::cos(selector.normal_within * std::numbers::pi / 180);
        if (!(mean_normal(model, id).dot(*selector.facing) >= within)) return false;
    }
    if (selector.box && !lies_in(model, face, *selector.box)) return false;
    if (selector.radius) {
        const std::optional<double> radius = topology::face_radius(model, id);
        if (!radius || *radius < (*selector.radius)[0] || *radius > (*selector.radius)[1]) return false;
    }
    const double area = topology::face_area(model, id);
    return area >= selector.area[0] && area <= selector.area[1];
}

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
            const bool again = tag && kept_of_two(model, *tag) && std::ranges::count(faces, face) > 0;
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
    push_text(L, [&] {
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
    return lua_tostring(L, -1);
}

/// Push the reason why there is no face with a tag: the note of loading about it, if there is one.
const char* push_why_missing(lua_State* L, const topology::Model& model, int tag)
{
    push_text(L, [&] {
        constexpr std::string_view kLeftOut[] = {"cad.face_not_cut", "cad.narrow_face", "healing.thin_face"};
        const auto note = std::ranges::find_if(model.notes, [&](const Message& of) {
            return std::ranges::find(kLeftOut, of.code()) != std::end(kLeftOut) && !of.entities().empty() &&
                   of.entities().front().tag == tag;
        });
        return note == model.notes.end() ? std::string("is not there") : "was not read: " + note->text();
    });
    return lua_tostring(L, -1);
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
    append(L, where, model, faces, none, missing, [&] { return select(model, wanted); });
}

/// Metatable field of an array that a selector returned empty: the selector as text.
constexpr const char* kFoundNothing = "lacuna.found_nothing";

struct GrowArguments {
    Selector selector;
    double angle = healing::GrowOptions{}.angle;
};

template <auto Read>
void selecting(lua_State* L, int index, const Where& where, GrowArguments& arguments)
{
    Read(L, index, where, arguments.selector);
}

void read_angle(lua_State* L, int index, const Where& where, GrowArguments& arguments)
{
    arguments.angle = read_positive(L, index, where);
    if (arguments.angle > 180) fail_value(L, where, "degrees in (0, 180]", index);
}

const Option<GrowArguments> kGrowOptions[] = {
    {"near", selecting<read_near>},
    {"angle", read_angle},
    {"region", selecting<read_text<&Selector::region>>},
    {"free", selecting<read_free>},
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
        const std::vector<FaceId> among = select(state->model, arguments.selector);
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

std::vector<FaceId> select(const topology::Model& model, Selector selector)
{
    const auto kept = [&](int& tag) { tag = kept_of_two(model, tag).value_or(tag); };
    if (selector.tags) std::ranges::for_each(*selector.tags, kept);
    if (selector.touching_tag) kept(*selector.touching_tag);
    std::vector<FaceId> faces;
    for (const FaceId face : topology::all_faces(model))
        if (matches(model, face, selector)) faces.push_back(face);
    if (selector.touching_model || selector.touching_tag || !selector.touching_name.empty())
        keep_touching(model, selector, faces);
    if (!selector.near || faces.empty()) return faces;
    if (selector.within) {
        const double most = *selector.within * *selector.within;
        std::erase_if(faces, [&](FaceId f) { return distance(model, f, *selector.near) > most; });
        return faces;
    }
    const auto further = [&](FaceId a, FaceId b) {
        return distance(model, a, *selector.near) < distance(model, b, *selector.near);
    };
    return {*std::ranges::min_element(faces, further)};
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

Vec3 mean_normal(const topology::Model& model, FaceId face)
{
    // Share of the area below which the summed normals are noise: around a closed skin they cancel.
    constexpr double kRounding = 1e-2;
    const Vec3 vector = topology::face_area_vector(model, face);
    return vector.norm() > kRounding * topology::face_area(model, face) ? Vec3(vector.normalized())
                                                                        : Vec3(Vec3::Zero());
}

const char* push_names(lua_State* L, const topology::Model& model, const std::vector<FaceId>& faces)
{
    push_text(
        L, [&] { return faces.empty() ? "no faces" : formatted("{}", topology::entities_of(model, faces)); });
    return lua_tostring(L, -1);
}

} // namespace lacuna::lua
