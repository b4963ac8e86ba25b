// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Wrappers for Gmsh's API, which differs between versions. Only sources of this folder include this file.

#include <gmsh.h>

#include <string>
#include <vector>

#define LACUNA_GMSH_AT_LEAST(major, minor)                                                                   \
    (GMSH_API_VERSION_MAJOR > (major) ||                                                                     \
     (GMSH_API_VERSION_MAJOR == (major) && GMSH_API_VERSION_MINOR >= (minor)))

namespace lacuna::cad_worker {

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

/// Tags of the entities of a dimension in the current model, ascending.
inline std::vector<int> tags_of(int dim)
{
    gmsh::vectorpair entities;
    gmsh::model::getEntities(entities, dim);
    std::vector<int> tags;
    for (const auto& entity : entities) tags.push_back(entity.second);
    return tags;
}

/// The boundaries of entities, one after the other. A seam occurs twice.
inline gmsh::vectorpair boundary_of(const gmsh::vectorpair& entities)
{
    gmsh::vectorpair boundary;
    gmsh::model::getBoundary(entities, boundary, false, false, false);
    return boundary;
}

/// Length, area or volume of a shape of Open CASCADE.
inline double mass_of(int dim, int tag)
{
    double mass = 0;
    gmsh::model::occ::getMass(dim, tag, mass);
    return mass;
}

/// Add the shapes of a file to the current model. @param format  "step", "iges" or "brep".
/// @param highest_only  leave out shapes that are not part of a shape of the highest dimension
inline void import_shapes(const std::string& path, const char* format, bool highest_only = false)
{
    gmsh::vectorpair all;
    gmsh::model::occ::importShapes(path, all, highest_only, format);
    gmsh::model::occ::synchronize();
}

} // namespace lacuna::cad_worker
