// SPDX-License-Identifier: MIT
#pragma once

/// Trial of fillings for patches.

#include <lacuna/quads/detail/clean_patch.h>
#include <lacuna/quads/detail/patch_template.h>
#include <lacuna/quads/shared/smooth_plane.h>

#include <span>
#include <vector>

namespace lacuna::quads::cleaning {

/// What became of a filling.
enum class Verdict {
    hopeless, ///< given up early
    poor,     ///< smoothed with its surroundings, and not good
    good      ///< put into the mesh; the patch is gone
};

/// Smooths fillings of one patch after the other with their surroundings, and puts the good ones into the
/// mesh.
class Trial {
public:
    /// @param mesh, options  kept by reference
    Trial(CleanMesh& mesh, const CleanOptions& options);

    /// Set the patch the next fillings are for, and the quads around it that are smoothed with it.
    /// Both are kept by reference.
    void set_patch(const QuadPatch& patch, std::span<const Index> around);

    /// Put a filling in the patch's place if it is good.
    ///
    /// It is judged three times: as it is, after a few sweeps over its own points, and smoothed together with
    /// its surroundings.
    /// @param hopeless  given up in the first two where the loss is more than so many times the allowed one
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
    // Of the patch.
    const QuadPatch* patch_ = nullptr;
    std::span<const Index> around_;
    double loss_ = 0, loss_around_ = 0;
    double least_ = 1; ///< scaled Jacobian of the patch and around
    Index worst_ = -1; ///< quad around
    // Of the filling.
    std::vector<Vec2> points_, inner_;
    std::vector<Quad> quads_;
    Marks in_reach_;                      ///< quads of the patch and around
    Numbers number_;                      ///< in `points_`
    std::vector<Index> staying_, moving_; ///< points of the patch's loop and around
};

} // namespace lacuna::quads::cleaning
