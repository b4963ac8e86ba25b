// SPDX-License-Identifier: MIT
/// Chooses the rows of cut weights that small regions are paved with, and measures those in use.
///
/// usage: choose_weights choose SEED OUTLINES [ROWS]   the best set of rows on a family of outlines, greedily
///        choose_weights few SEED OUTLINES [ROWS]      the same for few quads: no rows along the boundary,
///                                                     each outline at 60 to 400 quads
///        choose_weights measure SEED OUTLINES         the paver as it is on a family of outlines
///
/// Choose on one seed and measure on another, so that what is reported was not chosen for.

#include "support/dice.h"
#include "support/outline_family.h"

#include <lacuna/quads/detail/pave_choice.h>
#include <lacuna/quads/shared/measure_plane.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

using namespace lacuna;
using quads::paving::CutWeights;

namespace {

RunContext one_thread()
{
    RunContext context;
    context.threads = 1;
    return context;
}

/// The rows in use, and others around the default: each weight is left or taken from a few steps.
/// @param few  for few quads: also the default weights, more of the others, and patches taken sooner
std::vector<CutWeights> candidates(bool few)
{
    const int others = few ? 56 : 41; // with the seven in use 64 and 48: what a few minutes measure
    const auto used = quads::paving::cut_weight_rows();
    std::vector<CutWeights> rows(used.begin(), used.end());
    if (few) rows.emplace_back();
    test::Dice dice(20'240'601);
    const auto factor = [&] {
        return std::array{1.0, 1.0, 0.5, 0.75, 1.35, 2.0}[std::size_t(dice.whole(0, 5))];
    };
    const int last = few ? 3 : 2;
    for (int i = 0; i < others; ++i) {
        CutWeights row;
        for (double* weight : {&row.corners, &row.added, &row.length, &row.mismatch, &row.bent})
            *weight *= factor();
        row.least_patch = std::array{0.6, 0.5, 0.7, 0.4}[std::size_t(dice.whole(0, last))];
        rows.push_back(row);
    }
    return rows;
}

void print(const CutWeights& row)
{
    const CutWeights usual;
    std::string text;
    const auto add = [&](const char* name, double value, double other) {
        if (value == other) return;
        char part[40];
        std::snprintf(part, sizeof part, "%s.%s = %g", text.empty() ? "" : ", ", name, value);
        text += part;
    };
    add("corners", row.corners, usual.corners);
    add("added", row.added, usual.added);
    add("length", row.length, usual.length);
    add("mismatch", row.mismatch, usual.mismatch);
    add("bent", row.bent, usual.bent);
    add("least_patch", row.least_patch, usual.least_patch);
    std::printf("{%s},", text.c_str());
}

/// The scores of outlines with each of the candidates.
struct Scores {
    std::vector<double> best; ///< of each outline, so far
    std::vector<std::vector<double>> with;
};

/// Pave an outline with every row, unless a grid fills it.
void add_scores(const test::SeededDomain& seeded, const std::vector<CutWeights>& rows, bool few,
                Scores& scores)
{
    using quads::paving::RowStyle;
    const RunContext context = one_thread();
    quads::paving::AttemptChooser chooser(seeded.region, {}, context);
    chooser.try_default_weights();
    if (chooser.is_done()) return;
    constexpr double kNone = 0; // less than any valid mesh
    const RowStyle style = few ? RowStyle::no_rows : chooser.best().style;
    scores.best.push_back(few ? kNone : chooser.score());
    scores.with.emplace_back();
    for (const CutWeights& row : rows) scores.with.back().push_back(chooser.score_with(style, row));
}

/// Take the row that raises the mean of the best scores most, again and again.
void choose(std::uint32_t seed, int outlines, int most, bool few)
{
    const std::vector<CutWeights> rows = candidates(few);
    Scores scores;
    for (int number = 0; number < outlines; ++number) {
        if (!few) add_scores(test::family_region(seed, number), rows, few, scores);
        for (const double quads : {60, 90, 120, 250, 400}) {
            if (few)
                add_scores(test::seed_domain(test::family_domain(seed, number), quads), rows, few, scores);
        }
    }
    std::vector<double>& best = scores.best;
    const auto mean_with = [&](std::size_t row) {
        double sum = 0;
        for (std::size_t i = 0; i < best.size(); ++i) sum += std::max(best[i], scores.with[i][row]);
        return sum / static_cast<double>(best.size());
    };
    double sum = 0;
    for (const double score : best) sum += score;
    std::printf("%zu outlines of seed %u, %zu candidates; without them %.5f\n", best.size(), seed,
                rows.size(), sum / static_cast<double>(best.size()));
    for (int k = 0; k < most; ++k) {
        std::size_t chosen = 0;
        for (std::size_t row = 1; row < rows.size(); ++row) {
            if (mean_with(row) > mean_with(chosen)) chosen = row;
        }
        print(rows[chosen]);
        std::printf(" // %.5f\n", mean_with(chosen));
        for (std::size_t i = 0; i < best.size(); ++i) best[i] = std::max(best[i], scores.with[i][chosen]);
    }
}

void measure(std::uint32_t seed, int outlines)
{
    const RunContext context = one_thread();
    std::size_t quads = 0, irregular = 0;
    double least = 0, mean = 0, worst = 1, all = outlines;
    const auto start = std::clock();
    for (int number = 0; number < outlines; ++number) {
        const test::SeededDomain seeded = test::family_region(seed, number);
        const quads::PlaneQuality q = quads::measure_plane(quads::pave(seeded.region, {}, context).mesh,
                                                           seeded.region);
        quads += q.quads;
        irregular += q.irregular;
        least += q.min_scaled_jacobian / all;
        mean += q.mean_scaled_jacobian / all;
        worst = std::min(worst, q.min_scaled_jacobian);
    }
    std::printf("{\"seed\": %u, \"outlines\": %d, \"quads\": %zu, \"irregular\": %zu, "
                "\"mean_of_min_scaled_jacobian\": %.4f, \"min_scaled_jacobian\": %.4f, "
                "\"mean_scaled_jacobian\": %.4f, \"seconds\": %.1f}\n",
                seed, outlines, quads, irregular, least, worst, mean,
                static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
}

} // namespace

int main(int argc, char** argv)
try {
    if (argc < 4) {
        std::fprintf(stderr, "usage: choose_weights choose|few|measure SEED OUTLINES [ROWS]\n");
        return 2;
    }
    const auto seed = static_cast<std::uint32_t>(std::stoul(argv[2]));
    const int outlines = std::stoi(argv[3]);
    const std::string what = argv[1];
    if (what == "choose" || what == "few")
        choose(seed, outlines, argc > 4 ? std::stoi(argv[4]) : 7, what == "few");
    else
        measure(seed, outlines);
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
