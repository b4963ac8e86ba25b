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
    set_field(L, "tag", face.tag);
    set_field(L, "name", face.name);
    set_field(L, "kind", face.kind);
    set_field(L, "area", topology::face_area(model, id));
    set_field(L, "normal", topology::mean_normal(model, id));
    set_field(L, "centroid", topology::face_centroid(model, id));
    set_field(L, "box", std::array<Vec3, 2>{info.faces[f].box.min(), info.faces[f].box.max()});
    set_field(L, "loops", face.loops.size());
    set_field(L, "edges", topology::edge_count(face));
    set_field(L, "has_mesh", !face.given_quads.empty());
    set_tags(L, "neighbours", model, info.faces[f].neighbours);
    set_field(L, "free_edges", info.faces[f].free_edges.size());
    set_field(L, "part", info.faces[f].part + 1);
    set_field(L, "use", closure::use_of(info, id));
    if (info.cavity_of[f] < info.cavities.size()) set_field(L, "cavity", info.cavity_of[f] + 1);
    if (const auto& round = info.round[f]) {
        set_field(L, "fits", round->is_sphere() ? "sphere" : "cylinder");
        set_field(L, "radius", round->radius);
        set_field(L, "centre", round->centre);
        if (round->axis) set_field(L, "axis", *round->axis);
    }
    if (const auto& cone = info.cone[f]) {
        set_field(L, "fits", "cone");
        set_field(L, "half_angle", cone->half_angle);
        set_field(L, "least_radius", cone->least_radius);
        set_field(L, "largest_radius", cone->largest_radius);
        set_field(L, "apex", cone->apex);
        set_field(L, "axis", cone->axis);
    }
}

void push_cavities(lua_State* L, const topology::Model& model, const std::vector<closure::Cavity>& cavities)
{
    push_array(L, cavities, [&](const auto& item) {
        lua_createtable(L, 0, 4);
        set_field(L, "kind", item.kind);
        set_tags(L, "faces", model, item.faces);
        set_field(L, "class", topology::to_string(item.value));
        set_field(L, "volume", item.volume);
    });
}

void push_free_edges(lua_State* L, const topology::Model& model, const Info& info)
{
    lua_newtable(L);
    std::size_t count = 0;
    for (std::size_t f = 0; f < info.faces.size(); ++f) {
        for (const EdgeId edge : info.faces[f].free_edges) {
            push_edge(L, model, edge);
            set_field(L, "face", model.faces[f].tag);
            lua_rawseti(L, -2, to_lua(count++));
        }
    }
}

void push_gaps(lua_State* L, const topology::Model& model, const Info& info)
{
    push_array(L, info.gaps, [&](const auto& gap) {
        lua_createtable(L, 0, 4);
        set_field(L, "edge", model[gap.own].tag);
        set_field(L, "other", model[gap.other].tag);
        set_field(L, "width", gap.width);
        set_field(L, "tolerance", topology::sewing_tolerance(model, gap));
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
    set_field(L, "source", model.source);
    set_field(L, "diagonal", model.diagonal);
    set_field(L, "tolerance", model.tolerance);
    set_field(L, "parts", found.part_closed.size());
    set_field(L, "closed_parts", std::count(found.part_closed.begin(), found.part_closed.end(), true));
    set_array(L, "faces", std::views::iota(std::size_t{0}, found.faces.size()),
              [&](std::size_t f) { push_face_info(L, model, found, f); });
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
