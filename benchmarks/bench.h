// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

namespace lacuna::bench {

struct Timing {
    double median = 0;   ///< [s]
    double best = 0;     ///< [s]
    double peak_mib = 0; ///< most memory the process held at once meanwhile, what was there before included
};

/// Peak memory is counted anew from here.
inline void forget_peak() { std::ofstream("/proc/self/clear_refs") << "5"; }

inline double peak_mib()
{
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;) {
        double kib = 0;
        if (word == "VmHWM:" && status >> kib) return kib / 1024;
    }
    return 0;
}

/// Time `work` several times; `prepare` before each is not counted.
template <class Prepare, class Work>
Timing time_of(int runs, const Prepare& prepare, const Work& work)
{
    std::vector<double> seconds;
    forget_peak();
    for (int run = 0; run < runs; ++run) {
        prepare();
        const auto start = std::chrono::steady_clock::now();
        work();
        seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
    std::sort(seconds.begin(), seconds.end());
    return {seconds[seconds.size() / 2], seconds.front(), peak_mib()};
}

/// One JSON line on standard output.
inline void report(const std::string& name, int threads, const Timing& timing, double min_scaled_jacobian)
{
    std::printf(
        "{\"name\": \"%s\", \"threads\": %d, \"median_s\": %.4f, \"best_s\": %.4f, \"peak_mib\": %.0f, "
        "\"min_scaled_jacobian\": %.4f}\n",
        name.c_str(), threads, timing.median, timing.best, timing.peak_mib, min_scaled_jacobian);
    std::fflush(stdout);
}

} // namespace lacuna::bench
