// SPDX-License-Identifier: MIT
//
// bench_stress [members] [seed]: a JSON line for each member of the stress family.
#include "support/stress.h"

#include <lacuna/closure/close.h>
#include <lacuna/core/error.h>
#include <lacuna/matching/match.h>
#include <lacuna/quality/quality.h>
#ifdef LACUNA_WITH_CAD
#include <lacuna/cad/load.h>
#endif
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>

using namespace lacuna;

int main(int argc, char** argv)
{
    const int count = argc > 1 ? std::atoi(argv[1]) : 520;
    const unsigned seed = argc > 2 ? static_cast<unsigned>(std::atoi(argv[2])) : 1;
    const int only = argc > 3 ? std::atoi(argv[3]) : -1;
    for (const test::StressMember& member : test::stress_family(count, seed)) {
        if (only >= 0 && member.number != only) continue;
        const auto start = std::chrono::steady_clock::now();
        std::string verdict;
        try {
            topology::OpenVolume volume = test::stress_volume(member);
            const bool ends = !volume.faces(topology::Role::source).empty() &&
                              !volume.faces(topology::Role::target).empty();
            closure::close(volume, ends ? matching::match(volume) : matching::Match{});
            sweep::SweepOptions options = test::stress_options(member);
#ifdef LACUNA_WITH_CAD
            options.quad_mesher = cad::recombine;
#endif
            const sweep::Swept swept = sweep::sweep(volume, options);
            const quality::Quality q = quality::measure(swept.mesh);
            char text[200];
            std::snprintf(text, sizeof text, "%.3f mean %.3f bound %.3f cells %zu", q.min_scaled_jacobian,
                          q.mean_scaled_jacobian, test::skin_bound(swept.mesh), q.hexes);
            verdict = text;
            if (only >= 0) for (const std::string& line : swept.report) std::printf("  %s\n", line.c_str());
        } catch (const Error& error) {
            verdict = "-1 REFUSED " + error.code() + (only >= 0 ? std::string(": ") + error.what() : "");
        }
        const double seconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        std::printf("%s | %s | %.2fs\n", member.name().c_str(), verdict.c_str(), seconds);
        std::fflush(stdout);
    }
}
