// SPDX-License-Identifier: MIT
#pragma once

// The options of volume:sweep, volume:sweep_to and assembly:sweep, read from a table.

#include "bindings/classes.h"

struct lua_State;

namespace lacuna::lua {

/// Options of a sweep as a recipe gave them.
struct SweepArguments : sweep::SweepOptions {
    int threads = 0;
    int functions = 0;                   ///< stack index of a table that keeps the functions of sizes
    const VolumeState* volume = nullptr; ///< the volume whose faces selectors choose
};

/// Read the options at `index`, nil or a table, of the method `call`, as a temporary. Leaves the functions
/// that sizes call on the stack.
/// @param volume  the volume whose faces selectors choose; must outlive the result.
SweepArguments& push_sweep_arguments(lua_State* L, int index, const char* call, const VolumeState& volume);

/// Options of model:quads.
struct QuadsArguments : SweepArguments {
    const Box<ModelState>* model = nullptr; ///< on the stack during the call
    std::optional<std::vector<FaceId>> faces;
};

/// Read the options of model:quads at `index`, nil or a table, as a temporary.
QuadsArguments& push_quads_arguments(lua_State* L, int index, const Box<ModelState>& model);

} // namespace lacuna::lua
