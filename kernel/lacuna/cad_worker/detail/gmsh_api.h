// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Wrappers for the differences between versions of Gmsh's API. Only sources of
/// this folder include this file.

#include <gmsh.h>

#include <string>
#include <vector>

#define LACUNA_GMSH_AT_LEAST(major, minor)                                                                   \
    (GMSH_API_VERSION_MAJOR > (major) ||                                                                     \
     (GMSH_API_VERSION_MAJOR == (major) && GMSH_API_VERSION_MINOR >= (minor)))

namespace lacuna::cad_worker {

/// Whether Gmsh has been initialised.
inline bool gmsh_is_initialized()
{
#if LACUNA_GMSH_AT_LEAST(4, 10)
    return gmsh::isInitialized() != 0;
#else
    try { // An initialised Gmsh has at least one model; otherwise the list is empty or it throws.
        std::vector<std::string> names;
        gmsh::model::list(names);
        return !names.empty();
    } catch (...) {
        return false;
    }
#endif
}

/// The type as Gmsh names it: "Plane", "Cylinder", "Unknown", …
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
