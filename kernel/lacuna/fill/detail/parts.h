// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/fill.h>
#include <lacuna/fill/detail/kept_mesh.h>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

/// Parts of an assembly, and the options that name their faces. Internal to this folder.
namespace lacuna::fill {

/// A part of the assembly: a volume, or a piece of a volume, with its options; or a finished mesh.
struct Part {
    const Member* asked = nullptr; ///< null for a finished mesh
    std::string asked_name;        ///< name of the member volume, for messages
    Volume volume;
    std::unique_ptr<KeptMesh> kept;
    bool left_out = false;            ///< left out of the sweep; options may still name its faces
    const Volume* piece_of = nullptr; ///< volume that this part is a piece of; null: it is not a piece
    std::string whole{};              ///< name of that volume
    std::size_t glue = 0;             ///< as in `sweep::AssemblyMember`
    bool is_block = false;            ///< whether all pieces have six four-sided faces and straight edges
};

/// Drop the faces that a member does not have from its options: options for several volumes may name faces
/// that only one of these volumes has.
void keep_known_faces(sweep::AssemblyMember& member);

/// Drop the pairs of periodic faces if no member has any of their faces.
void keep_known_pairs(std::vector<sweep::AssemblyMember>& members);

/// Refuse a named face that no volume has. An option of a single volume may name only faces of that volume.
void check_known_faces(const std::vector<Part>& all);

} // namespace lacuna::fill
