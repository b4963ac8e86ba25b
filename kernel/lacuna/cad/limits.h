// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace lacuna::cad {

/// What one request to the CAD process may take; beyond it the process is ended and the request is an
/// error.
///
/// 0 means: what the environment says (LACUNA_CAD_SECONDS, LACUNA_CAD_MEGABYTES), else 12 s and 1.75 GiB,
/// and more the larger the files and the more points there are.
struct Limits {
    double seconds = 0;       ///< of processor time; four times as many by the clock
    std::uint64_t memory = 0; ///< address space of the process [bytes]
    bool may_raise = true;    ///< false: no more than without them, whatever they say
};

} // namespace lacuna::cad
