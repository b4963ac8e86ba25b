// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/readings.h>

#include <cstddef>
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
    /// Cost of its likeliest candidate, plus the cost of bent void faces.
    double cost = 0;
    topology::RoleCandidate first;             ///< the candidate that `sealed` was sealed with
    Sealed sealed;                             ///< the result of sealing with `first`
    std::vector<topology::RoleCandidate> ways; ///< role candidates, the likeliest first
    std::vector<topology::RoleCandidate> bent; ///< other candidates, which would need an ambiguous bend
    bool untold = false;                       ///< whether the rims of a void face do not determine its bend
    bool fills_flat_loops = false;             ///< whether a candidate fills only flat free loops
    /// An end that was moved together with its holes without walls; invalid if there is none.
    FaceId through;
    bool channel = false; ///< sealed by two congruent ends
    std::string filled;   ///< how it was sealed without roles, in words for the user
};

/// Some faces sealed with given roles; empty if that fails.
/// @throw Cancelled
std::optional<Sealed> seal(const topology::Model& model, const topology::Roles& roles,
                           const RunContext& context);

/// Whether volumes are equal within a tolerance that exceeds the effect of the facets' sag.
bool same_volume(double a, double b);

/// The candidates, sealed and grouped by the volume they enclose.
/// @param most  largest number of candidates to seal
std::vector<Void> voids(const topology::Model& model, const std::vector<topology::RoleCandidate>& candidates,
                        std::size_t most, const RunContext& context);

/// Use the voids that are sealed by moving a given end to the missing one (`move_ends()`). Voids that role
/// candidates found too are kept alone. If there are none, the voids with a moved end replace all others, or
/// are added to them if a rim without walls was extended.
void take_moved(const topology::Model& model, const std::vector<FaceId>& faces, std::vector<Void>& found,
                const RunContext& context);

/// Add a void closed by flat faces. If the same void is known already, the closing with fewer faces is kept.
/// Afterwards only voids that are about as likely as the best remain.
void add_filled(std::vector<Void>& found, Void filled);

} // namespace lacuna::closure
