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

/// Quality score for choosing between two attempts; higher is better, and 3.325 is the maximum.
///
/// The score is the sum of: the mean scaled Jacobian; twice the minimum scaled Jacobian up to kGood, and half
/// of it from there to kBest; half the share of sides of right size; and half the share of rows of right
/// height. Twice the share of irregular nodes, including those on the boundary, is subtracted. The minimum
/// counts most because a sweep repeats the worst quad and makes it worse; above kBest, smoothing reaches it
/// anyway. The number of irregular nodes depends on the outline and not on the number of quads, so their
/// share refers to at least kFewNodes nodes. A larger weight favours its term at the cost of the others.
double score_of(const PlaneQuality& quality);

/// A place as text for a message: "(0.5, 1.25)".
std::string position_text(const Vec2& p);

/// Paves a region in several ways and keeps the attempt of best measured quality.
class AttemptChooser {
public:
    /// @param region, context  kept by reference.
    /// @param cut  whether a symmetric region may be filled by images of a part.
    AttemptChooser(const PlanarRegion& region, const PaveOptions& options, const RunContext& context,
                   bool cut = true);

    /// Run all steps below until a further one cannot improve the result.
    void run();
    /// Try grids, then, with many quads, the quads of a coarser region, each cut in four. If neither is good:
    /// with few quads, pave without rows with the weights for few quads, and with rows with the first of
    /// `cut_weight_rows()`. If the result is poor, or there are more quads, pave with the default weights:
    /// with rows, then without rows if that failed or if the region is small and not yet good enough.
    void try_default_weights();
    /// The score of a style with other cut weights; the attempt is not kept.
    [[nodiscard]] double score_with(RowStyle style, const CutWeights& weights) const;
    /// Try the weights of `cut_weight_rows()` while the region is small and the score can still improve. With
    /// few quads this is done only if the best mesh is poor.
    void try_all_weights();
    /// Try triangles if nothing else fills the region well.
    void try_triangles();

    [[nodiscard]] const Attempt& best() const { return best_; }
    [[nodiscard]] Attempt take_best() { return std::move(best_); }
    /// Score of the best attempt, see `score_of()`; -2 before there is one.
    [[nodiscard]] double score() const { return best_score_; }
    /// Quads with a smaller sine count as folded [-].
    [[nodiscard]] double flat() const { return setting_.flat; }
    /// Whether no further attempt is needed.
    [[nodiscard]] bool is_done() const { return is_good_grid_; }

private:
    void consider(Attempt made);
    /// Try the grid of a rectilinear region. If it is not good, try images of a part between mirror axes and
    /// the grids of `fill_patterns()`, the more promising of the two first.
    void try_grids();
    /// Keep the quads of a coarser region, each cut in four, if they are good.
    /// @return whether no further attempt is needed.
    bool try_coarse();
    /// Keep images of a part around a central block if they are good and score at least as high as the best
    /// attempt. @return whether they were kept
    bool try_blocks();
    /// Images of a part around one block, smoothed together with the block.
    [[nodiscard]] Attempt fill_about(const CentralBlock& block) const;
    /// The part between mirror axes, with nodes on them; empty if there are no axes.
    [[nodiscard]] std::optional<MirrorPart> part_of_region() const;
    /// Keep images of a part if they are good; otherwise add them to `grids`.
    /// @param few  whether there are so few quads that the given sides determine their sizes.
    bool try_part(const MirrorPart& part, bool few, std::vector<Attempt>& grids);
    /// Images of the quads of a part.
    [[nodiscard]] Attempt fill_part(const MirrorPart& part) const;
    void try_few_weights();
    /// Finish an attempt and compare it with the best one, unless an identical attempt was finished before.
    void finish(Attempt begun);
    void pave_in(RowStyle style);
    [[nodiscard]] Attempt begin(RowStyle style, const CutWeights& weights = {}) const;
    /// Finish an attempt in place.
    void complete(Attempt& attempt) const;
    struct Judged {
        double score;
        PlaneQuality quality; ///< not measured if quads count as folded
    };
    /// The score of an attempt. If its mesh has a fault, `made.worst` is set to -1.
    Judged judge_score(Attempt& made) const;
    [[nodiscard]] bool is_small() const;
    [[nodiscard]] bool is_good_enough() const;

    const PlanarRegion& region_;
    PlanarRegion judged_; ///< the region with the size that its given sides allow
    bool grids_;          ///< whether one grid may fill the region
    const RunContext& context_;
    bool cut_;
    int least_irregular_; ///< least number of irregular nodes that topology allows
    bool is_few_;         ///< whether there are few quads, by estimate
    bool few_graded_;     ///< whether there are so few quads that the given sides determine their sizes
    AttemptSetting setting_;
    Attempt best_;
    double best_score_ = -2;
    std::size_t made_ = 0;                ///< quads made in all attempts together
    std::vector<std::uint64_t> finished_; ///< hashes of the attempts before they were finished
    bool is_good_grid_ = false;
    bool is_near_least_ = false; ///< whether the best attempt has nearly the least number of irregular nodes
};

/// The sets of weights with which small regions are also cut, in the order of trial.
std::span<const CutWeights> cut_weight_rows();

/// A quad counts as folded if the smallest sine of its corners is below this value: a sweep cannot use a
/// flatter quad. The value is lower if given corners are that sharp.
double flat_below(const PlanarRegion& region);

} // namespace lacuna::quads::paving
