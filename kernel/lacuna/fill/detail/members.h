// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/shared/partition.h>
#include <lacuna/closure/shared/steps.h>
#include <lacuna/core/error.h>
#include <lacuna/fill.h>

#include <string>
#include <vector>

namespace lacuna::fill {

/// Refuse a volume for which no ends to sweep between were found.
/// @throw InvalidInput  `Volume::no_roles`, the reason.
void require_roles(const Volume& volume);

/// The message that a volume cannot be swept. Its remedy also names the option that fills the volume with
/// tetrahedra.
Message with_tets_as_remedy(const Message& why, const sweep::SweepOptions& options);

/// Run a sweep. @throw NotSweepable  the error of the sweep, with the remedy of `with_tets_as_remedy()`
template <class Do>
auto sweep_or_name_tets(const sweep::SweepOptions& options, const Do& sweep)
{
    try {
        return sweep();
    } catch (const NotSweepable& error) {
        throw NotSweepable(with_tets_as_remedy(error.message(), options));
    }
}

/// Change the options so that the mesh keeps the middle nodes that the decks of a volume contain.
void keep_given_middles(const Volume& volume, sweep::SecondOrderOptions& options);

/// Divide the rounds (fillets) by which the walls of a volume blend smoothly into an end, see
/// `closure::split_round_rims()`. The volume is unchanged if it has no such rounds, or if the user matched or
/// closed it.
Volume with_rims_divided(const Volume& volume, const RunContext& context);

/// Note the given faces that pieces do not contain as faces of their own, because cutting joined them with
/// the walls beside them.
void note_joined(const topology::Model& whole, const std::vector<closure::StepPiece>& pieces,
                 const RunContext& context);

/// Close a volume and check that it has a source and a target.
/// @param region  name of the region, for messages.
Volume close_to_sweep(const Volume& volume, const std::string& region, const RunContext& context);

/// The same volume with the roles of an alternative sweep of its void. @pre number < others->ways.size()
Volume with_other_sweep(const Volume& volume, std::size_t number);

/// Seal a volume that is to be cut or filled. If the bottom of a hollow blends smoothly into its walls,
/// bottom and walls are not split from each other, because only a sweep needs this split. A full-turn ring is
/// returned unchanged.
Volume sealed_whole(const Volume& volume, const RunContext& context);

/// Make a piece of a cut volume a volume of its own. It inherits the settings of the whole.
Volume piece_of(const Volume& whole, closure::StepPiece piece, const std::string& name);

/// Open faces that replace a volume, or a piece of one, with its name and settings. Nothing is logged: the
/// notes on these faces were logged for the volume.
Volume open_anew(const Volume& volume, const topology::Model& model, RoleRequest request,
                 const RunContext& context);

/// Whether a volume must be swept in pieces, see `cut_into_pieces()`.
bool has_pieces(const Volume& volume, const RunContext& context);
/// The pieces of a volume: those of `closure::cut_into_pieces()` or, for class 0, the halves of a full turn.
std::vector<closure::StepPiece> cut_into_pieces(const Volume& volume, const RunContext& context);

/// Call `take` with partitions of a sealed volume, made by `closure::partitions()`, until `take` returns
/// true.
void partitions(const topology::OpenVolume& sealed, const closure::TakePieces& take,
                const RunContext& context);

/// The share of the pieces' volume that is in pieces with ends; exactly 1 if all have ends.
double swept_share(const std::vector<closure::StepPiece>& pieces);

/// A partition of a volume that no single sweep fills, of which every piece can be swept; it was meshed.
/// Empty if there is none.
/// @param why  why the volume cannot be swept
std::vector<closure::StepPiece> swept_pieces(const Volume& volume, const Message& why,
                                              const sweep::SweepOptions& options, const RunContext& context);

/// Whether a volume that no single sweep fills may be cut. Ends that the user named are replaced by ends of
/// pieces only if the fallback is `mixed`.
bool may_cut(const Volume& volume, bool mixed);

/// Sweep the pieces of one volume as an assembly.
FilledParts sweep_pieces(const Volume& volume, std::vector<closure::StepPiece> pieces,
                         const sweep::SweepOptions& options, const RunContext& context);

/// Close a volume and sweep it as an assembly of one member, because periodic faces need an assembly.
Filled sweep_as_assembly(const Volume& volume, const sweep::SweepOptions& options, const RunContext& context);

/// Fill one sealed volume with tetrahedra. @pre it has `no_roles`, and the fallback is `mixed`.
FilledParts fill_alone(const Member& member, const RunContext& context);

/// Report the faces of the file that are missing next to the volume and, after closing, the void faces that
/// replace them: one line for each.
void report_left_out(const Volume& volume, std::vector<std::string>& report);

} // namespace lacuna::fill
