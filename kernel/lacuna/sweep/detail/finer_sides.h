// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/sweep/fidelity.h>

/// What makes straight sides follow a face that bends away under them. Internal to this folder.
namespace lacuna::sweep {

/// One of the two is not 0.
struct FinerSides {
    int layers = 0;
    double size = 0; ///< of the source's quads [model length]
};

/// The face that is furthest beyond what is allowed; null: none is.
const FaceFidelity* worst_misfit(const Fidelity& fidelity);

/// By the sag of straight sides, a tenth below what would just do.
/// @pre  a face whose misfit is `straight`. @param layers  of the mesh.
FinerSides finer_sides(const FaceFidelity& face, int layers, const FidelityOptions& options);

} // namespace lacuna::sweep
