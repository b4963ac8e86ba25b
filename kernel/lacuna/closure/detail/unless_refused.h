// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/error.h>

#include <optional>

namespace lacuna::closure {

/// The result of an action; empty if the action throws InvalidInput or NotClosed, because the faces do not
/// permit it.
template <class Do>
auto unless_refused(const Do& action) -> std::optional<decltype(action())>
{
    try {
        return action();
    } catch (const InvalidInput&) {
        return std::nullopt;
    } catch (const NotClosed&) {
        return std::nullopt;
    }
}

} // namespace lacuna::closure
