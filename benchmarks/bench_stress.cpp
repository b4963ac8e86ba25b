// SPDX-License-Identifier: MIT
//
// bench_stress [--members N] [--seed S] [--only NUMBER] [--list] [--json FILE]
//
// The stress family with the layers as they are placed, and with cells untangled and improved (what a sweep
// does). Prints a table; --list adds a line a member and method, --only one member's report.
#include "support/stress.h"

#include <lacuna/core/error.h>
#include <lacuna/quality/quality.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

using namespace lacuna;

namespace {

struct Method {
    const char* name;
    bool improve;
};

constexpr Method kMethods[] = {
    {"as placed", false},
    {"untangled and improved", true},
};

struct Result {
    std::size_t cells = 0, invalid = 0;
    double least = -1, mean = 0, bound = 0, seconds = 0;
    std::string code, message;
    std::vector<std::string> report;
};

struct Arguments {
    int members = 520;
    unsigned seed = 1;
    int only = -1;
    bool list = false;
    std::string json;
};

Result run(const test::StressMember& member, const topology::OpenVolume& sealed, const Method& method)
{
    Result result;
    sweep::SweepOptions options = test::stress_options(member);
    options.improve = method.improve;
    const auto start = std::chrono::steady_clock::now();
    try {
        const sweep::Swept swept = sweep::sweep(sealed, options);
        const quality::Quality q = quality::measure(swept.mesh);
        result.cells = q.hexes;
        result.least = q.min_scaled_jacobian;
        result.mean = q.mean_scaled_jacobian;
        result.bound = test::edge_bound(swept.mesh);
        result.report = swept.report;
    } catch (const Error& error) {
        result.code = error.code();
        result.message = error.what();
        // "15 of 1534 cells are …"
        std::sscanf(error.what(), "%zu of %zu", &result.invalid, &result.cells);
    }
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
}

Arguments arguments_of(int argc, char** argv)
{
    Arguments a;
    for (int i = 1; i < argc; ++i) {
        const auto is = [&](const char* word) { return std::strcmp(argv[i], word) == 0; };
        const bool more = i + 1 < argc;
        if (is("--list"))
            a.list = true;
        else if (is("--members") && more)
            a.members = std::atoi(argv[++i]);
        else if (is("--seed") && more)
            a.seed = static_cast<unsigned>(std::atoi(argv[++i]));
        else if (is("--only") && more)
            a.only = std::atoi(argv[++i]);
        else if (is("--json") && more)
            a.json = argv[++i];
        else
            std::exit((std::fprintf(stderr, "bench_stress: what is '%s'?\n", argv[i]), 2));
    }
    return a;
}

void print_member(const test::StressMember& member, const Method& method, const Result& r, bool with_report)
{
    std::printf("%s | %s | ", member.name().c_str(), method.name);
    if (r.code.empty())
        std::printf("least %.3f mean %.3f bound %.3f cells %zu", r.least, r.mean, r.bound, r.cells);
    else
        std::printf("refused: %s", with_report ? r.message.c_str() : r.code.c_str());
    std::printf(" | %.2f s\n", r.seconds);
    for (std::size_t i = 0; with_report && i < r.report.size(); ++i)
        std::printf("    %s\n", r.report[i].c_str());
}

/// What a method makes of one half of the family.
struct Sum {
    int members = 0, refused = 0, below = 0;
    std::size_t cells = 0, invalid = 0;
    double least = 1, least_mean = 0, mean = 0, seconds = 0;

    void add(const Result& r, double bar)
    {
        ++members;
        refused += r.code.empty() ? 0 : 1;
        below += r.least < bar ? 1 : 0;
        cells += r.cells;
        invalid += r.invalid;
        seconds += r.seconds;
        if (!r.code.empty()) return;
        least = std::min(least, r.least);
        least_mean += r.least;
        mean += r.mean;
    }
};

} // namespace

int main(int argc, char** argv)
{
    const Arguments a = arguments_of(argc, argv);
    Sum sums[2][std::size(kMethods)];
    for (const test::StressMember& member : test::stress_family(a.members, a.seed)) {
        if (a.only >= 0 && member.number != a.only) continue;
        const topology::OpenVolume volume = test::sealed_stress_volume(member);
        for (std::size_t m = 0; m < std::size(kMethods); ++m) {
            const Result r = run(member, volume, kMethods[m]);
            sums[member.mild ? 0 : 1][m].add(r, member.mild ? 0.5 : 0.2);
            if (a.list || a.only >= 0) print_member(member, kMethods[m], r, a.only >= 0);
        }
    }
    std::FILE* json = a.json.empty() ? nullptr : std::fopen(a.json.c_str(), "w");
    if (json != nullptr) std::fprintf(json, "[");
    std::printf("| half | method | meshed | invalid cells | least SJ | mean of least | mean SJ | below the "
                "bar | seconds |\n"
                "|---|---|---|---|---|---|---|---|---|\n");
    bool first = true;
    for (int half = 0; half < 2; ++half) {
        for (std::size_t m = 0; m < std::size(kMethods); ++m) {
            const Sum& s = sums[half][m];
            const int meshed = s.members - s.refused;
            const double least = meshed > 0 ? s.least : -1, of_least = meshed > 0 ? s.least_mean / meshed : 0,
                         mean = meshed > 0 ? s.mean / meshed : 0;
            std::printf("| %s | %s | %d of %d | %zu of %zu | %.3f | %.3f | %.3f | %d | %.1f |\n",
                        half == 0 ? "mild, bar 0.5" : "hard, bar 0.2", kMethods[m].name, meshed, s.members,
                        s.invalid, s.cells, least, of_least, mean, s.below, s.seconds);
            if (json == nullptr) continue;
            std::fprintf(json,
                         "%s\n {\"half\": \"%s\", \"method\": \"%s\", \"members\": %d, \"meshed\": %d, "
                         "\"invalid_cells\": %zu, "
                         "\"cells\": %zu, \"least\": %.4f, \"mean_of_least\": %.4f, \"mean\": %.4f, "
                         "\"below_bar\": %d, "
                         "\"seconds\": %.2f}",
                         first ? "" : ",", half == 0 ? "mild" : "hard", kMethods[m].name, s.members, meshed,
                         s.invalid, s.cells, least, of_least, mean, s.below, s.seconds);
            first = false;
        }
    }
    if (json != nullptr) {
        std::fprintf(json, "\n]\n");
        std::fclose(json);
    }
}
