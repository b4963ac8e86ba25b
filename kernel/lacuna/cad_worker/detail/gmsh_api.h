// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What differs between the versions of Gmsh's API, so that the rest reads alike. Only sources of this folder
/// include it.

#include <gmsh.h>

#include <string>
#include <vector>

#define LACUNA_GMSH_AT_LEAST(major, minor)                                                                   \
    (GMSH_API_VERSION_MAJOR > (major) ||                                                                     \
     (GMSH_API_VERSION_MAJOR == (major) && GMSH_API_VERSION_MINOR >= (minor)))

namespace lacuna::cad_worker {

/// Has anyone initialised Gmsh?
inline bool gmsh_is_initialized()
{
#if LACUNA_GMSH_AT_LEAST(4, 10)
    return gmsh::isInitialized() != 0;
#else
    try { // An initialised Gmsh has one model at least; before and after it lists none or throws.
        std::vector<std::string> names;
        gmsh::model::list(names);
        return !names.empty();
    } catch (...) {
        return false;
    }
#endif
}

/// "Plane", "Cylinder", "Unknown", …
inline std::string gmsh_type(int dim, int tag)
{
    std::string type;
#if LACUNA_GMSH_AT_LEAST(4, 14)
    gmsh::model::getEntityType(dim, tag, type);
#else
    gmsh::model::getType(dim, tag, type);
#endif
    return type;
}

} // namespace lacuna::cad_worker
