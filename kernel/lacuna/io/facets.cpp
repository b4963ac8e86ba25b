// SPDX-License-Identifier: MIT
#include <lacuna/io/facets.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/renumbered.h>
#include <lacuna/io/detail/deck_writer.h>
#include <lacuna/io/mesh_file.h>
#include <lacuna/topology/shared/hollows.h>
#include <lacuna/topology/shared/names_of.h>
#include <lacuna/topology/shared/skin_groups.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <set>

namespace lacuna::io {

using namespace topology;

namespace {

/// The facets of the volume, face by face, and their points. Points are numbered from 0 in order of first
/// use.
struct Skin {
    std::vector<Triangle> triangles;
    std::vector<std::size_t> start; ///< first facet of each face, and the end
    std::vector<Vec3> points;
};

[[noreturn]] void throw_not_sealed(const OpenVolume& volume)
{
    const std::vector<EdgeId> open = free_edges(volume);
    if (open.empty())
        throw InvalidInput(Message("io.not_sealed",
                                   "the volume is not sealed, so its facets would not be watertight: the "
                                   "facets of neighbouring faces do not match")
                               .remedy("close() it first"));
    throw InvalidInput(
        Message("io.not_sealed",
                "the volume is not sealed, so its facets would not be watertight: {} {} free: {}",
                found(open.size()), open.size() == 1 ? "edge is" : "edges are",
                topology::entities_of(volume.model, open))
            .remedy("close() it first"));
}

/// Check that each side of a facet occurs once more, in the opposite direction.
void check_sealed(const OpenVolume& volume)
{
    std::map<Segment, int> balance;
    for (const Face& face : volume.model.faces) {
        for (const Triangle& t : face.triangles) {
            for (std::size_t i = 0; i < 3; ++i) {
                const Index a = t[i], b = t[(i + 1) % 3];
                balance[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
            }
        }
    }
    const bool met = std::all_of(balance.begin(), balance.end(),
                                 [](const auto& side) { return side.second == 0; });
    if (balance.empty() || !met || !free_edges(volume).empty()) throw_not_sealed(volume);
}

Skin skin_of(const OpenVolume& volume, const RunContext& context)
{
    Model model = volume.model;
    orient_skin(model, context);
    Skin skin;
    Renumbered<Vec3> points(model.points);
    for (const Face& face : model.faces) {
        skin.start.push_back(skin.triangles.size());
        for (Triangle t : face.triangles) {
            for (Index& p : t) p = points(p);
            skin.triangles.push_back(t);
        }
    }
    skin.start.push_back(skin.triangles.size());
    skin.points = std::move(points.used);
    return skin;
}

// ---- STL

Vec3 normal_of(const Skin& skin, const Triangle& t)
{
    const auto at = [&](std::size_t i) -> const Vec3& { return skin.points[index(t[i])]; };
    const Vec3 area = (at(1) - at(0)).cross(at(2) - at(0));
    const double norm = area.norm();
    return norm > 0 ? Vec3(area / norm) : Vec3::Zero();
}

std::vector<Section> stl_bytes(const Skin& skin)
{
    std::string head = "facets of a sealed volume"; // not "solid": readers take that for text
    head.resize(80, ' ');
    put(head, static_cast<std::uint32_t>(skin.triangles.size()));
    const auto put_floats = [](char* out, const Vec3& p) {
        for (const double value : p) out = put(out, static_cast<float>(value));
        return out;
    };
    return {{head, skin.triangles.size(), 50, each([&skin, put_floats](std::size_t i, char* out) {
                 out = put_floats(out, normal_of(skin, skin.triangles[i]));
                 for (const Index p : skin.triangles[i]) out = put_floats(out, skin.points[index(p)]);
                 return put(out, std::uint16_t{0});
             })}};
}

/// Write coordinates, each after a blank.
char* put_point(char* out, const Vec3& point)
{
    return put_text(out, " ", point[0], " ", point[1], " ", point[2]);
}

std::vector<Section> stl_text(const Skin& skin)
{
    constexpr std::size_t kWords = 100; // bytes of the words around a facet's numbers
    return {{"solid volume\n", skin.triangles.size(), kWords + 12 * kNumberBytes,
             each([&skin](std::size_t i, char* out) {
                 out = put_point(put_text(out, "facet normal"), normal_of(skin, skin.triangles[i]));
                 out = put_text(out, "\nouter loop\n");
                 for (const Index p : skin.triangles[i])
                     out = put_text(put_point(put_text(out, "vertex"), skin.points[index(p)]), "\n");
                 return put_text(out, "endloop\nendfacet\n");
             })},
            {"endsolid volume\n", 0, 0, {}}};
}

// ---- OBJ

/// The groups of a face as words, because names in OBJ cannot have blanks. The first group is unique to the
/// face.
std::string obj_groups(const OpenVolume& volume, std::vector<std::string> groups, std::size_t f)
{
    const Face& face = volume.model.faces[f];
    std::ranges::stable_partition(groups, is_role_group);
    if (volume.role[f] != Role::wall)
        groups.front() += (face.origin == Origin::made_void ? ":void:" : ":") + std::to_string(face.tag);
    std::string line;
    for (std::string& group : groups) {
        for (char& c : group)
            if (std::isspace(static_cast<unsigned char>(c)) != 0 ||
                std::iscntrl(static_cast<unsigned char>(c)) != 0)
                c = '_';
        line += " " + group;
    }
    return line;
}

std::vector<Section> obj_text(const OpenVolume& volume, const Skin& skin)
{
    const std::vector<std::vector<std::string>> groups = skin_groups(volume);
    std::vector<Section> sections{
        {{}, skin.points.size(), 3 * kNumberBytes + 2, each([&skin](std::size_t i, char* out) {
             return put_text(put_point(put_text(out, "v"), skin.points[i]), "\n");
         })}};
    for (std::size_t f = 0; f < volume.model.faces.size(); ++f) {
        const std::size_t first = skin.start[f];
        sections.push_back({"g" + obj_groups(volume, groups[f], f) + "\n", skin.start[f + 1] - first,
                            3 * kNumberBytes + 2, each([&skin, first](std::size_t i, char* out) {
                                const auto [a, b, c] = skin.triangles[first + i];
                                return put_text(out, "f ", a + 1LL, " ", b + 1LL, " ", c + 1LL, "\n");
                            })});
    }
    return sections;
}

// ---- MSH

std::vector<int> surface_tags(const Model& model)
{
    int highest = 0;
    for (const Face& face : model.faces)
        if (face.origin == Origin::given) highest = std::max(highest, face.tag);
    std::set<int> taken;
    std::vector<int> tags;
    for (const Face& face : model.faces) {
        const bool own = face.origin == Origin::given && face.tag > 0 && taken.insert(face.tag).second;
        tags.push_back(own ? face.tag : ++highest);
    }
    return tags;
}

/// A deck with a surface for each face, in the sets of the face's groups.
Deck deck_of(const OpenVolume& volume, const Skin& skin)
{
    const std::vector<std::vector<std::string>> groups = skin_groups(volume);
    const std::vector<int> tags = surface_tags(volume.model);
    Deck deck;
    deck.format = DeckFormat::msh;
    deck.points = skin.points;
    for (std::size_t p = 0; p < skin.points.size(); ++p)
        deck.point_tags.push_back(static_cast<DeckTag>(p) + 1);
    DeckBlock& block = deck.blocks.emplace_back();
    block.shape = DeckShape::tri3;
    for (std::size_t f = 0; f < groups.size(); ++f) {
        deck.regions.push_back({tags[f], groups[f].front(), {}});
        const std::size_t first = block.count();
        for (std::size_t i = skin.start[f]; i < skin.start[f + 1]; ++i) {
            block.nodes.insert(block.nodes.end(), skin.triangles[i].begin(), skin.triangles[i].end());
            block.tags.push_back(static_cast<DeckTag>(i) + 1);
            block.regions.push_back(static_cast<Index>(f));
        }
        for (const std::string& group : groups[f]) {
            auto set = std::ranges::find(deck.sets, group, &DeckSet::name);
            if (set == deck.sets.end()) set = deck.sets.insert(set, {.name = group});
            set->members.insert(set->members.end(), block.tags.begin() + static_cast<std::ptrdiff_t>(first),
                                block.tags.end());
        }
    }
    return deck;
}

} // namespace

void write_facets(const OpenVolume& volume, const OutputPath& path, const FacetFileOptions& options,
                  const RunContext& context)
{
    const std::string ending = ending_of(path.text());
    if (ending != ".stl" && ending != ".obj" && ending != ".msh")
        throw InvalidInput(Message("io.unknown_ending",
                                   "cannot write facets to '{}': the ending \"{}\" is unknown", path.text(),
                                   ending)
                               .remedy("use .stl, .obj or .msh"));
    check_sealed(volume);
    const Skin skin = skin_of(volume, context);
    if (ending == ".msh")
        write_deck(deck_of(volume, skin), DeckFormat::msh, path, context,
                   {.binary = options.binary, .all_groups = options.all_groups});
    else if (ending == ".obj")
        write_file(path, obj_text(volume, skin), Sizes::varying, context);
    else if (options.binary)
        write_file(path, stl_bytes(skin), Sizes::exact, context);
    else
        write_file(path, stl_text(skin), Sizes::varying, context);
}

} // namespace lacuna::io
