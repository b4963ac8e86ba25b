// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/readings.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace lacuna::closure {

/// A sealed role candidate of the given faces.
struct Sealed : SealedVolume {
    double enclosed = 0; ///< [model length³]
};

/// One void, and the role candidates that enclose it.
struct Void {
    /// Cost of the void: that of its likeliest candidate, plus the cost of bent void faces.
    double cost = 0;
    topology::RoleCandidate first;             ///< the candidate that `sealed` was sealed with
    Sealed sealed;                             ///< the result of sealing with `first`
    std::vector<topology::RoleCandidate> ways; ///< candidates that enclose this void, likeliest first
    std::vector<topology::RoleCandidate> bent; ///< candidates that enclose this void too, but with an
                                               ///< ambiguous bend
    bool untold = false;                       ///< whether the bend of a void face is ambiguous, see
                                               ///< `guess_of_bent()`
    bool fills_flat_loops = false;             ///< whether a candidate only fills flat free loops
    /// A given end that was moved to the missing end together with its holes without walls; invalid if there
    /// is none.
    FaceId through;
    std::string filled; ///< how it was sealed, in words for the user; empty if by a role candidate
};

/// Whether a sealed volume is one that the given faces may enclose.
using MayEnclose = std::function<bool(const topology::Model& sealed)>;

/// Some faces sealed with given roles; empty if that fails.
/// @throw Cancelled
std::optional<Sealed> seal(const topology::Model& model, const topology::Roles& roles,
                           const MayEnclose& may_enclose, const RunContext& context);

/// Whether two volumes are equal within a tolerance. The tolerance exceeds the effect of the facets' sag.
bool same_volume(double a, double b);

/// The candidates, sealed and grouped by the volume they enclose.
/// @param most  largest number of candidates to seal
std::vector<Void> voids(const topology::Model& model, const std::vector<topology::RoleCandidate>& candidates,
                        std::size_t most, const MayEnclose& may_enclose, const RunContext& context);

/// Combine the voids found so far with those that are sealed by moving a given end to the missing one
/// (`move_ends()`). The first rule that applies:
/// 1. If there is no void with a moved end, nothing changes.
/// 2. If voids were found in both ways, only these are kept.
/// 3. If no rim without walls was extended, the voids with a moved end replace all others.
/// 4. Otherwise they are added to the others.
void take_moved(const topology::Model& model, const std::vector<FaceId>& faces, std::vector<Void>& found,
                const RunContext& context);

/// Add a void that was closed without a role candidate. If the same void is known already, the new closing
/// replaces an ambiguous one or one with more void faces. Afterwards only voids that are about as likely as
/// the best remain.
void add_filled(std::vector<Void>& found, Void filled);

} // namespace lacuna::closure
