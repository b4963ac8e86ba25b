// SPDX-License-Identifier: MIT
#pragma once

#include "bindings/classes.h"

namespace lacuna::lua {

/// Push a Quality: a table of what was measured that prints as a table.
void push_quality(lua_State* L, const quality::Quality& quality);

} // namespace lacuna::lua
