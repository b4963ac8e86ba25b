// SPDX-License-Identifier: MIT
#include <lacuna/core/error.h>
#include <lacuna/sweep/detail/words.h>
#include <lacuna/sweep/sweep.h>

#include <cmath>
#include <limits>
#include <string>

namespace lacuna::sweep {

namespace {

/// More threads than any machine this is built for has cores; far fewer than a system lets a process start.
constexpr int kMostThreads = 1024;

[[noreturn]] void refuse(const std::string& option, const std::string& must, const std::string& found)
{
    throw InvalidInput("sweep." + option,
                       "sweep: option '" + option + "' must be " + must + ", found " + found);
}

void check_heights(const LayerSpec& spec)
{
    const auto fail = [](const std::string& what) {
        throw InvalidInput("sweep.layer_heights", "sweep: option 'layers' " + what);
    };
    const int layers = static_cast<int>(spec.heights.size());
    if (spec.count != 0 && spec.count != layers) {
        fail("has " + std::to_string(layers) + " heights and a count of " + std::to_string(spec.count) +
             ": leave out the count, or the heights");
    }
    // Heights are often sums of steps, so the last is 1 up to the rounding of as many steps.
    const double slack = 4 * layers * std::numeric_limits<double>::epsilon();
    double below = 0;
    for (int i = 0; i < layers; ++i) {
        const double height = spec.heights[index(i)];
        const bool last = i + 1 == layers;
        if (!(height > below && height <= 1 + slack) || (!last && height >= 1)) {
            fail("needs a height that rises from the last one, in (0, 1], the last alone being 1: height " +
                 std::to_string(i + 1) + " is " + in_full(height) + " after " + in_full(below));
        }
        below = height;
    }
    if (below < 1 - slack) {
        fail("must end with the height 1 (the target), found " + in_full(below) + " as the last of " +
             std::to_string(layers) + ": divide all heights by it");
    }
}

void check(const surface::BoundaryLayer& layer)
{
    const auto fail = [](const std::string& member, const std::string& must, const std::string& found) {
        throw InvalidInput("sweep.boundary_layers", "sweep: option 'boundary_layers': " + member +
                                                        " must be " + must + ", found " + found);
    };
    if (layer.walls.tags.empty() && layer.walls.names.empty()) fail("walls", "faces of the volume", "none");
    if (!(layer.first > 0) || !std::isfinite(layer.first))
        fail("first", "a positive length", in_full(layer.first));
    if (!(layer.growth > 0) || !std::isfinite(layer.growth))
        fail("growth", "a positive number", in_full(layer.growth));
    if (layer.count < 1) fail("count", "a positive whole number", std::to_string(layer.count));
}

void check(const surface::Interval& interval)
{
    const auto fail = [](const std::string& what) {
        throw InvalidInput("sweep.intervals", "sweep: option 'intervals': " + what);
    };
    if (interval.count < 1)
        fail("a count must be a positive whole number, found " + std::to_string(interval.count));
    if (!(interval.bias > 0) || !std::isfinite(interval.bias))
        fail("a bias must be a finite number above 0, found " + in_full(interval.bias));
    if (interval.of == surface::Interval::Of::wall && interval.bias != 1)
        fail("a bias needs a direction, which a wall has none of; name its edge, or { from, to }");
}

} // namespace

void check(const LayerSpec& spec)
{
    if (!spec.heights.empty()) return check_heights(spec);
    if (spec.count < 0) {
        throw InvalidInput("sweep.layers",
                           "sweep: option 'layers' must be at least 1, or 0 for a count of its own, found " +
                               std::to_string(spec.count) +
                               ": set layers to a count or to a list of heights");
    }
    if (!(spec.bias > 0) || !std::isfinite(spec.bias))
        refuse("bias", "a finite number above 0", in_full(spec.bias));
}

void check(const ImproveOptions& options)
{
    const auto fail = [](const std::string& member, const std::string& must, const std::string& found) {
        throw InvalidInput("sweep.improve",
                           "sweep: option 'improve': " + member + " must be " + must + ", found " + found);
    };
    if (!(options.good_enough >= -1 && options.good_enough <= 1))
        fail("good_enough", "a scaled Jacobian in [-1, 1]", in_full(options.good_enough));
    if (options.rings < 0) fail("rings", "a whole number of at least 0", std::to_string(options.rings));
    if (options.iterations < 1)
        fail("iterations", "a positive whole number", std::to_string(options.iterations));
    if (!(options.work > 0)) fail("work", "a positive number", in_full(options.work));
    if (!(options.seconds >= 0)) fail("seconds", "a number of at least 0", in_full(options.seconds));
}

void check(const SweepOptions& options, const RunContext& context)
{
    if (!(options.min_scaled_jacobian >= 0 && options.min_scaled_jacobian <= 1))
        refuse("min_scaled_jacobian", "a number in [0, 1]", in_full(options.min_scaled_jacobian));
    if (options.order != 1 && options.order != 2) refuse("order", "1 or 2", std::to_string(options.order));
    if (options.second_order.serendipity && options.order != 2)
        throw InvalidInput("sweep.order",
                           "sweep: option 'serendipity' is for cells of order 2; set order = 2");
    if (options.wedges && options.order == 2)
        throw InvalidInput("sweep.order",
                           "sweep: wedges have no middle nodes here: 'wedges' goes with order = 1");
    if (options.curvature < 0)
        refuse("curvature", "a whole number of at least 0", std::to_string(options.curvature));
    if (options.gap < 0) refuse("gap", "a whole number of at least 0", std::to_string(options.gap));
    if (!(options.max_deviation >= 0) || !std::isfinite(options.max_deviation))
        refuse("max_deviation", "a finite length of at least 0", in_full(options.max_deviation));
    if (!(options.volume_share >= 0 && options.volume_share < 1))
        refuse("volume_share", "a number in [0, 1)", in_full(options.volume_share));
    if (options.rows < 0) refuse("rows", "a whole number of at least 0", std::to_string(options.rows));
    if (options.row_height && options.rows == 0)
        throw InvalidInput("sweep.rows",
                           "sweep: option 'row_height' needs 'rows', the number of rows it is for");
    if (options.rows > 0 && options.quads != Quads::automatic && options.quads != Quads::paved) {
        throw InvalidInput("sweep.rows", "sweep: 'rows' and 'row_height' are the paver's; use them with "
                                         "quads = \"auto\" or \"paved\"");
    }
    for (const surface::BoundaryLayer& layer : options.boundary_layers) check(layer);
    for (const surface::Interval& interval : options.intervals) check(interval);
    if (options.rows > 0 && !options.boundary_layers.empty())
        throw InvalidInput("sweep.boundary_layers",
                           "sweep: 'boundary_layers' and 'rows' both lay rows along the source's loops; use "
                           "one of them");
    if (context.threads < 0 || context.threads > kMostThreads) {
        refuse("threads", "a whole number from 0 (all cores) to " + std::to_string(kMostThreads),
               std::to_string(context.threads));
    }
    check(options.improving);
    check(options.layers);
}

} // namespace lacuna::sweep
