// SPDX-License-Identifier: MIT
#pragma once

// Options of written meshes that several methods read.

#include "bindings/options.h"

#include <lacuna/io/whole_file.h>
#include <lacuna/team/shared/write.h>

namespace lacuna::lua {

/// The option `version` of MSH: 4.1 or 2.2.
template <auto Member, class Options>
void msh_version(lua_State* L, int index, const Where& where, Options& options)
{
    const double version = read_number(L, index, where);
    if (version != 4.1 && version != 2.2) fail_value(L, where, "4.1 or 2.2", index);
    options.*Member = version;
}

/// The option `groups` of MSH.
inline constexpr Word<bool> kMshGroups[] = {{"one", false}, {"all", true}};

/// Read the options of mesh:write at `index`, nil or a table, for a file that is written a layer at a time;
/// as a temporary. Refuses file extensions and options that such files do not have.
team::WriteRequest& push_layered_write(lua_State* L, int index, const io::OutputPath& path);

} // namespace lacuna::lua
