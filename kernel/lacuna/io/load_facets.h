// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/healing/split_facets.h>
#include <lacuna/topology/model.h>

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace lacuna::io {

/// The facets of one file.
struct FacetFile {
    healing::FacetSoup soup;
    std::vector<int> label_tag; ///< tag each label has in the file: of a surface entity, property or group
    std::vector<std::string> notes; ///< what was passed over, counted; a sentence each
};

/// Read the faces of a file; its ending, in any case, says the format, and its content must agree.
///
/// | ending | read | a label is |
/// |---|---|---|
/// | .stl | text with several solids; binary | a solid, counted |
/// | .obj | points and polygons; more than four corners are split | an `o` or `g` line, counted |
/// | .msh | 2.x and 4.1, text and binary | a surface entity, named as its first named physical group |
/// | .unv | nodes 15, 781, 2411; elements 71, 780, 2412; groups 752, 2417, 2429 to 2477 | a group, else a property |
/// | .bdf .nas .dat | Nastran bulk data: free, small and large field; INCLUDE in the file's folder | a property |
/// | .vtk | legacy 1 to 5.1, text and binary: polygons, strips, cells | all one |
/// | .vtu | text, base64 and appended; not compressed | all one |
/// | .mesh | Medit, text | a reference number |
///
/// Higher-order faces give their corners. Nothing is guessed: what is not understood is an error. Solids and other
/// cells are counted in the notes.
/// @throw InvalidInput  "io.no_file", "io.not_a_file", "io.empty_file", "io.unknown_ending", "io.unreadable" (names
///                      the line or byte, what was expected and found), "io.no_faces".
/// @note  Linear time but for sorting sparse node numbers; memory at most 20 times the file's size, itself included.
FacetFile read_facets(const std::string& path);
/// The same of bytes in memory. @param name  stands for the path: its ending, its folder, in messages.
FacetFile read_facets(const std::string& name, std::string_view bytes);

/// Options of `load_facets()` and `cad::load()`.
struct LoadOptions {
    double tolerance = 0;      ///< gaps below it are sewn [model length]; 0: 1e-6 × the diagonal
    double feature_angle = 40; ///< where facets are cut into faces [degrees]
    bool keep_mesh = true;     ///< quads of FE formats stay as they are
    double scale = 1;          ///< every coordinate times this, > 0 [-]
};

/// Formats that somebody else reads, all files of theirs at once.
struct OtherFormats {
    std::string_view endings; ///< in lower case, a blank between: ".step .stp"
    std::function<topology::Model(const std::vector<std::string>& paths, const LoadOptions& options,
                                  const RunContext& context)>
        import;
};

/// Read files into one model. Facets are cut into faces by healing::split_facets(); a face that is all of a label has
/// the label's tag, the others count on from the highest; tags of later files go on from those of the first.
/// Faces that do not share edges are joined by healing::stitch().
/// @param others  formats beside those of read_facets().
/// @throw InvalidInput  as read_facets(), or an option out of range: "io.scale", "io.tolerance".
topology::Model load_facets(const std::vector<std::string>& paths, const LoadOptions& options = {},
                            const RunContext& context = {}, const OtherFormats& others = {});

/// The part of a path from its last dot on, in lower case; empty where there is none.
std::string ending_of(const std::string& path);

} // namespace lacuna::io
