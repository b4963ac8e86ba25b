// SPDX-License-Identifier: MIT
#include <lacuna/surface/clean_quads.h>

namespace lacuna::surface {

CleanReport clean_quads(PlanarQuads&, std::size_t, const CleanOptions&, const RunContext&) { return {}; }

} // namespace lacuna::surface
