// SPDX-License-Identifier: MIT
#include <lacuna/sweep/improve.h>

#include <lacuna/core/run_context.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/core/shared/progress.h>
#include <lacuna/geometry/shared/foldover.h>
#include <lacuna/geometry/shared/minimise.h>
#include <lacuna/sweep/detail/cell_region.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <map>
#include <memory>

namespace lacuna::sweep {

namespace {

/// Exponent k in each round of the second stage. With low values all poor corners have weight, with high
/// values only the worst ones.
constexpr std::array<double, 6> kSharpness{6, 12, 20, 30, 45, 60};
/// Weight of the shape energy in the second stage: enough to keep lengths and to prevent folds.
constexpr double kShapeShare = 1e-3;

class Improver {
public:
    Improver(std::vector<Vec3>& nodes, const CellRegion& region, const ImproveOptions& options,
             const Sliding& sliding, const RunContext& context)
        : nodes_(nodes),
          region_(region),
          options_(with_shared_limits(options)),
          sliding_(sliding),
          context_(context)
    {
    }

    Improved run()
    {
        Improved result;
        const RegionQuality first = best_quality_;
        result.cells = region_.cells.size();
        result.moved = region_.free;
        result.before = first.least;
        result.mean_before = first.mean;
        result.untangled = !(first.least > 0);
        if (result.untangled) untangle();
        if (best_quality_.least > 0 && best_quality_.lacking > 0) optimise(result.untangled);
        result.after = best_quality_.least;
        result.mean_after = best_quality_.mean;
        result.unfinished = out_of_time();
        result.won = is_better(best_quality_, first);
        for (std::size_t i = 0; result.won && i < region_.free; ++i)
            nodes_[index(region_.node[i])] = best_[i];
        return result;
    }

private:
    static std::vector<Vec3> places_of(const std::vector<Vec3>& nodes, const CellRegion& region)
    {
        std::vector<Vec3> places;
        for (const Index n : region.node) places.push_back(nodes[index(n)]);
        return places;
    }

    [[nodiscard]] Eigen::VectorXd variables(const std::vector<Vec3>& places) const
    {
        const auto size = static_cast<Eigen::Index>(3 * region_.free);
        return Eigen::Map<const Eigen::VectorXd>(places.front().data(), size);
    }

    /// While a mesh is folded, work on earlier meshes does not count, because a folded mesh would be refused.
    [[nodiscard]] double work_that_counts() const
    {
        return best_quality_.least > 0 ? options_.spent->work : work_;
    }

    [[nodiscard]] bool out_of_time() const
    {
        if (work_that_counts() > options_.work) return true;
        if (!(options_.seconds > 0)) return false;
        const auto now = std::chrono::steady_clock::now();
        if (!options_.spent->start) options_.spent->start = now;
        return std::chrono::duration<double>(now - *options_.spent->start).count() > options_.seconds;
    }

    /// Whether a region is visibly better than before: by its worst cell or, if that is as good, by
    /// `RegionQuality::lacking`.
    static bool is_better(const RegionQuality& found, const RegionQuality& before)
    {
        if (found.least > before.least + kVisible) return true;
        return found.least >= before.least && found.lacking < before.lacking * (1 - kVisible);
    }

    /// Run one minimisation, starting from `x`. Every iterate is judged after its sliding nodes are projected
    /// back onto their surfaces, and the best iterate is kept.
    void descend(Eigen::VectorXd& x, double mean_floor)
    {
        energy_.set_planes(x, sliding_);
        geometry::MinimiseOptions how;
        how.iterations = options_.iterations;
        how.stop = [&] {
            check_cancelled(context_);
            report_progress(context_, "improving", std::min(1.0, work_that_counts() / options_.work));
            return out_of_time();
        };
        how.visit = [&](const Eigen::VectorXd& at) {
            Eigen::VectorXd there = at;
            put_on_surfaces(there);
            keep(there, mean_floor);
            return best_quality_.least > 0 && best_quality_.lacking <= 0;
        };
        x = geometry::minimise(
            [&](const Eigen::VectorXd& at, Eigen::VectorXd& gradient) {
                const auto cells = static_cast<double>(region_.cells.size());
                work_ += cells;
                options_.spent->work += cells;
                return energy_(at, gradient);
            },
            std::move(x), how);
        put_on_surfaces(x);
        keep(x, mean_floor);
    }

    void put_on_surfaces(Eigen::VectorXd& x) const
    {
        std::map<Index, std::vector<std::size_t>> on;
        for (std::size_t i = 0; i < region_.free; ++i) {
            if (region_.surface[i] >= 0) on[region_.surface[i]].push_back(i);
        }
        for (const auto& [surface, nodes] : on) {
            std::vector<Vec3> points;
            for (const std::size_t i : nodes)
                points.emplace_back(x.segment<3>(3 * static_cast<Eigen::Index>(i)));
            sliding_.project(surface, points);
            for (std::size_t k = 0; k < nodes.size(); ++k)
                x.segment<3>(3 * static_cast<Eigen::Index>(nodes[k])) = points[k];
        }
    }

    [[nodiscard]] std::vector<Vec3> places_at(const Eigen::VectorXd& x) const
    {
        std::vector<Vec3> places = best_;
        Eigen::Map<Eigen::VectorXd>(places.front().data(), x.size()) = x;
        return places;
    }

    /// Replace the best positions by `x` if `x` is better and its mean quality is at least `mean_floor`.
    void keep(const Eigen::VectorXd& x, double mean_floor)
    {
        std::vector<Vec3> places = places_at(x);
        const RegionQuality found = measure(region_, places, context_);
        if (!is_better(found, best_quality_) || found.mean < mean_floor) return;
        best_ = std::move(places);
        best_quality_ = found;
    }

    void untangle()
    {
        Eigen::VectorXd x = variables(best_);
        energy_.energy = {};
        int without_gain = 0;
        RegionQuality reached = best_quality_;
        for (int round = 0; round < kMostRounds && without_gain < kIdleRounds && !out_of_time(); ++round) {
            const double determinant = energy_.least_determinant(x);
            energy_.energy.epsilon = geometry::epsilon_for(determinant);
            const double before = best_quality_.least, work = work_;
            descend(x, -1);
            // The worst cell may be the last to unfold. Progress of the other cells therefore counts as a
            // gain too, but folds only if at this rate all would unfold in the rounds that are left.
            const RegionQuality now = measure(region_, places_at(x), context_);
            const double left = std::min<double>(kMostRounds - round,
                                                 (options_.work - work_) / (work_ - work));
            const bool gain = best_quality_.least > before + kVisible ||
                              (now.folded > 0 ? (reached.folded - now.folded) * left > now.folded
                                              : now.lacking < reached.lacking * (1 - kAlikeSizes));
            reached.folded = std::min(reached.folded, now.folded);
            reached.lacking = std::min(reached.lacking, now.lacking);
            without_gain = gain ? 0 : without_gain + 1;
            if (best_quality_.least > 0 && best_quality_.lacking <= 0) return;
        }
    }

    void optimise(bool was_folded)
    {
        // If the mesh was folded, its mean quality may decrease.
        const double floor = was_folded ? -1 : best_quality_.mean - kAlikeSizes;
        Eigen::VectorXd x = variables(best_);
        for (const double sharpness : kSharpness) {
            if (out_of_time() || best_quality_.lacking <= 0) return;
            energy_.energy = {geometry::kLeastEpsilon, kShapeShare, sharpness};
            descend(x, floor);
            if (!(energy_.least_determinant(x) > 0)) x = variables(best_);
        }
    }

    std::vector<Vec3>& nodes_;
    const CellRegion& region_;
    ImproveOptions options_;
    const Sliding& sliding_;
    const RunContext& context_;
    double work_ = 0; ///< number of cell evaluations
    RegionEnergy energy_{region_, places_of(nodes_, region_), context_};
    std::vector<Vec3> best_ = places_of(nodes_, region_);
    RegionQuality best_quality_ = measure(region_, best_, context_);
};

} // namespace

ImproveOptions with_shared_limits(ImproveOptions options)
{
    if (!options.spent) options.spent = std::make_shared<ImproveSpent>();
    return options;
}

Improved improve_cells(std::vector<Vec3>& nodes, const CellsView& cells, const std::vector<char>& locked,
                       const ImproveOptions& options, const Sliding& sliding, const RunContext& context)
{
    const CellRegion region = poor_region(cells, locked, options, sliding, context);
    if (region.free == 0) return {};
    return Improver(nodes, region, options, sliding, context).run();
}

Improved improve(mesh::HexMesh mesh, const ImproveOptions& options, const Sliding& sliding,
                 const RunContext& context)
{
    check(options);
    report_progress(context, "improving");
    Improved result;
    result.stuck = stuck_corner(mesh, sliding);
    if (!result.stuck) {
        const CellsView cells{mesh.nodes, mesh.cell_count(), [&](std::size_t c) { return mesh.hex(c); }};
        result = improve_cells(mesh.nodes, cells, locked_nodes(mesh, sliding), options, sliding, context);
    }
    result.mesh = std::move(mesh);
    return result;
}

} // namespace lacuna::sweep
