// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/io/deck_file.h>
#include <lacuna/mesh/mesh_part.h>
#include <lacuna/mesh/tet_mesh.h>

#include <cstddef>
#include <span>
#include <string>

namespace lacuna::io {

/// Tetrahedra and pyramids among several meshes with shared nodes. Holds references only.
struct NumberedTets {
    const mesh::TetPart& mesh;
    std::span<const Index> numbers; ///< number of each of its nodes in the whole mesh, from 0
};

/// Convert swept meshes and tetrahedra with shared nodes to a deck, with regions and sets as in
/// `write_mesh()`.
/// @param swept       meshes that store their nodes
/// @param nodes       number of nodes of the whole mesh
/// @param interfaces  as `MeshFileOptions::interfaces`
/// @throw InvalidInput  as `write_mesh()`.
/// @throw Cancelled
/// @note  O(n log n) in the sides of the skins, O(n) in the cells.
Deck deck_of(std::span<const mesh::LayeredPart> swept, std::span<const NumberedTets> tets, std::size_t nodes,
             MeshDeckOptions options, bool interfaces, const RunContext& context = {});

/// Append cells to a deck, between existing nodes. They form a new region and a new set (in Nastran a region
/// only).
/// @param cells    hexahedra and wedges of order 1 or 2, as indices in `Deck::points`
/// @param element  Abaqus type of the hexahedra, such as "COH3D8"
void add_layer(Deck& deck, std::span<const mesh::CellNodes> cells, const std::string& region,
               const std::string& element);

/// List contact pairs of meshes that were added to a deck, with the sets of their sides.
void add_contacts(Deck& deck, std::span<const mesh::ContactPair> pairs, const JoinedBefore& before);

/// As `join_deck()` of `deck_file.h`, for tetrahedra and pyramids.
Deck join_deck(const Deck& deck, const topology::Model& model, double scale, const mesh::TetPart& mesh,
               const MeshDeckOptions& options, const RunContext& context = {}, const Deck* gone = nullptr,
               JoinedBefore* before = nullptr);

} // namespace lacuna::io
