// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace lacuna::cad {

/// Limits of one request to the CAD process. If one is exceeded, the process is killed and the request fails.
///
/// A limit of 0 stands for the value of an environment variable (LACUNA_CAD_SECONDS, LACUNA_CAD_MEGABYTES).
/// If the variable is not set, the limits are 12 s and 1.75 GiB, and more for large files and many points.
struct Limits {
    double seconds = 0;       ///< processor time; the limit on elapsed time is four times as long
    std::uint64_t memory = 0; ///< address space of the process [bytes]
    bool may_raise = true;    ///< false: values above the default have no effect
};

} // namespace lacuna::cad
