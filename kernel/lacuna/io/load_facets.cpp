// SPDX-License-Identifier: MIT
#include <lacuna/io/load_facets.h>

#include <lacuna/core/error.h>
#include <lacuna/healing/shared/stitch.h>
#include <lacuna/io/detail/deck_builder.h>
#include <lacuna/io/detail/format_table.h>
#include <lacuna/io/detail/input_file.h>
#include <lacuna/io/leave_out.h>
#include <lacuna/io/shared/deck_facets.h>
#include <lacuna/io/shared/units.h>
#include <lacuna/topology/shared/gaps.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iterator>

namespace lacuna::io {
namespace {

void check_options(const LoadOptions& options)
{
    if (!(options.scale > 0) || !std::isfinite(options.scale)) {
        throw InvalidInput("io.scale", "the scale must be a number above 0, not {:.6g}",
                           found(options.scale));
    }
    if (!(options.tolerance >= 0) || !std::isfinite(options.tolerance)) {
        throw InvalidInput("io.tolerance", "the tolerance must be a length of 0 or more, not {:.6g}",
                           found(options.tolerance));
    }
    if (!options.unit.empty()) metres_of(options.unit);
}

/// The factor from millimetres to the declared unit, for STEP and IGES files. These state their unit and are
/// read in millimetres.
double scale_of_cad(const std::vector<std::string>& paths, const std::string& unit)
{
    const auto states = [](const std::string& path) {
        return has_word(".step .stp .iges .igs", ending_of(path));
    };
    const auto stating = static_cast<std::size_t>(std::ranges::count_if(paths, states));
    if (unit.empty() || stating == 0) return 1;
    if (stating < paths.size() && unit != "mm")
        throw InvalidInput(Message("io.unit",
                                   "{} states no unit, unlike the STEP or IGES files loaded with it",
                                   *std::ranges::find_if_not(paths, states))
                               .remedy("load it by itself, or as STEP"));
    return metres_of("mm") / metres_of(unit);
}

/// Split quads into two triangles along the shorter diagonal, for remeshing.
void split_quads(healing::FacetSoup& soup)
{
    for (std::size_t q = 0; q < soup.quads.size(); ++q) {
        const Quad& quad = soup.quads[q];
        const auto at = [&](std::size_t k) -> const Vec3& { return soup.points[index(quad[k])]; };
        const std::size_t k = (at(0) - at(2)).squaredNorm() <= (at(1) - at(3)).squaredNorm() ? 0 : 1;
        soup.triangles.push_back({quad[k], quad[k + 1], quad[k + 2]});
        soup.triangles.push_back({quad[k], quad[k + 2], quad[(k + 3) % 4]});
        soup.triangle_label.insert(soup.triangle_label.end(), 2, soup.quad_label[q]);
    }
    soup.quads.clear();
    soup.quad_label.clear();
}

template <class T>
void move_in(std::vector<T>& to, std::vector<T>& from)
{
    if (to.empty())
        to.swap(from);
    else
        to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
}

/// Append the facets of `more` to `all`, with tags above those of `all`.
void append(FacetFile& all, FacetFile more)
{
    const auto points = static_cast<Index>(all.soup.points.size());
    const auto labels = static_cast<int>(all.label_tag.size());
    int offset = 0;
    for (const int tag : all.label_tag) offset = std::max(offset, tag);
    for (int& tag : more.label_tag)
        if (tag > 0) tag += offset;
    const auto shift = [&](auto& cells, std::vector<int>& cell_labels) {
        for (auto& cell : cells)
            for (Index& p : cell) p += points;
        for (int& label : cell_labels) label += labels;
    };
    shift(more.soup.triangles, more.soup.triangle_label);
    shift(more.soup.quads, more.soup.quad_label);
    // The tolerance of a coarse file would swallow the details of a fine one.
    all.soup.least_tolerance = points == 0 ? more.soup.least_tolerance
                                           : std::min(all.soup.least_tolerance, more.soup.least_tolerance);
    move_in(all.soup.points, more.soup.points);
    move_in(all.soup.triangles, more.soup.triangles);
    move_in(all.soup.triangle_label, more.soup.triangle_label);
    move_in(all.soup.quads, more.soup.quads);
    move_in(all.soup.quad_label, more.soup.quad_label);
    move_in(all.soup.label_name, more.soup.label_name);
    move_in(all.soup.label_keeps_nodes, more.soup.label_keeps_nodes);
    move_in(all.label_tag, more.label_tag);
    move_in(all.labels, more.labels);
    move_in(all.notes, more.notes);
}

/// A model with the entities of `first`, followed by those of `second`. Tags of faces, edges and vertices of
/// the second start above the highest of the first.
topology::Model joined(topology::Model first, topology::Model second)
{
    topology::ModelBuilder model(std::move(first)), more(std::move(second));
    const auto raise_tags = [](auto& entities, int by) {
        for (auto& entity : entities) entity.tag += by;
    };
    raise_tags(more.vertices, highest_tag(model.vertices));
    raise_tags(more.edges, highest_tag(model.edges));
    raise_tags(more.faces, highest_tag(model.faces));
    model.tolerance = std::max(model.tolerance, more.tolerance);
    model.source += ", " + more.source;
    move_in(model.notes, more.notes);
    healing::append(model, std::move(more).finish());
    Eigen::AlignedBox3d bounds;
    for (const Vec3& p : model.points) bounds.extend(p);
    model.diagonal = bounds.diagonal().norm();
    return std::move(model).finish();
}

/// Give faces the data of their labels. A face that is a whole label gets the label's tag; other faces get
/// tags above the highest one.
void name_faces(topology::ModelBuilder& model, const std::vector<std::string>& names, const FacetFile& file)
{
    std::vector<std::size_t> label_of_face;
    std::vector<int> faces_of_label(names.size(), 0);
    for (const topology::Face& face : model.faces) {
        label_of_face.push_back(static_cast<std::size_t>(std::stoul(face.name)));
        ++faces_of_label[label_of_face.back()];
    }
    // Faces of a file with a single label are numbered in order.
    const bool counted = names.size() == 1 && model.faces.size() > 1;
    int next = 0;
    for (const int tag : file.label_tag) next = std::max(next, tag);
    for (std::size_t f = 0; f < model.faces.size(); ++f) {
        const std::size_t label = label_of_face[f];
        topology::Face& face = model.faces[f];
        face.name = names[label];
        face.groups = file.labels[label].groups;
        face.regions = file.labels[label].regions;
        const bool whole = faces_of_label[label] == 1 && file.label_tag[label] > 0;
        if (!counted) face.tag = whole ? file.label_tag[label] : ++next;
    }
}

/// The facets of files as faces, before stitching.
LoadedFiles import_facets(const std::vector<std::string>& paths, const LoadOptions& options,
                          const RunContext& context)
{
    FacetFile all;
    LoadedFiles loaded{.scale = options.scale};
    std::string source;
    std::vector<Message> notes;
    std::vector<std::string> missing = options.without;
    for (const std::string& path : paths) {
        check_cancelled(context);
        source += (source.empty() ? "" : ", ") + path;
        auto deck = std::make_shared<Deck>(read_deck(path));
        for (const std::string& warning : deck->warnings)
            notes.push_back(Message("io.read_differently", "{}", warning).as_warning());
        std::erase_if(missing, [&](const std::string& part) { return has_part(*deck, part); });
        std::vector<std::string> parts = options.without;
        std::erase_if(parts, [&](const std::string& part) { return !has_part(*deck, part); });
        if (!parts.empty()) *deck = leave_out(*deck, parts).kept;
        deck->unit = common_unit(options.unit, "the option `unit`", deck->unit, path);
        loaded.unit = common_unit(loaded.unit, "a file before", deck->unit, path);
        check_cancelled(context);
        FacetFile file = facets_of(*deck, options.tolerance / options.scale);
        const bool is_mesh = format_of(deck->format).is_mesh;
        file.soup.label_keeps_nodes.assign(file.label_tag.size(), options.keep_mesh && is_mesh ? 1 : 0);
        append(all, std::move(file));
        if (is_mesh) loaded.decks.push_back(std::move(deck));
    }
    if (!missing.empty()) { // decks are read once more to name the parts that they have
        std::vector<Deck> decks;
        for (const std::string& path : paths) decks.push_back(read_deck(path));
        refuse_part(decks, missing.front());
    }
    check_cancelled(context);
    for (Vec3& p : all.soup.points) p *= options.scale;
    all.soup.least_tolerance *= options.scale;
    if (!options.keep_mesh) split_quads(all.soup);
    // Names may be equal or missing, so during splitting each face is named by the number of its label.
    const std::vector<std::string> names = std::exchange(all.soup.label_name, {});
    for (std::size_t label = 0; label < names.size(); ++label)
        all.soup.label_name.push_back(std::to_string(label));
    topology::ModelBuilder model(healing::split_facets(all.soup,
                                                       {.feature_angle = options.feature_angle,
                                                        .tolerance = options.tolerance,
                                                        .keep_noise = options.keep_noise},
                                                       context));
    name_faces(model, names, all);
    model.source = source;
    for (const std::string& note : all.notes) model.notes.push_back({"io.file_note", "{}", note});
    move_in(model.notes, notes);
    loaded.model = std::move(model).finish();
    return loaded;
}

/// Join faces that reading left separate: at T-junctions, in different files, and duplicates.
void stitch(LoadedFiles& loaded, const LoadOptions& options, const RunContext& context)
{
    topology::Model& model = loaded.model;
    if (model.tolerance > topology::kMostTolerance * model.diagonal) {
        throw InvalidInput(Message("io.tolerance",
                                   "the tolerance {:.6g} exceeds a hundredth of the model's diagonal "
                                   "({:.6g}), so faces would collapse",
                                   found(model.tolerance), model.diagonal)
                               .remedy("give a smaller one"));
    }
    const double share = options.tolerance > 0 ? 0 : healing::kSewnShare;
    healing::StitchReport report = healing::stitch(model, model.tolerance, context, share);
    if (report.changed()) log_line(context, report.summary());
    topology::ModelBuilder stitched(std::move(model));
    move_in(stitched.notes, report.notes);
    // Quads of formats of facets are facets. Until here they show that a face is the same as one of a mesh.
    for (topology::Face& face : stitched.faces)
        if (!face.keeps_nodes) face.given_quads.clear();
    model = std::move(stitched).finish();
    for (const Message& note : model.notes)
        log_line(context, note.is_warning() ? "note: " + note.text() : note.text());
}

} // namespace

LoadedFiles load_files(const std::vector<std::string>& paths, const LoadOptions& options,
                       const RunContext& context, const OtherFormats& others)
{
    check_options(options);
    if (paths.empty())
        throw InvalidInput(Message("io.no_file", "no file was named").remedy("name at least one"));
    std::vector<std::string> other, facets;
    for (const std::string& path : paths) {
        check_file(path);
        const bool is_other = has_word(others.endings, ending_of(path));
        if (!is_other) needed_reader(path, others.endings);
        (is_other ? other : facets).push_back(path);
    }
    if (facets.empty() && !options.without.empty())
        throw InvalidInput("io.no_such_part",
                           "without: {}: only finite element meshes have parts, and none of the files is one",
                           options.without.front());
    LoadedFiles loaded{.scale = options.scale};
    if (!other.empty()) {
        LoadOptions own = options;
        own.scale *= scale_of_cad(other, options.unit);
        loaded = others.import(other, own, context);
        loaded.scale = options.scale;
    }
    if (!facets.empty()) {
        LoadedFiles more = import_facets(facets, options, context);
        loaded.decks = std::move(more.decks);
        loaded.unit = more.unit;
        if (other.empty())
            loaded.model = std::move(more.model);
        else
            loaded.model = joined(std::move(loaded.model), std::move(more.model));
    }
    if (!other.empty()) loaded.model = topology::with_loops(std::move(loaded.model), context);
    if (loaded.unit.empty()) loaded.unit = options.unit;
    stitch(loaded, options, context);
    return loaded;
}

topology::Model load_facets(const std::vector<std::string>& paths, const LoadOptions& options,
                            const RunContext& context, const OtherFormats& others)
{
    return load_files(paths, options, context, others).model;
}

} // namespace lacuna::io
