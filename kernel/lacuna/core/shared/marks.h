// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace lacuna {

/// A set of integers below a fixed count. Clearing is O(1), so that one set can serve many searches over a
/// mesh or model.
class Marks {
public:
    explicit Marks(std::size_t count = 0) : of_(count, 0) {}

    void clear()
    {
        if (++now_ != 0) return;
        std::fill(of_.begin(), of_.end(), 0);
        now_ = 1;
    }
    /// Make the set empty, for integers below `count`.
    void clear(std::size_t count)
    {
        of_.resize(count, 0);
        clear();
    }
    [[nodiscard]] bool has(std::size_t i) const { return i < of_.size() && of_[i] == now_; }
    [[nodiscard]] bool has(Index i) const { return has(index(i)); }
    /// @return true if `i` was not in the set before.
    bool add(std::size_t i)
    {
        if (has(i)) return false;
        of_[i] = now_;
        return true;
    }
    bool add(Index i) { return add(index(i)); }

private:
    std::vector<std::uint32_t> of_; ///< for each integer, the value of `now_` when it was last added
    std::uint32_t now_ = 1;         ///< increased by each `clear()`
};

} // namespace lacuna
