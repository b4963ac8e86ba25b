// SPDX-License-Identifier: MIT
#include <lacuna/cad/load.h>

#include <lacuna/cad/detail/worker.h>
#include <lacuna/core/shared/limits.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lacuna::cad {

using namespace cad_protocol;

namespace {

std::size_t side_count(const quads::PlanarRegion& region)
{
    std::size_t sides = 0;
    for (const std::vector<Index>& loop : region.loops) sides += loop.size();
    return sides;
}

/// Abscissas at which a horizontal line crosses the loops, ascending.
std::vector<double> cuts_at(const quads::PlanarRegion& region, double y)
{
    std::vector<double> cuts;
    for (const std::vector<Index>& loop : region.loops) {
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const Vec2 &a = region.points[index(loop[i])],
                       &b = region.points[index(loop[(i + 1) % loop.size()])];
            if ((a.y() <= y) != (b.y() <= y))
                cuts.push_back(a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
        }
    }
    std::sort(cuts.begin(), cuts.end());
    return cuts;
}

/// Target sizes of a region, on a raster over it. They are evaluated inside the region only; points outside
/// get the average of their neighbours, from the border outwards.
SizeRaster size_raster(const quads::PlanarRegion& region, const Eigen::AlignedBox2d& box,
                       const RunContext& context)
{
    SizeRaster raster;
    raster.origin = box.min();
    raster.step = box.sizes().maxCoeff() / kFineChords;
    const auto lines = [&](double length) {
        return std::max(2, static_cast<int>(std::ceil(length / raster.step)) + 1);
    };
    raster.columns = lines(box.sizes().x());
    const int columns = raster.columns, rows = lines(box.sizes().y());
    raster.sizes.assign(index(columns) * index(rows), std::numeric_limits<double>::quiet_NaN());
    const auto at = [&](int i, int j) -> double& {
        return raster.sizes[index(j) * index(columns) + index(i)];
    };
    bool any = false;
    for (int j = 0; j < rows; ++j) {
        check_cancelled(context);
        const double y = raster.origin.y() + j * raster.step;
        const std::vector<double> cuts = cuts_at(region, y);
        for (std::size_t c = 0; c + 1 < cuts.size(); c += 2) {
            const auto first = static_cast<int>(std::ceil((cuts[c] - raster.origin.x()) / raster.step));
            for (int i = std::max(0, first);
                 i < columns && raster.origin.x() + i * raster.step <= cuts[c + 1]; ++i) {
                at(i, j) = region.size(Vec2(raster.origin.x() + i * raster.step, y));
                any = true;
            }
        }
    }
    if (!any) { // the region is thinner than the spacing of the raster
        raster.sizes.assign(raster.sizes.size(),
                            region.size(region.points[index(region.loops.front().front())]));
        return raster;
    }
    for (bool missing = true; missing;) {
        missing = false;
        const std::vector<double> before = raster.sizes;
        for (int j = 0; j < rows; ++j) {
            for (int i = 0; i < columns; ++i) {
                if (!std::isnan(at(i, j))) continue;
                double sum = 0, first = 0;
                int count = 0;
                for (int y = std::max(0, j - 1); y <= std::min(rows - 1, j + 1); ++y) {
                    for (int x = std::max(0, i - 1); x <= std::min(columns - 1, i + 1); ++x) {
                        const double size = before[index(y) * index(columns) + index(x)];
                        if (std::isnan(size)) continue;
                        // Averaging differences keeps equal sizes exactly equal.
                        if (count == 0) first = size;
                        sum += size - first;
                        ++count;
                    }
                }
                if (count > 0) at(i, j) = first + sum / count;
                missing = missing || count == 0;
            }
        }
    }
    return raster;
}

} // namespace

quads::PlanarQuads recombine(const quads::PlanarRegion& region, const RunContext& context)
{
    const std::size_t sides = side_count(region);
    if (region.loops.empty() || sides % 2 != 0 || sides < 4) {
        throw NotSweepable(Message("cad.odd_rim",
                                   "a region with {} boundary sides cannot be filled with quads",
                                   found(sides))
                               .remedy("change the number with 'intervals': it must be even, and 4 or more"));
    }
    // Gmsh crashes on loops that intersect.
    quads::check(region);
    check_cancelled(context);
    RecombineRequest request{region.points, region.loops, {}};
    if (region.size) {
        Eigen::AlignedBox2d box;
        for (const std::vector<Index>& loop : region.loops)
            for (const Index p : loop) box.extend(region.points[index(p)]);
        request.size = size_raster(region, box, context);
    }
    Task task{formatted("a region of {} boundary sides", sides), "filling it with quads"};
    task.context = &context;
    task.points = sides * sides / 16; // estimate: quads in a round region with this number of boundary sides
    try {
        auto reply =
            Worker::current(&context, task.subject)->ask<RecombineReply>(Opcode::recombine, request, task);
        if (reply.points.size() < region.points.size() ||
            !std::equal(region.points.begin(), region.points.end(), reply.points.begin()))
            throw BackendError(Message("cad.protocol", "the CAD process moved boundary nodes of a region")
                                   .remedy("use quads = \"paved\""));
        return {std::move(reply.points), std::move(reply.quads), "gmsh"};
    } catch (const BackendError& error) {
        if (error.code() != "cad.worker_ended") throw;
        // No input file is involved, so the standard message of a crash does not apply.
        throw BackendError(Message(error.code(), "Gmsh's quad mesher crashed on {}", task.subject)
                               .remedy("use quads = \"paved\", which does not need Gmsh"));
    }
}

std::string gmsh_version()
{
    try {
        const Hello& hello = Worker::current()->hello();
        return hello.missing.empty() ? hello.gmsh_version
                                     : formatted("{}, without {}", hello.gmsh_version, hello.missing);
    } catch (const BackendError&) {
        return "none";
    }
}

} // namespace lacuna::cad
