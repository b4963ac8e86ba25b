// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quality/quality.h>
#include <lacuna/sweep/detail/mean_outline.h>
#include <lacuna/sweep/sweep.h>

#include <functional>
#include <set>
#include <vector>

namespace lacuna::sweep {

/// A mesh and the result of its proof.
struct ProvedSweep {
    Swept swept;
    quality::Proof proof;
    std::vector<FaceId> faces; ///< of each patch of the skin
    std::set<FaceId> kept;     ///< source faces whose own quads are the mesh
};

/// Sweeps a sealed volume from its source to its target, with the source's quads laid out in an outline.
using OneWay = std::function<ProvedSweep(const topology::OpenVolume&, const SweepOptions&, Outline)>;

/// The sealed volume with source and target exchanged; groups keep the original names.
topology::OpenVolume turned_round(topology::OpenVolume volume);

/// Sweep from the more promising end, and from the other one if that is refused or its minimum scaled
/// Jacobian is poor. Returns the better mesh, whose report states the direction. If both are poor, the quads
/// are laid out between the outlines of both ends.
///
/// An end of several faces is preferred as source over an end of one face: its inner edges then become mesh
/// edges directly. A source that keeps its own quads is always the start; a source with rows along its rim is
/// tried first.
/// @throw  as `sweep_one_way` for the first direction, extended by the finding of the other direction.
ProvedSweep sweep_both_ways(const topology::OpenVolume& volume, const SweepOptions& options,
                            const OneWay& sweep_one_way, const RunContext& context);

} // namespace lacuna::sweep
