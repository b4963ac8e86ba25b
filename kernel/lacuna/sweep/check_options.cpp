// SPDX-License-Identifier: MIT
#include <lacuna/core/error.h>
#include <lacuna/core/shared/parallel.h>
#include <lacuna/sweep/assembly.h>
#include <lacuna/sweep/sweep.h>

#include <cmath>
#include <limits>
#include <string>

namespace lacuna::sweep {

namespace {

[[noreturn]] void refuse(const std::string& option, const Argument& must, const Argument& value)
{
    throw InvalidInput("sweep." + option, "sweep: option '{}' must be {}, found {}", option, needed(must),
                       found(value));
}

/// Refuse a value in a table of options.
[[noreturn]] void refuse_member(const std::string& option, const char* member, const Argument& must,
                                const Argument& value)
{
    throw InvalidInput("sweep." + option, "sweep: option '{}': {} must be {}, found {}", option, member,
                       needed(must), found(value));
}

void check_heights(const LayerSpec& spec)
{
    const std::string code = "sweep.layer_heights";
    const int layers = static_cast<int>(spec.heights.size());
    if (spec.count != 0 && spec.count != layers) {
        throw InvalidInput(Message(code, "sweep: option 'layers' has {} heights and a count of {}",
                                   found(layers), found(spec.count))
                               .remedy("leave out the count, or the heights"));
    }
    // Heights are often sums of steps. The last height may therefore differ from 1 by as many rounding errors
    // as there are layers.
    const double slack = 4 * layers * std::numeric_limits<double>::epsilon();
    double below = 0;
    for (int i = 0; i < layers; ++i) {
        const double height = spec.heights[index(i)];
        const bool last = i + 1 == layers;
        if (!(height > below && height <= 1 + slack) || (!last && height >= 1)) {
            throw InvalidInput(code,
                               "sweep: option 'layers' needs increasing heights in (0, 1], of which only "
                               "the last is 1: height {} is {} after {}",
                               i + 1, found(height), below);
        }
        below = height;
    }
    if (below < 1 - slack) {
        throw InvalidInput(
            Message(
                code,
                "sweep: option 'layers' must end with the height {} (the target), found {} as the last of {}",
                needed(1), found(below), layers)
                .remedy("divide all heights by it"));
    }
}

void check(const surface::BoundaryLayer& layer)
{
    const auto fail = [](const char* member, const char* must, const Argument& value) {
        refuse_member("boundary_layers", member, must, value);
    };
    if (layer.walls.tags.empty() && layer.walls.names.empty()) fail("walls", "faces of the volume", "none");
    if (!(layer.first > 0) || !std::isfinite(layer.first)) fail("first", "a positive length", layer.first);
    if (!(layer.growth > 0) || !std::isfinite(layer.growth))
        fail("growth", "a positive number", layer.growth);
    if (layer.count < 1) fail("count", "a positive whole number", layer.count);
}

void check(const surface::Interval& interval)
{
    if (interval.count < 1) refuse_member("intervals", "a count", "a positive whole number", interval.count);
    if (!(interval.bias > 0) || !std::isfinite(interval.bias))
        refuse_member("intervals", "a bias", "a finite number above 0", interval.bias);
    if (interval.of == surface::Interval::Of::wall && interval.bias != 1)
        throw InvalidInput(
            Message("sweep.intervals", "sweep: option 'intervals': a wall has no direction for a bias")
                .remedy("name its edge, or {{ from, to }}"));
}

} // namespace

void check(const LayerSpec& spec)
{
    if (!spec.heights.empty()) return check_heights(spec);
    if (spec.count < 0) {
        throw InvalidInput(
            Message("sweep.layers",
                    "sweep: option 'layers' must be at least {}, or 0 for an automatic number, found {}",
                    needed(1), found(spec.count))
                .remedy("set 'layers' to a number or to a list of heights"));
    }
    if (!(spec.bias > 0) || !std::isfinite(spec.bias)) refuse("bias", "a finite number above 0", spec.bias);
}

void check(const ImproveOptions& options)
{
    const auto fail = [](const char* member, const char* must, const Argument& value) {
        refuse_member("improve", member, must, value);
    };
    if (!(options.good_enough >= -1 && options.good_enough <= 1))
        fail("good_enough", "a scaled Jacobian in [-1, 1]", options.good_enough);
    if (options.rings < 0) fail("rings", "a whole number of at least 0", options.rings);
    if (options.iterations < 1) fail("iterations", "a positive whole number", options.iterations);
    if (!(options.work > 0)) fail("work", "a positive number", options.work);
    if (!(options.seconds >= 0)) fail("seconds", "a number of at least 0", options.seconds);
}

void check(const SweepOptions& options, const RunContext& context)
{
    if (!(options.min_scaled_jacobian >= 0 && options.min_scaled_jacobian <= 1))
        refuse("min_scaled_jacobian", "a number in [0, 1]", options.min_scaled_jacobian);
    if (options.order != 1 && options.order != 2) refuse("order", "1 or 2", options.order);
    if (options.second_order.serendipity && options.order != 2)
        throw InvalidInput(
            Message("sweep.order", "sweep: option 'serendipity' applies to cells of order {} only", needed(2))
                .remedy("set order = 2"));
    if (options.wedges && options.order == 2)
        throw InvalidInput(Message("sweep.order", "sweep: wedges cannot have middle nodes")
                               .remedy("use 'wedges' with order = 1"));
    if (options.curvature < 0) refuse("curvature", "a whole number of at least 0", options.curvature);
    if (options.gap < 0) refuse("gap", "a whole number of at least 0", options.gap);
    if (!(options.max_deviation >= 0) || !std::isfinite(options.max_deviation))
        refuse("max_deviation", "a finite length of at least 0", options.max_deviation);
    if (!(options.volume_share >= 0 && options.volume_share < 1))
        refuse("volume_share", "a number in [0, 1)", options.volume_share);
    if (options.rows < 0) refuse("rows", "a whole number of at least 0", options.rows);
    if (options.row_height && options.rows == 0)
        throw InvalidInput(
            "sweep.rows",
            "sweep: option 'row_height' needs option 'rows', the number of rows of that height");
    if (options.rows > 0 && options.quads != Quads::automatic && options.quads != Quads::paved) {
        throw InvalidInput(Message("sweep.rows", "sweep: 'rows' and 'row_height' apply to paving only")
                               .remedy("use them with quads = \"auto\" or \"paved\""));
    }
    for (const surface::BoundaryLayer& layer : options.boundary_layers) check(layer);
    for (const surface::Interval& interval : options.intervals) check(interval);
    if (!options.periodic.empty() && options.fallback == Fallback::mixed)
        throw InvalidInput(Message("sweep.periodic_mixed",
                                   "sweep: 'periodic' pairs faces of hexahedra, and fallback = \"mixed\" may "
                                   "fill their volumes with tetrahedra")
                               .remedy("use one of them"));
    if (options.rows > 0 && !options.boundary_layers.empty())
        throw InvalidInput(
            Message("sweep.boundary_layers",
                    "sweep: 'boundary_layers' and 'rows' both place rows along the source's loops")
                .remedy("use one of them"));
    if (context.threads < 0 || context.threads > kMostThreads) {
        refuse("threads", formatted("a whole number from 0 (all cores) to {}", kMostThreads),
               context.threads);
    }
    check(options.improving);
    check(options.layers);
}

void check_alike(std::span<const AssemblyMember> members)
{
    for (std::size_t m = 0; m < members.size(); ++m) {
        if (members[m].region == "volume" && members.size() > 1)
            throw InvalidInput(
                Message("assembly.same_name",
                        "a volume of the assembly is named \"volume\", the group name of all cells")
                    .remedy("give it another name"));
        const SweepOptions &first = members.front().options, &own = members[m].options;
        if (own.order != first.order || own.second_order.serendipity != first.second_order.serendipity)
            throw InvalidInput(
                Message("assembly.order",
                        "{} and {} are parts of one mesh and must have the same 'order' and 'serendipity'",
                        members.front().region, members[m].region)
                    .remedy("give both volumes the same values"));
        for (std::size_t n = 0; n < m; ++n)
            if (members[m].region == members[n].region)
                throw InvalidInput(Message("assembly.same_name",
                                           "two volumes of the assembly are named \"{}\"", members[m].region)
                                       .remedy("give one of them another name"));
    }
}

} // namespace lacuna::sweep
