// SPDX-License-Identifier: MIT
#pragma once

/// Tables of point and quad numbers, for searches over parts of a mesh.

#include <lacuna/core/shared/marks.h>
#include <lacuna/core/types.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lacuna::quads {

/// A table of numbers by index that is cleared in constant time.
class Numbers {
public:
    void clear(std::size_t count)
    {
        of_.resize(count);
        ++now_;
    }
    Index& operator[](Index i)
    {
        Entry& entry = of_[index(i)];
        if (entry.known != now_) entry = {now_, 0};
        return entry.value;
    }
    [[nodiscard]] bool has(Index i) const
    {
        return static_cast<std::size_t>(i) < of_.size() && of_[index(i)].known == now_;
    }

private:
    struct Entry {
        unsigned known = 0;
        Index value = 0;
    };
    std::vector<Entry> of_;
    unsigned now_ = 0;
};

/// Hash of a number (the finaliser of splitmix64). A sum of such hashes identifies a set, because it does not
/// depend on the order.
inline std::uint64_t mixed(std::uint64_t x)
{
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
    return x ^ (x >> 31);
}

} // namespace lacuna::quads
