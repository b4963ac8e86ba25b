// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/core/types.h>
#include <lacuna/mesh/cell_shape.h>

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

enum class DeckFormat { nastran, abaqus, unv, msh, vtk, vtu, medit, stl, obj, exodus };

using DeckShape = mesh::CellShape;
using DeckShapeInfo = mesh::CellShapeInfo;
inline constexpr std::size_t kDeckShapes = mesh::kCellShapes;
using mesh::face_corners;
using mesh::find_shape;
using mesh::shape_info;
using mesh::side_corners;

/// Elements of one shape and one word of the file, in the file's order. Element e has the nodes
/// [e · n, (e + 1) · n) of `nodes`, where n is shape_info(shape).nodes.
struct DeckBlock {
    DeckShape shape = DeckShape::hex8;
    std::string type;             ///< as the file says it: "CQUAD4", "S4R", "C3D8I", "115"; may be empty
    std::vector<Index> nodes{};   ///< places in `Deck::points`; -1: a middle node the file leaves out
    std::vector<DeckTag> tags{};  ///< of each element
    std::vector<Index> regions{}; ///< of each element: its place in `Deck::regions`
    /// What an element's card holds behind its nodes, as the file has it, fields apart by commas: angle,
    /// offset and thicknesses of a Nastran shell. By the element's place in the block, rising.
    std::vector<std::pair<std::size_t, std::string>> more{};

    [[nodiscard]] std::size_t count() const { return tags.size(); }
    [[nodiscard]] std::span<const Index> element(std::size_t e) const
    {
        const auto n = static_cast<std::size_t>(shape_info(shape).nodes);
        return std::span(nodes).subspan(e * n, n);
    }
};

/// What every element belongs to one of: a property, the element set of a section, a surface or volume
/// entity, a solid of an STL file.
struct DeckRegion {
    int tag = 0;          ///< number of the property or entity; sets are counted from 1
    std::string name;     ///< "pid:7", the name of the set, physical group or part; may be empty
    std::string material; ///< name or number of the material, where the file says it
    std::string part{};   ///< the instance or part of an Abaqus deck it lies in
};

/// A side of an element as surfaces name it: 1, 2, … is a face (of a shell, in 3D, an edge) in the numbering
/// of the format; 0 the side a shell's normal points to, -1 the other.
struct DeckSide {
    DeckTag element = 0;
    int side = 0;
    friend constexpr auto operator<=>(const DeckSide&, const DeckSide&) = default;
};

/// A named set. Sets within sets and ranges are resolved.
struct DeckSet {
    enum class Kind : std::uint8_t { nodes, elements, sides };
    Kind kind = Kind::elements;
    int tag = 0; ///< number of the group, where the format has one
    std::string name;
    std::vector<DeckTag> members{}; ///< of nodes or elements, rising, each once; may name what is in `texts`
    std::vector<DeckSide> sides{};  ///< of a surface, rising, each once
    bool listed = false;            ///< Abaqus has a card of it, even where it is all elements of a region
    bool of_one_deck = false;       ///< holds all nodes or solids of one of the decks that were merged
};

/// A part put in place. Decks without parts have none.
///
/// Where two instances number alike, the numbers of the later ones are raised so that a number is unique in
/// the deck: less `offset` they are the file's. Likewise the names of sets become "instance.set" as soon as
/// there is more than one instance.
struct DeckInstance {
    std::string name, part;
    std::size_t first_point = 0, points = 0; ///< of `Deck::points`
    DeckTag offset = 0;                      ///< of nodes and elements
};

/// Text of a file that is no mesh, verbatim and with its line ends, so that the same format can be written
/// again. Files included are put where they were named.
struct DeckText {
    enum class Place : std::uint8_t {
        head, ///< before the mesh: executive and case control up to BEGIN BULK; what precedes the first *NODE
        cards, ///< beside the mesh: materials, sections, loads, frames, elements that are no shells or solids
        tail,  ///< behind it: ENDDATA; in UNV, elements that are no shells or solids
    };
    Place place = Place::cards;
    std::string part; ///< part of an Abaqus deck it stands in; empty: none
    std::string text;
};

struct Deck;

/// What was left out of a deck.
struct DeckGap {
    std::vector<std::string> names{}; ///< regions and sets without elements or members now
    DeckTag node = 0, cell = 0;       ///< the highest numbers left out, which text may still name
    /// What each `leave_out()` left out; the sets are those that held some of it, as they were.
    std::vector<std::shared_ptr<const Deck>> gone{};
    /// Of these sets, by kind and name, the share of what they lost that meshes have replaced [-].
    std::map<std::pair<DeckSet::Kind, std::string>, double> replaced{};
};

/// A finite element mesh as a file holds it.
struct Deck {
    std::string path;
    DeckFormat format = DeckFormat::nastran;
    double version = 0;              ///< of .msh and .vtk
    std::vector<Vec3> points;        ///< in the basic frame [the file's length], in the file's order
    std::vector<DeckTag> point_tags; ///< unique
    /// What a node's card holds behind its coordinates, as the file has it, fields apart by commas: the frame
    /// of a Nastran node's displacements, its constraints. By place in `points`, rising.
    std::vector<std::pair<std::size_t, std::string>> point_more;
    std::vector<DeckBlock> blocks;
    std::vector<DeckRegion> regions;
    std::vector<DeckSet> sets;
    std::vector<DeckInstance> instances;
    std::vector<DeckText> texts;
    std::vector<std::string> notes; ///< what was passed over, counted; a sentence each
    /// What was read otherwise than it stands; a sentence each.
    std::vector<std::string> warnings{};
    DeckGap gap{};

    [[nodiscard]] std::size_t element_count() const;
    /// Of elements of a dimension. @param dimension  1, 2 or 3.
    [[nodiscard]] std::size_t element_count(int dimension) const;
};

/// The deck's nodes at each of some places.
struct NodesAt {
    std::vector<Index> first; ///< of each place, in `nodes`, and one behind the last
    std::vector<Index> nodes; ///< places in `Deck::points`, rising; several where nodes coincide

    [[nodiscard]] std::span<const Index> at(std::size_t place) const
    {
        return std::span(nodes).subspan(index(first[place]), index(first[place + 1] - first[place]));
    }
};

/// Which nodes of a deck lie at each place: of the points of a model or the nodes of a mesh made from it, the
/// ones that were given.
/// @param places     [the deck's length × scale].
/// @param tolerance  nodes no further than this count [model length], >= 0.
/// @note  O(n) where no more than a few nodes are within the tolerance of each other.
NodesAt nodes_at(const Deck& deck, std::span<const Vec3> places, double tolerance, double scale = 1);

/// Read the mesh of a file: .bdf .nas .dat (Nastran), .inp (Abaqus, CalculiX), .unv, .msh, .vtk, .vtu, .mesh,
/// .exo, .e, .stl, .obj; the ending says which, in any case, and the content must agree.
/// @param context  its log is told the deck's warnings, each behind "note: ".
/// @throw InvalidInput  as read_facets().
Deck read_deck(const std::string& path, const RunContext& context = {});
/// The same of bytes in memory, without that. @param name  stands for the path: its ending, its folder, in
/// messages.
Deck read_deck(const std::string& name, std::string_view bytes);

/// The part of a path from its last dot on, in lower case; empty where there is none.
std::string ending_of(const std::string& path);

} // namespace lacuna::io
