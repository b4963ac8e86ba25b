// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace lacuna::geometry {

/// Disjoint sets of the numbers 0 … count - 1. Each set is represented by one of its members, the root.
///
/// Algorithm: a forest with path halving (Tarjan and van Leeuwen 1984), without union by rank: the caller
/// chooses the root of a union, because roots are used for numbering. A step costs O(log n) amortised.
class UnionFind {
public:
    explicit UnionFind(std::size_t count) : parent_(count)
    {
        std::iota(parent_.begin(), parent_.end(), std::size_t{0});
    }

    /// Add the next number as a set of its own.
    void add() { parent_.push_back(parent_.size()); }

    /// The root of the set that contains `i`.
    [[nodiscard]] std::size_t find(std::size_t i)
    {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    [[nodiscard]] std::size_t find(Index i) { return find(index(i)); }

    /// Merge the set of `b` into that of `a`, whose root is kept. @return  false if both are in one set
    /// already.
    bool unite(std::size_t a, std::size_t b)
    {
        a = find(a);
        b = find(b);
        if (a == b) return false;
        parent_[b] = a;
        return true;
    }
    bool unite(Index a, Index b) { return unite(index(a), index(b)); }

    /// Merge two sets and keep the smaller root, so that every root is the smallest member of its set.
    bool unite_least(std::size_t a, std::size_t b)
    {
        a = find(a);
        b = find(b);
        return unite(std::min(a, b), std::max(a, b));
    }

private:
    std::vector<std::size_t> parent_;
};

} // namespace lacuna::geometry
