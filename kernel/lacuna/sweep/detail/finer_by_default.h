// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/sweep/sweep.h>

#include <functional>

/// Refinement of default sizes and layers if the mesh does not follow a face. Internal to this folder.
namespace lacuna::sweep {

/// The same volume swept by other options, proved and compared.
using SweepBy = std::function<Swept(const SweepOptions&)>;

/// Return the mesh if it follows every face, otherwise a finer one that does, if size and layers are
/// defaults.
/// @param asked  the user's options. @param taken  the options of `swept`.
/// @throw NotSweepable "sweep.deviation"  the finding on the first mesh, and on the finest one tried
Swept require_or_refine(const SweepOptions& asked, const SweepOptions& taken, Swept swept,
                        const SweepBy& again, const RunContext& context);

} // namespace lacuna::sweep
