// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

namespace lacuna::test {

/// Random numbers that are the same on every machine, which the standard's distributions are not.
class Dice {
public:
    explicit Dice(std::uint32_t seed) : engine_(seed) {}
    /// In [0, 1).
    double unit() { return static_cast<double>(engine_() >> 5) / static_cast<double>(1U << 27); }
    double between(double low, double high) { return low + (high - low) * unit(); }
    /// Low to high, each power as likely as the next.
    double log_between(double low, double high) { return low * std::pow(high / low, unit()); }
    /// A whole number from low to high, both included.
    int whole(int low, int high) { return low + static_cast<int>(unit() * (high - low + 1)); }
    bool chance(double share) { return unit() < share; }

private:
    std::mt19937 engine_;
};

} // namespace lacuna::test
