// SPDX-License-Identifier: MIT
#include <lacuna/view/detail/legend.h>

#include <lacuna/core/message.h>
#include <lacuna/core/shared/number_text.h>
#include <lacuna/view/detail/stroke_font.h>

#include <cmath>

namespace lacuna::view {

namespace {

// Sizes that look balanced in a picture of 1200 pixels [pixels].
constexpr double kEdge = 18, kLetters = 11, kGap = 7, kBarWide = 180;
constexpr int kRows = 3; // most rows of keys
constexpr Colour kInk{20, 28, 38};

double width_of(const std::string& text, double height) { return stroked(text).width * height; }

/// Write text in capitals of the given height, with its upper left corner at `at`.
void write(std::vector<Mark>& marks, const std::string& text, const Vec2& at, double height)
{
    for (const auto& [from, to] : stroked(text).strokes)
        marks.push_back({at + height * from, at + height * to, kInk, height / 8, false});
}

double width_of(const Key& key) { return kLetters + kGap + width_of(key.text, kLetters); }

/// Distribute keys to rows. If there is no room for all, the last key counts the others.
std::vector<std::vector<Key>> rows_of(const std::vector<Key>& keys, double wide)
{
    std::vector<std::vector<Key>> rows;
    double used = 0;
    for (std::size_t k = 0; k < keys.size(); ++k) {
        if (rows.empty() || used + width_of(keys[k]) > wide) {
            if (rows.size() == kRows) {
                Key rest{{255, 255, 255}, formatted("and {} more", keys.size() - k + 1), false, true};
                rows.back().back() = rest; // replaces the last key
                break;
            }
            rows.emplace_back();
            used = 0;
        }
        rows.back().push_back(keys[k]);
        used += width_of(keys[k]) + kEdge;
    }
    return rows;
}

} // namespace

PlacedLegend place_legend(const Legend& legend, int width, int height)
{
    PlacedLegend placed;
    if (!legend.title.empty()) {
        write(placed.marks, legend.title, {kEdge, kEdge}, kLetters);
        placed.above = kEdge + kLetters + kGap;
    }
    double bottom = height - kEdge;
    if (!legend.ramp.empty()) {
        const double top = bottom - kLetters - kGap - kLetters, right = kEdge + kBarWide;
        for (int i = 0; i < kBarWide; ++i)
            placed.marks.push_back({{kEdge + i, top},
                                    {kEdge + i + 1, top + kLetters},
                                    on_ramp(legend.ramp, (i + 0.5) / kBarWide)});
        const auto number = [](double value) {
            return with_decimals(value, value == std::floor(value) ? 0 : 1);
        };
        const std::string low = number(legend.low), high = number(legend.high);
        const double text = bottom - kLetters;
        write(placed.marks, low, {kEdge, text}, kLetters);
        write(placed.marks, high, {right - width_of(high, kLetters), text}, kLetters);
        write(placed.marks, legend.quantity, {right + kGap * 2, top}, kLetters);
        bottom = top - kGap * 2;
    }
    const auto rows = rows_of(legend.keys, width - 2 * kEdge);
    for (auto row = rows.rbegin(); row != rows.rend(); ++row) {
        double left = kEdge;
        const double top = bottom - kLetters;
        for (const Key& key : *row) {
            const Vec2 low(left, top), high(left + kLetters, top + kLetters), half(0, kLetters / 2);
            if (key.line) {
                placed.marks.push_back({low + half, high - half, key.colour, 4, false});
            } else {
                placed.marks.push_back({low, high, kInk});
                const Vec2 rim(1, 1);
                placed.marks.push_back({low + rim, high - rim, key.colour, 0, key.hatched});
            }
            write(placed.marks, key.text, {left + kLetters + kGap, top}, kLetters);
            left += width_of(key) + kEdge;
        }
        bottom -= kEdge;
    }
    placed.below = height - kEdge - bottom > 0 ? height - bottom : 0;
    return placed;
}

} // namespace lacuna::view
