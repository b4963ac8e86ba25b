// SPDX-License-Identifier: MIT
#pragma once

/// Trying out fillings of patches.

#include <lacuna/quads/detail/clean_patch.h>
#include <lacuna/quads/detail/patch_template.h>
#include <lacuna/quads/detail/smooth_plane.h>

#include <span>
#include <vector>

namespace lacuna::quads::cleaning {

/// Result of a trial.
enum class Verdict {
    hopeless, ///< rejected before the filling was smoothed with its surroundings
    poor,     ///< rejected after the filling was smoothed with its surroundings
    good      ///< accepted: the filling has replaced the quads of the patch
};

/// Smooths fillings of one patch with their surroundings, one after the other, and puts a good one into the
/// mesh.
class Trial {
public:
    /// @param mesh, options  kept by reference
    Trial(CleanMesh& mesh, const CleanOptions& options);

    /// Set the patch to which the next fillings belong, and the surrounding quads that are smoothed with each
    /// filling. Both are kept by reference.
    void set_patch(const QuadPatch& patch, std::span<const Index> around);

    /// Put a filling into the mesh in place of the patch, if the filling is good.
    ///
    /// The filling is tested three times: before smoothing, after some smoothing sweeps over its own points,
    /// and after it is smoothed together with its surroundings.
    /// @param sweeps    number of smoothing sweeps
    /// @param hopeless  the first two tests reject a filling whose loss exceeds this multiple of the allowed
    ///                  loss
    Verdict run(const TemplateMesh& filling, int sweeps, double hopeless);

private:
    bool settles(const TemplateMesh& filling, int sweeps, double most);
    bool exceeds(std::size_t filled, double most) const;
    void number_points();
    bool fits(const TemplateMesh& filling, double allowed);
    void put_in(const TemplateMesh& filling);

    CleanMesh& mesh_;
    const CleanOptions& options_;
    SmoothPlaneOptions smoothing_;
    // For the current patch:
    const QuadPatch* patch_ = nullptr;
    std::span<const Index> around_;
    double loss_ = 0, loss_around_ = 0;
    double least_ = 1; ///< least scaled Jacobian of the patch and its surroundings
    Index worst_ = -1; ///< the worst quad of the surroundings
    // For the current filling:
    std::vector<Vec2> points_, inner_;
    std::vector<Quad> quads_;
    Marks in_reach_;                      ///< quads of the patch and its surroundings
    Numbers number_;                      ///< number of each point in `points_`
    std::vector<Index> staying_, moving_; ///< points of the patch's loop and its surroundings
};

} // namespace lacuna::quads::cleaning
