// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/cad/load.h>

namespace lacuna::cad {

/// Read CAD files into one model through the CAD process. Tags continue from file to file, as in Gmsh.
/// The warnings name faces left out, other than slivers, and script commands that are skipped.
/// @pre every path has one of the endings that load() gives to this.
io::LoadedFiles import_cad(const std::vector<std::string>& paths, const LoadOptions& options,
                           const RunContext& context, const Limits& limits);

} // namespace lacuna::cad
