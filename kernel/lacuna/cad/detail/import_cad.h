// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/cad/load.h>

namespace lacuna::cad {

/// Have the CAD process read CAD files into one model, their tags running on from file to file as in Gmsh.
/// @pre every path has one of the endings of `is_cad_ending()`.
topology::Model import_cad(const std::vector<std::string>& paths, const LoadOptions& options,
                           const RunContext& context);

/// Turn faces so that neighbours agree, as far as each edge has two of them in its group (a solid, or all
/// faces of none), and outward where that closes a volume. Where no orientation agrees, faces stay as they
/// are.
void orient_groups(topology::Model& model, const std::vector<std::vector<std::size_t>>& groups);

} // namespace lacuna::cad
