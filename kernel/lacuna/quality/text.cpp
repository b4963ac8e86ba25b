// SPDX-License-Identifier: MIT
#include <lacuna/quality/detail/text.h>

#include <lacuna/core/message.h>
#include <lacuna/quality/shared/metrics.h>

#include <algorithm>

namespace lacuna::quality {

std::string number(double value) { return formatted("{:.6g}", value); }

std::string place(const Vec3& point)
{
    return formatted("{:.6g} {:.6g} {:.6g}", point.x(), point.y(), point.z());
}

std::string place_in_mesh(const WorstCell& cell, int layers)
{
    const std::string at = place(cell.centre);
    return cell.layer < 0 ? "at " + at : formatted("layer {} of {}, at {}", cell.layer + 1, layers, at);
}

std::string to_table(const Quality& quality)
{
    constexpr const char* kKinds[] = {"hexahedra ", "wedges    ", "pyramids  ", "tetrahedra"};
    const std::size_t counts[] = {quality.hexes, quality.wedges, quality.pyramids, quality.tets};
    std::string text, least;
    for (std::size_t k = 0; k < std::size(counts); ++k) {
        if (counts[k] == 0 && (k > 0 || quality.cells() > 0)) continue;
        text += formatted("{}{:>25}\n", kKinds[k], counts[k]);
        if (counts[k] < quality.cells())
            least += formatted("   of the {}{:>15.4f}\n", kKinds[k], quality.least_by_kind[k]);
    }
    text += formatted("scaled Jacobian  least {:>12.4f}\n", quality.min_scaled_jacobian) + least;
    text += formatted("                  mean {:>12.4f}\n", quality.mean_scaled_jacobian);
    text += formatted("inverted               {:>12}\n", quality.inverted);
    text += formatted("not certified valid    {:>12}\n", quality.uncertified);
    text += formatted("volume                 {:>12.6g}\n", quality.volume);

    const std::size_t most = *std::max_element(quality.histogram.begin(), quality.histogram.end());
    if (most == 0) return text;
    constexpr std::size_t kBar = 40; ///< characters of the longest bar: lines stay below 80
    std::size_t bin = 0;
    while (quality.histogram[bin] == 0) ++bin;
    for (; bin < quality.histogram.size(); ++bin) {
        const std::size_t cells = quality.histogram[bin];
        const std::size_t bar = (cells * kBar + most - 1) / most;
        const double low = -1 + 0.1 * static_cast<double>(bin);
        text += formatted("  {:>4.1f} … {:>4.1f}{:>19}{}{}\n", low, low + 0.1, cells, bar > 0 ? "  " : "",
                          std::string(bar, '#'));
    }
    return text;
}

std::string to_table(std::span<const MetricSummary> summaries)
{
    std::string text = formatted("{:<29}{:>13}{:>13}{:>13}{:>13}{:>13}\n", "metric of the corner nodes",
                                 "least", "mean", "largest", "acceptable", "outside");
    for (const MetricSummary& summary : summaries) {
        if (summary.cells == 0) continue;
        const MetricInfo& info = metric_info(summary.metric);
        text += formatted("{:<29}{:>13.6g}{:>13.6g}{:>13.6g}", info.name, summary.min, summary.mean,
                          summary.max);
        if (info.acceptable)
            text += formatted("{:>13}{:>11.2f} %",
                              number(info.acceptable->low) + " to " + number(info.acceptable->high),
                              100 * summary.outside_share);
        text += "\n";
    }
    return text;
}

} // namespace lacuna::quality
