// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>

#include <algorithm>
#include <memory>
#include <string_view>

namespace lacuna {

/// Report to the context which stage runs, and the fraction `share` in [0, 1] of the call that is done.
/// @pre called on the thread that called the kernel
inline void report_progress(const RunContext& context, std::string_view stage, double share = 0)
{
    if (context.progress) context.progress(stage, share);
}

/// The context of a part of a call. If the part reports the share s, `from` + s (`to` - `from`) is reported
/// for the call.
/// @param call  must outlive the context
inline RunContext part_of(const RunContext& call, double from, double to)
{
    RunContext part = call;
    if (call.progress)
        part.progress = [&call, from, to](std::string_view stage, double share) {
            call.progress(stage, from + share * (to - from));
        };
    return part;
}

/// The context of a call that may try a part again: the reported share never falls.
/// @param call  must outlive the context
inline RunContext never_falling(const RunContext& call)
{
    RunContext rising = call;
    if (call.progress)
        rising.progress = [&call, most = std::make_shared<double>(0)](std::string_view stage, double share) {
            call.progress(stage, *most = std::max(*most, share));
        };
    return rising;
}

} // namespace lacuna
