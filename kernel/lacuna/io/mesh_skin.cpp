// SPDX-License-Identifier: MIT
#include <lacuna/io/shared/mesh_skin.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/renumbered.h>
#include <lacuna/healing/shared/add_facet.h>
#include <lacuna/io/detail/texts.h>

#include <string>

namespace lacuna::io {

MeshSkin skin_of(const mesh::HexMesh& mesh, const RunContext& context)
{
    healing::FacetSoup soup;
    Renumbered<Vec3> nodes(mesh.nodes);
    for (std::size_t p = 0; p < mesh.patches.size(); ++p) soup.label_name.push_back(std::to_string(p));
    soup.label_keeps_nodes.assign(mesh.patches.size(), 1);
    for (std::size_t i = 0; i < mesh.skin_count(); ++i) {
        const mesh::SkinQuad skin = skin_quad(mesh, i);
        Quad quad = skin.nodes;
        for (Index& n : quad) n = nodes(n);
        healing::add_facet(soup, std::span(quad).first(mesh::corner_count(quad)), skin.patch);
    }
    soup.points = std::move(nodes.used);
    healing::SplitOptions options;
    options.whole_labels = true;
    topology::ModelBuilder model(healing::split_facets(soup, options, context));
    topology::Roles roles;
    MeshSkin skin;
    skin.face.resize(mesh.patches.size());
    for (std::size_t f = 0; f < model.faces.size(); ++f) {
        topology::Face& face = model.faces[f];
        const auto patch = static_cast<std::size_t>(std::stoul(face.name));
        const mesh::SkinPatch& of = mesh.patches[patch];
        face.name = of.groups.empty() ? "" : of.groups.front();
        face.tag = of.face != 0 ? of.face : of.tag;
        if (skin.face[patch].valid())
            throw InvalidInput(Message("io.skin_in_pieces", "the quads of {} of a mesh are not connected",
                                       NamedEntity{"patch", of.tag, face.name})
                                   .remedy("give the assembly the volume instead of its mesh"));
        skin.face[patch] = FaceId(f);
        roles.walls.emplace_back(f);
    }
    for (std::size_t p = 0; p < skin.face.size(); ++p) {
        if (!skin.face[p].valid())
            throw InvalidInput(Message("io.skin_in_pieces", "{} of a mesh has no quads",
                                       numbered("patch", mesh.patches[p].tag))
                                   .remedy("give the assembly the volume instead of its mesh"));
    }
    skin.volume = topology::open_volume(std::move(model).finish(), roles, context);
    return skin;
}

} // namespace lacuna::io
