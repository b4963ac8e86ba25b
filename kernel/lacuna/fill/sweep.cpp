// SPDX-License-Identifier: MIT
#include <lacuna/fill.h>

#include <lacuna/closure/shared/along.h>
#include <lacuna/closure/shared/branches.h>
#include <lacuna/closure/shared/partition.h>
#include <lacuna/core/error.h>
#include <lacuna/core/shared/attempt.h>
#include <lacuna/core/shared/constants.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/progress.h>
#include <lacuna/fill/describe.h>
#include <lacuna/fill/detail/crossing_faces.h>
#include <lacuna/fill/detail/edge_sets.h>
#include <lacuna/fill/detail/members.h>
#include <lacuna/surface/shared/default_size.h>
#include <lacuna/sweep/shared/turn_at_axis.h>
#include <lacuna/topology/shared/face_parts.h>
#include <lacuna/topology/shared/joined_faces.h>
#include <lacuna/topology/shared/names_of.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <functional>
#include <map>
#include <tuple>
#include <utility>

namespace lacuna::fill {

namespace {

// --- one sweep of a volume --------------------------------------------------------------------------------

/// Report what closing assumed. If void edges were drawn from the match, also report and log
/// the notes of the match.
void report_closure(const Volume& volume, std::vector<std::string>& report, const RunContext& context)
{
    report_left_out(volume, report);
    if (!volume.closure) return;
    if (volume.match && !volume.closure->void_edges.empty()) {
        for (const Message& note : volume.match->notes) {
            report.push_back("match: " + note.text());
            log_line(context, "note: " + note.text());
        }
    }
    for (const Message& note : volume.closure->notes) report.push_back("closed: " + note.text());
}

Filled sweep_whole(const Volume& volume, sweep::SweepOptions options, const RunContext& context)
{
    Volume sealed = close_to_sweep(with_rims_divided(volume, context),
                                   volume.name.empty() ? "the volume" : volume.name, context);
    keep_given_middles(sealed, options.second_order);
    FilledVolume mesh{sweep::sweep(sealed.volume, options, context), sealed.material, sealed.unit};
    report_closure(sealed, mesh.swept.report, context);
    mesh.columns = column_sets(sealed, mesh.swept);
    if (!sealed.name.empty()) mesh.swept.mesh.volume_groups = {sealed.name};
    Filled filled{{}, std::move(mesh)};
    filled.volumes.push_back(std::move(sealed));
    return filled;
}

Filled sweep_once(const Volume& volume, bool pieces, const SweepRequest& request, const RunContext& context)
{
    const bool periodic = !request.options.periodic.empty();
    if (!pieces && !periodic) return sweep_whole(volume, request.options, context);
    sweep::SweepOptions options = request.options;
    options.layered = options.layered && request.layered_parts;
    if (!options.layered) options.crew = nullptr;
    if (!pieces) return sweep_as_assembly(volume, options, context);
    if (volume.closure && !volume.told) closure::log_notes(*volume.closure, context);
    Filled filled{{}, sweep_pieces(volume, cut_into_pieces(volume, context), options, context)};
    filled.volumes.push_back(volume);
    return filled;
}

// --- a source with edges on its axis ----------------------------------------------------------------------

/// Revolve a source with edges on its axis: it is meshed as the end of a plate, whose quads are then
/// revolved.
Filled turn_at_axis(const Volume& volume, const SweepRequest& request, const RunContext& context)
{
    sweep::SweepOptions options = request.options;
    options.wedges = true;
    sweep::check(options, context);
    options.fallback = sweep::Fallback::none;
    options.layered = false;
    options.crew = nullptr;
    const closure::SweptSource& along = *volume.along;
    const topology::Model& source = along.source.model;
    const Vec3 normal = topology::area_vector_of(source, topology::all_faces(source));
    if (!(normal.norm() > 0))
        throw InvalidInput(Message("closure.along_direction", "the source has no mean normal")
                               .remedy("use a source in a plane through its axis"));
    // Any thickness serves, because the plate has one layer.
    closure::SweptSource plate{along.source, nullptr, false, along.sets};
    plate.motion = std::make_shared<const geometry::Motion>(
        geometry::translation(source.diagonal * normal.normalized()));
    sweep::SweepOptions flat = options;
    flat.layers = {};
    flat.layers.count = 1;
    flat.wedges = false;
    flat.min_scaled_jacobian = 0;
    const topology::OpenVolume sealed = closure::close_along(plate, {}, context).volume;
    sweep::Swept base = sweep::sweep(sealed, flat, context);
    if (!volume.name.empty()) base.mesh.volume_groups = {volume.name};
    const closure::Along::Axis& axis = *along.on_axis;
    FilledParts mesh{sweep::turn_at_axis({axis.point, axis.direction, axis.angle * kDegree, along.full_turn},
                                         sealed, base, options, context),
                     {},
                     {},
                     {},
                     {}};
    const std::string name = volume.name.empty() ? "volume" : volume.name;
    for (const sweep::Swept& part : mesh.swept.parts) // without hexahedra: the wedges along the axis
        mesh.regions.push_back(part.mesh.hex_count() > 0 ? name : name + "_axis");
    mesh.materials.assign(mesh.swept.parts.size(), volume.material);
    Filled filled{{}, std::move(mesh)};
    filled.volumes.push_back(volume);
    return filled;
}

// --- volumes that no single sweep fills -------------------------------------------------------------------

/// The relative difference between the volume of a mesh and that of the sealed skin.
double lost_volume(const sweep::Fidelity& shape) { return std::abs(shape.volume / shape.sealed_volume - 1); }

double lost_volume(const Filled& filled)
{
    const auto* parts = std::get_if<FilledParts>(&filled.mesh);
    return lost_volume(parts ? fidelity(*parts) : std::get<FilledVolume>(filled.mesh).swept.fidelity);
}

/// Sweep pieces and check that their volume is that of the sealed whole. If it is not, the sizes are reduced
/// once, by what was measured: what facets cut off falls with the square of the size. Half of the difference
/// that is allowed is aimed at, because numbers of sides are rounded.
/// @param sized  whether the user requested sizes; if so, the volume is not checked here.
/// @throw NotSweepable "sweep.volume"  the volumes differ.
FilledParts sweep_pieces_true(const Volume& sealed, const std::vector<closure::StepPiece>& pieces,
                              sweep::SweepOptions options, bool sized, const RunContext& context)
{
    FilledParts mesh = sweep_pieces(sealed, pieces, options, context);
    double off = lost_volume(fidelity(mesh));
    if (sized || !(off > kVolumeNoted)) return mesh;
    const double finer = std::sqrt(kSameVolume / 2 / off);
    options.size = [size = options.size, finer](const Vec3& p) { return finer * size(p); };
    mesh = sweep_pieces(sealed, pieces, options, context);
    off = lost_volume(fidelity(mesh));
    if (off > kVolumeNoted)
        throw NotSweepable(
            Message("sweep.volume",
                    "the meshes of the pieces together differ by {:.2g} % in volume from the sealed skin",
                    found(100 * off))
                .remedy("give a smaller 'size'"));
    return mesh;
}

/// The share of a mesh's volume that is in hexahedra.
double hex_share(const FilledParts& mesh)
{
    double tets = 0;
    for (const FilledTets& part : mesh.tets) tets += part.fidelity.volume;
    return 1 - tets / fidelity(mesh).volume;
}

/// The result of an attempt that logs its notes to a context of its own. Empty if it fails; the log says why.
/// @param what   attempted
/// @param notes  receives the notes, which are to be logged only if the result is used
/// @param why    receives the error if there was none before; null: nobody asks
template <class Action>
auto attempted(std::string_view what, std::vector<std::string>& notes, const RunContext& context,
               const Action& action, std::optional<Message>* why = nullptr) -> decltype(action(context))
{
    RunContext own = context;
    own.log = [&](std::string_view line) { notes.emplace_back(line); };
    auto outcome = attempt([&] { return action(own); });
    if (outcome) return std::move(*outcome);
    log_line(context, formatted("{}: {}", what, outcome.why->text()));
    if (why != nullptr && !*why) *why = outcome.why;
    return std::nullopt;
}

/// The least scaled Jacobian of the hexahedra of a mesh.
double least_of(std::span<const sweep::Swept> parts)
{
    double least = 1;
    for (const sweep::Swept& part : parts) least = std::min(least, part.quality.min_scaled_jacobian);
    return least;
}

/// Meshes partitions of a volume and keeps the mesh with the largest share of hexahedra, of several the one
/// whose worst cell is best. Only the notes of that mesh are logged.
class PieceMesher {
public:
    PieceMesher(const Volume& sealed, const Message& why, const sweep::SweepOptions& options, bool sized,
                const RunContext& context)
        : sealed_(sealed), why_(why), options_(options), sized_(sized), context_(context)
    {
    }

    void mesh(std::vector<closure::StepPiece> pieces)
    {
        const bool is_cut = pieces.size() > 1;
        const bool divided = pieces.front().volume.model.faces.size() > sealed_.volume.model.faces.size();
        std::string cut = is_cut ? formatted("cut into {} pieces, because {}", pieces.size(), why_.text())
                                 : formatted("swept {}{}, because {}", ends_in_words(pieces.front().volume),
                                             divided ? ", after the rounds at the rims of these ends were "
                                                       "divided"
                                                     : "",
                                             why_.text());
        std::vector<std::string> notes;
        auto mesh = attempted(
            cut, notes, context_,
            [&](const RunContext& own) {
                note_joined(sealed_.volume.model, pieces, own);
                return std::optional(sweep_pieces_true(sealed_, pieces, options_, sized_, own));
            },
            &failure_);
        if (!mesh) return;
        const std::pair worth(hex_share(*mesh), least_of(parts(*mesh)));
        if (!(worth > std::pair(share_, least_))) return;
        notes.push_back(formatted("note: {}; the report says why [{}]",
                                  is_cut    ? "the volume is cut into pieces"
                                  : divided ? "the rounds at the rims of the volume's ends are divided"
                                            : "other faces than the likely ones are the volume's ends",
                                  why_.code()));
        mesh->swept.report.insert(mesh->swept.report.begin(), std::move(cut));
        best_ = std::move(mesh);
        pieces_ = std::move(pieces);
        std::tie(share_, least_) = worth;
        notes_ = std::move(notes);
    }

    [[nodiscard]] double share() const { return share_; }
    /// Whether the mesh is of hexahedra alone, and none is poor.
    [[nodiscard]] bool is_good() const { return share_ == 1 && least_ >= kPoorCell; }
    /// The first error of a partition.
    [[nodiscard]] const std::optional<Message>& failure() const { return failure_; }
    /// The pieces of the best mesh; empty if there is none.
    std::vector<closure::StepPiece> pieces() { return std::move(pieces_); }

    std::optional<FilledParts> best()
    {
        for (const std::string& note : notes_) log_line(context_, note);
        return std::move(best_);
    }

private:
    const Volume& sealed_;
    const Message& why_;
    const sweep::SweepOptions& options_;
    bool sized_; ///< as for sweep_pieces_true()
    const RunContext& context_;
    std::optional<FilledParts> best_;
    std::optional<Message> failure_;
    std::vector<closure::StepPiece> pieces_;
    double share_ = 0; ///< of the volume of `best_` that is in hexahedra
    double least_ = 0; ///< least scaled Jacobian of `best_`
    std::vector<std::string> notes_;
};

/// Options for the pieces of a volume. All pieces get the same size, because the default sizes of
/// neighbouring pieces would differ. Ends that were found for the whole volume are not those of the pieces,
/// and may be small.
sweep::SweepOptions options_of_pieces(const Volume& volume, sweep::SweepOptions options)
{
    options.layered = false;
    options.crew = nullptr;
    if (options.size) return options;
    topology::OpenVolume sized = volume.volume;
    if (volume.roles_found) std::ranges::fill(sized.role, topology::Role::wall);
    options.size = surface::even_size(surface::default_size(sized).length);
    options.gap = std::max(options.gap, sweep::kDefaultGap);
    return options;
}

/// Mesh the partitions of a sealed volume, until one is all hexahedra.
/// @param mixed  whether pieces may be filled with tetrahedra
void mesh_partitions(PieceMesher& mesher, const Volume& sealed, bool mixed, const RunContext& context)
{
    // A volume of which less than this share can be swept is filled with tetrahedra alone. On the bodies of
    // the tests, meshing such volumes in pieces took up to a minute, and at most a fifth of the volume became
    // hexahedra.
    constexpr double kWorthMixing = 0.5;
    // Partitions with pieces that have no ends, by the share of the volume in the pieces with ends.
    std::multimap<double, std::vector<closure::StepPiece>, std::greater<>> partial;
    const auto take = [&](std::vector<closure::StepPiece> pieces) {
        const double share = swept_share(pieces);
        if (share == 1)
            mesher.mesh(std::move(pieces));
        else if (mixed && share > kWorthMixing)
            partial.emplace(share, std::move(pieces));
        return mesher.is_good();
    };
    partitions(sealed.volume, take, context);
    for (auto& [share, pieces] : partial)
        if (share > mesher.share()) mesher.mesh(std::move(pieces));
}

/// A volume whose faces that continue each other are one face, with the same ends if the user named them.
/// Empty if there are none.
std::optional<Volume> with_joined_faces(const Volume& volume, topology::Continued how,
                                        const RunContext& context)
{
    const topology::OpenVolume& open = volume.volume;
    if (volume.along || open.full_turn || open.override_class) return std::nullopt;
    const bool named = !volume.roles_found && !volume.no_roles;
    std::vector<int> apart(open.role.size(), 0);
    for (std::size_t f = 0; named && f < apart.size(); ++f) apart[f] = static_cast<int>(open.role[f]);
    const std::vector<std::vector<FaceId>> faces = topology::continued_faces(open.model, apart, how, context);
    // Parts of one face have its tag; opened again, the face would be split again.
    const auto is_one_face = [&](const std::vector<FaceId>& parts) {
        return std::ranges::all_of(
            parts, [&](FaceId part) { return open.model[part].tag == open.model[parts.front()].tag; });
    };
    if (std::ranges::all_of(faces, is_one_face)) return std::nullopt;
    for (const std::vector<FaceId>& parts : faces)
        if (parts.size() > 1)
            log_line(context,
                     formatted("note: {} {} and are meshed as one face, because the cells cannot follow the "
                               "edges between them",
                               topology::entities_of(open.model, parts),
                               how == topology::Continued::smoothly
                                   ? "continue each other"
                                   : "lie on one " + open.model[parts.front()].kind));
    const topology::Model joined = topology::join_faces(open.model, faces, context);
    RoleRequest request;
    if (named) {
        request.roles.emplace();
        for (std::size_t f = 0; f < faces.size(); ++f) {
            const topology::Role role = open.role[faces[f].front().index()];
            (role == topology::Role::source   ? request.roles->source
             : role == topology::Role::target ? request.roles->target
                                              : request.roles->walls)
                .emplace_back(f);
        }
    } else {
        request.faces = topology::all_faces(joined);
    }
    return open_anew(volume, joined, std::move(request), context);
}

Filled sweep_or_fill(const Volume& volume, const SweepRequest& asked, const RunContext& context);

/// Fill a volume that neither a sweep nor cuts fill after joining its faces that continue each other: those
/// on one shape or, if there are none, those that meet smoothly. Empty if there are none of both, or if that
/// fails as well; then its notes are not logged.
std::optional<Filled> fill_joined(const Volume& volume, const SweepRequest& asked, const RunContext& context)
{
    std::vector<std::string> notes;
    const auto fill = [&](const RunContext& own) -> std::optional<Filled> {
        auto joined = with_joined_faces(volume, topology::Continued::on_one_shape, own);
        // What is missing beside a joined face would be harder to tell.
        if (!joined && topology::free_edges(volume.volume).empty())
            joined = with_joined_faces(volume, topology::Continued::smoothly, own);
        if (!joined) return std::nullopt;
        SweepRequest request = asked;
        if (request.options.fallback == sweep::Fallback::mixed)
            request.options.fallback = sweep::Fallback::none;
        return sweep_or_fill(*joined, request, own);
    };
    auto filled = attempted("with faces joined", notes, context, fill);
    if (filled)
        for (const std::string& note : notes) log_line(context, note);
    return filled;
}

/// Mesh a volume that no single sweep fills, in pieces that can be swept. With `Fallback::mixed`, pieces that
/// cannot be swept are filled with tetrahedra. If the volume cannot be cut into pieces, it is filled with
/// tetrahedra as a whole.
/// @param why   why the volume cannot be swept
/// @param told  whether a sweep that failed has closed the volume and logged what closing assumes
/// @return  empty if no mesh is found.
std::optional<Filled> sweep_in_pieces(const Volume& volume, const Message& why, bool told,
                                      const SweepRequest& request, const RunContext& context)
{
    const bool mixed = request.options.fallback == sweep::Fallback::mixed;
    const sweep::SweepOptions options = options_of_pieces(volume, request.options);
    RunContext closing = context;
    if (told) closing.log = nullptr;
    Volume sealed = sealed_whole(volume, closing);
    PieceMesher mesher(sealed, why, options, static_cast<bool>(request.options.size), context);
    mesh_partitions(mesher, sealed, mixed, context);
    if (mesher.share() < 1)
        if (auto filled = fill_joined(volume, request, context)) return filled;
    Filled filled;
    if (auto mesh = mesher.best()) {
        report_closure(sealed, mesh->swept.report, closing);
        filled.mesh = std::move(*mesh);
    } else if (mixed) {
        if (!sealed.no_roles) sealed.no_roles = why;
        filled.mesh = fill_alone({&sealed, nullptr, nullptr, options, true, true}, context);
    } else if (mesher.failure() && !options.boundary_layers.empty() &&
               why.code().find(".layers_") == std::string_view::npos) {
        // The error of the whole does not name the rows.
        throw NotSweepable(Message("sweep.layers_pieces",
                                   "no single sweep fills the volume, and its pieces cannot be meshed with "
                                   "the boundary layers asked for")
                               .remedy("use fewer or thinner rows, or leave out 'boundary_layers'")
                               .attempt(*mesher.failure()));
    } else {
        return std::nullopt;
    }
    filled.volumes.push_back(std::move(sealed));
    return filled;
}

/// Sweep a volume once. If cells are poor or, with default sizes, the volume is off, and the ends are not the
/// user's, the volume is also swept with its faces that continue each other joined, and, if that does not
/// help, in pieces. Of the meshes that keep the volume, the one whose worst cell is best is taken. Only the
/// notes of that mesh are logged.
/// @param pieces, told  as for `sweep_once()` and `sweep_in_pieces()`
Filled sweep_once_or_better(const Volume& volume, bool pieces, bool told, const SweepRequest& request,
                            const RunContext& context)
{
    const sweep::LayerSpec& layers = request.options.layers;
    if (!may_cut(volume, false) || volume.along || layers.count > 0 || !layers.heights.empty())
        return sweep_once(volume, pieces, request, context);
    std::vector<std::string> notes;
    RunContext own = context;
    own.log = [&](std::string_view line) { notes.emplace_back(line); };
    const auto log_notes = [&] {
        for (const std::string& note : notes) log_line(context, note);
    };
    std::optional<Filled> filled;
    try {
        filled = sweep_once(volume, pieces, request, own);
    } catch (...) {
        log_notes();
        throw;
    }
    const auto keeps_volume = [&](const Filled& mesh) {
        return request.options.size || !(lost_volume(mesh) > kVolumeNoted);
    };
    const auto take_better = [&](std::string_view how, const auto& fill) {
        const std::pair so_far(keeps_volume(*filled), least_of(parts(*filled)));
        if (so_far.first && !(so_far.second < kPoorCell)) return;
        std::vector<std::string> notes_of_other;
        auto other = attempted(how, notes_of_other, context, fill);
        if (!other || !(std::pair(keeps_volume(*other), least_of(parts(*other)) - kVisible) > so_far)) return;
        filled = std::move(other);
        notes = std::move(notes_of_other);
    };
    // Cells cannot follow edges between coplanar parts of an end as well as its rim.
    take_better("with faces joined", [&](const RunContext& other) -> std::optional<Filled> {
        const auto joined = with_joined_faces(volume, topology::Continued::on_one_shape, other);
        if (!joined) return std::nullopt;
        return sweep_once(*joined, has_pieces(*joined, other), request, other);
    });
    take_better("in pieces", [&](const RunContext& other) {
        const double off = lost_volume(*filled);
        const Message why = keeps_volume(*filled)
                                ? Message("quality.below_limit",
                                          "the least scaled Jacobian of a single sweep is {:.2g}",
                                          found(least_of(parts(*filled))))
                                : Message("sweep.volume",
                                          "the mesh of a single sweep differs by {:.2g} % in volume",
                                          found(100 * off));
        return sweep_in_pieces(volume, why, told, request, other);
    });
    log_notes();
    return std::move(*filled);
}

std::vector<std::string>& report_of(Filled& filled)
{
    if (auto* parts = std::get_if<FilledParts>(&filled.mesh)) return parts->swept.report;
    return std::get<FilledVolume>(filled.mesh).swept.report;
}

Filled sweep_or_fill(const Volume& volume, const SweepRequest& asked, const RunContext& context)
{
    if (volume.no_roles) {
        if (auto filled = sweep_in_pieces(volume, *volume.no_roles, false, asked, context))
            return std::move(*filled);
        throw InvalidInput(with_tets_as_remedy(*volume.no_roles, asked.options));
    }
    SweepRequest request = asked;
    std::vector<std::string> failed; // one line for each sweep that failed
    std::exception_ptr first;
    std::optional<Message> why; // message of `first`
    std::optional<Volume> other;
    const std::size_t ways = volume.others ? volume.others->ways.size() : 0;
    const bool mixed = asked.options.fallback == sweep::Fallback::mixed;
    if (mixed) request.options.fallback = sweep::Fallback::none;
    const bool cuts = may_cut(volume, mixed);
    bool told = volume.told; // whether what closing the volume assumes has been logged
    for (std::size_t next = 0;; ++next) {
        const Volume& now = other ? *other : volume;
        const bool pieces = has_pieces(now, context);
        const bool told_before = told;
        told = told || !pieces || now.closure;
        const auto note_failure = [&](const Error& error) {
            if (!first) first = std::current_exception();
            if (!why) why = error.message();
            if (ways == 0) return;
            failed.push_back(formatted("roles: swept {}, it fails: {} [{}]", ends_in_words(now.volume),
                                       error.what(), error.code()));
            log_line(context, failed.back());
        };
        try {
            Filled filled = sweep_once_or_better(now, pieces, told_before, request, context);
            if (!failed.empty())
                failed.push_back(formatted("roles: swept {} instead, which encloses the same volume",
                                           ends_in_words(filled.volumes.front().volume)));
            std::vector<std::string>& report = report_of(filled);
            report.insert(report.begin(), failed.begin(), failed.end());
            return filled;
        } catch (const NotSweepable& error) {
            note_failure(error);
        } catch (const NotClosed& error) {
            note_failure(error);
        }
        if (next == ways) {
            std::optional<Filled> filled = cuts ? sweep_in_pieces(volume, *why, told, asked, context)
                                                : fill_joined(volume, asked, context);
            if (!filled) std::rethrow_exception(first);
            std::vector<std::string>& report = report_of(*filled);
            report.insert(report.begin(), failed.begin(), failed.end());
            return std::move(*filled);
        }
        other = with_other_sweep(volume, next);
        other->told = true;
    }
}

} // namespace

std::vector<closure::StepPiece> swept_pieces(const Volume& volume, const Message& why,
                                             const sweep::SweepOptions& asked, const RunContext& context)
{
    RunContext quiet = context;
    quiet.log = nullptr;
    sweep::SweepOptions options = options_of_pieces(volume, asked);
    options.fallback = sweep::Fallback::none;
    const Volume sealed = sealed_whole(volume, quiet);
    PieceMesher mesher(sealed, why, options, static_cast<bool>(asked.size), quiet);
    mesh_partitions(mesher, sealed, false, quiet);
    return mesher.pieces();
}

Message with_tets_as_remedy(const Message& why, const sweep::SweepOptions& options)
{
    // Faces of tetrahedra cannot be periodic.
    if (options.fallback == sweep::Fallback::mixed || !options.tet_mesher || !options.periodic.empty())
        return why;
    // Hexahedra that only miss a limit are still better than tetrahedra.
    if (why.code() == "quality.below_limit")
        return why.remedy().empty() ? why.remedy("change 'size' or 'layers', or lower 'min_scaled_jacobian'")
                                    : why;
    return why.remedy("{}sweep with fallback = \"mixed\"",
                      why.remedy().empty() ? "" : why.remedy() + ", or ");
}

Filled sweep(const Volume& volume, const SweepRequest& asked, const RunContext& host)
{
    const RunContext context = never_falling(host);
    SweepRequest request = asked;
    sweep::SweepOptions& options = request.options;
    options.improving = sweep::with_shared_limits(options.improving);
    if (const topology::Model& model = volume.volume.model; options.size && !model.points.empty())
        if (const double size = options.size(model.points.front()); size > model.diagonal)
            log_line(context,
                     formatted("note: 'size' is {:.3g}, but the whole model is only {:.3g} long; check "
                               "the unit, and 'scale' if the file was loaded with it",
                               size, model.diagonal));
    const bool on_axis = volume.along && volume.along->on_axis &&
                         (options.wedges || options.fallback == sweep::Fallback::wedges);
    Filled filled = on_axis ? turn_at_axis(volume, request, context) : sweep_or_name_tets(options, [&] {
        const topology::Model& model = volume.volume.model;
        return unless_faces_cross(model, topology::all_faces(model), context,
                                  [&] { return sweep_or_fill(volume, request, context); });
    });
    report_progress(context, "shape of the skin", 1);
    return filled;
}

Filled fill(const topology::Model& model, const Request& request, const RunContext& context)
{
    RoleRequest roles = request.roles;
    roles.decks = request.decks;
    roles.scale = request.scale;
    Volume volume = open(model, roles, context);
    volume.decks = request.decks;
    volume.scale = request.scale;
    volume.unit = request.unit;
    if (request.match) volume = match(std::move(volume), request.match, context);
    if (request.close) volume = close(std::move(volume), request.close, context);
    return sweep(volume, request.sweep, context);
}

} // namespace lacuna::fill
