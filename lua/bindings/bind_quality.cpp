// SPDX-License-Identifier: MIT
#include "bindings/bind_quality.h"

#include <array>
#include <cstring>

namespace lacuna::lua {

namespace {

constexpr const char* kQualityMeta = "Quality";

/// Push the cell of a WorstCell or MetricSummary: its number, its layer if it has one, its centre, and its
/// value under `name`.
void push_cell(lua_State* L, std::size_t cell, int layer, const Vec3& centre, const char* name, double value)
{
    lua_createtable(L, 0, 4);
    set_field(L, "cell", to_lua(cell));
    if (layer >= 0) set_field(L, "layer", to_lua(static_cast<Index>(layer)));
    set_field(L, "centre", centre);
    set_field(L, name, value);
}

/// The source of the Quality at index 1; its userdata is left on the stack.
QualitySource& check_source(lua_State* L)
{
    luaL_checktype(L, 1, LUA_TTABLE);
    luaL_getmetatable(L, kQualityMeta);
    lua_getfield(L, -1, "sources"); // weak table from a Quality to its source
    lua_pushvalue(L, 1);
    if (lua_rawget(L, -2) != LUA_TUSERDATA) fail(L, "this table is not a Quality");
    return temporary_at<QualitySource>(L, -1);
}

/// Measure all metrics, unless they were measured before.
void measure_metrics(lua_State* L, QualitySource& source)
{
    RunContext& context = push_context(L);
    guard(L, [&] {
        if (source.metrics) return;
        std::vector<quality::Metric> metrics;
        for (const quality::MetricInfo& info : quality::metric_infos()) metrics.push_back(info.metric);
        source.metrics = source.mesh ? quality::measure_metrics(source.mesh->swept.mesh, metrics, context)
                                     : quality::measure_metrics(source.nodes, source.hexes, metrics, context);
    });
}

void push_metric(lua_State* L, const quality::MetricSummary& summary)
{
    const quality::MetricInfo& info = quality::metric_info(summary.metric);
    lua_createtable(L, 0, 10);
    set_field(L, "name", info.name);
    set_field(L, "min", summary.min);
    set_field(L, "mean", summary.mean);
    set_field(L, "max", summary.max);
    set_field(L, "deviation", summary.deviation);
    set_field(L, "cells", summary.cells);
    set_field(L, "outside", summary.outside);
    set_field(L, "outside_share", summary.outside_share);
    if (info.acceptable) set_field(L, "acceptable", std::array{info.acceptable->low, info.acceptable->high});
    push_cell(L, summary.worst, summary.layer, summary.centre, "value", summary.value);
    lua_setfield(L, -2, "worst");
}

/// Push the metrics, in order and by name, and store them in the field `metrics` of the Quality at index 1.
void push_metrics(lua_State* L)
{
    lua_pushliteral(L, "metrics");
    if (lua_rawget(L, 1) == LUA_TTABLE) return;
    QualitySource& source = check_source(L);
    measure_metrics(L, source);
    const auto count = static_cast<int>(source.metrics->size());
    lua_createtable(L, count, count);
    for (const quality::MetricSummary& summary : *source.metrics) {
        push_metric(L, summary);
        lua_pushvalue(L, -1);
        lua_setfield(L, -3, quality::metric_name(summary.metric));
        lua_rawseti(L, -2, static_cast<lua_Integer>(lua_rawlen(L, -2)) + 1);
    }
    lua_pushliteral(L, "metrics");
    lua_pushvalue(L, -2);
    lua_rawset(L, 1);
}

/// quality.metrics: measured when first asked for.
int quality_index(lua_State* L)
{
    lua_settop(L, 2);
    luaL_checktype(L, 1, LUA_TTABLE);
    const char* key = lua_type(L, 2) == LUA_TSTRING ? lua_tostring(L, 2) : "";
    if (std::strcmp(key, "metrics") != 0) return 0;
    push_metrics(L);
    return 1;
}

int quality_pairs(lua_State* L)
{
    lua_settop(L, 1);
    luaL_checktype(L, 1, LUA_TTABLE);
    push_metrics(L);
    lua_getglobal(L, "next");
    lua_pushvalue(L, 1);
    lua_pushnil(L);
    return 3;
}

/// Counts, the scaled Jacobian with a histogram, and a line for each other metric, except for a metric's
/// second name and VTK's edge ratio.
int quality_to_string(lua_State* L)
{
    lua_settop(L, 1);
    QualitySource& source = check_source(L);
    measure_metrics(L, source);
    push_text(L, [&] {
        std::vector<quality::MetricSummary> shown;
        for (const quality::MetricSummary& summary : *source.metrics)
            if (summary.metric != quality::Metric::scaled_jacobian &&
                summary.metric != quality::Metric::max_aspect_frobenius &&
                summary.metric != quality::Metric::edge_ratio)
                shown.push_back(summary);
        std::string text = quality::to_table(source.quality);
        if (source.mesh) text += sweep::in_words(source.mesh->swept.fidelity) + "\n";
        text += "\n" + quality::to_table(shown);
        text.pop_back(); // print() ends the line
        return text;
    });
    return 1;
}

/// quality = mesh:quality()
int mesh_quality(lua_State* L)
{
    lua_settop(L, 1);
    const Box<MeshState>& mesh = hold_box<MeshState>(L, 1);
    auto& source = temporary<QualitySource>(L);
    const int at = lua_gettop(L);
    guard(L, [&] {
        source.quality = mesh->swept.quality;
        source.mesh = mesh;
    });
    push_quality(L, at);
    return 1;
}

/// quality = assembly_mesh:quality()
int assembly_quality(lua_State* L)
{
    lua_settop(L, 1);
    auto& mesh = hold<AssemblyMeshState>(L, 1);
    auto& source = temporary<QualitySource>(L);
    const int at = lua_gettop(L);
    RunContext& context = push_context(L);
    guard(L, [&] {
        WholeCells whole = whole_cells(mesh);
        if (!mesh.quality) mesh.quality = fill::measure(whole, context);
        source.quality = *mesh.quality;
        source.nodes = std::move(whole.nodes);
        source.hexes = std::move(whole.hexes);
    });
    push_quality(L, at);
    return 1;
}

} // namespace

quality::Metric read_metric(lua_State* L, int index, const Where& where)
{
    const char* names[quality::kMetricCount];
    for (std::size_t i = 0; i < quality::kMetricCount; ++i) names[i] = quality::metric_infos()[i].name;
    return static_cast<quality::Metric>(read_word(L, index, where, names, quality::kMetricCount));
}

void push_quality(lua_State* L, int source)
{
    const quality::Quality& q = temporary_at<QualitySource>(L, source).quality;
    lua_createtable(L, 0, 13);
    set_field(L, "min_scaled_jacobian", q.min_scaled_jacobian);
    set_field(L, "mean_scaled_jacobian", q.mean_scaled_jacobian);
    set_field(L, "inverted", q.inverted);
    set_field(L, "uncertified", q.uncertified);
    set_field(L, "certified", q.uncertified == 0 && q.inverted == 0);
    set_field(L, "hexes", q.hexes);
    set_field(L, "wedges", q.wedges);
    set_field(L, "pyramids", q.pyramids);
    set_field(L, "tets", q.tets);
    lua_createtable(L, 0, 4);
    const std::pair<const char*, std::size_t> kinds[] = {
        {"hexes", q.hexes}, {"wedges", q.wedges}, {"pyramids", q.pyramids}, {"tets", q.tets}};
    for (std::size_t k = 0; k < std::size(kinds); ++k)
        if (kinds[k].second > 0) set_field(L, kinds[k].first, q.least_by_kind[k]);
    lua_setfield(L, -2, "least");
    set_field(L, "volume", q.volume);
    set_array(L, "worst", q.worst, [&](const quality::WorstCell& worst) {
        push_cell(L, worst.cell, worst.layer, worst.centre, "scaled_jacobian", worst.scaled_jacobian);
    });
    set_field(L, "histogram", q.histogram);

    luaL_setmetatable(L, kQualityMeta);
    luaL_getmetafield(L, -1, "sources");
    lua_pushvalue(L, -2);
    lua_pushvalue(L, source);
    lua_rawset(L, -3);
    lua_pop(L, 1);
}

void bind_quality(lua_State* L)
{
    luaL_newmetatable(L, kQualityMeta);
    set_functions(
        L, {{"__tostring", quality_to_string}, {"__index", quality_index}, {"__pairs", quality_pairs}});
    lua_newtable(L);
    lua_createtable(L, 0, 1);
    set_field(L, "__mode", "k");
    lua_setmetatable(L, -2);
    lua_setfield(L, -2, "sources");
    set_field(L, "__metatable", "Quality");
    lua_pop(L, 1);
    add_methods<MeshState>(L, {{"quality", mesh_quality}});
    add_methods<AssemblyMeshState>(L, {{"quality", assembly_quality}});
}

} // namespace lacuna::lua
