// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/cad/load.h>

namespace lacuna::cad {

/// Have the CAD process read CAD files into one model, their tags running on from file to file as in Gmsh.
/// The warnings are faces left out that are no slivers, and commands of scripts that are skipped.
/// @pre every path has one of the endings that load() gives to this.
io::LoadedFiles import_cad(const std::vector<std::string>& paths, const LoadOptions& options,
                           const RunContext& context, const Limits& limits);

} // namespace lacuna::cad
