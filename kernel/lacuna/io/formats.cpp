// SPDX-License-Identifier: MIT
#include <lacuna/io/detail/format_table.h>

#include <lacuna/core/error.h>
#include <lacuna/io/detail/deck_builder.h>

#include <algorithm>
#include <filesystem>

namespace lacuna::io {

/// Write the polyMesh folder of OpenFOAM. @throw InvalidInput  as `WholeFolder`; "io.no_such_element"  cells
/// with mid-side nodes.
void write_poly_mesh(const mesh::MeshView& view, const OutputPath& path, const RunContext& context);

void read_dyna(Cursor& cursor, DeckBuilder& into);
/// @throw BackendError "io.no_med"  the build has no libmedc
void read_med(Cursor& cursor, DeckBuilder& into);

namespace {

constexpr std::string_view kDeckOptions = "with without renumber first_node first_cell interfaces";
constexpr std::string_view kOrientedDeckOptions =
    "orientation with without renumber first_node first_cell interfaces";

FormatRow mesh_format(std::string_view ending, std::string_view name, std::string_view word, DeckFormat deck)
{
    FormatRow row{};
    row.ending = ending, row.name = name, row.word = word, row.deck = deck;
    row.is_read = row.is_written = true;
    return row;
}

FormatRow view_format(std::string_view ending, std::string_view name, std::string_view word, DeckFormat deck,
                      std::string_view options, WriteView* write)
{
    FormatRow row = mesh_format(ending, name, word, deck);
    row.options = options, row.write = write;
    row.streamed = row.streamed_parts = row.has_lines = row.has_hex27 = true;
    return row;
}

FormatRow deck_format(std::string_view ending, std::string_view name, std::string_view word, DeckFormat deck,
                      Format::Skin skin, WriteView* write, void (*read)(Cursor&, DeckBuilder&))
{
    FormatRow row = mesh_format(ending, name, word, deck);
    row.options = kDeckOptions, row.skin = skin, row.write = write, row.read = read;
    row.is_numbered = row.streamed = row.streamed_parts = true;
    row.numbers_regions = deck != DeckFormat::abaqus;
    return row;
}

std::vector<FormatRow> make_table()
{
    using enum DeckFormat;
    std::vector<FormatRow> table;
    FormatRow* row = nullptr; // the last one
    const auto add = [&](const FormatRow& made) { row = &table.emplace_back(made); };
    constexpr std::string_view kNoSides = "sets of sides are not written: VTK has none";

    add(view_format(".msh", "an MSH file", "MSH", msh,
                    "version binary quality groups gmsh_options "
                    "partitions ghosts with without "
                    "renumber first_node first_cell interfaces",
                    msh_file));
    row->read = read_msh, row->has_node_sets = false;
    row->unwritten_sets = "sets of nodes or sides are not written: groups of MSH hold elements";
    add(view_format(".vtu", "a VTU file", "VTK", vtu,
                    "quality orientation with without renumber first_node first_cell interfaces", vtu_file));
    row->read = read_vtu, row->unwritten_sets = kNoSides;
    add(view_format(".pvtu", "a PVTU file", "VTK", vtu, "quality partitions ghosts interfaces", nullptr));
    row->is_read = row->streamed_parts = false;
    add(view_format(".vtk", "a legacy VTK file", "VTK", vtk,
                    "binary quality orientation with without renumber first_node first_cell interfaces",
                    vtk_file));
    row->read = read_vtk, row->unwritten_sets = kNoSides;
    add(deck_format(".inp", "an Abaqus deck", "Abaqus", abaqus, Format::Skin::nodes_and_sides, abaqus_file,
                    read_abaqus));
    row->options = "element orientation with without renumber first_node first_cell interfaces";
    row->has_contacts = true, row->has_thin_order2 = false;
    for (const char* ending : {".bdf", ".nas", ".dat"}) {
        add(deck_format(ending, "a Nastran deck", "Nastran", nastran, Format::Skin::nodes, nastran_file,
                        read_nastran));
        row->unwritten_sets = "sets of sides are not written: Nastran has none";
        row->omits_middles = row->has_contacts = true;
        row->options = kOrientedDeckOptions;
    }
    add(deck_format(".unv", "a universal file", "UNV", unv, Format::Skin::quads, unv_file, read_unv));
    row->unwritten_sets = "sets of sides are not written: UNV has none";
    for (const char* ending : {".exo", ".e"}) {
        add(deck_format(ending, "an Exodus file", "Exodus", exodus, Format::Skin::nodes_and_sides,
                        exodus_file, read_exodus));
        row->has_hex27 = true, row->streamed_parts = false;
        row->options = kOrientedDeckOptions;
    }
    for (const char* ending : {".k", ".key", ".dyn"}) {
        add(deck_format(ending, "an LS-DYNA deck", "LS-DYNA", dyna, Format::Skin::nodes_and_sides, dyna_file,
                        read_dyna));
        row->has_contacts = true, row->has_thin_order2 = false;
    }
    add(deck_format(".feb", "a FEBio file", "FEBio", febio, Format::Skin::nodes_and_sides, febio_file,
                    nullptr));
    row->is_read = false, row->has_hex27 = row->has_contacts = true, row->options = kOrientedDeckOptions;
    add(view_format(".med", "a MED file", "MED", med,
                    "with without renumber first_node first_cell interfaces", med_file));
    row->read = read_med, row->streamed = row->streamed_parts = false;
    row->unwritten_sets = "sets of sides are not written: MED has none";
    add(mesh_format("polyMesh", "a polyMesh of OpenFOAM", "OpenFOAM", msh));
    row->is_folder = true, row->is_read = row->has_node_sets = false;
    row->options = "with without renumber interfaces", row->write_folder = write_poly_mesh;
    row->unwritten_sets = "sets of nodes or sides are not written: a polyMesh has patches of faces";
    add(mesh_format(".mesh", "a Medit file", "Medit", medit));
    row->read = read_medit, row->is_written = false, row->numbers_regions = true;
    add(mesh_format(".stl", "an STL file", "STL", stl));
    row->read = read_stl, row->is_written = row->is_mesh = false;
    add(mesh_format(".obj", "a Wavefront OBJ file", "OBJ", obj));
    row->read = read_obj, row->is_written = row->is_mesh = false;
    return table;
}

} // namespace

std::span<const FormatRow> format_table()
{
    static const std::vector<FormatRow> table = make_table();
    return table;
}

const Format* find_format(const std::string& path)
{
    const std::string name = std::filesystem::path(path).filename().string();
    const std::string ending = ending_of(path);
    for (const FormatRow& row : format_table())
        if (row.ending == (row.is_folder ? name : ending)) return &row;
    return nullptr;
}

const Format& needed_mesh_format(const std::string& call, const std::string& path, bool decks)
{
    const auto is_written = [](const Format& of) { return of.is_written; };
    const auto holds_decks = [](const Format& of) { return of.has_option("with"); };
    const Format* const format = find_format(path);
    if (format != nullptr && (decks ? holds_decks(*format) : is_written(*format))) return *format;
    throw InvalidInput(
        Message("lua.unknown_ending", "{}: the ending of {} is unknown", call, path)
            .remedy("mesh files end in {}", decks ? endings_of(holds_decks) : endings_of(is_written)));
}

const Format& format_of(DeckFormat deck)
{
    return *std::ranges::find(format_table(), deck, [](const FormatRow& row) { return row.deck; });
}

std::string endings_of(bool (*which)(const Format&))
{
    std::string all;
    for (const FormatRow& row : format_table())
        if (which(row)) all.append(all.empty() ? "" : " ").append(row.ending);
    return all;
}

const FormatRow& needed_reader(const std::string& path, std::string_view others)
{
    const Format* const format = find_format(path);
    if (format != nullptr && format->is_read) return row_of(*format);
    const std::string known = endings_of([](const Format& of) { return of.is_read; });
    throw InvalidInput(Message("io.unknown_ending", "{}: the ending \"{}\" is unknown", path, ending_of(path))
                           .remedy("supported endings are {}{}{}", others, others.empty() ? "" : " ", known));
}

} // namespace lacuna::io
