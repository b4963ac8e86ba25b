// SPDX-License-Identifier: MIT
#include <lacuna/closure/shared/partition.h>

#include <lacuna/closure/close.h>
#include <lacuna/closure/detail/bowl.h>
#include <lacuna/closure/detail/cut_planes.h>
#include <lacuna/closure/detail/divide.h>
#include <lacuna/closure/detail/pieces.h>
#include <lacuna/closure/detail/turns.h>
#include <lacuna/closure/detail/void_sweeps.h>
#include <lacuna/closure/shared/branches.h>
#include <lacuna/closure/shared/cut.h>
#include <lacuna/closure/shared/piece_ends.h>
#include <lacuna/closure/shared/round_rims.h>
#include <lacuna/closure/shared/steps.h>
#include <lacuna/core/shared/attempt.h>
#include <lacuna/core/shared/constants.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/topology/shared/face_parts.h>
#include <lacuna/topology/shared/face_plane.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <optional>
#include <tuple>
#include <utility>

namespace lacuna::closure {

using namespace topology;

namespace {

/// Largest number of trial cuts, and of pieces. With these limits, a volume with hundreds of features takes
/// seconds.
constexpr std::size_t kMostCuts = 200, kMostPieces = 64;

/// A piece of the volume. Its bends and the length left to cut matter only if it has no ends.
struct CutPart {
    StepPiece piece;
    std::vector<Bend> bends;
    double left = 0;       ///< [model length]
    bool has_cusp = false; ///< whether a bent face meets another face at an interior angle below
                           ///< kCreaseAngle, such as a fillet and its tangent plane
    bool has_ends = false;
    std::vector<StepPiece> blocks{}; ///< blocks into which the piece is divided; empty if it is not divided
};

CutPart part_of(StepPiece piece, const RunContext& context)
{
    const SkinTurns turns = skin_turns(piece.volume, context);
    const Model& model = piece.volume.model;
    bool has_cusp = false;
    for (std::size_t e = 0; e < turns.concave.size(); ++e)
        has_cusp = has_cusp || (turns.concave[e] < kCreaseAngle - 180 &&
                                std::ranges::any_of(model.uses_of_edge(EdgeId(e)), [&](const FaceUse& use) {
                                    return !plane_of(model, use.face);
                                }));
    std::vector<Bend> bends = bends_of(model, turns);
    const double left = length_to_cut(bends);
    return {std::move(piece), std::move(bends), left, has_cusp};
}

/// Whether an end has a step at a wall that a cut made: a concave edge of more than 60° between two faces of
/// the end, which meets this wall. The adjacent piece could not continue the rows of quads beside the step.
bool has_stepped_end(const OpenVolume& volume, const RunContext& context)
{
    const Model& model = volume.model;
    std::vector<bool> at_cut(model.vertices.size(), false);
    for (const FaceId face : volume.faces(Role::wall)) {
        if (model[face].origin != Origin::made_void) continue;
        for (const EdgeUse& use : uses_of(model[face])) at_cut[use_from(model, use).index()] = true;
    }
    const std::vector<double> turns = concave_turns(volume, context);
    for (std::size_t e = 0; e < turns.size(); ++e) {
        const Edge& edge = model[EdgeId(e)];
        if (!(turns[e] > 2 * kCreaseAngle) || !(at_cut[edge.from.index()] || at_cut[edge.to.index()]))
            continue;
        const std::span<const FaceUse> uses = model.uses_of_edge(EdgeId(e));
        const Role role = volume.role[uses[0].face.index()];
        if (role != Role::wall && role == volume.role[uses[1].face.index()]) return true;
    }
    return false;
}

/// Divide a part without ends at its middle or, if no length is left to cut, at an edge between coplanar
/// faces, where smooth parts of its skin turn over, at the centre of a sphere or apex of a cone, or at
/// vertices.
/// @return  the number of additional pieces
std::size_t divide(CutPart& part, std::size_t most, const CanSweep& can_sweep, const RunContext& context)
{
    std::ranges::fill(part.piece.volume.role, Role::wall);
    part.blocks = divided_at_middle(part.piece.volume, most, can_sweep, context);
    if (part.blocks.empty() && !(part.left > 0))
        part.blocks = divided_at_flat_edge(part.piece.volume, most, can_sweep, context);
    if (part.blocks.empty() && !(part.left > 0))
        part.blocks = divided_where_turning(part.piece.volume, most, can_sweep, context);
    if (part.blocks.empty() && !(part.left > 0))
        part.blocks = divided_at_centre(part.piece.volume, most, can_sweep, context);
    if (part.blocks.empty() && !(part.left > 0))
        part.blocks = divided_at_vertices(part.piece.volume, most, can_sweep, context);
    return part.blocks.empty() ? 0 : part.blocks.size() - 1;
}

/// The pieces of one cut, and the length that is left to cut.
struct CutTried {
    std::vector<CutPart> parts;
    double left = 0;               ///< length to cut in pieces without ends [model length]
    std::vector<double> volumes{}; ///< of the pieces, ascending [model length³]
};

/// Cut a piece by each of its `cut_planes()`. Cuts that make a cusp (`CutPart::has_cusp`) are left out. The
/// cuts that leave the least length to cut come first. Of cuts that leave the same length in pieces of the
/// same volumes, only one is returned. Examples: cuts by coplanar faces, cuts that are images of each other.
/// @param whole  false: all planes are used, and a plane with a list of edges cuts only in regions that
///         adjoin these edges. True: only planes with a list of edges are used, and they cut in all regions.
std::vector<CutTried> try_cuts(const CutPart& part, double least, bool whole, std::size_t& tried,
                               const RunContext& context)
{
    const OpenVolume& volume = part.piece.volume;
    std::vector<CutTried> cuts;
    for (auto& [plane, edges] : cut_planes(volume, part.bends, kMostTrials)) {
        if (tried == kMostCuts) break;
        if (whole && edges.empty()) continue;
        if (whole) edges.clear();
        ++tried;
        // A cut is refused if the plane crosses given quads, passes an edge closely, or leaves the volume in
        // one piece.
        auto pieces = unless_refused([&] { return cut_at_edges(volume, plane, edges, least, context); });
        if (!pieces || pieces->size() < 2) continue;
        CutTried cut;
        for (StepPiece& piece : *pieces) {
            cut.volumes.push_back(enclosed_volume(piece.volume));
            cut.parts.push_back(part_of(std::move(piece), context));
            cut.left += cut.parts.back().left;
        }
        std::ranges::sort(cut.volumes);
        if (part.has_cusp || std::ranges::none_of(cut.parts, &CutPart::has_cusp))
            cuts.push_back(std::move(cut));
    }
    std::ranges::stable_sort(cuts, {}, &CutTried::left);
    const auto alike = [&](const CutTried& a, const CutTried& b) {
        return std::abs(a.left - b.left) <= kVisible * part.left &&
               std::ranges::equal(a.volumes, b.volumes, [](double own, double other) {
                   return std::abs(own - other) <= kVisible * std::max(own, other);
               });
    };
    std::vector<CutTried> unlike;
    for (CutTried& cut : cuts)
        if (std::ranges::none_of(unlike, [&](const CutTried& other) { return alike(cut, other); }))
            unlike.push_back(std::move(cut));
    return unlike;
}

/// The cuts that reduce the length to cut (`length_to_cut()`) of a piece, best first. Pieces that have ends
/// need no further cut, so their length is not counted. A cut into two pieces that both have ends cannot be
/// improved on and is returned alone.
std::vector<CutTried> best_cuts(const CutPart& part, double least, bool whole, std::size_t& tried,
                                const CanSweep& can_sweep, const RunContext& context)
{
    if (!(part.left > 0)) return {};
    std::vector<CutTried> cuts = try_cuts(part, least, whole, tried, context);
    if (cuts.size() > kMostTrials) cuts.resize(kMostTrials);
    const auto without_ends = [](const CutTried& cut) {
        return std::ranges::count(cut.parts, false, &CutPart::has_ends);
    };
    for (CutTried& cut : cuts) {
        cut.left = 0;
        for (CutPart& own : cut.parts) {
            own.has_ends = find_ends(own.piece, can_sweep, context);
            if (!own.has_ends) cut.left += own.left;
        }
        if (cut.parts.size() == 2 && without_ends(cut) == 0) { // no cut is better
            std::swap(cut, cuts.front());
            cuts.resize(1);
            return cuts;
        }
    }
    std::erase_if(cuts, [&](const CutTried& cut) { return !(cut.left < (1 - kFileAccuracy) * part.left); });
    std::ranges::stable_sort(cuts, {}, [&](const CutTried& cut) {
        return std::tuple(cut.left, without_ends(cut), cut.parts.size());
    });
    return cuts;
}

/// Cuts a volume and then its parts, as long as a cut reduces the length to cut in parts without ends.
class Cutter {
public:
    /// @param can_sweep  whether a part can be swept
    /// @param may_step  as `can_sweep`, for a part that no further cut improves: its ends may have steps
    /// @param can_sweep_block  whether a block of a divided part can be swept
    /// @param least  the least distance between a cut and an edge beside it
    Cutter(const CanSweep& can_sweep, const CanSweep& may_step, const CanSweep& can_sweep_block, double least,
           const RunContext& context)
        : can_sweep_(can_sweep),
          may_step_(may_step),
          can_sweep_block_(can_sweep_block),
          least_(least),
          context_(context)
    {
    }

    /// The cuts of a part without ends, best first.
    std::vector<CutTried> cuts_of(const CutPart& part)
    {
        check_cancelled(context_);
        if (tried_ >= kMostCuts || pieces_ >= kMostPieces) return {};
        std::vector<CutTried> cuts = best_cuts(part, least_, false, tried_, can_sweep_, context_);
        // If a plane is cut only on one side of a bore, the part stays in one piece; so whole planes are
        // tried next.
        if (cuts.empty()) cuts = best_cuts(part, least_, true, tried_, can_sweep_, context_);
        return cuts;
    }

    /// Cut the parts `made` from `part` further. @return all resulting parts; `part` alone if none of them
    /// has ends or was divided.
    std::vector<CutPart> cut_on(CutPart part, std::vector<CutPart> made)
    {
        if (pieces_ + made.size() > kMostPieces + 1) return {std::move(part)};
        pieces_ += made.size() - 1;
        std::vector<CutPart> all;
        for (CutPart& own : made) {
            std::vector<CutTried> cuts;
            if (!own.has_ends && own.left > 0) cuts = cuts_of(own);
            std::vector<CutPart> parts;
            if (cuts.empty())
                parts.push_back(std::move(own));
            else
                parts = cut_on(std::move(own), std::move(cuts.front().parts));
            if (CutPart& only = parts.front(); parts.size() == 1 && !only.has_ends) {
                only.has_ends = find_ends(only.piece, may_step_, context_);
                if (!only.has_ends && !(only.left > 0))
                    pieces_ += divide(only, kMostPieces + 1 - pieces_, can_sweep_block_, context_);
            }
            std::ranges::move(parts, std::back_inserter(all));
        }
        const auto helps = [](const CutPart& own) { return own.has_ends || !own.blocks.empty(); };
        if (std::ranges::none_of(all, helps)) {
            pieces_ -= all.size() - 1;
            return {std::move(part)};
        }
        return all;
    }

    /// Reset the number of pieces for another partition of the whole volume. The cuts tried so far still
    /// count towards `kMostCuts`.
    void start_again() { pieces_ = 1; }

private:
    const CanSweep &can_sweep_, &may_step_, &can_sweep_block_;
    double least_;
    const RunContext& context_;
    std::size_t tried_ = 0, pieces_ = 1;
};

/// Make the faces of a volume that face along an axis the target, those that face against it the source, and
/// all others walls.
void set_ends_along(OpenVolume& volume, const Vec3& axis)
{
    for (const FaceId face : all_faces(volume.model)) {
        const double along = face_area_vector(volume.model, face).dot(axis);
        const bool is_end = std::abs(along) >
                                std::cos(kCreaseAngle * kDegree) * face_area(volume.model, face) ||
                            is_end_with_walls(volume.model, face, axis);
        volume.role[face.index()] = !is_end ? Role::wall : along > 0 ? Role::target : Role::source;
    }
}

/// Divide the rounds at the rims of the ends of a volume (`split_round_rims()`).
/// @return  whether there are any, and the volume can be swept without them; if not, it is unchanged
bool divide_rounds(OpenVolume& volume, const CanSweep& can_sweep, const RunContext& context)
{
    OpenVolume divided = volume;
    split_round_rims(divided, RoundsOf::ends_and_walls, context);
    if (divided.model.faces.size() == volume.model.faces.size() || has_steps(divided, context) ||
        !can_sweep(divided))
        return false;
    volume = std::move(divided);
    return true;
}

/// The volume with ends along an axis (`set_ends_along()`), and with the rounds at their rims divided. The
/// axis is the first along which the volume has rounds and can be swept; empty if there is none.
std::optional<OpenVolume> with_rounds_divided(const OpenVolume& volume, const CanSweep& can_sweep,
                                              const RunContext& context)
{
    OpenVolume away = volume;
    face_away(away, context);
    for (const Vec3& axis : axes_of(away, true)) {
        check_cancelled(context);
        set_ends_along(away, axis);
        if (divide_rounds(away, can_sweep, context)) return away;
    }
    return std::nullopt;
}

/// Make ledges walls: faces of an end that lie between walls that lead on along the axis and walls that lead
/// back, such as the underside of a bottle's lip. @return whether there are any.
bool make_ledges_walls(OpenVolume& volume, const Vec3& axis)
{
    const Model& model = volume.model;
    const auto is_ledge = [&](FaceId face) {
        const Vec3 centre = face_centroid(model, face);
        bool on = false, back = false;
        for (const EdgeUse& use : uses_of(model[face]))
            for (const FaceUse& beside : model.uses_of_edge(use.edge)) {
                if (beside.face == face) continue;
                if (volume.role[beside.face.index()] != Role::wall) return false;
                const double rise = (face_centroid(model, beside.face) - centre).dot(axis);
                on |= rise > model.tolerance;
                back |= rise < -model.tolerance;
            }
        return on && back;
    };
    std::vector<FaceId> ledges;
    for (const FaceId face : all_faces(model))
        if (volume.role[face.index()] != Role::wall && is_ledge(face)) ledges.push_back(face);
    for (const FaceId face : ledges) volume.role[face.index()] = Role::wall;
    return !ledges.empty();
}

/// Pieces that a volume is cut into at once.
using Pieces = std::vector<StepPiece>;

/// Cut a volume at its branches and at the steps of its ends along an axis (`set_ends_along()`), such as foam
/// around a tilted product; if that fails, with ledges as walls, such as the underside of a bottle's lip.
/// @param take     called with pieces that can be swept, until it returns true
/// @param refused  receives the other pieces
/// @return  whether `take` accepted pieces
bool cut_in_steps(const OpenVolume& volume, const CanSweep& can_sweep, const TakePieces& take,
                  std::vector<Pieces>& refused, const RunContext& context)
{
    const auto suits = [&](const StepPiece& piece) {
        return has_ends(piece.volume) && can_sweep(piece.volume);
    };
    OpenVolume away = volume;
    face_away(away, context);
    const auto offer = [&](std::size_t least) {
        auto pieces = unless_refused([&] { return cut_into_pieces(away, context); });
        if (!pieces || pieces->size() < least) return false;
        if (std::ranges::all_of(*pieces, suits)) return take(std::move(*pieces));
        refused.push_back(std::move(*pieces));
        return false;
    };
    std::vector<Vec3> axes = axes_of(away, true);
    if (axes.size() > kMostTrials) axes.resize(kMostTrials);
    for (const Vec3& axis : axes) {
        check_cancelled(context);
        set_ends_along(away, axis);
        if (offer(2) || (make_ledges_walls(away, axis) && offer(1))) return true;
    }
    return false;
}

/// The pieces of a volume with a round bottom, cut at its branches; empty if it has neither.
Pieces cut_above_bottom(const OpenVolume& volume, const RunContext& context)
{
    OpenVolume away = volume;
    face_away(away, context);
    std::ranges::fill(away.role, Role::wall);
    const auto bowl = part_bowl(away, context);
    auto pieces = bowl ? unless_refused([&] { return cut_into_pieces(bowl->volume, context); })
                       : std::nullopt;
    return pieces && pieces->size() > 1 ? std::move(*pieces) : Pieces();
}

/// Change pieces of branches and steps so that they can be swept. Pieces that lack an end get other ends: an
/// end that the cut of a branch made is a wall of an arm that has steps, because the arm already had ends. A
/// branch may have a round bottom. Rounds at the rims of ends are divided.
/// @return  whether all pieces can be swept
bool change_to_sweep(Pieces& pieces, const CanSweep& can_sweep, const RunContext& context)
{
    if (!std::ranges::all_of(pieces, has_ends, &StepPiece::volume))
        pieces = read_ends(std::move(pieces), context).pieces;
    return std::ranges::all_of(pieces, [&](StepPiece& piece) {
        OpenVolume& volume = piece.volume;
        if (!has_ends(volume) && free_edges(volume).empty())
            if (auto bowl = part_bowl(volume, context)) volume = std::move(bowl->volume);
        return has_ends(volume) && (can_sweep(volume) || divide_rounds(volume, can_sweep, context));
    });
}

/// The pieces of a volume that was cut into parts: blocks of divided parts, and the other parts. If there are
/// several parts, those without ends that have length left to cut are divided at their middles where that is
/// possible.
std::vector<StepPiece> pieces_of(std::vector<CutPart> parts, const CanSweep& can_sweep,
                                 const RunContext& context)
{
    std::size_t count = 0;
    for (const CutPart& part : parts) count += std::max<std::size_t>(1, part.blocks.size());
    std::vector<StepPiece> pieces;
    for (CutPart& part : parts) {
        if (!part.has_ends && part.left > 0 && parts.size() > 1)
            count += divide(part, kMostPieces + 1 - std::min(kMostPieces, count), can_sweep, context);
        else if (!part.has_ends)
            std::ranges::fill(part.piece.volume.role, Role::wall);
        if (part.blocks.empty()) part.blocks.push_back(std::move(part.piece));
        std::ranges::move(part.blocks, std::back_inserter(pieces));
    }
    return pieces;
}

/// Tells partitions apart by the centroids of their pieces' skins: cuts that are made in another order may
/// divide a volume into the same pieces.
class KnownPartitions {
public:
    explicit KnownPartitions(double near) : near_(near) {}

    /// Whether pieces differ from those of each earlier call.
    bool is_new(const std::vector<StepPiece>& pieces)
    {
        std::vector<Vec3> own;
        for (const StepPiece& piece : pieces)
            own.push_back(centroid_of(piece.volume.model, all_faces(piece.volume.model)));
        const auto is_same = [&](const std::vector<Vec3>& other) {
            return other.size() == own.size() && std::ranges::all_of(own, [&](const Vec3& p) {
                       return std::ranges::any_of(other,
                                                  [&](const Vec3& q) { return (q - p).norm() <= near_; });
                   });
        };
        if (std::ranges::any_of(known_, is_same)) return false;
        known_.push_back(std::move(own));
        return true;
    }

private:
    double near_;
    std::vector<std::vector<Vec3>> known_;
};

} // namespace

bool has_ends(const OpenVolume& piece)
{
    return !piece.faces(Role::source).empty() && !piece.faces(Role::target).empty();
}

void partitions(const OpenVolume& volume, const CanSweep& can_sweep, double least, const TakePieces& take,
                const RunContext& context)
{
    const CanSweep may_step = [&](const OpenVolume& piece) {
        return ends_suit_columns(piece) && can_sweep(piece) && !has_round_steps(piece, context);
    };
    const CanSweep suits = [&](const OpenVolume& piece) {
        return !has_stepped_end(piece, context) && may_step(piece);
    };
    Cutter cutter(suits, may_step, can_sweep, least, context);
    const CutPart whole = part_of({volume}, context);
    std::vector<CutTried> cuts = cutter.cuts_of(whole);
    const auto parts_of_cut = [&](std::size_t number) {
        cutter.start_again();
        return cutter.cut_on(whole, std::move(cuts[number].parts));
    };
    std::vector<CutPart> first = cuts.empty() ? std::vector{whole} : parts_of_cut(0);
    const bool is_swept = std::ranges::all_of(first, &CutPart::has_ends);
    const bool is_whole = first.size() == 1 && !(first.front().left > 0);
    KnownPartitions known(kVisible * volume.model.diagonal);
    const auto take_new = [&](std::vector<StepPiece> pieces) {
        return known.is_new(pieces) && take(std::move(pieces));
    };
    if (is_swept && take_new(pieces_of(std::move(first), can_sweep, context))) return;
    const auto take_some = [&](std::vector<StepPiece> pieces) {
        return !pieces.empty() && take(std::move(pieces));
    };
    if (auto divided = with_rounds_divided(volume, can_sweep, context))
        if (take({{std::move(*divided)}})) return;
    std::vector<Pieces> refused;
    if (cut_in_steps(volume, can_sweep, take, refused, context) ||
        take_some(divided_through_axis(volume, can_sweep, context)) ||
        take_some(divided_at_middle(volume, kMostPieces, can_sweep, context)) ||
        take_some(divided_where_turning(volume, kMostPieces, can_sweep, context)) ||
        (is_whole && take_some(divided_at_centre(volume, kMostPieces, can_sweep, context))) ||
        (is_whole && take_some(divided_at_vertices(volume, kMostPieces, can_sweep, context))))
        return;
    if (is_whole) { // the blocks of cones are many, but small and all alike
        Pieces blocks = divided_at_middle(volume, 2 * kMostPieces, can_sweep, context);
        if (blocks.size() > kMostPieces && take(std::move(blocks))) return;
    }
    // The whole volume may have ends that were not tried yet, such as a top with its chamfers.
    if (!is_swept && first.size() == 1)
        first.front().has_ends = find_ends(first.front().piece, suits, context) &&
                                 first.front().piece.volume.role != volume.role;
    if (!is_swept && take_new(pieces_of(std::move(first), can_sweep, context))) return;
    for (std::size_t c = 1; c < cuts.size(); ++c)
        if (take_new(pieces_of(parts_of_cut(c), can_sweep, context))) return;
    if (auto pieces = cut_above_bottom(volume, context); !pieces.empty())
        refused.push_back(std::move(pieces));
    for (Pieces& pieces : refused)
        if (change_to_sweep(pieces, can_sweep, context) && take(std::move(pieces))) return;
}

} // namespace lacuna::closure
