// SPDX-License-Identifier: MIT
#include <lacuna/io/mesh_file.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/list_text.h>
#include <lacuna/core/shared/team.h>
#include <lacuna/io/detail/deck_view.h>
#include <lacuna/io/detail/format_table.h>
#include <lacuna/io/detail/periodic_nodes.h>
#include <lacuna/io/detail/swept_view.h>
#include <lacuna/io/shared/units.h>

#include <algorithm>

namespace lacuna::io {
namespace {

/// Log notes. @param team  only its rank 0 logs
void tell(const std::vector<std::string>& notes, const OutputPath& path, const RunContext& context,
          const Team* team = nullptr)
{
    if (team != nullptr && team->rank != 0) return;
    for (const std::string& note : notes) log_line(context, formatted("note: {}: {}", path.text(), note));
}

/// Report contact pairs that the format cannot store.
void tell_contacts(const Format& format, const mesh::MeshView& view, const MeshFileOptions& options,
                   const OutputPath& path, const RunContext& context, const Team* team)
{
    if (view.contacts.empty() || format.has_contacts) return;
    const bool one = format.has_option("groups") && !options.all_groups;
    const auto groups = [](const mesh::ContactPair& pair) { return pair.groups[0] + ", " + pair.groups[1]; };
    tell({formatted("ties and contacts are not written; the faces of pairs are the groups {}{}",
                    short_list(view.contacts, groups), one ? ", with groups = \"all\"" : "")},
         path, context, team);
}

/// Note sets of columns that the format does not hold.
void note_columns(const Format& format, const MeshDeckOptions& deck, std::vector<std::string>& notes)
{
    if (deck.columns.empty() || (format.is_numbered && format.has_node_sets)) return;
    notes.push_back(formatted("sets of nodes are not written: {}",
                              short_list(deck.columns, [](const ColumnSet& set) { return set.name; })));
}

void check_version(const Format& format, const MeshFileOptions& options)
{
    if (!format.has_option("version")) return;
    if (options.version != 2.2 && options.version != 4.1)
        throw InvalidInput(
            Message("io.unknown_version", "MSH version {} is not supported", text_of(options.version))
                .remedy("use 4.1 or 2.2"));
    if (options.partition.parts > 0 && options.version != 4.1)
        throw InvalidInput(Message("io.partition_version", "only MSH version 4.1 can contain partitions")
                               .remedy("leave out the version"));
}

/// Write a view to a file.
/// @param divide  divides a view of swept meshes into parts. Given if parts are requested or the format
///                consists of pieces; empty: the view is not divided
/// @param notes   logged after those of the writer
void write_view(const FormatRow& format, const View& view, const std::function<mesh::ViewParts()>& divide,
                const std::vector<std::string>& notes, const MeshFileOptions& options, const OutputPath& path,
                const RunContext& context, const Team* team)
{
    const bool pieces = format.write == nullptr && !format.is_folder;
    const bool divided = divide &&
                         (pieces || (options.partition.parts > 0 && format.has_option("partitions")));
    const mesh::ViewParts parts = divided ? divide() : mesh::ViewParts();
    if (format.write == nullptr) {
        tell(notes, path, context, team);
        tell_contacts(format, *view, options, path, context, team);
        if (format.is_folder) return format.write_folder(*view, path, context);
        return write_pieces(view, parts, options.partition.ghosts, path, context, team);
    }
    const DeckFile file = format.write(view, options, divided ? &parts : nullptr);
    tell(file.notes, path, context, team);
    tell(notes, path, context, team);
    tell_contacts(format, *view, options, path, context, team);
    if (!file.changed.empty()) tell({file.changed}, path, context, team);
    write_file(path, file.sections, file.sizes, context, team);
}

/// Whether the format has named sets of nodes. Formats with numbered nodes have them, and so has MED.
bool has_sets(const Format& format) { return format.is_numbered || format.deck == DeckFormat::med; }
bool has_fields(const Format& format) { return !format.is_numbered || format.deck == DeckFormat::exodus; }

/// Write swept meshes with the regions and sets of a deck.
void write_as_deck(const Format& format, std::span<BulkPart> parts, const OutputPath& path,
                   const MeshFileOptions& options, MeshDeckOptions deck_options, const RunContext& context,
                   const Team* team)
{
    deck_options.format = format.deck;
    const Deck deck = deck_without_bulk(parts, deck_options, options.interfaces, context);
    const std::shared_ptr<mesh::MeshView> view = view_of(deck, format, parts);
    add_periodic(options.periodic, has_sets(format), *view);
    if (options.orientation) add_orientation(parts, has_fields(format), *view);
    std::vector<std::string> notes;
    if (format.is_folder && !options.periodic.empty())
        notes.emplace_back(
            "pairs of periodic nodes are not written: make the patches cyclic with createPatch");
    note_columns(format, deck_options, notes);
    write_view(
        row_of(format), view, [&] { return parts_of(*view, parts, options.partition); }, notes, options, path,
        context, team);
}

/// Write a swept mesh. @param readers  makes the readers of its fields; not used for decks
template <class Readers>
void write_swept(const Format& format, const mesh::HexMesh& mesh, std::unique_ptr<const NodeReader> nodes,
                 const Readers& readers, const OutputPath& path, const MeshFileOptions& options,
                 const MeshDeckOptions& deck, const RunContext& context, const Team* team)
{
    if (format.is_numbered) {
        BulkPart part{mesh, std::move(nodes), nullptr};
        return write_as_deck(format, {&part, 1}, path, options, deck, context, team);
    }
    const std::vector<FieldReader> fields = readers();
    const std::shared_ptr<mesh::MeshView> view = view_of(mesh, *nodes, fields);
    const BulkPart whole{mesh, nullptr, nullptr};
    if (options.orientation) add_orientation({&whole, 1}, true, *view);
    std::vector<std::string> notes;
    note_columns(format, deck, notes);
    write_view(
        row_of(format), view, [&] { return parts_of(mesh, options.partition); }, notes, options, path,
        context, team);
}

void note_sets(const Format& format, const Deck& deck, std::vector<std::string>& notes)
{
    if (format.unwritten_sets.empty()) return;
    const auto unwritten = std::ranges::count_if(deck.sets, [&](const DeckSet& set) {
        const auto number = static_cast<std::size_t>(&set - deck.sets.data());
        const auto is_paired = [&](const mesh::ContactPair& pair) {
            return std::ranges::find(pair.sets, number) != pair.sets.end();
        };
        if (std::ranges::any_of(deck.contacts, is_paired)) return false;
        return set.kind == DeckSet::Kind::sides ||
               (set.kind == DeckSet::Kind::nodes && !format.has_node_sets);
    });
    if (unwritten > 0) notes.push_back(formatted("{} {}", unwritten, format.unwritten_sets));
}

/// A copy of the deck without line elements. They are removed from sets, too.
Deck without_lines(const Deck& deck)
{
    Deck less = deck;
    std::vector<DeckTag> lines;
    std::erase_if(less.blocks, [&](const DeckBlock& block) {
        if (shape_info(block.shape).dimension != 1) return false;
        lines.insert(lines.end(), block.tags.begin(), block.tags.end());
        return true;
    });
    std::ranges::sort(lines);
    for (DeckSet& set : less.sets)
        if (set.kind == DeckSet::Kind::elements)
            std::erase_if(set.members, [&](DeckTag tag) { return std::ranges::binary_search(lines, tag); });
    std::erase_if(less.sets, [](const DeckSet& set) {
        return set.kind == DeckSet::Kind::elements && set.members.empty();
    });
    return less;
}

} // namespace

void write_mesh(const Format& format, const mesh::HexMesh& mesh, const OutputPath& path,
                const MeshFileOptions& options, const MeshDeckOptions& deck, const RunContext& context)
{
    check_version(format, options);
    write_swept(
        format, mesh, std::make_unique<NodeReader>(mesh), [&] { return readers_of(mesh, options.fields); },
        path, options, deck, context, nullptr);
}

void write_mesh(const Format& format, const mesh::LayeredMesh& layered, const OutputPath& path,
                const MeshFileOptions& options, const MeshDeckOptions& deck,
                const std::vector<LayeredField>& fields, const RunContext& context, const Team* team)
{
    check_version(format, options);
    write_swept(
        format, layered.mesh, std::make_unique<NodeReader>(layered, context),
        [&] { return readers_of(layered, fields, context, team); }, path, options, deck, context, team);
}

void write_parts(const Format& format, std::span<const mesh::LayeredPart> parts, const OutputPath& path,
                 const MeshFileOptions& options, const MeshDeckOptions& deck, const RunContext& context,
                 const Team* team)
{
    check_version(format, options);
    std::vector<BulkPart> bulk;
    for (const mesh::LayeredPart& part : parts) {
        auto nodes = part.nodes != nullptr
                         ? std::make_unique<NodeReader>(mesh::LayeredMesh{part.mesh, *part.nodes}, context)
                         : std::make_unique<NodeReader>(part.mesh);
        bulk.push_back({part.mesh, std::move(nodes), &part.numbers});
    }
    write_as_deck(format, bulk, path, options, deck, context, team);
}

void write_deck(const Deck& deck, const Format& format, const OutputPath& path, const RunContext& context,
                const MeshFileOptions& options)
{
    if (const std::size_t lines = deck.element_count(1); lines > 0 && !format.has_lines) {
        log_line(context, formatted("{}: {} lines are not written", path.text(), lines));
        return write_deck(without_lines(deck), format, path, context, options);
    }
    const FormatRow& row = row_of(format);
    const std::shared_ptr<mesh::MeshView> view = view_of(deck, format);
    add_periodic(options.periodic, has_sets(format), *view);
    std::vector<BulkPart> oriented;
    for (const mesh::HexMesh* mesh : options.oriented) oriented.push_back({*mesh, nullptr, nullptr});
    if (options.orientation) add_orientation(oriented, has_fields(format), *view);
    for (std::size_t b = 0; b < deck.blocks.size(); ++b)
        if (!row.omits_middles && std::ranges::find(deck.blocks[b].nodes, -1) != deck.blocks[b].nodes.end())
            refuse_element(view->blocks[b], format.word, "some lack middle nodes");
    if (deck.format == DeckFormat::abaqus && !deck.instances.empty() && format.deck == DeckFormat::abaqus) {
        const std::string& only = deck.instances.front().name;
        const bool several = deck.instances.size() > 1;
        tell({several
                  ? formatted("the {} instances become one mesh without *PART and *INSTANCE, sets are named "
                              "instance_set{}",
                              deck.instances.size(),
                              deck.texts.empty()
                                  ? ""
                                  : ", and cards are not copied: they refer to nodes by instance")
                  : formatted("the instance {} becomes one mesh without *PART and *INSTANCE; names in cards "
                              "lose \"{}.\"",
                              only, only)},
             path, context);
    }
    std::vector<std::string> notes;
    note_sets(format, deck, notes);
    const bool texts = std::ranges::any_of(
        deck.texts, [](const DeckText& text) { return text.place == DeckText::Place::cards; });
    if (format.deck != deck.format && texts)
        notes.push_back(formatted(
            "materials, loads and other cards of {} are of another format and not copied", deck.path));
    MeshFileOptions own = options;
    own.unit = common_unit(options.unit, "the mesh", deck.unit, deck.path);
    write_view(row, view, {}, notes, own, path, context, nullptr);
}

void write_deck(const Deck& deck, DeckFormat format, const OutputPath& path, const RunContext& context,
                const MeshFileOptions& options)
{
    write_deck(deck, format_of(format), path, context, options);
}

} // namespace lacuna::io
