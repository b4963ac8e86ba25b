// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/close.h>

namespace lacuna::closure {

/// Seal a volume in order to compare it with other candidates of the same faces. Unlike close(), it does not
/// build a missing end from a copy of the given one, does not compare alternative shapes, accepts an
/// ambiguous closing and logs nothing. Callers try the alternatives themselves.
/// @throw  the errors of close().
Closed close_trial(const topology::OpenVolume& volume, const matching::Match& match,
                   const RunContext& context);

} // namespace lacuna::closure
