// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/sweep/fidelity.h>

/// Refinement that makes straight sides follow a curved face. Internal to this folder.
namespace lacuna::sweep {

/// One of the two is not 0.
struct FinerSides {
    int layers = 0;
    double size = 0; ///< of the source's quads [model length]
};

/// The face that exceeds the allowed distance most; null: none does.
const FaceFidelity* worst_misfit(const Fidelity& fidelity);

/// By the sag of straight sides, with a margin of a tenth.
/// @pre  a face whose misfit is `straight`. @param layers  of the mesh.
FinerSides finer_sides(const FaceFidelity& face, int layers, const FidelityOptions& options);

} // namespace lacuna::sweep
