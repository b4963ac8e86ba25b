// SPDX-License-Identifier: MIT
#include <lacuna/core/error.h>
#include <lacuna/sweep/sweep.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

namespace lacuna::sweep {

namespace {

std::string text(double value)
{
    std::ostringstream out;
    out.precision(std::numeric_limits<double>::max_digits10);
    out << value;
    return out.str();
}

/// Exponent of the bias in the height of layer `layer` of `count`: 0 where heights are 1, 1 where they are the bias.
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

std::vector<double> given_heights(const LayerSpec& spec)
{
    const int layers = static_cast<int>(spec.heights.size());
    if (spec.count != 0 && spec.count != layers) {
        throw InvalidInput("sweep.layer_heights",
                           std::to_string(layers) + " layer heights and a count of " +
                               std::to_string(spec.count) +
                               " layers were given: leave out the count, or the heights");
    }
    std::vector<double> result{0.0};
    for (int i = 0; i < layers; ++i) {
        const double height = spec.heights[static_cast<std::size_t>(i)];
        if (!(height > result.back()) || !std::isfinite(height)) {
            throw InvalidInput("sweep.layer_heights", "layer heights must rise from above 0 to 1: height " +
                                                          std::to_string(i + 1) + " is " + text(height) +
                                                          " after " + text(result.back()));
        }
        result.push_back(height);
    }
    // Heights are often sums of steps, so the last is 1 up to the rounding of as many steps.
    if (std::abs(result.back() - 1) > 4 * layers * std::numeric_limits<double>::epsilon()) {
        throw InvalidInput("sweep.layer_heights", "the last layer height must be 1 (the target), found " +
                                                      text(result.back()) + ": divide all heights by it");
    }
    if (layers > 1 && result[static_cast<std::size_t>(layers) - 1] >= 1) {
        throw InvalidInput("sweep.layer_heights", "the last but one layer height must be below 1, found " +
                                                      text(result[static_cast<std::size_t>(layers) - 1]));
    }
    result.back() = 1;
    return result;
}

} // namespace

std::vector<double> layer_heights(const LayerSpec& spec)
{
    if (!spec.heights.empty()) return given_heights(spec);
    if (spec.count < 1) {
        throw InvalidInput("sweep.layers", "a sweep needs at least 1 layer, found " +
                                               std::to_string(spec.count) +
                                               ": set layers to a count or to a list of heights");
    }
    if (!(spec.bias > 0) || !std::isfinite(spec.bias)) {
        throw InvalidInput("sweep.bias",
                           "the bias of the layer heights must be a finite number above 0, found " +
                               text(spec.bias));
    }

    std::vector<double> result{0.0};
    result.reserve(static_cast<std::size_t>(spec.count) + 1);
    for (int i = 0; i < spec.count; ++i)
        result.push_back(result.back() + std::pow(spec.bias, exponent(spec, i)));
    const double total = result.back();
    for (double& height : result) height /= total;
    result.back() = 1;

    const bool rising = std::adjacent_find(result.begin(), result.end(), [](double low, double high) {
                            return !(low < high);
                        }) == result.end();
    if (!rising) {
        throw InvalidInput("sweep.bias", "a bias of " + text(spec.bias) + " over " +
                                             std::to_string(spec.count) +
                                             " layers leaves layers without height: choose one nearer 1");
    }
    return result;
}

} // namespace lacuna::sweep
