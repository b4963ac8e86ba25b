// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/sweep/sweep.h>

#include <functional>

/// Sizes and layers that nobody asked for, finer where the mesh does not follow a face. Internal to this
/// folder.
namespace lacuna::sweep {

/// The same volume swept by other options, proved and compared.
using SweepBy = std::function<Swept(const SweepOptions&)>;

/// A mesh that follows every face, or a finer one that does where nobody asked for its size and layers.
/// @param asked  what the person said. @param taken  what `swept` was made with.
/// @throw NotSweepable "sweep.deviation"  what is wrong with the mesh as asked for, and with the finest tried
Swept require_or_refine(const SweepOptions& asked, const SweepOptions& taken, Swept swept,
                        const SweepBy& again, const RunContext& context);

} // namespace lacuna::sweep
