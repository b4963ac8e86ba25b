// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/close.h>

namespace lacuna::closure {

/// Seal a volume for comparison with others that the same faces may be. Unlike close() it moves no given end
/// to where the other is missing, weighs no other shape, takes what its options would have to ask for, and
/// logs nothing: callers enumerate these choices.
/// @throw  as close().
Closure close_trial(topology::OpenVolume& volume, const matching::Match& match, const RunContext& context);

} // namespace lacuna::closure
