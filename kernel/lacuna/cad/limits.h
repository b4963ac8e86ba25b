// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace lacuna::cad {

/// Limits of one request to the CAD process. If one is exceeded, the process is killed and the request fails.
///
/// 0: the value of the environment variable (LACUNA_CAD_SECONDS, LACUNA_CAD_MEGABYTES), else 12 s and
/// 1.75 GiB, more for large files and many points.
struct Limits {
    double seconds = 0;       ///< processor time; the limit on elapsed time is four times as long
    std::uint64_t memory = 0; ///< address space of the process [bytes]
    bool may_raise = true;    ///< false: values above the default have no effect
};

} // namespace lacuna::cad
