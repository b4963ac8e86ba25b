// SPDX-License-Identifier: MIT
#pragma once

// What volume:sweep_to and assembly:sweep_to share.

#include "bindings/classes.h"
#include "bindings/write_mesh.h"

#include <cstddef>

struct lua_State;

namespace lacuna::lua {

/// Take `write` out of a table of options: a copy without it stands at `index` then, and it on top.
void push_write_options(lua_State* L, int index);

/// What sweep_to tells of a mesh.
struct Told {
    std::size_t nodes = 0, hexes = 0, wedges = 0;
    int layers = 0;
    double least = 1; ///< scaled Jacobian
    bool streamed = false;
    int processes = 1;
};

/// As fields of the report on top of the stack.
void set_told(lua_State* L, const Told& told);

/// Write the mesh of an assembly, which is on top of the stack, and leave its report there.
void write_swept_parts(lua_State* L, const io::OutputPath& path, WriteArguments& file, const Crew* crew,
                       const RunContext& context);

} // namespace lacuna::lua
