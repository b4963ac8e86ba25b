// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lacuna/cad/load.h>

namespace lacuna::cad {

/// Read CAD files into one model, their tags running on from file to file as in Gmsh.
/// @pre every path has one of the endings that load() gives to this.
topology::Model import_cad(const std::vector<std::string>& paths, const LoadOptions& options,
                           const RunContext& context);

} // namespace lacuna::cad
