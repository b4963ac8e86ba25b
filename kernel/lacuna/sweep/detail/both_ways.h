// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quality/quality.h>
#include <lacuna/sweep/detail/mean_outline.h>
#include <lacuna/sweep/sweep.h>

#include <functional>
#include <set>
#include <vector>

namespace lacuna::sweep {

/// A mesh with what its proof says.
struct ProvedSweep {
    Swept swept;
    quality::Proof proof;
    std::vector<FaceId> faces; ///< of each patch of the skin
    std::set<FaceId> kept;     ///< source faces whose own quads are the mesh
};

/// Sweeps a sealed volume from its source to its target, the source's quads laid out in an outline.
using OneWay = std::function<ProvedSweep(const topology::OpenVolume&, const SweepOptions&, Outline)>;

/// The sealed volume with source and target exchanged; groups keep the names the person gave.
topology::OpenVolume turned_round(topology::OpenVolume volume);

/// Sweep from the end that promises more, and from the other where that is refused or its least scaled
/// Jacobian is poor; the better mesh is given, and its report says which way it was swept. Where both are,
/// the quads are laid out between the outlines of both ends.
///
/// An end of several faces goes first, onto an end of one: edges inside the end swept from become mesh edges
/// by themselves. A source whose own quads are to be kept is always swept from; so is, at first, one with
/// rows along its rim.
/// @throw  what `sweep_one_way` throws for the way tried first, with what the other way found added.
ProvedSweep sweep_both_ways(const topology::OpenVolume& volume, const SweepOptions& options,
                            const OneWay& sweep_one_way, const RunContext& context);

} // namespace lacuna::sweep
