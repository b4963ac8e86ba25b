// SPDX-License-Identifier: MIT
#include "bindings/classes.h"
#include "bindings/io_paths.h"
#include "bindings/lacuna_lua.h"
#include "bindings/options.h"
#include "bindings/other_ways.h"
#include "bindings/sweep_members.h"
#include "bindings/sweep_to.h"
#include "bindings/write_mesh.h"

#include <lacuna/closure/branches.h>
#include <lacuna/closure/piece_ends.h>
#include <lacuna/io/deck_middles.h>

#include <algorithm>
#include <array>
#include <limits>
#include <span>

namespace lacuna::lua {

namespace {

/// Nodes of the decks a volume's faces came from, where `ask(deck, tolerance, scale)` finds them; the first
/// deck that has one gives it.
template <class Ask>
std::vector<Vec3> from_decks(const VolumeState& state, std::size_t count, const Ask& ask)
{
    constexpr double kTogether =
        1e-9; // of the diagonal: kept nodes are the decks' to the bit, but for the scale
    std::vector<Vec3> found(count, Vec3::Constant(std::numeric_limits<double>::quiet_NaN()));
    for (const auto& deck : state.decks) {
        const std::vector<Vec3> own = ask(*deck, kTogether * state.volume.model.diagonal, state.scale);
        for (std::size_t i = 0; i < found.size(); ++i)
            if (!found[i].allFinite()) found[i] = own[i];
    }
    return found;
}

/// Middle nodes of sides and of quads that the decks give.
void take_given_middles(const VolumeState& state, sweep::SecondOrderOptions& options)
{
    options.given = [&state](std::span<const Vec3> from, std::span<const Vec3> to) {
        return from_decks(state, from.size(), [&](const io::Deck& deck, double tolerance, double scale) {
            return io::middles_between(deck, from, to, tolerance, scale);
        });
    };
    options.given_centres = [&state](std::span<const std::array<Vec3, 4>> quads) {
        return from_decks(state, quads.size(), [&](const io::Deck& deck, double tolerance, double scale) {
            return io::centres_of(deck, quads, tolerance, scale);
        });
    };
}

/// Sweep the pieces of a volume with branches or steps as an assembly.
bool sweep_steps(lua_State* L, const Box<VolumeState>& volume, SweepArguments& arguments, OtherWays& ways,
                 RunContext& context)
{
    auto& box = new_box<AssemblyMeshState>(L);
    bool done = false;
    guard(L, [&] {
        arguments.name = volume->name.empty() ? "the volume" : volume->name;
        arguments.own.insert(kOfFaces.begin(), kOfFaces.end());
        const Busy busy(*volume, "sweep");
        StageClock clock(context);
        done = sweep_or_turn(*volume, ways, context, [&]() -> std::vector<std::string>& {
            std::vector<ToMesh> pieces;
            const std::string name = volume->name;
            add_members(pieces, volume, name.empty() ? "piece" : name, name.empty() ? "volume" : name,
                        arguments, context);
            box = sweep_members(pieces, {}, true, context);
            return box->swept.report;
        });
        if (done) box->seconds = clock.seconds();
    });
    return done;
}

/// Say in the report what closing took though something else may have been meant, and there and in the log
/// what a match was unsure of that void edges were drawn by.
void tell_match(const VolumeState& state, std::vector<std::string>& report, const RunContext& context)
{
    tell_left_out(state, report);
    if (!state.closure) return;
    if (state.match && !state.closure->void_edges.empty()) {
        for (const std::string& note : state.match->notes) {
            report.push_back("match: " + note);
            if (context.log) context.log(report.back());
        }
    }
    for (const std::string& note : state.closure->notes) report.push_back("closed: " + note);
}

/// Sweep a volume as it is.
bool sweep_whole(lua_State* L, VolumeState& state, SweepArguments& arguments, OtherWays& ways,
                 RunContext& context)
{
    lua_gc(L, LUA_GCCOLLECT); // to Lua a mesh is a few bytes: it would let old ones pile up
    auto& box = new_box<MeshState>(L);
    bool done = false;
    guard(L, [&] {
        const Busy busy(state, "sweep");
        StageClock clock(context);
        done = sweep_or_turn(state, ways, context, [&]() -> std::vector<std::string>& {
            close_volume(state, {}, context);
            closure::check_ends(state.volume, state.name.empty() ? "the volume" : state.name);
            box = std::make_shared<MeshState>();
            if (!state.decks.empty()) take_given_middles(state, arguments.options.second_order);
            box->swept = sweep::sweep(state.volume, arguments.options, context);
            tell_match(state, box->swept.report, context);
            if (!state.name.empty()) box->swept.mesh.volume_groups = {state.name};
            box->material = state.material;
            return box->swept.report;
        });
        if (done) box->seconds = clock.seconds();
    });
    return done;
}

/// mesh = volume:sweep(options)
int sweep_volume(lua_State* L)
{
    lua_settop(L, 2);
    const Box<VolumeState>& volume = hold_box<VolumeState>(L, 1);
    VolumeState& state = *volume;
    SweepArguments& arguments = push_sweep_arguments(L, 2, "sweep", state);
    RunContext& context = push_context(L);
    if (arguments.threads != 0) context.threads = arguments.threads;
    auto& ways = temporary<OtherWays>(L);
    for (;;) {
        const int top = lua_gettop(L);
        bool steps = false;
        guard(L, [&] { steps = closure::has_pieces(state.volume, context); });
        if (steps ? sweep_steps(L, volume, arguments, ways, context)
                  : sweep_whole(L, state, arguments, ways, context))
            return 1;
        lua_settop(L, top);
    }
}

/// Sweep a volume as it is and write it, a layer at a time where that goes.
/// @return  whether it is swept
bool sweep_whole_to(lua_State* L, VolumeState& state, SweepArguments& arguments, OtherWays& ways,
                    const io::OutputPath& path, WriteArguments& file, const Crew* crew, RunContext& context)
{
    auto& swept = temporary<sweep::Swept>(L);
    auto& seconds = temporary<StageSeconds>(L);
    bool done = false;
    const Host& lent = host(L);
    guard(L, [&] {
        refuse_interfaces(file);
        const Busy busy(state, "sweep_to");
        StageClock clock(context);
        done = sweep_or_turn(state, ways, context, [&]() -> std::vector<std::string>& {
            close_volume(state, {}, context);
            closure::check_ends(state.volume, state.name.empty() ? "the volume" : state.name);
            if (!state.decks.empty()) take_given_middles(state, arguments.options.second_order);
            arguments.options.layered = true;
            arguments.options.crew = crew;
            swept = sweep::sweep(state.volume, arguments.options, context);
            tell_match(state, swept.report, context);
            return swept.report;
        });
        if (!done) return;
        if (!state.name.empty()) swept.mesh.volume_groups = {state.name};
        if (!swept.layers)
            swept.report.push_back(
                "sweep_to: the whole mesh was held in memory, since its nodes are more than "
                "placed layers: moved to improve cells or to make them valid, laid along normals, or of "
                "boundary layers");
        write_layered(swept, state.material, path, file, crew, context);
        write_options_beside(lent, path, file);
        seconds = clock.seconds();
    });
    if (!done) return false;
    lua_createtable(L, static_cast<int>(swept.report.size()), 8);
    for (std::size_t i = 0; i < swept.report.size(); ++i) {
        lua_pushlstring(L, swept.report[i].data(), swept.report[i].size());
        lua_rawseti(L, -2, to_lua(i));
    }
    const mesh::HexMesh& mesh = swept.mesh;
    set_told(L, {.nodes = mesh::corner_count(mesh) + mesh::middle_count(mesh),
                 .hexes = mesh.hex_count(),
                 .wedges = mesh.wedge_count(),
                 .layers = mesh.layers,
                 .least = swept.min_scaled_jacobian,
                 .streamed = swept.layers.has_value(),
                 .processes = swept.layers && crew != nullptr ? crew->size : 1});
    set_report_meta(L, seconds);
    return true;
}

/// report = volume:sweep_to(path, options)
int sweep_to(lua_State* L)
{
    lua_settop(L, 3);
    const Box<VolumeState>& volume = hold_box<VolumeState>(L, 1);
    VolumeState& state = *volume;
    const io::OutputPath& path = push_output_path(L, 2, "sweep_to");
    push_write_options(L, 3);
    WriteArguments& file = push_layered_write(L, lua_gettop(L), path);
    SweepArguments& arguments = push_sweep_arguments(L, 3, "sweep_to", state);
    RunContext& context = push_context(L);
    if (arguments.threads != 0) context.threads = arguments.threads;
    const Crew* const crew = host(L).crew;
    lua_gc(L, LUA_GCCOLLECT);
    auto& ways = temporary<OtherWays>(L);
    for (;;) {
        const int top = lua_gettop(L);
        bool steps = false;
        guard(L, [&] { steps = closure::has_pieces(state.volume, context); });
        arguments.options.layered = may_be_layered_of_parts(file, path);
        arguments.options.crew = arguments.options.layered ? crew : nullptr;
        if (steps && sweep_steps(L, volume, arguments, ways, context)) {
            write_swept_parts(L, path, file, crew, context);
            return 1;
        }
        if (!steps && sweep_whole_to(L, state, arguments, ways, path, file, crew, context)) return 1;
        lua_settop(L, top);
    }
}

const luaL_Reg kVolumeMethods[] = {{"sweep", sweep_volume}, {"sweep_to", sweep_to}, {nullptr, nullptr}};

} // namespace

void bind_sweep(lua_State* L) { add_methods(L, kClassName<VolumeState>, kVolumeMethods); }

} // namespace lacuna::lua
