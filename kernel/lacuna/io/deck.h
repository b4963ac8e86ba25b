// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/core/types.h>
#include <lacuna/mesh/cell_shape.h>
#include <lacuna/mesh/mesh_part.h>

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace lacuna::io {

/// Number of a node or an element as a file gives it, >= 0.
using DeckTag = std::int64_t;

enum class DeckFormat {
    nastran,
    abaqus,
    unv,
    msh,
    vtk,
    vtu,
    medit,
    stl,
    obj,
    exodus,
    dyna,
    febio,
    med,
};

using DeckShape = mesh::CellShape;
using DeckShapeInfo = mesh::CellShapeInfo;
using DeckSide = mesh::CellSide;
using mesh::face_corners;
using mesh::find_shape;
using mesh::shape_info;
using mesh::side_corners;

/// Elements of one shape and one type word of the file, in the file's order. Element e has the nodes [e · n,
/// (e + 1) · n) of `nodes`, where n is shape_info(shape).nodes.
struct DeckBlock {
    DeckShape shape = DeckShape::hex8;
    std::string type;             ///< as in the file: "CQUAD4", "S4R", "C3D8I", "115"; may be empty
    std::vector<Index> nodes{};   ///< indices in `Deck::points`; -1: a middle node that the file omits
    std::vector<DeckTag> tags{};  ///< for each element
    std::vector<Index> regions{}; ///< index in `Deck::regions`, for each element
    /// Fields of an element's card after its nodes, as in the file, separated by commas; for example angle,
    /// offset and thicknesses of a Nastran shell. Sorted by the element's index in the block.
    std::vector<std::pair<std::size_t, std::string>> more{};

    [[nodiscard]] std::size_t count() const { return tags.size(); }
    [[nodiscard]] std::span<const Index> element(std::size_t e) const
    {
        const auto n = static_cast<std::size_t>(shape_info(shape).nodes);
        return std::span(nodes).subspan(e * n, n);
    }
};

/// Elements that belong together: the elements of a property, of a section's element set, of a surface or
/// volume entity, or of a solid in an STL file. Each element is in exactly one region.
struct DeckRegion {
    int tag = 0;          ///< number of the property or entity; sets are numbered from 1
    std::string name;     ///< "pid:7", the name of the set, physical group or part; may be empty
    std::string material; ///< name or number of the material, if the file gives it
    std::string part{};   ///< its instance or part in an Abaqus deck
};

/// A named set. Nested sets and ranges are resolved.
struct DeckSet {
    using Kind = mesh::SetKind;
    Kind kind = Kind::elements;
    int tag = 0; ///< number of the group, if the format has one
    std::string name;
    /// Members of a set of nodes or elements, ascending, each once. They may include entities that only
    /// `texts` contains.
    std::vector<DeckTag> members{};
    std::vector<DeckSide> sides{}; ///< members of a surface, increasing, each once
    bool listed = false;           ///< an Abaqus deck lists it on a card of its own although it equals a
                                   ///< region
    bool of_one_deck = false;      ///< after a merge: holds all nodes or all solids of one of the merged
                                   ///< decks
};

/// A part instance. Decks without parts have none.
///
/// If two instances use the same numbers, those of the later instance are raised, so that numbers are unique
/// in the deck. Subtracting `offset` gives the numbers of the file. With more than one instance, sets are
/// named "instance.set".
struct DeckInstance {
    std::string name, part;
    std::size_t first_point = 0, points = 0; ///< range of the instance in `Deck::points`
    DeckTag offset = 0;                      ///< offset of its node and element numbers
};

/// Text of a file outside its mesh, verbatim, with line ends. It is written again if the output has the same
/// format. The text of an included file replaces the INCLUDE card.
struct DeckText {
    enum class Place : std::uint8_t {
        head,  ///< before the mesh: executive and case control up to BEGIN BULK; text before the first *NODE
        cards, ///< with the mesh: materials, sections, loads, frames, elements other than shells and solids
        tail,  ///< after the mesh: ENDDATA; in UNV, elements other than shells and solids
    };
    Place place = Place::cards;
    std::string part; ///< Abaqus part that contains it; empty: none
    std::string text;
};

struct Deck;

/// Record of the parts that were left out of a deck.
struct DeckGap {
    std::vector<std::string> names{}; ///< regions and sets that lost all elements or members
    DeckTag node = 0, cell = 0;       ///< highest numbers that were left out; text may still name them
    /// For each call of `leave_out()`: the elements that it left out, and the sets that contained some of
    /// them, as they were before the call.
    std::vector<std::shared_ptr<const Deck>> gone{};
    /// For each of these sets, by kind and name: the share of the lost members that added meshes have
    /// replaced [-].
    std::map<std::pair<DeckSet::Kind, std::string>, double> replaced{};
};

/// A finite element mesh as stored in a file.
struct Deck {
    std::string path;
    DeckFormat format = DeckFormat::nastran;
    double version = 0;              ///< version of the format, for .msh and .vtk
    std::string unit{};              ///< declared unit of its lengths, a name that `metres_of()` knows;
                                     ///< empty: none
    std::vector<Vec3> points;        ///< in the basic frame [the file's length], in the file's order
    std::vector<DeckTag> point_tags; ///< unique
    /// Fields of a node's card after its coordinates, as in the file, separated by commas; for example the
    /// displacement frame and the constraints of a Nastran node. Sorted by the index in `points`.
    std::vector<std::pair<std::size_t, std::string>> point_more;
    std::vector<DeckBlock> blocks;
    std::vector<DeckRegion> regions;
    std::vector<DeckSet> sets;
    std::vector<mesh::ContactPair> contacts{}; ///< contacts between meshes that were not read from a file
    std::vector<DeckInstance> instances;
    std::vector<DeckText> texts;
    std::vector<std::string> notes; ///< ignored content with counts; one sentence each
    /// Content that was read differently from the file; one sentence each.
    std::vector<std::string> warnings{};
    DeckGap gap{};

    [[nodiscard]] std::size_t element_count() const;
    /// Number of elements of a dimension. @param dimension  1, 2 or 3.
    [[nodiscard]] std::size_t element_count(int dimension) const;
};

/// The deck's nodes at each of several positions.
struct NodesAt {
    std::vector<Index> first; ///< start of each position's nodes in `nodes`, and the end of the last
    std::vector<Index> nodes; ///< indices in `Deck::points`, increasing for each position; several if nodes
                              ///< coincide

    [[nodiscard]] std::span<const Index> at(std::size_t place) const
    {
        return std::span(nodes).subspan(index(first[place]), index(first[place + 1] - first[place]));
    }
};

/// Find the nodes of a deck at given positions: points of a model, or nodes of a mesh made from the deck.
/// @param places     [the deck's length × scale].
/// @param tolerance  maximum distance of a node [model length], >= 0.
/// @note  O(n) if only a few nodes are within the tolerance of each other.
NodesAt nodes_at(const Deck& deck, std::span<const Vec3> places, double tolerance, double scale = 1);

/// Read the mesh of a file: .bdf .nas .dat (Nastran), .inp (Abaqus, CalculiX), .unv, .msh, .vtk, .vtu, .mesh,
/// .exo, .e, .k, .key, .dyn, .med, .stl, .obj. The file extension, in upper or lower case, determines the
/// format, and the content must agree.
/// @param context  its log gets the deck's warnings, each after "note: ".
/// @throw InvalidInput  as read_facets().
Deck read_deck(const std::string& path, const RunContext& context = {});
/// `read_deck()` for bytes in memory, without logging. @param name  used like a path: for the extension, the
/// folder and messages.
Deck read_deck(const std::string& name, std::string_view bytes);

/// The part of a path from its last dot, in lower case; empty if there is none.
std::string ending_of(const std::string& path);

} // namespace lacuna::io
