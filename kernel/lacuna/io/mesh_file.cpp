// SPDX-License-Identifier: MIT
#include <lacuna/io/mesh_file.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/team.h>
#include <lacuna/io/detail/deck_view.h>
#include <lacuna/io/detail/format_table.h>
#include <lacuna/io/detail/swept_view.h>
#include <lacuna/io/detail/vtk_writer.h>

#include <algorithm>

namespace lacuna::io {
namespace {

/// @param team  only rank 0 logs
void tell(const std::vector<std::string>& notes, const OutputPath& path, const RunContext& context,
          const Team* team = nullptr)
{
    if (team != nullptr && team->rank != 0) return;
    for (const std::string& note : notes) log_line(context, formatted("note: {}: {}", path.text(), note));
}

/// Clear `all_groups` if the format cannot hold it, and log that.
DeckFileOptions options_for(const Format& format, DeckFileOptions options, const OutputPath& path,
                            const RunContext& context)
{
    if (options.all_groups && options.msh_version == 2.2 && format.has_option("version")) {
        options.all_groups = false;
        tell({"MSH 2.2 holds one group an element, so groups = \"all\" is not "
              "followed; version = 4.1 holds "
              "all"},
             path, context);
    }
    return options;
}

void check_version(const Format& format, const MeshFileOptions& options)
{
    if (!format.has_option("version")) return;
    if (options.version != 2.2 && options.version != 4.1)
        throw InvalidInput(
            Message("io.unknown_version", "MSH version {} cannot be written", text_of(options.version))
                .remedy("known are 4.1 and 2.2"));
    if (options.partition.parts > 0 && options.version != 4.1)
        throw InvalidInput(Message("io.partition_version", "parts are written in MSH version 4.1 alone")
                               .remedy("leave out the version"));
}

/// Write a swept mesh in a format other than a deck.
void write_view(const FormatRow& format, const mesh::HexMesh& mesh, const NodeReader& nodes,
                const std::vector<FieldReader>& fields, const OutputPath& path,
                const MeshFileOptions& options, const RunContext& context, const Team* team = nullptr)
{
    const auto view = view_of(mesh, nodes, fields);
    if (format.view_folder != nullptr) return format.view_folder(*view, path, context);
    mesh::ViewParts parts;
    const bool pieces = format.view_file == nullptr, parted = pieces || options.partition.parts > 0;
    if (parted) parts = parts_of(mesh, options.partition);
    if (pieces) return write_pieces(view, parts, options.partition.ghosts, path, context, team);
    const DeckFileOptions file_options = options_for(
        format, {.binary = options.binary, .msh_version = options.version, .all_groups = options.all_groups},
        path, context);
    const DeckFile file = format.view_file(view, file_options, parted ? &parts : nullptr);
    write_file(path, file.sections, file.sizes, context, team);
}

/// View a deck for a format other than a deck. @param bulk  reader of this deck
std::shared_ptr<const mesh::MeshView> view_for(const FormatRow& format, const Deck& deck,
                                               const BulkReader& bulk)
{
    for (const DeckBlock& block : deck.blocks)
        if (std::ranges::find(block.nodes, -1) != block.nodes.end())
            refuse_element(block, format.word, "some have not all their middle nodes");
    return view_of(deck, bulk);
}

void note_sets(const Format& format, const Deck& deck, std::vector<std::string>& notes)
{
    if (format.unwritten_sets.empty()) return;
    const auto unwritten = std::ranges::count_if(deck.sets, [&](const DeckSet& set) {
        return set.kind == DeckSet::Kind::sides ||
               (set.kind == DeckSet::Kind::nodes && !format.has_node_sets);
    });
    if (unwritten > 0) notes.push_back(formatted("{} {}", unwritten, format.unwritten_sets));
}

DeckFile file_of(const FormatRow& format, const Deck& deck, const DeckFileOptions& options,
                 const LayeredBulk* layered = nullptr)
{
    DeckFile file;
    mesh::ViewParts parts;
    if (options.partition != nullptr) parts = parts_of(deck, *options.partition);
    if (format.deck_file != nullptr)
        file = format.deck_file(deck, layered);
    else
        file = format.view_file(view_for(format, deck, {deck, layered}), options,
                                options.partition != nullptr ? &parts : nullptr);
    note_sets(format, deck, file.notes);
    return file;
}

void write_bulk(const Format& format, const Deck& deck, std::vector<BulkPart> parts,
                const DeckFileOptions& options, const OutputPath& path, const RunContext& context,
                const Team* team)
{
    const LayeredBulk bulk(deck, std::move(parts));
    const DeckFile file = file_of(row_of(format), deck, options_for(format, options, path, context), &bulk);
    tell(file.notes, path, context, team);
    write_file(path, file.sections, file.sizes, context, team);
}

/// A copy of the deck without line elements, also removed from sets.
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
    if (!format.is_numbered)
        return write_view(row_of(format), mesh, NodeReader(mesh), readers_of(mesh, options.fields), path,
                          options, context);
    MeshDeckOptions own = deck;
    own.format = format.deck;
    write_deck(deck_of(mesh, own, context), format, path, context);
}

void write_mesh(const Format& format, const mesh::LayeredMesh& layered, const OutputPath& path,
                const MeshFileOptions& options, const MeshDeckOptions& deck,
                const std::vector<LayeredField>& fields, const RunContext& context, const Team* team)
{
    check_version(format, options);
    auto nodes = std::make_unique<NodeReader>(layered, context);
    if (!format.is_numbered)
        return write_view(row_of(format), layered.mesh, *nodes, readers_of(layered, fields, context, team),
                          path, options, context, team);
    MeshDeckOptions own = deck;
    own.format = format.deck;
    BulkPlace place;
    const Deck bulk = deck_without_bulk(layered.mesh, own, place, context);
    std::vector<BulkPart> parts;
    parts.push_back({layered.mesh, std::move(nodes), nullptr, std::move(place)});
    write_bulk(format, bulk, std::move(parts), {}, path, context, team);
}

void write_parts(const Format& format, std::span<const mesh::LayeredPart> parts, const OutputPath& path,
                 const DeckFileOptions& file, const RunContext& context, const Team* team)
{
    std::vector<BulkPlace> places;
    const Deck deck = deck_without_bulk(parts, {.format = format.deck}, false, places, context);
    std::vector<BulkPart> bulk;
    for (std::size_t p = 0; p < parts.size(); ++p) {
        const mesh::HexMesh& mesh = parts[p].mesh;
        auto nodes = parts[p].nodes != nullptr
                         ? std::make_unique<NodeReader>(mesh::LayeredMesh{mesh, *parts[p].nodes}, context)
                         : std::make_unique<NodeReader>(mesh);
        bulk.push_back({mesh, std::move(nodes), &parts[p].numbers, std::move(places[p])});
    }
    write_bulk(format, deck, std::move(bulk), file, path, context, team);
}

void write_deck(const Deck& deck, const Format& format, const OutputPath& path, const RunContext& context,
                const DeckFileOptions& options)
{
    if (const std::size_t lines = deck.element_count(1); lines > 0 && !format.has_lines) {
        log_line(context, formatted("{}: {} lines are not written", path.text(), lines));
        return write_deck(without_lines(deck), format, path, context, options);
    }
    const FormatRow& row = row_of(format);
    DeckFile file;
    if (row.view_folder == nullptr)
        file = file_of(row, deck, options_for(format, options, path, context));
    else
        note_sets(format, deck, file.notes);
    const bool texts = std::ranges::any_of(
        deck.texts, [](const DeckText& text) { return text.place == DeckText::Place::cards; });
    if (format.deck != deck.format && texts)
        file.notes.push_back(formatted(
            "materials, loads and other cards of {} are of another format and not carried over", deck.path));
    if (!file.changed.empty()) file.notes.push_back(file.changed);
    tell(file.notes, path, context);
    if (row.view_folder != nullptr)
        return row.view_folder(*view_for(row, deck, {deck, nullptr}), path, context);
    write_file(path, file.sections, file.sizes, context);
}

void write_deck(const Deck& deck, DeckFormat format, const OutputPath& path, const RunContext& context,
                const DeckFileOptions& options)
{
    write_deck(deck, format_of(format), path, context, options);
}

void write_pvtu(const Deck& deck, const DeckPartition& partition, int ghosts, const OutputPath& path,
                const RunContext& context)
{
    const auto view = view_for(row_of(format_of(DeckFormat::vtu)), deck, {deck, nullptr});
    write_pieces(view, parts_of(deck, partition), ghosts, path, context);
}

} // namespace lacuna::io
