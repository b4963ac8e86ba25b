// SPDX-License-Identifier: GPL-2.0-or-later
#include <lacuna/cad/detail/import_facets.h>
#include <lacuna/healing/split_facets.h>

#include <lacuna/cad_worker/detail/gmsh_api.h>
#include <lacuna/cad/detail/import_cad.h>
#include <lacuna/cad/detail/input_file.h>
#include <lacuna/cad_worker/session.h>

#include <algorithm>
#include <fstream>
#include <unordered_map>

namespace lacuna::cad {

namespace {

/// What a file of each kind begins with. Gmsh takes a file it does not know for a script and runs it.
bool begins_as(const std::string& path, const std::string& ending)
{
    std::ifstream file(path, std::ios::binary);
    std::string head(256, '\0');
    file.read(head.data(), static_cast<std::streamsize>(head.size()));
    head.resize(static_cast<std::size_t>(file.gcount()));
    if (head.starts_with("\xef\xbb\xbf")) head.erase(0, 3);
    head.erase(0, head.find_first_not_of(" \t\r\n"));
    if (ending == ".msh") return head.starts_with('$');
    if (ending == ".vtk") return head.starts_with("# vtk");
    if (ending == ".unv") return head.starts_with("-1");
    if (ending == ".mesh") return head.starts_with("MeshVersion") || head.starts_with('#');
    return true;
}

std::string trimmed(std::string text)
{
    text.erase(0, std::min(text.size(), text.find_first_not_of(" \t\r\n")));
    while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back()))) text.pop_back();
    return text;
}

std::string name_of_entity(int tag, const std::string& ending)
{
    if (ending == ".bdf" || ending == ".nas") return "pid:" + std::to_string(tag);
    std::vector<int> groups;
    gmsh::model::getPhysicalGroupsForEntity(2, tag, groups);
    for (const int group : groups) {
        std::string name;
        gmsh::model::getPhysicalName(2, std::abs(group), name);
        if (!name.empty()) return trimmed(name);
    }
    std::string name;
    gmsh::model::getEntityName(2, tag, name);
    return trimmed(name);
}

/// Adds what is in the current Gmsh model to a soup.
class GmshCollector {
public:
    GmshCollector(LabelledSoup& into, int tag_offset) : into_(into), tag_offset_(tag_offset) {}

    void collect(const std::string& path, const std::string& ending)
    {
        if (ending == ".unv") groups_ = read_unv_groups(path);
        std::vector<std::size_t> tags;
        std::vector<double> at, parameters;
        gmsh::model::mesh::getNodes(tags, at, parameters, -1, -1, false, false);
        for (std::size_t i = 0; i < tags.size(); ++i)
            node_at_[tags[i]] = {at[3 * i], at[3 * i + 1], at[3 * i + 2]};
        gmsh::vectorpair entities;
        gmsh::model::getEntities(entities, 2);
        for (const auto& [dim, tag] : entities) collect_entity(tag, ending);
    }

private:
    void collect_entity(int tag, const std::string& ending)
    {
        std::vector<int> types;
        std::vector<std::vector<std::size_t>> elements, nodes;
        gmsh::model::mesh::getElements(types, elements, nodes, 2, tag);
        for (std::size_t t = 0; t < types.size(); ++t) {
            std::string type_name;
            int dim = 0, order = 0, node_count = 0, corners = 0;
            std::vector<double> local;
            gmsh::model::mesh::getElementProperties(types[t], type_name, dim, order, node_count, local,
                                                    corners);
            if (corners != 3 && corners != 4) continue;
            for (std::size_t e = 0; e < elements[t].size(); ++e) {
                const int label = label_of(elements[t][e], tag, ending);
                const std::size_t* node = nodes[t].data() + e * static_cast<std::size_t>(node_count);
                if (corners == 3) {
                    into_.soup.triangles.push_back({point(node[0]), point(node[1]), point(node[2])});
                    into_.soup.triangle_label.push_back(label);
                } else {
                    into_.soup.quads.push_back(
                        {point(node[0]), point(node[1]), point(node[2]), point(node[3])});
                    into_.soup.quad_label.push_back(label);
                }
            }
        }
    }

    int label_of(std::size_t element, int entity, const std::string& ending)
    {
        const auto group = groups_.find(element);
        if (group != groups_.end()) return label(group->second.number, true, group->second.name);
        if (labels_.contains({entity, false})) return labels_.at({entity, false});
        return label(entity, false, name_of_entity(entity, ending));
    }

    int label(int tag, bool of_group, const std::string& name)
    {
        const auto [found, fresh] = labels_.try_emplace({tag, of_group},
                                                        static_cast<int>(into_.label_tag.size()));
        if (fresh) {
            into_.label_tag.push_back(tag + tag_offset_);
            into_.soup.label_name.push_back(name);
        }
        return found->second;
    }

    Index point(std::size_t node)
    {
        const auto [found, fresh] = place_.try_emplace(node, static_cast<Index>(into_.soup.points.size()));
        if (fresh) into_.soup.points.push_back(node_at_.at(node));
        return found->second;
    }

    LabelledSoup& into_;
    int tag_offset_;
    std::map<std::size_t, UnvGroup> groups_;
    std::map<std::pair<int, bool>, int> labels_;
    std::unordered_map<std::size_t, Vec3> node_at_;
    std::unordered_map<std::size_t, Index> place_;
};

void read_with_gmsh(const std::string& path, const std::string& ending, LabelledSoup& into)
{
    if (!begins_as(path, ending)) {
        throw InvalidInput("cad.unreadable",
                           path + " does not hold what its ending promises; check the file, or give it the "
                                  "ending of what it holds");
    }
    int tag_offset = 0;
    for (const int tag : into.label_tag) tag_offset = std::max(tag_offset, tag);
    const cad_worker::Gmsh gmsh;
    cad_worker::Session session(path);
    const cad_worker::GmshModel model(session);
    const std::size_t before = into.soup.triangles.size() + into.soup.quads.size();
    try {
        session.run([&] { gmsh::merge(path); });
    } catch (const BackendError& error) {
        throw InvalidInput("cad.unreadable", error.what());
    }
    model.activate(session);
    session.run([&] { GmshCollector(into, tag_offset).collect(path, ending); });
    if (into.soup.triangles.size() + into.soup.quads.size() > before) return;

    gmsh::vectorpair solids;
    session.run([&] { gmsh::model::getEntities(solids, 3); });
    std::string words;
    for (const std::string& error : session.logged_errors()) words += "; Gmsh says: " + error;
    throw InvalidInput(
        "cad.no_faces",
        path + " holds no faces" +
            (solids.empty()
                 ? " that can be read; check that it is what its ending says, and holds triangles or quads"
                 : ", only solid cells; export their skin as shells") +
            words);
}

/// Quads as two triangles each, for those who want them meshed anew.
void split_quads(healing::FacetSoup& soup)
{
    for (std::size_t q = 0; q < soup.quads.size(); ++q) {
        const Quad& quad = soup.quads[q];
        // Along the shorter diagonal.
        const auto at = [&](std::size_t k) -> const Vec3& {
            return soup.points[static_cast<std::size_t>(quad[k])];
        };
        const std::size_t k = (at(0) - at(2)).squaredNorm() <= (at(1) - at(3)).squaredNorm() ? 0 : 1;
        soup.triangles.push_back({quad[k], quad[k + 1], quad[k + 2]});
        soup.triangles.push_back({quad[k], quad[k + 2], quad[(k + 3) % 4]});
        soup.triangle_label.insert(soup.triangle_label.end(), 2, soup.quad_label[q]);
    }
    soup.quads.clear();
    soup.quad_label.clear();
}

/// Give faces their labels' names and, where a label is one face, its tag; the others count on from the
/// highest tag.
void name_faces(topology::Model& model, const std::vector<std::string>& names,
                const std::vector<int>& label_tag)
{
    std::vector<std::size_t> label_of_face;
    std::vector<int> faces_of_label(names.size(), 0);
    for (const topology::Face& face : model.faces) {
        label_of_face.push_back(static_cast<std::size_t>(std::stoul(face.name)));
        ++faces_of_label[label_of_face.back()];
    }
    // A file of one part: the faces are counted as they come.
    const bool counted = names.size() == 1 && model.faces.size() > 1;
    int next = 0;
    for (const int tag : label_tag) next = std::max(next, tag);
    for (std::size_t f = 0; f < model.faces.size(); ++f) {
        const std::size_t label = label_of_face[f];
        model.faces[f].name = names[label];
        if (!counted) model.faces[f].tag = faces_of_label[label] == 1 ? label_tag[label] : ++next;
    }
}

} // namespace

bool is_facet_ending(std::string_view ending)
{
    for (const std::string_view known : {".stl", ".obj", ".msh", ".bdf", ".nas", ".unv", ".vtk", ".mesh"}) {
        if (ending == known) return true;
    }
    return false;
}

topology::Model import_facets(const std::vector<std::string>& paths, const LoadOptions& options,
                              const RunContext& context)
{
    LabelledSoup all;
    std::string source;
    for (const std::string& path : paths) {
        check_cancelled(context);
        source += (source.empty() ? "" : ", ") + path;
        const std::string ending = ending_of(path);
        if (ending == ".obj") {
            const std::size_t before = all.soup.triangles.size() + all.soup.quads.size();
            read_obj(path, all);
            if (all.soup.triangles.size() + all.soup.quads.size() == before) {
                throw InvalidInput("cad.no_faces",
                                   path +
                                       " holds no faces; check that it is a Wavefront OBJ file with f lines");
            }
        } else {
            read_with_gmsh(path, ending, all);
        }
    }
    for (Vec3& p : all.soup.points) p *= options.scale;
    if (!options.keep_mesh) split_quads(all.soup);
    // Names may be alike or missing: faces carry the label's number through the cutting.
    const std::vector<std::string> names = std::exchange(all.soup.label_name, {});
    for (std::size_t label = 0; label < names.size(); ++label)
        all.soup.label_name.push_back(std::to_string(label));
    topology::Model model = healing::split_facets(all.soup, {options.feature_angle, options.tolerance});
    name_faces(model, names, all.label_tag);
    model.source = source;
    return model;
}

} // namespace lacuna::cad
