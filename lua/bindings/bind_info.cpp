// SPDX-License-Identifier: MIT
// What a model is made of, as a table and as text: faces and their sizes, free edges, gaps, cavities.
#include "bindings/faces.h"

#include <lacuna/closure/shared/model_facts.h>
#include <lacuna/fill/describe.h>

#include <algorithm>

namespace lacuna::lua {

namespace {

using Info = closure::ModelFacts;

// --- tables ---------------------------------------------------------------------------------------------

void push_face_info(lua_State* L, const topology::Model& model, const Info& info, std::size_t f)
{
    const FaceId id(f);
    const topology::Face& face = model[id];
    lua_createtable(L, 0, 24);
    set_whole(L, "tag", face.tag);
    set_string(L, "name", face.name);
    set_string(L, "kind", face.kind);
    set_number(L, "area", topology::face_area(model, id));
    set_vector(L, "normal", topology::mean_normal(model, id));
    set_vector(L, "centroid", topology::face_centroid(model, id));
    push_bounds(L, info.faces[f].box);
    lua_setfield(L, -2, "box");
    set_count(L, "loops", face.loops.size());
    set_count(L, "edges", topology::edge_count(face));
    set_boolean(L, "has_mesh", !face.given_quads.empty());
    set_tags(L, "neighbours", model, info.faces[f].neighbours);
    set_count(L, "free_edges", info.faces[f].free_edges.size());
    set_count(L, "part", info.faces[f].part + 1);
    set_string(L, "use", closure::use_of(info, id));
    if (info.cavity_of[f] < info.cavities.size()) set_count(L, "cavity", info.cavity_of[f] + 1);
    if (const auto& round = info.round[f]) {
        set_string(L, "fits", round->is_sphere() ? "sphere" : "cylinder");
        set_number(L, "radius", round->radius);
        set_vector(L, "centre", round->centre);
        if (round->axis) set_vector(L, "axis", *round->axis);
    }
    if (const auto& cone = info.cone[f]) {
        set_string(L, "fits", "cone");
        set_number(L, "half_angle", cone->half_angle);
        set_number(L, "least_radius", cone->least_radius);
        set_number(L, "largest_radius", cone->largest_radius);
        set_vector(L, "apex", cone->apex);
        set_vector(L, "axis", cone->axis);
    }
}

void push_cavities(lua_State* L, const topology::Model& model, const std::vector<closure::Cavity>& cavities)
{
    push_array(L, cavities, [&](const auto& item) {
        lua_createtable(L, 0, 4);
        set_string(L, "kind", item.kind);
        set_tags(L, "faces", model, item.faces);
        set_string(L, "class", topology::to_string(item.value));
        set_number(L, "volume", item.volume);
    });
}

void push_free_edges(lua_State* L, const topology::Model& model, const Info& info)
{
    lua_newtable(L);
    std::size_t count = 0;
    for (std::size_t f = 0; f < info.faces.size(); ++f) {
        for (const EdgeId edge : info.faces[f].free_edges) {
            push_edge(L, model, edge);
            set_whole(L, "face", model.faces[f].tag);
            lua_rawseti(L, -2, to_lua(count++));
        }
    }
}

void push_gaps(lua_State* L, const topology::Model& model, const Info& info)
{
    push_array(L, info.gaps, [&](const auto& gap) {
        lua_createtable(L, 0, 4);
        set_count(L, "edge", static_cast<std::size_t>(model[gap.own].tag));
        set_count(L, "other", static_cast<std::size_t>(model[gap.other].tag));
        set_number(L, "width", gap.width);
        set_number(L, "tolerance", topology::sewing_tolerance(model, gap));
    });
}

/// { faces =, free_edges =, gaps =, cavities =, … } = model:info()
int info(lua_State* L)
{
    lua_settop(L, 1);
    const Box<ModelState>& state = hold_model(L, 1);
    RunContext& context = push_context(L);
    auto& found = temporary<Info>(L);
    auto& model = temporary<topology::Model>(L); // a copy: a finalizer may change the model meanwhile
    guard(L, [&] {
        model = state->model;
        found = closure::model_facts(model, context);
    });
    lua_createtable(L, 0, 9);
    set_string(L, "source", model.source);
    set_number(L, "diagonal", model.diagonal);
    set_number(L, "tolerance", model.tolerance);
    set_count(L, "parts", found.part_closed.size());
    set_count(L, "closed_parts",
              static_cast<std::size_t>(std::count(found.part_closed.begin(), found.part_closed.end(), true)));
    lua_createtable(L, static_cast<int>(found.faces.size()), 0);
    for (std::size_t f = 0; f < found.faces.size(); ++f) {
        push_face_info(L, model, found, f);
        lua_rawseti(L, -2, to_lua(f));
    }
    lua_setfield(L, -2, "faces");
    push_free_edges(L, model, found);
    lua_setfield(L, -2, "free_edges");
    push_gaps(L, model, found);
    lua_setfield(L, -2, "gaps");
    push_cavities(L, model, found.cavities);
    lua_setfield(L, -2, "cavities");
    return 1;
}

/// { { kind =, faces =, class =, volume = }, … } = model:cavities()
int cavities(lua_State* L)
{
    lua_settop(L, 1);
    const Box<ModelState>& state = hold_model(L, 1);
    RunContext& context = push_context(L);
    auto& found = temporary<std::vector<closure::Cavity>>(L);
    auto& model = temporary<topology::Model>(L);
    guard(L, [&] {
        model = state->model;
        found = closure::cavities(model, context);
    });
    push_cavities(L, model, found);
    return 1;
}

/// text = model:describe()
int describe_model(lua_State* L)
{
    lua_settop(L, 1);
    const Box<ModelState>& state = hold_model(L, 1);
    RunContext& context = push_context(L);
    push_text(L, [&] { return fill::describe(state->model, context); });
    return 1;
}

} // namespace

void bind_info(lua_State* L)
{
    add_methods<ModelState>(L, {{"info", info}, {"cavities", cavities}, {"describe", describe_model}});
}

} // namespace lacuna::lua
