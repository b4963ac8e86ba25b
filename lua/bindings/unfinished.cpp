// SPDX-License-Identifier: MIT
// Stands in for kernel functions that are declared and not there yet; goes when they come.
#ifdef LACUNA_WITH_CAD
#include <lacuna/cad/load.h>
#include <lacuna/core/error.h>

[[gnu::weak]] lacuna::surface::PlanarQuads lacuna::cad::recombine(const surface::PlanarRegion&,
                                                                  const RunContext&)
{
    throw Error("lua.unfinished", "Gmsh's quads are not available yet");
}
#endif
