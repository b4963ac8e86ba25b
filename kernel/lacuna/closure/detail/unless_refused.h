// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/error.h>

#include <optional>

namespace lacuna::closure {

/// The result of an action; empty if it throws an error of the kernel, for instance because the faces do not
/// permit it. `Cancelled` passes through.
template <class Do>
auto unless_refused(const Do& action) -> std::optional<decltype(action())>
{
    try {
        return action();
    } catch (const Cancelled&) {
        throw;
    } catch (const Error&) {
        return std::nullopt;
    }
}

} // namespace lacuna::closure
