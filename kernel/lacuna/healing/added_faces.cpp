// SPDX-License-Identifier: MIT
#include <lacuna/healing/shared/added_faces.h>

#include <lacuna/core/error.h>
#include <lacuna/healing/detail/soup_facets.h>

#include <utility>

namespace lacuna::healing {

void add(AddedFaces& faces, const AddedFace& face)
{
    FacetSoup& soup = faces.soup;
    const int label = faces.count++;
    const auto offset = static_cast<Index>(soup.points.size());
    soup.points.insert(soup.points.end(), face.points.begin(), face.points.end());
    soup.label_name.push_back(face.name);
    soup.label_keeps_nodes.push_back(face.keep_mesh ? 1 : 0);
    const auto add_triangle = [&](const Triangle& triangle) {
        soup.triangles.push_back(triangle);
        soup.triangle_label.push_back(label);
    };
    for (const std::array<int, 4>& cell : face.cells) {
        const Quad q{offset + cell[0] - 1, offset + cell[1] - 1, offset + cell[2] - 1, offset + cell[3] - 1};
        if (cell[3] == 0) {
            add_triangle({q[0], q[1], q[2]});
        } else if (face.keep_mesh) {
            soup.quads.push_back(q);
            soup.quad_label.push_back(label);
        } else {
            for (const Triangle& triangle : halves_of(soup.points, q)) add_triangle(triangle);
        }
    }
}

topology::Model model_of(const AddedFaces& added, const RunContext& context)
{
    SplitOptions options;
    options.whole_labels = true;
    options.tolerance = added.tolerance;
    topology::ModelBuilder model(split_facets(added.soup, options, context));
    if (model.faces.size() != static_cast<std::size_t>(added.count))
        throw InvalidInput(Message("lua.face_in_parts",
                                   "the {} added faces became {}, because the cells of a face are not "
                                   "connected",
                                   needed(added.count), found(model.faces.size()))
                               .remedy("add each part as a face of its own"));
    // Restore the order of adding: split_facets() makes the faces of triangles before those of quads.
    std::vector<topology::Face> faces(model.faces.size());
    std::vector<bool> met(model.faces.size(), false);
    std::size_t next = 0;
    for (const std::vector<int>* labels : {&added.soup.triangle_label, &added.soup.quad_label})
        for (const int label : *labels) {
            const auto place = static_cast<std::size_t>(label);
            if (met[place]) continue;
            met[place] = true;
            faces[place] = std::move(model.faces[next++]);
            faces[place].tag = label + 1;
        }
    model.faces = std::move(faces);
    model.source = "faces of the recipe";
    return std::move(model).finish();
}

} // namespace lacuna::healing
