// SPDX-License-Identifier: MIT
#include "program/stopping.h"

#include <cmath>
#include <cstdio>
#include <sys/resource.h>
#include <sys/time.h>

namespace lacuna::program {

namespace {

std::size_t data_in_use()
{
    // The sixth number of /proc/self/statm: data and stack in pages, the memory that RLIMIT_DATA limits.
    unsigned long pages = 0;
    if (std::FILE* file = std::fopen("/proc/self/statm", "r")) {
        if (std::fscanf(file, "%*u %*u %*u %*u %*u %lu", &pages) != 1) pages = 0;
        std::fclose(file);
    }
    return pages * 4096;
}

} // namespace

void limit_process(double megabytes, double seconds)
{
#ifndef __SANITIZE_ADDRESS__ // its shadow memory is larger than any limit
    rlimit data = {};
    getrlimit(RLIMIT_DATA, &data);
    const auto wanted = static_cast<rlim_t>(megabytes * 1024 * 1024) + data_in_use();
    if (data.rlim_max == RLIM_INFINITY || wanted < data.rlim_max) data.rlim_cur = wanted;
    setrlimit(RLIMIT_DATA, &data);
#endif
    constexpr double kGrace = 5; // between the request to stop and the end of the process [s]
    const auto split = [](double s) {
        return timeval{static_cast<time_t>(s),
                       static_cast<suseconds_t>(std::fmod(s, 1.0) * 1e6) + (s < 1e-6 ? 1 : 0)};
    };
    const itimerval timer{split(kGrace), split(seconds)};
    setitimer(ITIMER_REAL, &timer, nullptr);
}

} // namespace lacuna::program
