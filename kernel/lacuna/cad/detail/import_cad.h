// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/cad/load.h>

namespace lacuna::cad {

struct ImportedCad {
    topology::Model model;
    std::vector<std::string> left_out; ///< of its notes those of faces left out that are no slivers
};

/// Have the CAD process read CAD files into one model, their tags running on from file to file as in Gmsh.
/// @pre every path has one of the endings that load() gives to this.
ImportedCad import_cad(const std::vector<std::string>& paths, const LoadOptions& options,
                       const RunContext& context, const Limits& limits);

} // namespace lacuna::cad
