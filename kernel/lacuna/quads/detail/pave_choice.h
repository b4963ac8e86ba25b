// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/quads/detail/central_block.h>
#include <lacuna/quads/detail/outline_symmetry.h>
#include <lacuna/quads/detail/pave_attempt.h>
#include <lacuna/quads/shared/measure_plane.h>

#include <cstdint>
#include <span>
#include <vector>

namespace lacuna::quads::paving {

/// How good quads are, to choose between two attempts; higher is better, 3.325 at most.
///
/// The sum of the mean and the least scaled Jacobian, the shares of right sizes and of right row heights,
/// less the share of irregular nodes, those on the boundary among them. The least one counts double up to
/// kGood, for a sweep repeats the worst quad and makes it worse, and half up to kBest, above which smoothing
/// gets it anyway. The outline, not the number of quads, says how many irregular nodes there must be: below
/// kFewNodes their share is taken of that many. The weights are choices.
double score_of(const PlaneQuality& quality);

/// A place for a message: "(0.5, 1.25)".
std::string position_text(const Vec2& p);

/// Paves a region in several ways and keeps the best attempt by measure.
class AttemptChooser {
public:
    /// @param region, context  kept by reference.
    /// @param cut  whether a symmetric region may be filled by images of a part of it.
    AttemptChooser(const PlanarRegion& region, const PaveOptions& options, const RunContext& context,
                   bool cut = true);

    /// All of the below, for as long as there is something to gain.
    void run();
    /// The grid of a region of right angles. Then, unless that is good, few quads by weights of their own
    /// without rows, and with rows. Then, unless that is good, rows in every style that is worth a trial,
    /// with the default weights.
    void try_default_weights();
    /// The score of a style with other weights of the cuts; nothing is kept.
    [[nodiscard]] double score_with(RowStyle style, const CutWeights& weights) const;
    /// The rows of `cut_weight_rows()`, as long as the region is small and there is something to gain; few
    /// quads only where they are poor.
    void try_all_weights();
    /// Triangles, where nothing else fills the region well.
    void try_triangles();

    [[nodiscard]] const Attempt& best() const { return best_; }
    [[nodiscard]] Attempt take_best() { return std::move(best_); }
    /// Of the best attempt: see `score_of()`; -2 before there is one.
    [[nodiscard]] double score() const { return best_score_; }
    /// Quads with a smaller sine count as folded.
    [[nodiscard]] double flat() const { return setting_.flat; }
    /// Whether nothing else need be tried.
    [[nodiscard]] bool is_done() const { return is_good_grid_; }

private:
    void consider(Attempt made);
    /// The grid of a region of right angles; unless that is good, images of a part between mirror axes and
    /// the grids of `fill_patterns()`, whichever are likelier to be good first.
    void try_grids();
    /// Keep quads of a coarser region, each cut in four, where they are good.
    /// @return whether nothing else need be tried.
    bool try_coarse();
    /// Keep images of a part about a block in the middle, where they are good and score no less than what is
    /// kept already. @return whether they were kept
    bool try_blocks();
    /// Those about one block, smoothed with it.
    [[nodiscard]] Attempt fill_about(const CentralBlock& block) const;
    /// The part between mirror axes, where there are any, with nodes on them.
    [[nodiscard]] std::optional<MirrorPart> part_of_region() const;
    /// Keep images of a part where they are good, else add them to the grids.
    /// @param few  whether given sides decide the sizes of quads.
    /// @return whether they were kept.
    bool try_part(const MirrorPart& part, bool few, std::vector<Attempt>& grids);
    /// Images of that part's quads.
    [[nodiscard]] Attempt fill_part(const MirrorPart& part) const;
    void try_few_weights();
    /// Finish an attempt that was begun, unless an equal one was before, and consider it.
    void finish(Attempt begun);
    void pave_in(RowStyle style);
    [[nodiscard]] Attempt begin(RowStyle style, const CutWeights& weights = {}) const;
    /// Finish an attempt in place.
    void complete(Attempt& attempt) const;
    struct Judged {
        double score;
        PlaneQuality quality; ///< not measured of quads that count as folded
    };
    /// The score of an attempt; one with a fault is marked as such.
    Judged judge_score(Attempt& made) const;
    [[nodiscard]] bool is_small() const;
    [[nodiscard]] bool is_good_enough() const;

    const PlanarRegion& region_;
    PlanarRegion judged_; ///< the region with the size that its given sides allow
    bool grids_;          ///< the region may be filled by one grid
    const RunContext& context_;
    bool cut_;
    int least_irregular_; ///< that topology allows
    bool is_few_;         ///< quads, about
    bool few_graded_;     ///< so few that given sides decide their sizes
    AttemptSetting setting_;
    Attempt best_;
    double best_score_ = -2;
    std::size_t made_ = 0;                ///< quads, in all attempts
    std::vector<std::uint64_t> finished_; ///< names of the attempts as they began
    bool is_good_grid_ = false;
    bool is_near_least_ = false; ///< the best attempt
};

/// The rows of weights that small regions are also cut with, in the order they are tried.
std::span<const CutWeights> cut_weight_rows();

/// Below what sine a quad counts as folded: no sweep bears a flatter one, unless the given corners are that
/// sharp.
double flat_below(const PlanarRegion& region);

} // namespace lacuna::quads::paving
