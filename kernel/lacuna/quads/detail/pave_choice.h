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

/// Score by which the better of two attempts is chosen. Higher is better, and the maximum is 3.325.
///
/// The score is the sum of these terms:
/// - the mean scaled Jacobian;
/// - twice the minimum scaled Jacobian up to kGood, and half of the part between kGood and kBest;
/// - half the share of sides that have the requested size;
/// - half the share of rows that have the requested height;
/// - minus twice the share of irregular nodes, including those on the boundary. Their number depends on the
///   outline, not on the number of quads, so the share refers to at least kFewNodes nodes.
///
/// The minimum counts most, because a sweep repeats the worst quad in every layer and makes it worse. The
/// part above kBest does not count, because smoothing alone reaches such values.
double score_of(const PlaneQuality& quality);

/// A position as text for a message: "(0.5, 1.25)".
std::string position_text(const Vec2& p);

/// Paves a region in several ways and keeps the attempt with the best score.
class AttemptChooser {
public:
    /// @param region, context  kept by reference.
    /// @param cut  whether a symmetric region may be filled by the images of one part.
    AttemptChooser(const PlanarRegion& region, const PaveOptions& options, const RunContext& context,
                   bool cut = true);

    /// Run all steps below until a further one cannot improve the result.
    void run();
    /// Try these meshes in turn until one is good:
    /// 1. grids;
    /// 2. for many quads: the quads of a coarser region, each cut in four;
    /// 3. for few quads: paving without rows, with the weights for few quads; and paving with rows, with the
    ///    first weights of `cut_weight_rows()`;
    /// 4. unless step 3 gave a good mesh: paving with rows and the default weights;
    /// 5. if step 4 failed, or the region is small and the mesh not good enough: paving without rows.
    void try_default_weights();
    /// The score of a row style with other cut weights. The attempt is not kept.
    [[nodiscard]] double score_with(RowStyle style, const CutWeights& weights) const;
    /// Try the weights of `cut_weight_rows()` as long as the region is small and the score can still improve.
    /// With few quads, or if the outline sets most irregular nodes, do so only if the best mesh is poor.
    void try_all_weights();
    /// Try triangles if no other method fills the region well.
    void try_triangles();

    [[nodiscard]] const Attempt& best() const { return best_; }
    [[nodiscard]] Attempt take_best() { return std::move(best_); }
    /// Score of the best attempt, see `score_of()`; -2 if there is no attempt yet.
    [[nodiscard]] double score() const { return best_score_; }
    /// A quad counts as folded if the sine of a corner is smaller than this [-].
    [[nodiscard]] double flat() const { return setting_.flat; }
    /// Whether no further attempt is needed.
    [[nodiscard]] bool is_done() const { return is_good_grid_; }

private:
    void consider(Attempt made);
    /// Try the grid of a rectilinear region. If it is not good, try the images of a part between mirror axes,
    /// and the grids of `fill_patterns()`. The more promising of these two comes first.
    void try_grids();
    /// Keep the quads of a coarser region, each cut in four, if they are good.
    /// @return whether no further attempt is needed.
    bool try_coarse();
    /// Try the images of a part around a central block. Keep them if they are good and score at least as high
    /// as the best attempt. @return whether they were kept
    bool try_blocks();
    /// The images of a part around one block, smoothed together with the block.
    [[nodiscard]] Attempt fill_about(const CentralBlock& block) const;
    /// The part of the region between mirror axes, with nodes on the axes. Empty if there are no axes.
    [[nodiscard]] std::optional<MirrorPart> part_of_region() const;
    /// Fill the region with the images of a part. Keep this attempt as the best one if it is good; otherwise
    /// add it to `grids`.
    /// @param few  whether there are so few quads that the given sides determine their sizes.
    /// @return whether the attempt was kept
    bool try_part(const MirrorPart& part, bool few, std::vector<Attempt>& grids);
    /// The images of the quads of a part.
    [[nodiscard]] Attempt fill_part(const MirrorPart& part) const;
    void try_few_weights();
    /// Finish an attempt and compare it with the best attempt. An attempt identical to an earlier one is
    /// skipped.
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

    const PlanarRegion& region_;
    PlanarRegion judged_; ///< the region with the size that its given sides permit
    bool grids_;          ///< whether one grid may fill the region
    const RunContext& context_;
    bool cut_;
    int least_irregular_; ///< least number of irregular nodes that topology permits
    bool is_few_;         ///< whether there are few quads, by estimate
    bool few_graded_;     ///< whether there are so few quads that the given sides determine their sizes
    AttemptSetting setting_;
    Attempt best_;
    double best_score_ = -2;
    std::vector<std::uint64_t> finished_; ///< hashes of the attempts before they were finished
    bool is_good_grid_ = false;
    bool is_near_least_ = false; ///< whether the best attempt has nearly the least number of irregular nodes
    /// Whether the best attempt has few irregular nodes beside those that topology demands, as between many
    /// holes. Other cuts then only move them.
    bool is_set_by_outline_ = false;
};

/// The sets of weights with which small regions are also cut, in the order of trial.
std::span<const CutWeights> cut_weight_rows();

/// A quad counts as folded if the smallest sine of its corners is below this value, because a sweep cannot
/// use a flatter quad. The value is lower if given corners are so sharp.
double flat_below(const PlanarRegion& region);

} // namespace lacuna::quads::paving
