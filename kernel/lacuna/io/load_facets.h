// SPDX-License-Identifier: MIT
#pragma once

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
        label_tag; ///< tag each label has in the file: of a surface entity, property or group; 0: none
    /// What the file says of a label beside its name.
    struct Label {
        std::vector<std::string> groups;               ///< as `topology::Face::groups`
        std::vector<std::vector<std::string>> regions; ///< as `topology::Face::regions`
    };
    std::vector<Label> labels;
    std::vector<std::string> notes; ///< what was passed over, counted; a sentence each
};

/// Read the faces of a file; its ending, in any case, says the format, and its content must agree. What holds
/// elements is read as read_deck() reads it, and faces are its shells and the skin of its solids.
///
/// | ending | read | a region or set is |
/// |---|---|---|
/// | .stl | text with several solids; binary | a solid, counted |
/// | .obj | points and polygons; more than four corners are split | an `o` or `g` line, counted |
/// | .msh | 1.0, 2.x, 4.0 and 4.1, text and binary | an entity; a physical group |
/// | .unv | nodes 15, 781, 2411; elements 71, 780, 2412; groups 752 to 2477 | a property; a group |
/// | .bdf .nas .dat | Nastran bulk data: free, small, large fields; INCLUDE beside it | a property |
/// | .inp | Abaqus, CalculiX: parts, instances, assemblies; INCLUDE beside it | a section; a set or surface |
/// | .vtk | legacy 1 to 5.1, text and binary: polygons, strips, cells | all one |
/// | .vtu | text, base64 and appended, compressed by zlib | all one |
/// | .mesh | Medit, text | a reference number |
/// | .exo .e | Exodus: netCDF's classic formats | a block; a set |
///
/// A label is what shells of one region in the same sets are, or sides of solids between the same regions in
/// the same surfaces. Higher-order elements give their corners. Nothing is guessed: what is not understood is
/// an error. Other cells are counted in the notes.
/// @throw InvalidInput  "io.no_file", "io.not_a_file", "io.empty_file", "io.unknown_ending", "io.no_faces",
///                      "io.unreadable" (names the line or byte, what was expected and what was found).
/// @note  Linear time but for sorting sparse node numbers and cutting polygons that are not convex; memory at
///        most 20 times the file's size, the file itself included.
FacetFile read_facets(const std::string& path);
/// The same of bytes in memory. @param name  stands for the path: its ending, its folder, in messages.
FacetFile read_facets(const std::string& name, std::string_view bytes);

/// Options of `load_facets()` and `cad::load()`.
struct LoadOptions {
    double tolerance = 0;      ///< gaps below it are sewn [model length]; 0: 1e-6 × the diagonal
    double feature_angle = 40; ///< where facets are cut into faces [degrees]
    bool keep_mesh = true;     ///< quads of FE formats stay as they are
    double scale = 1;          ///< every coordinate times this, > 0 [-]
    /// Parts of the meshes that are left out, as `leave_out()` has them; each must be in one file at least.
    std::vector<std::string> without{};
};

/// A model and the meshes it was made of.
struct LoadedFiles {
    topology::Model model{};
    /// Of the files that hold elements, in their order; `nodes_at()` finds the nodes of model points.
    std::vector<std::shared_ptr<const Deck>> decks{};
    double scale = 1; ///< of the model's coordinates to the decks' [-]
    /// Of the model's notes those about what was read otherwise than it stands, which everybody should see.
    std::vector<std::string> warnings{};
};

/// Formats that somebody else reads, all files of theirs at once.
struct OtherFormats {
    std::string_view endings; ///< in lower case, a blank between: ".step .stp"
    std::function<LoadedFiles(const std::vector<std::string>& paths, const LoadOptions& options,
                              const RunContext& context)>
        import;
};

/// Read files into one model. Facets are cut into faces by healing::split_facets(); a face that is all of a
/// label has the label's tag, the others count on from the highest; tags of later files go on from those of
/// the first. Faces that do not share edges are joined by healing::stitch().
/// @param others  formats beside those of read_facets().
/// @throw InvalidInput  as read_facets() and leave_out(), or an option out of range: "io.scale",
///                      "io.tolerance".
topology::Model load_facets(const std::vector<std::string>& paths, const LoadOptions& options = {},
                            const RunContext& context = {}, const OtherFormats& others = {});

/// load_facets() that hands the meshes over as well.
LoadedFiles load_files(const std::vector<std::string>& paths, const LoadOptions& options = {},
                       const RunContext& context = {}, const OtherFormats& others = {});

} // namespace lacuna::io
