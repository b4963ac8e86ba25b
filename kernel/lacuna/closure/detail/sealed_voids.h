// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/readings.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace lacuna::closure {

/// A reading of the given faces, sealed.
struct Sealed : SealedVolume {
    double enclosed = 0; ///< [model length³]
};

/// One void, and the readings that enclose it.
struct Void {
    double cost = 0;                           ///< of its likeliest reading, and of what closing bends
    topology::RoleCandidate first;             ///< by which it was sealed
    Sealed sealed;                             ///< as that seals it
    std::vector<topology::RoleCandidate> ways; ///< the likeliest first
    std::vector<topology::RoleCandidate> bent; ///< others, by which it would bend as nothing given tells
    bool untold = false;                       ///< whether a void face bends as nothing given tells
    bool fills_flat_loops = false;             ///< all that is missing
    FaceId through;                            ///< an end that was moved with its holes without walls
    bool channel = false;                      ///< whether it was sealed by two ends that are alike
    std::string filled;                        ///< how it was sealed where that was by no roles, in words
};

/// Some faces sealed by their roles; nothing where that cannot be done.
/// @throw Cancelled
std::optional<Sealed> seal(const topology::Model& model, const topology::Roles& roles,
                           const RunContext& context);

/// Whether volumes are about as large: what chords leave out of round faces, and more, is no difference.
bool same_volume(double a, double b);

/// Whether a void face leaves open how its inside bends.
bool has_membranes(const Sealed& sealed);

/// Whether what is missing may bend otherwise: a void face leaves open how its inside does, or an end that
/// lies in no plane was closed without anything that says how it bends.
bool leaves_open(const Sealed& sealed);

/// The faces of the model in the order that a volume with these roles has them.
std::vector<FaceId> as_named(const topology::Roles& roles);

/// Readings of the given faces, sealed and sorted by what they enclose.
/// @param most  as many are sealed
std::vector<Void> voids(const topology::Model& model, const std::vector<topology::RoleCandidate>& candidates,
                        std::size_t most, const RunContext& context);

/// Take the voids that a given end tells when it is moved to where the other is missing: where readings found
/// one of these that stays, else the moved ones do.
void take_moved(const topology::Model& model, const std::vector<FaceId>& faces, std::vector<Void>& found,
                const RunContext& context);

/// Add a void that flat faces close, unless it is one of those known: then that is closed by the fewer faces.
/// Only those about as likely as the likeliest stay.
void add_filled(std::vector<Void>& found, Void filled);

} // namespace lacuna::closure
