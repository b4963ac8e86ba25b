// SPDX-License-Identifier: MIT
//
// OpenFOAM's polyMesh: a folder of files with the points, the faces, the owner and neighbour cell of each
// face, and the patches of boundary faces. https://doc.openfoam.com/2306/fundamentals/mesh
#include <lacuna/core/error.h>
#include <lacuna/core/shared/progress.h>
#include <lacuna/core/shared/same_corners.h>
#include <lacuna/io/detail/format_table.h>
#include <lacuna/io/detail/sections.h>
#include <lacuna/io/detail/texts.h>
#include <lacuna/io/detail/whole_folder.h>
#include <lacuna/topology/shared/skin_groups.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <set>
#include <utility>

namespace lacuna::io {

void write_poly_mesh(const mesh::MeshView& view, const OutputPath& path, const RunContext& context);

namespace {

using mesh::MeshView;

/// A face of a cell: its corners, counter-clockwise seen from outside the cell. The fourth is -1 for a
/// triangle.
struct CellFace {
    Quad corners;
    Index cell;
};

/// Convert a name to a valid OpenFOAM word.
std::string word_of(const std::string& name)
{
    std::string word = name;
    for (char& c : word)
        if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '.' && c != '-') c = '_';
    if (word.empty() || std::isalpha(static_cast<unsigned char>(word[0])) == 0) word.insert(0, "g_");
    return word;
}

/// Converts names to words, so that different names get different words.
class Words {
public:
    const std::string& operator[](const std::string& name)
    {
        const auto [at, fresh] = words_.try_emplace(name);
        if (!fresh) return at->second;
        std::string word = word_of(name);
        for (int i = 2; !taken_.insert(word).second; ++i) word = word_of(name) + "_" + std::to_string(i);
        return at->second = word;
    }

private:
    std::map<std::string, std::string> words_;
    std::set<std::string> taken_;
};

/// Faces in OpenFOAM's order: internal faces by owner, then by neighbour; boundary faces by patch.
class PolyMesh {
public:
    PolyMesh(const MeshView& view, const RunContext& context) : view_(view), context_(context)
    {
        gather_cells();
        number_points();
        find_faces();
        find_patches();
    }

    struct Patch {
        std::string name;
        std::size_t first, count;
    };
    mesh::Ranges points;           ///< view indices of the points that cells use
    std::vector<Quad> faces;       ///< point numbers, counter-clockwise seen from outside the owner cell
    std::vector<Index> owners;     ///< one for each face
    std::vector<Index> neighbours; ///< one for each internal face; internal faces come before boundary faces
    std::vector<Patch> patches;
    std::vector<std::pair<std::string, mesh::Ranges>> zones; ///< cells of each region
    std::size_t cells = 0;
    std::vector<std::string> notes;

private:
    static std::string group_of(const MeshView::Entity& entity, const char* otherwise)
    {
        return entity.groups.empty() ? otherwise : entity.groups[entity.main];
    }

    void gather_cells()
    {
        std::map<std::string, std::size_t> known;
        for (const MeshView::Block& block : view_.blocks) {
            const mesh::CellShapeInfo& info = mesh::shape_info(block.shape);
            if (info.dimension != 3 || block.count == 0) continue;
            if (info.nodes != info.corners)
                throw InvalidInput(Message("io.no_such_element",
                                           "polyMesh has no middle nodes, but {} cells have {} nodes each",
                                           block.count, info.nodes)
                                       .remedy("sweep with order = 1"));
            mesh::each_run(block.entities, 0, block.count,
                           [&](std::size_t first, std::size_t last, Index entity) {
                               const std::string name = group_of(view_.entities[index(entity)], "volume");
                               const auto [at, fresh] = known.try_emplace(name, zones.size());
                               if (fresh) zones.emplace_back(name, mesh::Ranges());
                               zones[at->second].second.add(cells + first, cells + last);
                           });
            const std::span<const Quad> sides = mesh::face_corners(block.shape);
            block.each_cell(0, block.count, [&](std::size_t i, std::span<const Index> nodes) {
                for (const Quad& side : sides) {
                    CellFace& face = found_.emplace_back();
                    face.cell = static_cast<Index>(cells + i);
                    std::ranges::transform(side, face.corners.begin(),
                                           [&](Index c) { return c < 0 ? c : nodes[index(c)]; });
                }
            });
            cells += block.count;
            check_cancelled(context_);
        }
        if (cells == 0)
            throw InvalidInput(Message("io.no_such_element", "a polyMesh needs cells, but the mesh has none")
                                   .remedy("write another format"));
    }

    /// Drop points that no cell uses, because checkMesh would report them as an error.
    void number_points()
    {
        place_.assign(view_.points, -1);
        for (const CellFace& face : found_)
            for (const Index corner : face.corners)
                if (corner >= 0) place_[index(corner)] = 0;
        for (std::size_t p = 0; p < place_.size(); ++p) {
            if (place_[p] < 0) continue;
            place_[p] = static_cast<Index>(points.count());
            points.add(p, p + 1);
        }
    }

    void put(const CellFace& face)
    {
        Quad& own = faces.emplace_back(face.corners);
        for (Index& corner : own)
            if (corner >= 0) corner = place_[index(corner)];
        owners.push_back(face.cell);
    }

    /// Two faces with the same corners become one internal face. A boundary face gets the entity of the quad
    /// or triangle with the same corners.
    void find_faces()
    {
        std::vector<std::pair<Quad, Index>> skin; // corners and entity
        for (const MeshView::Block& block : view_.blocks) {
            const mesh::CellShapeInfo& info = mesh::shape_info(block.shape);
            if (info.dimension != 2) continue;
            mesh::each_run(block.entities, 0, block.count,
                           [&](std::size_t first, std::size_t last, Index entity) {
                               block.each_cell(first, last, [&](std::size_t, std::span<const Index> nodes) {
                                   Quad& corners = skin.emplace_back(Quad{-1, -1, -1, -1}, entity).first;
                                   std::copy_n(nodes.begin(), info.corners, corners.begin());
                               });
                           });
        }
        struct Inner {
            Index owner, neighbour, face;
        };
        std::vector<Inner> inner;
        std::size_t inside = skin.size();
        const auto each = [&](const auto& visit) {
            for (std::size_t f = 0; f < found_.size(); ++f) visit(found_[f].corners, f);
            for (std::size_t q = 0; q < skin.size(); ++q) visit(skin[q].first, found_.size() + q);
        };
        each_with_same_corners(view_.points, each, [&](std::span<const NumberedCell> alike) {
            const auto is_cell = [&](const NumberedCell& of) { return of.number < found_.size(); };
            const auto beside = static_cast<std::size_t>(std::ranges::count_if(alike, is_cell));
            if (beside == 0) return;
            const auto face = static_cast<Index>(alike[0].number);
            const Index owner = found_[index(face)].cell; // the owner is the lower cell, because faces were
                                                          // collected cell by cell
            if (beside > 2)
                throw InvalidInput(
                    Message("io.not_conformal",
                            "a face of {} belongs to {} cells, but at most {} can share a face",
                            numbered("cell", owner + 1), found(beside), needed("two"))
                        .remedy("remove cells that occur twice"));
            if (beside == 2) return inner.push_back({owner, found_[alike[1].number].cell, face});
            Index entity = -1;
            for (const NumberedCell& of : alike.subspan(1)) {
                const Index own = skin[of.number - found_.size()].second;
                entity = entity < 0 ? own : std::min(entity, own);
            }
            inside -= alike.size() > 1 ? 1 : 0;
            of_entity_[entity].push_back(face);
        });
        std::ranges::sort(inner, {}, [](const Inner& of) { return std::pair(of.owner, of.neighbour); });
        for (const Inner& of : inner) {
            put(found_[index(of.face)]);
            neighbours.push_back(of.neighbour);
        }
        if (inside > 0)
            notes.push_back(formatted("{} quads and triangles inside the mesh are not written: a polyMesh "
                                      "has patches on its boundary only",
                                      inside));
    }

    /// The first groups that entities with different groups have in common.
    std::set<std::string> shared_groups() const
    {
        std::map<std::string, const MeshView::Entity*> known;
        std::set<std::string> shared;
        for (const auto& [number, own] : of_entity_) {
            if (number < 0) continue;
            const MeshView::Entity& entity = view_.entities[index(number)];
            const std::string first = group_of(entity, kNoGroup);
            if (known.try_emplace(first, &entity).first->second->groups != entity.groups)
                shared.insert(first);
        }
        return shared;
    }

    /// The patch of an entity's faces: its first group. If other entities, with other groups, have the same
    /// first group, a void face is a patch of its own: an inlet and an outlet may both be in `target`.
    static std::string patch_of(const MeshView::Entity& entity, const std::set<std::string>& shared)
    {
        const std::string first = group_of(entity, kNoGroup);
        const auto own = std::ranges::find_if(entity.groups, topology::is_void_group);
        return shared.contains(first) && own != entity.groups.end() ? *own : first;
    }

    /// Make the patches. Faces without a group come last.
    void find_patches()
    {
        std::vector<std::pair<std::string, std::vector<Index>>> groups;
        const std::set<std::string> shared = shared_groups();
        const auto add = [&](const std::string& name, const std::vector<Index>& own) {
            auto group = std::ranges::find(groups, name, &std::pair<std::string, std::vector<Index>>::first);
            if (group == groups.end()) group = groups.insert(group, {name, {}});
            group->second.insert(group->second.end(), own.begin(), own.end());
        };
        for (const auto& [entity, own] : of_entity_)
            if (entity >= 0) add(patch_of(view_.entities[index(entity)], shared), own);
        if (of_entity_.contains(-1)) add(kNoGroup, of_entity_[-1]);
        Words words;
        for (auto& [name, own] : groups) {
            std::ranges::sort(own);
            patches.push_back({words[name], faces.size(), own.size()});
            for (const Index f : own) put(found_[index(f)]);
        }
        found_ = {};
    }

    static constexpr const char* kNoGroup = "defaultFaces"; // OpenFOAM's name for faces in no patch

    const MeshView& view_;
    const RunContext& context_;
    std::vector<CellFace> found_;                   ///< the faces of all cells, cell by cell
    std::map<Index, std::vector<Index>> of_entity_; ///< boundary faces of each entity; -1: faces without an
                                                    ///< entity
    std::vector<Index> place_; ///< for each view point: index among the points used; -1: unused
};

std::string head_of(const char* kind, const char* object, const std::string& note = {})
{
    return formatted("FoamFile\n{{\n    version     2.0;\n    format      ascii;\n    class       {};\n{}    "
                     "location    \"constant/polyMesh\";\n    object      {};\n}}\n\n",
                     kind, note.empty() ? "" : formatted("    note        \"{}\";\n", note), object);
}

/// A list of `count` entries, one per line, each of at most `numbers` numbers.
std::vector<Section> list(const std::string& head, std::size_t count, std::size_t numbers, Fill fill)
{
    return {{head + std::to_string(count) + "\n(\n", count, numbers * kNumberBytes + 4, std::move(fill)},
            {")\n", 0, 0, {}}};
}

/// Write numbers in parentheses on a line of their own.
template <class Values>
char* put_row(char* out, const Values& values)
{
    out = put_text(out, "(");
    for (const auto& value : values) out = put_text(out, value, " ");
    return put_text(out - 1, ")\n");
}

std::string zones_text(const PolyMesh& mesh)
{
    Words words;
    std::string text = formatted("{}{}\n(\n", head_of("regIOobject", "cellZones"), mesh.zones.size());
    for (const auto& [name, cells] : mesh.zones) {
        text += formatted("{}\n{{\n    type cellZone;\n    cellLabels List<label>\n{}\n(\n", words[name],
                          cells.count());
        cells.each(0, cells.count(), [&](std::size_t first, std::size_t last) {
            for (; first < last; ++first) text += std::to_string(first) + "\n";
        });
        text += ")\n;\n}\n";
    }
    return text + ")\n";
}

/// Whether OpenFOAM or one of its tools writes a file of this name into a polyMesh. Such a file is useless
/// for another mesh.
bool is_of_mesh(std::string_view name)
{
    constexpr std::array<std::string_view, 14> kFiles{
        "points",     "faces", "owner",     "neighbour",  "boundary",   "cellZones",    "faceZones",
        "pointZones", "cells", "cellLevel", "pointLevel", "level0Edge", "surfaceIndex", "meshModifiers"};
    if (name.ends_with(".gz")) name.remove_suffix(3);
    return std::ranges::find(kFiles, name) != kFiles.end();
}

} // namespace

void write_poly_mesh(const MeshView& view, const OutputPath& path, const RunContext& context)
{
    WholeFolder folder(path, is_of_mesh);
    const PolyMesh mesh(view, context);
    for (const std::string& note : mesh.notes)
        log_line(context, formatted("note: {}: {}", path.text(), note));
    std::vector<std::pair<const char*, std::vector<Section>>> files;
    const auto put_points = [&](std::size_t begin, std::size_t end, char* out) {
        mesh.points.each(begin, end, [&](std::size_t first, std::size_t last) {
            view.each_point(first, last, [&](std::span<const Vec3> points) {
                for (const Vec3& point : points) out = put_row(out, point);
            });
        });
        return out;
    };
    files.emplace_back("points", list(head_of("vectorField", "points"), mesh.points.count(), 3, put_points));
    files.emplace_back(
        "faces", list(head_of("faceList", "faces"), mesh.faces.size(), 5, each([&](std::size_t i, char* out) {
                          const Quad& face = mesh.faces[i];
                          const std::size_t corners = face[3] < 0 ? 3 : 4;
                          return put_row(put_text(out, corners), std::span(face).first(corners));
                      })));
    const std::string note = formatted("nPoints:{} nCells:{} nFaces:{} nInternalFaces:{}",
                                       mesh.points.count(), mesh.cells, mesh.faces.size(),
                                       mesh.neighbours.size());
    const auto labels = [&](const char* name, const std::vector<Index>& of) {
        files.emplace_back(
            name, list(head_of("labelList", name, note), of.size(), 1,
                       each([&own = of](std::size_t i, char* out) { return put_text(out, own[i], "\n"); })));
    };
    labels("owner", mesh.owners);
    labels("neighbour", mesh.neighbours);
    std::string boundary = formatted("{}{}\n(\n", head_of("polyBoundaryMesh", "boundary"),
                                     mesh.patches.size());
    for (const PolyMesh::Patch& patch : mesh.patches)
        boundary += formatted("    {}\n    {{\n        type            patch;\n        nFaces          {};\n "
                              "       startFace       {};\n    }}\n",
                              patch.name, patch.count, patch.first);
    files.emplace_back("boundary", std::vector<Section>{{boundary + ")\n", 0, 0, {}}});
    if (mesh.zones.size() > 1)
        files.emplace_back("cellZones", std::vector<Section>{{zones_text(mesh), 0, 0, {}}});
    const auto share = [&](std::size_t f) {
        return static_cast<double>(f) / static_cast<double>(files.size());
    };
    for (std::size_t f = 0; f < files.size(); ++f)
        write_file(folder.file(files[f].first), files[f].second, Sizes::varying,
                   part_of(context, share(f), share(f + 1)));
    folder.commit();
    report_progress(context, "writing " + path.text(), 1);
}

} // namespace lacuna::io
