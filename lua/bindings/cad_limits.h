// SPDX-License-Identifier: MIT
#pragma once

#include "bindings/options.h"

#include <lacuna/cad/limits.h>

#include <algorithm>

namespace lacuna::lua {

// Readers of the options `cad_seconds` and `cad_megabytes` into the `limits` of a call's options.

template <class Options>
void read_cad_seconds(lua_State* L, int index, const Where& where, Options& options)
{
    options.limits.seconds = read_positive(L, index, where);
}

template <class Options>
void read_cad_megabytes(lua_State* L, int index, const Where& where, Options& options)
{
    constexpr double kMost = 1e12; // [MB]: more than any machine has, and still a whole number of bytes
    options.limits.memory = static_cast<std::uint64_t>(std::min(read_positive(L, index, where), kMost) * 1e6);
}

} // namespace lacuna::lua
