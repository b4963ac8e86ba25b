// SPDX-License-Identifier: MIT
#include <lacuna/core/error.h>
#include <lacuna/sweep/sweep.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace lacuna::sweep {

namespace {

/// The exponent e of a layer's relative height, which is bias^e.
double exponent(const LayerSpec& spec, int layer)
{
    if (spec.spacing == Spacing::geometric) {
        return spec.count > 1 ? static_cast<double>(layer) / (spec.count - 1) : 0.0;
    }
    const int middle = (spec.count - 1) / 2;
    const double inward = middle > 0 ? static_cast<double>(std::min(layer, spec.count - 1 - layer)) / middle
                                     : 0.0;
    return spec.spacing == Spacing::bell ? inward : -inward;
}

} // namespace

std::vector<double> layer_heights(const LayerSpec& spec)
{
    check(spec);
    if (spec.heights.empty() && spec.count < 1) {
        throw InvalidInput("sweep.layers", "the heights of layers need at least {} layer, found {}",
                           needed(1), found(spec.count));
    }
    if (!spec.heights.empty()) {
        std::vector<double> result{0.0};
        result.insert(result.end(), spec.heights.begin(), spec.heights.end());
        result.back() = 1;
        return result;
    }
    std::vector<double> result{0.0};
    result.reserve(static_cast<std::size_t>(spec.count) + 1);
    for (int i = 0; i < spec.count; ++i)
        result.push_back(result.back() + std::pow(spec.bias, exponent(spec, i)));
    const double total = result.back();
    for (double& height : result) height /= total;
    result.back() = 1;

    const bool rising = std::ranges::adjacent_find(
                            result, [](double low, double high) { return !(low < high); }) == result.end();
    if (!rising) {
        throw InvalidInput(Message("sweep.bias",
                                   "sweep: with a bias of {} over {} layers, some layers have no height",
                                   found(spec.bias), spec.count)
                               .remedy("choose a bias nearer to 1"));
    }
    return result;
}

} // namespace lacuna::sweep
