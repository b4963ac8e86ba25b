// SPDX-License-Identifier: MIT
#include <lacuna/quality/detail/text.h>

#include <lacuna/core/shared/number_text.h>
#include <lacuna/quality/shared/metrics.h>

#include <algorithm>

namespace lacuna::quality {
namespace {

std::string pad_left(const std::string& text, std::size_t width)
{
    return std::string(width > text.size() ? width - text.size() : 0, ' ') + text;
}

} // namespace

std::string number(double value) { return formatted("{:.6g}", value); }

std::string fixed(double value, int digits, std::size_t width)
{
    return pad_left(with_decimals(value, digits), width);
}

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
    const auto count = [](std::size_t value, std::size_t width) {
        return pad_left(std::to_string(value), width);
    };
    constexpr const char* kKinds[] = {"hexahedra ", "wedges    ", "pyramids  ", "tetrahedra"};
    const std::size_t counts[] = {quality.hexes, quality.wedges, quality.pyramids, quality.tets};
    std::string text, least;
    for (std::size_t k = 0; k < std::size(counts); ++k) {
        if (counts[k] == 0 && (k > 0 || quality.cells() > 0)) continue;
        text += kKinds[k] + count(counts[k], 25) + "\n";
        if (counts[k] < quality.cells())
            least += "   of the " + (kKinds[k] + fixed(quality.least_by_kind[k], 4, 15)) + "\n";
    }
    text += "scaled Jacobian  least " + fixed(quality.min_scaled_jacobian, 4, 12) + "\n" + least;
    text += "                  mean " + fixed(quality.mean_scaled_jacobian, 4, 12) + "\n";
    text += "inverted               " + count(quality.inverted, 12) + "\n";
    text += "not certified valid    " + count(quality.uncertified, 12) + "\n";
    text += "volume                 " + pad_left(number(quality.volume), 12) + "\n";

    const std::size_t most = *std::max_element(quality.histogram.begin(), quality.histogram.end());
    if (most == 0) return text;
    constexpr std::size_t kBar = 40; ///< characters of the longest bar: lines stay below 80
    std::size_t bin = 0;
    while (quality.histogram[bin] == 0) ++bin;
    for (; bin < quality.histogram.size(); ++bin) {
        const std::size_t cells = quality.histogram[bin];
        const std::size_t bar = (cells * kBar + most - 1) / most;
        const double low = -1 + 0.1 * static_cast<double>(bin);
        text += "  " + fixed(low, 1, 4) + " … " + fixed(low + 0.1, 1, 4) + count(cells, 19);
        text += (bar > 0 ? "  " : "") + std::string(bar, '#') + "\n";
    }
    return text;
}

std::string to_table(std::span<const MetricSummary> summaries)
{
    constexpr std::size_t kNameWidth = 29;
    constexpr std::size_t kWidth = 13;
    const auto pad_right = [](const std::string& text, std::size_t width) {
        return text + std::string(width > text.size() ? width - text.size() : 1, ' ');
    };
    std::string text = pad_right("metric of the corner nodes", kNameWidth);
    for (const char* head : {"least", "mean", "largest", "acceptable", "outside"})
        text += pad_left(head, kWidth);
    text += "\n";
    for (const MetricSummary& summary : summaries) {
        if (summary.cells == 0) continue;
        const MetricInfo& info = metric_info(summary.metric);
        text += pad_right(info.name, kNameWidth);
        for (const double value : {summary.min, summary.mean, summary.max})
            text += pad_left(number(value), kWidth);
        if (info.acceptable) {
            text += pad_left(number(info.acceptable->low) + " to " + number(info.acceptable->high), kWidth);
            text += pad_left(fixed(100 * summary.outside_share, 2) + " %", kWidth);
        }
        text += "\n";
    }
    return text;
}

} // namespace lacuna::quality
