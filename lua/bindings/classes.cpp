// SPDX-License-Identifier: MIT
#include "bindings/classes.h"

#include "bindings/lacuna_lua.h"

#include <lacuna/cad/left_out.h>
#include <lacuna/closure/steps.h>
#include <lacuna/core/progress.h>

#include <algorithm>
#include <sstream>

namespace lacuna::lua {

using topology::Origin;
using topology::Role;

namespace {

const char* word(topology::Geometry geometry)
{
    switch (geometry) {
    case topology::Geometry::given:
        return "given";
    case topology::Geometry::newell:
        return "Newell";
    case topology::Geometry::transfinite:
        return "transfinite";
    case topology::Geometry::annular:
        return "annular strip";
    case topology::Geometry::followed:
        return "followed sides";
    case topology::Geometry::parallel:
        return "parallel to the other end";
    }
    return "unknown";
}

const char* word(Role role)
{
    return role == Role::source ? "source" : role == Role::target ? "target" : "wall";
}

bool has_both_ends(const topology::OpenVolume& volume)
{
    return !volume.faces(Role::source).empty() && !volume.faces(Role::target).empty();
}

void list_faces(std::ostream& out, const char* title, const topology::OpenVolume& volume, Role role,
                Origin origin)
{
    std::string names;
    for (const FaceId face : volume.faces(role))
        if (volume.model[face].origin == origin)
            names += (names.empty() ? "" : ", ") + topology::name_of(volume.model, face);
    if (origin == Origin::given || !names.empty()) out << title << (names.empty() ? "none" : names) << '\n';
}

/// The splitter meets triangles before quads; give each face the number of its label.
/// @pre a face a label.
void put_in_order_of_adding(topology::Model& model, const healing::FacetSoup& soup)
{
    std::vector<topology::Face> faces(model.faces.size());
    std::vector<bool> met(model.faces.size(), false);
    std::size_t next = 0;
    for (const std::vector<int>* labels : {&soup.triangle_label, &soup.quad_label})
        for (const int label : *labels) {
            const auto place = static_cast<std::size_t>(label);
            if (met[place]) continue;
            met[place] = true;
            faces[place] = std::move(model.faces[next++]);
            faces[place].tag = label + 1;
        }
    model.faces = std::move(faces);
}

} // namespace

void refresh(ModelState& state, const RunContext& context)
{
    if (!state.stale) return;
    healing::SplitOptions options;
    options.whole_labels = true;
    options.tolerance = state.tolerance;
    topology::Model model = healing::split_facets(state.added, options, context);
    if (model.faces.size() != static_cast<std::size_t>(state.added_faces))
        throw InvalidInput("lua.face_in_parts", "the " + std::to_string(state.added_faces) +
                                                    " faces added became " +
                                                    std::to_string(model.faces.size()) +
                                                    ": the cells of one do not hang together; "
                                                    "add each part as a face of its own");
    put_in_order_of_adding(model, state.added);
    model.source = "faces of the recipe";
    state.model = std::move(model);
    state.stale = false;
}

void bring_up_to_date(lua_State* L, ModelState& state)
{
    if (!state.stale) return;
    const RunContext& context = push_context(L);
    guard(L, [&] { refresh(state, context); });
    lua_pop(L, 1);
}

FaceId face_now(const FaceHandle& handle)
{
    FaceId face = handle.face;
    for (std::size_t m = handle.moves; m < handle.model->moves.size() && face.valid(); ++m)
        face = handle.model->moves[m][face.index()];
    return face;
}

FaceId face_of(const FaceHandle& handle)
{
    const FaceId face = face_now(handle);
    if (!face.valid())
        throw InvalidInput("lua.face_grown_over", "this face is part of one that face_from grew since; take "
                                                  "that one, or pick faces after face_from");
    return face;
}

Busy::Busy(VolumeState& state, const char* method) : state_(state)
{
    if (state.busy)
        throw InvalidInput("lua.busy", std::string(method) + ": this volume is being worked on by its " +
                                           state.busy + "(); call " + method + " when that is done");
    state.busy = method;
}

namespace {

bool asks_nothing(const closure::CloseOptions& options)
{
    const closure::CloseOptions none;
    return options.edge_shape == none.edge_shape && options.void_edges.empty() && options.cap == none.cap &&
           options.holes == none.holes;
}

} // namespace

void match_volume(VolumeState& state, const matching::MatchOptions& options, const RunContext& context)
{
    if (state.match) return;
    if (options == matching::MatchOptions{} && state.as_read) {
        state.match = state.as_read->match;
        return;
    }
    state.as_read.reset();
    state.match = matching::match(state.volume, options, context);
}

void close_volume(VolumeState& state, const closure::CloseOptions& options, const RunContext& context)
{
    if (state.closure) { // sealed as it was read: what that assumed was not told yet
        if (!std::exchange(state.told, true)) closure::log_notes(*state.closure, context);
        return;
    }
    const bool whole = topology::free_edges(state.volume).empty();
    // The ends match when their holes are covered, and not before.
    if (options.holes != closure::Holes::cover && has_both_ends(state.volume) &&
        !(whole && closure::has_steps(state.volume, context))) {
        matching::MatchOptions by_hand;
        by_hand.vertices = closure::pairs_by_hand(state.volume, options);
        match_volume(state, by_hand, context);
    }
    report_progress(context, "closing");
    state.told = true;
    // What a trial with void edges assumed is measured and told where it is closed anew.
    if (state.as_read && asks_nothing(options) && state.as_read->closure.void_edges.empty()) {
        state.closure = std::move(state.as_read->closure);
        state.volume = std::move(state.as_read->volume);
        state.as_read.reset();
        closure::log_notes(*state.closure, context);
        return;
    }
    topology::OpenVolume sealed = state.volume;
    closure::CloseOptions asked = options;
    asked.take_guess = state.take_guess;
    state.closure = closure::close(sealed, state.match.value_or(matching::Match{}), asked, context);
    state.volume = std::move(sealed);
}

RunContext& push_context(lua_State* L)
{
    const Host& lent = host(L);
    auto& context = temporary<RunContext>(L);
    context.threads = lent.threads;
    context.cancel = lent.cancel;
    if (lent.log)
        context.log = [&lent](std::string_view line) { lent.log(line); }; // one pointer: no allocation
    if (lent.progress)
        context.progress = [&lent](std::string_view stage, double share) {
            lent.in_stage = true;
            lent.progress(stage, share);
        };
    return context;
}

std::string tree(const topology::OpenVolume& volume)
{
    const topology::Model& model = volume.model;
    std::ostringstream out;
    out << "volume: " << model.faces.size() << " faces, " << model.edges.size() << " edges, "
        << model.vertices.size() << " vertices\n";
    for (std::size_t f = 0; f < model.faces.size(); ++f) {
        const topology::Face& face = model.faces[f];
        out << "  " << topology::name_of(model, FaceId(f)) << ", " << word(volume.role[f]) << ": "
            << (face.origin == Origin::given ? face.kind : word(face.geometry)) << ", "
            << face.triangles.size() << " facets" << (face.surface ? ", exact surface" : "")
            << (face.given_quads.empty() ? "" : ", given mesh") << '\n';
        for (const topology::Loop& loop : face.loops) {
            out << "    loop of " << loop.uses.size() << '\n';
            for (const topology::EdgeUse use : loop.uses) {
                const topology::Edge& edge = model[use.edge];
                out << "      " << topology::name_of(model, use.edge) << (use.reversed ? ", reversed" : "")
                    << ": " << (edge.curve ? "exact curve" : "polyline") << " of " << edge.points.size() - 1
                    << ", from " << topology::name_of(model, edge.from) << " to "
                    << topology::name_of(model, edge.to) << '\n';
            }
        }
    }
    return out.str();
}

std::string describe(const VolumeState& state)
{
    std::ostringstream out;
    list_faces(out, "source: ", state.volume, Role::source, Origin::given);
    list_faces(out, "target: ", state.volume, Role::target, Origin::given);
    list_faces(out, "walls:  ", state.volume, Role::wall, Origin::given);
    if (!state.role_reasons.empty()) out << "likely roles:\n";
    for (const std::string& reason : state.role_reasons) out << "  " << reason << '\n';
    out << "class:  " << topology::to_string(state.classification.value) << '\n';
    for (const std::string& reason : state.classification.reasons) out << "  " << reason << '\n';
    if (state.match) {
        out << "match:  " << state.match->method << ", " << state.match->loops.size() << " loops, "
            << state.match->vertices.size() << " vertices, confidence " << state.match->confidence << '\n';
        for (const std::string& note : state.match->notes) out << "  " << note << '\n';
    }
    list_faces(out, "void source: ", state.volume, Role::source, Origin::made_void);
    list_faces(out, "void target: ", state.volume, Role::target, Origin::made_void);
    list_faces(out, "void walls:  ", state.volume, Role::wall, Origin::made_void);
    if (state.closure) {
        out << "sealed: " << state.closure->void_edges.size() << " void edges, "
            << state.closure->void_faces.size() << " void faces, "
            << (state.closure->watertight ? "watertight" : "not watertight") << '\n';
        for (const std::string& algorithm : state.closure->algorithms) out << "  " << algorithm << '\n';
        for (const std::string& note : state.closure->notes) out << "  " << note << '\n';
    } else if (!state.classification.free_loops.empty()) {
        out << "open:   " << topology::free_edges(state.volume).size() << " free edges in "
            << state.classification.free_loops.size() << " loops; close() seals them\n";
    }
    for (const std::string& missing : cad::left_out_in_words(state.volume)) out << missing << '\n';
    return out.str();
}

void push_vector(lua_State* L, const Vec3& vector)
{
    lua_createtable(L, 3, 0);
    for (int i = 0; i < 3; ++i) {
        lua_pushnumber(L, vector[i]);
        lua_rawseti(L, -2, i + 1);
    }
}

void set_number(lua_State* L, const char* key, double value)
{
    lua_pushnumber(L, value);
    lua_setfield(L, -2, key);
}

void set_count(lua_State* L, const char* key, std::size_t value)
{
    lua_pushinteger(L, static_cast<lua_Integer>(value));
    lua_setfield(L, -2, key);
}

void set_boolean(lua_State* L, const char* key, bool value)
{
    lua_pushboolean(L, value);
    lua_setfield(L, -2, key);
}

void set_string(lua_State* L, const char* key, const char* value)
{
    lua_pushstring(L, value);
    lua_setfield(L, -2, key);
}

void set_strings(lua_State* L, const char* key, const std::vector<std::string>& values)
{
    lua_createtable(L, static_cast<int>(values.size()), 0);
    for (std::size_t i = 0; i < values.size(); ++i) {
        lua_pushlstring(L, values[i].data(), values[i].size());
        lua_rawseti(L, -2, to_lua(i));
    }
    lua_setfield(L, -2, key);
}

void push_face(lua_State* L, const Box<ModelState>& model, FaceId face)
{
    auto& box = new_box<FaceHandle>(L);
    guard(L, [&] { box = std::make_shared<FaceHandle>(FaceHandle{model, face, model->moves.size()}); });
}

void push_group(lua_State* L, const std::string& name, int dim, std::size_t cells)
{
    lua_createtable(L, 0, 3);
    set_string(L, "name", name.c_str());
    set_count(L, "dim", static_cast<std::size_t>(dim));
    set_count(L, "cells", cells);
}

namespace {

int report_to_string(lua_State* L)
{
    luaL_checktype(L, 1, LUA_TTABLE);
    luaL_Buffer buffer;
    luaL_buffinit(L, &buffer);
    const auto count = static_cast<lua_Integer>(lua_rawlen(L, 1));
    for (lua_Integer i = 1; i <= count; ++i) {
        if (i > 1) luaL_addchar(&buffer, '\n');
        lua_rawgeti(L, 1, i);
        luaL_tolstring(L, -1, nullptr); // whatever a recipe put there
        lua_remove(L, -2);
        luaL_addvalue(&buffer);
    }
    luaL_pushresult(&buffer);
    return 1;
}

} // namespace

void set_report_meta(lua_State* L, const StageSeconds& seconds)
{
    lua_createtable(L, 0, static_cast<int>(seconds.size()));
    for (const auto& [stage, taken] : seconds) set_number(L, stage.c_str(), taken);
    lua_setfield(L, -2, "seconds");
    if (luaL_newmetatable(L, "Report")) {
        lua_pushcfunction(L, report_to_string);
        lua_setfield(L, -2, "__tostring");
        set_string(L, "__metatable", "Report");
    }
    lua_setmetatable(L, -2);
}

std::size_t check_number(lua_State* L, const char* call, std::size_t count)
{
    int whole = 0;
    const lua_Integer number = lua_type(L, 2) == LUA_TNUMBER ? lua_tointegerx(L, 2, &whole) : 0;
    if (!whole || number < 1 || static_cast<std::size_t>(number) > count) {
        const char* found = push_found(L, 2);
        fail(L, "%s: the number must be from 1 to %I, found %s", call, static_cast<lua_Integer>(count),
             found);
    }
    return from_lua(number);
}

} // namespace lacuna::lua
