// SPDX-License-Identifier: MIT
#pragma once

#include "bindings/classes.h"

#include <cstddef>
#include <exception>
#include <optional>
#include <string>
#include <vector>

namespace lacuna::lua {

/// A volume whose roles were found, swept the other ways that enclose the same where one fails.
struct OtherWays {
    std::size_t next = 0;
    std::vector<std::string> failed;   ///< a line for each way
    std::exception_ptr first;          ///< why the likeliest failed
    std::optional<VolumeState> before; ///< the volume with the likeliest roles
};

/// The ends of a volume as a person knows them.
std::string ends_in_words(const topology::OpenVolume& volume);

/// Turn to the next way to sweep a volume. Called where one has failed, with its exception at hand.
/// @throw  what the first way failed by, where there is no other; the volume is as it was then.
void take_next_way(VolumeState& state, OtherWays& ways, const Error& why, const RunContext& context);

/// Sweep a volume one way; where that fails turn to the next.
/// @return  whether it is swept.
template <class Sweep>
bool sweep_or_turn(VolumeState& state, OtherWays& ways, const RunContext& context, const Sweep& sweep)
{
    try {
        std::vector<std::string>& report = sweep();
        if (!ways.failed.empty())
            ways.failed.push_back("roles: swept " + ends_in_words(state.volume) +
                                  " instead, which encloses the same volume");
        report.insert(report.begin(), ways.failed.begin(), ways.failed.end());
        return true;
    } catch (const NotSweepable& error) {
        take_next_way(state, ways, error, context);
    } catch (const NotClosed& error) {
        take_next_way(state, ways, error, context);
    }
    return false;
}

} // namespace lacuna::lua
