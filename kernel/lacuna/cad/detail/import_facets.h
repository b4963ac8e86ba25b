// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lacuna/cad/load.h>
#include <lacuna/healing/split_facets.h>

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace lacuna::cad {

/// Facets of files, with what their labels stand for in them.
struct LabelledSoup {
    healing::FacetSoup soup;
    std::vector<int> label_tag; ///< tag each label has in its file: of a surface entity, a part, a group
};

/// Read the facets of STL, OBJ, MSH, BDF, UNV, VTK and Medit files and cut them into faces. A face that is
/// all of a label has the tag of that label in its file.
/// @pre every path has one of the endings of `is_facet_ending()`.
topology::Model import_facets(const std::vector<std::string>& paths, const LoadOptions& options,
                              const RunContext& context);

/// .stl .obj .msh .bdf .nas .unv .vtk .mesh, in lower case.
bool is_facet_ending(std::string_view ending);

/// Append the facets of a Wavefront OBJ file; `o` and `g` lines give labels.
/// @throw InvalidInput  a line that cannot be read; names file and line.
void read_obj(const std::string& path, LabelledSoup& into);

/// Number and name of the group each element of a universal file is in; the first group counts.
struct UnvGroup {
    int number = 0;
    std::string name;
};
std::map<std::size_t, UnvGroup> read_unv_groups(const std::string& path);

} // namespace lacuna::cad
