// SPDX-License-Identifier: MIT
#pragma once

// In: files to read, or meshes and decks to write; out: a model with the decks that it was read from, or
// files.
//
// Where to change things:
//   table of formats                           formats.cpp
//   options of reading, joining files          load_facets.cpp; units: units.cpp
//   data of a mesh file, reading it            deck.h, deck.cpp
//   common parts of readers                    deck_builder.cpp, cursor.cpp; of writers: deck_writer.cpp
//   reader of a format                         <format>_reader.cpp, med.cpp; libmedC: med_library.cpp
//   cards and frames of Nastran                nastran_cards.cpp, nastran_frames.cpp
//   cards, parts and instances of Abaqus       abaqus_cards.cpp, abaqus_parts.cpp
//   faces of a mesh                            deck_facets.cpp; default_tolerance.cpp
//   options of writing                         mesh_file.cpp
//   writer of a format                         <format>_writer.cpp, vtk.cpp, med.cpp, msh.cpp, msh_groups.cpp
//   views of meshes and decks for writers      swept_view.cpp, deck_view.cpp; nodes: node_reader.cpp
//   parallel writing; files that appear whole  sections.cpp, whole_file.cpp; folders: whole_folder.cpp
//   facets of a sealed volume                  facets.cpp
//   adding a mesh to a deck, to its sets       join_deck.cpp, mesh_deck.cpp, set_adder.cpp, join_sets.cpp
//   new decks of swept meshes and tetrahedra   mixed_deck.cpp
//   several decks; parts left out              merge_decks.cpp, leave_out.cpp
//   parts for a solver                         partition.cpp; one as a view: view_piece.cpp
//   values of cells; periodic nodes            cell_field.cpp, periodic_nodes.cpp

#include <lacuna/core/message.h>
#include <lacuna/core/run_context.h>
#include <lacuna/healing/split_facets.h>
#include <lacuna/io/deck.h>
#include <lacuna/topology/model.h>

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace lacuna::io {

/// The facets of one file.
struct FacetFile {
    healing::FacetSoup soup;
    std::vector<int>
        label_tag; ///< tag of each label in the file: of a surface entity, property or group; 0: none
    /// Data of a label in the file besides its name.
    struct Label {
        std::vector<std::string> groups;               ///< see `topology::Face::groups`
        std::vector<std::vector<std::string>> regions; ///< see `topology::Face::regions`
    };
    std::vector<Label> labels;
    std::vector<std::string> notes; ///< ignored content with counts; one sentence each
};

/// Read the faces of a file. The file extension, in upper or lower case, determines the format, and the
/// content must agree. Formats with elements are read as by read_deck(); the faces are the shells and the
/// skin of the solids.
///
/// | ending | read | a region or set is |
/// |---|---|---|
/// | .stl | text with several solids; binary | a solid; regions are numbered in order |
/// | .obj | points and polygons; more than four corners are split | an `o` or `g` line; numbered in order |
/// | .msh | 1.0, 2.x, 4.0 and 4.1, text and binary | an entity; a physical group |
/// | .unv | nodes 15, 781, 2411; elements 71, 780, 2412; groups 752 to 2477 | a property; a group |
/// | .bdf .nas .dat | Nastran bulk data: free, small, large fields; INCLUDE in its folder | a property |
/// | .inp | Abaqus, CalculiX: parts, instances; INCLUDE in its folder | a section; a set or surface |
/// | .vtk | legacy 1 to 5.1, text and binary: polygons, strips, cells | all one |
/// | .vtu | text, base64 and appended, compressed by zlib | all one |
/// | .mesh | Medit, text | a reference number |
/// | .exo .e | Exodus: netCDF's classic formats | a block; a set |
/// | .k .key .dyn | LS-DYNA keyword decks | a part; a set |
/// | .med | MED of Salome, if libmedC is installed | a family of cells; a group |
///
/// Shells of one region in the same sets have one label; so do sides of solids between the same regions in
/// the same surfaces. Higher-order elements are reduced to their corners. Unknown content is an error, never
/// guessed. Known elements that are neither shells nor solids are ignored, and counted in the notes.
/// @throw InvalidInput  "io.no_file", "io.not_a_file", "io.empty_file", "io.unknown_ending", "io.no_faces",
///                      "io.unreadable" (names the line or byte, what was expected and what was found).
/// @note  Linear time, apart from sorting sparse node numbers and splitting non-convex polygons; memory at
///        most 20 times the file's size, including the file itself.
FacetFile read_facets(const std::string& path);
/// `read_facets()` for bytes in memory. @param name  used like a path: for the extension, the folder and
/// messages.
FacetFile read_facets(const std::string& name, std::string_view bytes);

/// Options of `load_facets()` and `cad::load()`.
struct LoadOptions {
    double tolerance = 0;      ///< gaps below it are sewn [model length]; 0: 1e-6 × the diagonal, or, if
                               ///< larger, `least_tolerance()` of a mesh file
    double feature_angle = 40; ///< angle above which facets are split into faces [degrees]
    bool keep_mesh = true;     ///< quads of FE formats are kept
    bool keep_noise = false;   ///< points of noisy facets stay where they are
    double scale = 1;          ///< factor on every coordinate, > 0 [-]
    /// Unit of the model's lengths, a name that `metres_of()` knows. Lengths of STEP and IGES files, which
    /// state their unit, are converted to it; lengths in other formats are taken to be in it. Empty: no unit
    /// is declared.
    std::string unit{};
    /// Parts of the meshes to leave out, as in `leave_out()`; each must be in at least one file.
    std::vector<std::string> without{};
};

/// A model and the meshes that it was made from.
struct LoadedFiles {
    topology::Model model{};
    /// Decks of the files that hold elements, in the order of the files; `nodes_at()` finds their nodes at
    /// model points.
    std::vector<std::shared_ptr<const Deck>> decks{};
    double scale = 1;   ///< factor from the model's coordinates to the decks' [-]
    std::string unit{}; ///< declared unit of the lengths, from the options or a file; empty: none
};

/// Formats of another reader, which reads all its files in one call.
struct OtherFormats {
    std::string_view endings; ///< in lower case, separated by blanks: ".step .stp"
    std::function<LoadedFiles(const std::vector<std::string>& paths, const LoadOptions& options,
                              const RunContext& context)>
        import;
};

/// Read files into one model. healing::split_facets() splits facets into faces. A face with all facets of a
/// label has the label's tag; other faces get tags above the highest one. Tags of later files start above
/// those of earlier ones. healing::stitch() joins faces without shared edges.
/// @param others  formats besides those of read_facets().
/// @throw InvalidInput  an option is out of range ("io.scale", "io.tolerance"); or as read_facets() and
///                      leave_out().
topology::Model load_facets(const std::vector<std::string>& paths, const LoadOptions& options = {},
                            const RunContext& context = {}, const OtherFormats& others = {});

/// load_facets() that returns the meshes too.
LoadedFiles load_files(const std::vector<std::string>& paths, const LoadOptions& options = {},
                       const RunContext& context = {}, const OtherFormats& others = {});

} // namespace lacuna::io
