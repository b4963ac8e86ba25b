// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>

#include <string_view>

namespace lacuna {

/// Report to the context that a fraction `share` in [0, 1] of a stage is done; 0 starts the stage.
/// @pre called on the thread that called the kernel
inline void report_progress(const RunContext& context, std::string_view stage, double share = 0)
{
    if (context.progress) context.progress(stage, share);
}

} // namespace lacuna
