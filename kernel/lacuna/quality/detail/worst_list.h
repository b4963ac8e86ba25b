// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quality/quality.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace lacuna::quality {

/// The cells of `Quality::worst`: at most ten, one for each column, worst first. Internal to this folder.
struct WorstList {
    struct Entry {
        WorstCell cell;
        std::size_t column;
    };
    std::vector<Entry> entries;

    /// Whether a cell with this value may belong to the list.
    [[nodiscard]] bool takes(double scaled_jacobian) const
    {
        return entries.size() < kMost || scaled_jacobian <= entries.back().cell.scaled_jacobian;
    }
    void offer(const WorstCell& cell, std::size_t column)
    {
        const auto precedes = [&](const Entry& other) {
            return std::pair(cell.scaled_jacobian, cell.cell) <
                   std::pair(other.cell.scaled_jacobian, other.cell.cell);
        };
        if (entries.size() == kMost && !precedes(entries.back())) return;
        const auto known = std::ranges::find(entries, column, &Entry::column);
        if (known != entries.end()) {
            if (!precedes(*known)) return;
            entries.erase(known);
        } else if (entries.size() == kMost) {
            entries.pop_back();
        }
        entries.insert(std::ranges::find_if(entries, precedes), {cell, column});
    }

private:
    static constexpr std::size_t kMost = 10; ///< as `Quality::worst` says
};

} // namespace lacuna::quality
