// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>

#include <string_view>

namespace lacuna {

/// Tell the context's progress, if it has one, that a stage is done to a share in [0, 1]; 0 begins it.
/// @pre called on the thread that the work was asked on.
inline void report_progress(const RunContext& context, std::string_view stage, double share = 0)
{
    if (context.progress) context.progress(stage, share);
}

} // namespace lacuna
