// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/fill.h>

#include <span>
#include <vector>

namespace lacuna::fill {

/// The contact of two regions, and its faces.
struct FoundContact {
    Contact contact;
    std::vector<sweep::FaceContact> faces; ///< in each of them, `a` belongs to the first region
};

/// Find contacts like `contacts()`. Without a gap, only regions that are not glued can be in contact.
std::vector<FoundContact> find_contacts(std::span<const sweep::AssemblyMember> members,
                                        const ContactRequest& request, const RunContext& context);

std::vector<Contact> without_faces(std::vector<FoundContact> found);

/// Add a contact and the groups of its faces to a mesh. Nothing is added if the volumes on one side of the
/// contact were left out of the mesh. A note is logged if the two meshes may overlap.
void add_contact(FilledParts& mesh, std::span<const sweep::AssemblyMember> members, const FoundContact& found,
                 const RunContext& context);

/// Add a mesh that shares no nodes with the whole.
void append(FilledParts& whole, FilledParts part);

} // namespace lacuna::fill
