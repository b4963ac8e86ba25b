// SPDX-License-Identifier: MIT
//
// MED, the format of Salome and Code_Aster. It is read and written by libmedC (LGPL-3), which is loaded only
// when such a file is read or written. The library runs in a process of its own, because HDF5, which it uses,
// crashes on damaged files.
// https://docs.salome-platform.org/latest/dev/MEDCoupling/developer/med-file.html
#include <lacuna/core/error.h>
#include <lacuna/io/detail/deck_builder.h>
#include <lacuna/io/detail/deck_view.h>
#include <lacuna/io/detail/format_table.h>

#ifdef LACUNA_MED

#include <lacuna/core/shared/bytes.h>
#include <lacuna/io/shared/units.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <map>
#include <set>

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

// The header needs these types of MPI for a function that is not used here.
using MPI_Comm = void*;
using MPI_Info = void*;
#include <med.h>

namespace lacuna::io {

void read_med(Cursor& cursor, DeckBuilder& into);

namespace {

using enum DeckShape;
using mesh::MeshView;

/// A shape in MED, and for each MED node its index in the order of DeckShape. In MED the nodes of a solid's
/// base are listed in the opposite direction: counter-clockwise seen from outside.
struct MedShape {
    DeckShape shape;
    med_geometry_type type;
    std::array<std::uint8_t, 27> places;
};
constexpr MedShape kShapes[] = {
    {line2, MED_SEG2, {0, 1}},
    {line3, MED_SEG3, {0, 1, 2}},
    {tri3, MED_TRIA3, {0, 1, 2}},
    {tri6, MED_TRIA6, {0, 1, 2, 3, 4, 5}},
    {quad4, MED_QUAD4, {0, 1, 2, 3}},
    {quad8, MED_QUAD8, {0, 1, 2, 3, 4, 5, 6, 7}},
    {quad9, MED_QUAD9, {0, 1, 2, 3, 4, 5, 6, 7, 8}},
    {tet4, MED_TETRA4, {0, 2, 1, 3}},
    {tet10, MED_TETRA10, {0, 2, 1, 3, 6, 5, 4, 7, 9, 8}},
    {pyramid5, MED_PYRA5, {0, 3, 2, 1, 4}},
    {pyramid13, MED_PYRA13, {0, 3, 2, 1, 4, 8, 7, 6, 5, 9, 12, 11, 10}},
    {wedge6, MED_PENTA6, {0, 2, 1, 3, 5, 4}},
    {wedge15, MED_PENTA15, {0, 2, 1, 3, 5, 4, 8, 7, 6, 11, 10, 9, 12, 14, 13}},
    {hex8, MED_HEXA8, {0, 3, 2, 1, 4, 7, 6, 5}},
    {hex20, MED_HEXA20, {0, 3, 2, 1, 4, 7, 6, 5, 11, 10, 9, 8, 15, 14, 13, 12, 16, 19, 18, 17}},
    {hex27, MED_HEXA27, {0,  3,  2,  1,  4,  7,  6,  5,  11, 10, 9,  8,  15, 14,
                         13, 12, 16, 19, 18, 17, 21, 23, 24, 22, 20, 25, 26}},
};
const MedShape* med_shape(DeckShape shape)
{
    const auto known = std::ranges::find(kShapes, shape, &MedShape::shape);
    return known == std::end(kShapes) ? nullptr : &*known;
}

struct Cells {
    std::int32_t type = 0;
    std::vector<std::int32_t> nodes{}, families{}, numbers{}; ///< `numbers`: empty if the file gives none
};
struct Family {
    std::int32_t number = 0; ///< above 0 for nodes, below 0 for cells
    std::vector<std::string> groups{};
};
/// Content of a file, as it is sent from one process to the other.
struct Content {
    std::string error{}; ///< not empty: the reason why the file cannot be read or written
    bool no_library = false;
    std::string unit{};
    std::vector<Vec3> points{};
    std::vector<std::int32_t> point_families{}, point_numbers{};
    std::vector<Cells> cells{};
    std::vector<Family> families{};
    std::vector<std::string> notes{};
};

constexpr std::uint64_t kMostPerByte = 1032; // limit on counts, per byte of the file: deflate compresses at
                                             // most by this factor
constexpr char kMesh[] = "mesh";

// --- the other process ------------------------------------------------------------------------------------

/// Functions of the library, which only the other process loads.
class Library {
public:
    Library() : handle_(::dlopen(LACUNA_MED, RTLD_NOW)) {}
    [[nodiscard]] bool is_there() const { return handle_ != nullptr; }
    template <class Function>
    Function* get(Function*, const char* name) const
    {
        return reinterpret_cast<Function*>(::dlsym(handle_, name));
    }

private:
    void* handle_;
};
#define LACUNA_MED_CALL(library, name) (*(library).get(static_cast<decltype(&(name))>(nullptr), #name))

/// Run `work` in another process. @return  the result of `work`; empty if the process crashed or took too
/// long
template <class Work>
std::string in_other_process(std::uint64_t bytes, const Work& work)
{
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) throw BackendError("io.no_process", "no pipe can be opened");
    const pid_t child = ::fork();
    if (child < 0) {
        for (const int end : ends) ::close(end);
        throw BackendError("io.no_process", "no process can be started");
    }
    if (child == 0) {
        ::prctl(PR_SET_PDEATHSIG, SIGKILL);
        // Time limit: ten seconds, plus one for each million bytes, for which libmedC takes 0.02 s on the
        // test machine. Elapsed time is limited, because the process would wait forever for a lock that
        // another thread of the host held at fork().
        sigset_t alarm_alone;
        ::sigemptyset(&alarm_alone);
        ::sigaddset(&alarm_alone, SIGALRM);
        ::signal(SIGALRM, SIG_DFL);
        ::sigprocmask(SIG_UNBLOCK, &alarm_alone, nullptr);
        ::alarm(static_cast<unsigned>(10 + bytes / 1'000'000));
        const rlimit none{0, 0};
        ::setrlimit(RLIMIT_CORE, &none);
        const int nowhere = ::open("/dev/null", O_WRONLY); // the library prints every error
        ::dup2(nowhere, STDOUT_FILENO);
        ::dup2(nowhere, STDERR_FILENO);
        std::string result;
        try {
            result = work();
        } catch (...) {
            ::_exit(1); // the host's exception handlers must not run in this process
        }
        for (std::size_t done = 0; done < result.size();) {
            const ssize_t now = ::write(ends[1], result.data() + done, result.size() - done);
            if (now <= 0) ::_exit(1);
            done += static_cast<std::size_t>(now);
        }
        ::_exit(0);
    }
    ::close(ends[1]);
    std::string result;
    std::vector<char> room(1 << 16);
    for (ssize_t now; (now = ::read(ends[0], room.data(), room.size())) != 0;) {
        if (now > 0) result.append(room.data(), static_cast<std::size_t>(now));
        if (now < 0 && errno != EINTR) break;
    }
    ::close(ends[0]);
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {}
    return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? result : std::string();
}

template <class Value>
std::string bytes_of(const Value& value)
{
    Writer writer;
    writer(value);
    return std::move(writer).take();
}

// --- reading ----------------------------------------------------------------------------------------------

/// Text of a fixed length, without blanks and zeros at its end.
std::string text_of_field(const char* text, std::size_t length)
{
    const std::string_view all(text, length);
    return std::string(trimmed(all.substr(0, all.find('\0'))));
}

Content content_of(std::string_view bytes)
{
    Content content;
    const auto refuse = [&](std::string why) {
        content.error = std::move(why);
        return content;
    };
    const Library library;
    content.no_library = !library.is_there();
    if (content.no_library) return refuse("no library");
    std::string copy(bytes);
    med_memfile image = MED_MEMFILE_INIT;
    image.app_image_ptr = copy.data();
    image.app_image_size = copy.size();
    const med_idt file = LACUNA_MED_CALL(library, MEDmemFileOpen)("file.med", &image, MED_FALSE,
                                                                  MED_ACC_RDONLY);
    if (file < 0) return refuse("it is no MED file");
    const med_int meshes = LACUNA_MED_CALL(library, MEDnMesh)(file);
    if (meshes < 1) return refuse("it holds no mesh");
    if (meshes > 1) content.notes.push_back(formatted("the first of {} meshes is read", meshes));
    const med_int axes = LACUNA_MED_CALL(library, MEDmeshnAxis)(file, 1);
    if (axes < 2 || axes > 3) return refuse("its mesh does not have two or three dimensions");
    char name[MED_NAME_SIZE + 1] = {}, text[MED_COMMENT_SIZE + 1] = {}, time[MED_SNAME_SIZE + 1] = {};
    char axis[3 * MED_SNAME_SIZE + 1] = {}, unit[3 * MED_SNAME_SIZE + 1] = {};
    med_int space = 0, dimension = 0, steps = 0;
    med_mesh_type type = MED_UNDEF_MESH_TYPE;
    med_sorting_type sorting = MED_SORT_UNDEF;
    med_axis_type frame = MED_UNDEF_AXIS_TYPE;
    if (LACUNA_MED_CALL(library, MEDmeshInfo)(file, 1, name, &space, &dimension, &type, text, time, &sorting,
                                              &steps, &frame, axis, unit) < 0)
        return refuse("its mesh cannot be read");
    if (type != MED_UNSTRUCTURED_MESH || frame != MED_CARTESIAN)
        return refuse("its mesh is structured or not in Cartesian coordinates");
    content.unit = text_of_field(unit, MED_SNAME_SIZE);
    med_int step = MED_NO_DT, iteration = MED_NO_IT;
    med_float at = 0;
    if (steps > 0)
        LACUNA_MED_CALL(library, MEDmeshComputationStepInfo)(file, name, 1, &step, &iteration, &at);
    const auto count_of = [&](med_entity_type entity, med_geometry_type shape, med_data_type data) {
        med_bool changed = MED_FALSE, moved = MED_FALSE;
        const auto mode = data == MED_CONNECTIVITY ? MED_NODAL : MED_NO_CMODE;
        const med_int count = LACUNA_MED_CALL(library, MEDmeshnEntity)(file, name, step, iteration, entity,
                                                                       shape, data, mode, &changed, &moved);
        return count > 0 ? static_cast<std::uint64_t>(count) : 0;
    };
    const auto is_too_many = [&](std::uint64_t values) { return values > kMostPerByte * bytes.size(); };
    const auto read_numbers = [&](med_entity_type entity, med_geometry_type shape, std::uint64_t count,
                                  std::vector<std::int32_t>& families, std::vector<std::int32_t>& numbers) {
        families.assign(count, 0);
        if (count_of(entity, shape, MED_FAMILY_NUMBER) == count)
            LACUNA_MED_CALL(library, MEDmeshEntityFamilyNumberRd)
        (file, name, step, iteration, entity, shape, families.data());
        if (count_of(entity, shape, MED_NUMBER) != count) return;
        numbers.resize(count);
        LACUNA_MED_CALL(library, MEDmeshEntityNumberRd)
        (file, name, step, iteration, entity, shape, numbers.data());
    };
    const std::uint64_t nodes = count_of(MED_NODE, MED_NONE, MED_COORDINATE);
    if (nodes == 0 || is_too_many(nodes * static_cast<std::uint64_t>(axes)))
        return refuse("its mesh has no nodes");
    std::vector<double> coordinates(nodes * static_cast<std::uint64_t>(axes));
    if (LACUNA_MED_CALL(library, MEDmeshNodeCoordinateRd)(file, name, step, iteration, MED_FULL_INTERLACE,
                                                          coordinates.data()) < 0)
        return refuse("its nodes cannot be read");
    content.points.assign(nodes, Vec3::Zero());
    for (std::size_t k = 0; k < coordinates.size(); ++k)
        content.points[k / static_cast<std::size_t>(axes)][static_cast<Index>(k) % axes] = coordinates[k];
    read_numbers(MED_NODE, MED_NONE, nodes, content.point_families, content.point_numbers);
    for (const MedShape& shape : kShapes) {
        const std::uint64_t count = count_of(MED_CELL, shape.type, MED_CONNECTIVITY);
        const auto size = static_cast<std::uint64_t>(shape_info(shape.shape).nodes);
        if (count == 0) continue;
        if (is_too_many(count * size)) return refuse("it announces more cells than it can hold");
        Cells& cells = content.cells.emplace_back(Cells{.type = shape.type});
        cells.nodes.resize(count * size);
        if (LACUNA_MED_CALL(library, MEDmeshElementConnectivityRd)(file, name, step, iteration, MED_CELL,
                                                                   shape.type, MED_NODAL, MED_FULL_INTERLACE,
                                                                   cells.nodes.data()) < 0)
            return refuse("its cells cannot be read");
        read_numbers(MED_CELL, shape.type, count, cells.families, cells.numbers);
    }
    for (const auto& [other, what] : {std::pair(MED_PENTA18, "wedges of 18 nodes"),
                                      {MED_TRIA7, "triangles of 7 nodes"},
                                      {MED_POLYGON, "polygons"},
                                      {MED_POLYHEDRON, "polyhedra"}})
        if (count_of(MED_CELL, other, other < MED_POLYGON ? MED_CONNECTIVITY : MED_INDEX_NODE) > 0)
            content.notes.push_back(formatted("{} are not read", what));
    const med_int families = LACUNA_MED_CALL(library, MEDnFamily)(file, name);
    for (med_int f = 1; f <= families; ++f) {
        const med_int groups = LACUNA_MED_CALL(library, MEDnFamilyGroup)(file, name, f);
        if (groups < 1) continue;
        if (is_too_many(static_cast<std::uint64_t>(groups) * MED_LNAME_SIZE))
            return refuse("it announces more groups than it can hold");
        std::string names(static_cast<std::size_t>(groups) * MED_LNAME_SIZE + 1, '\0');
        char family[MED_NAME_SIZE + 1] = {};
        Family own;
        if (LACUNA_MED_CALL(library, MEDfamilyInfo)(file, name, f, family, &own.number, names.data()) < 0)
            return refuse("its groups cannot be read");
        for (std::size_t g = 0; g < static_cast<std::size_t>(groups); ++g)
            add_once(own.groups, text_of_field(names.data() + g * MED_LNAME_SIZE, MED_LNAME_SIZE));
        content.families.push_back(std::move(own));
    }
    return content;
}

class MedReader {
public:
    MedReader(Cursor& cursor, DeckBuilder& into, Content content)
        : cursor_(cursor), into_(into), content_(std::move(content))
    {
    }

    void read()
    {
        Deck& deck = into_.deck();
        if (is_unit(content_.unit)) deck.unit = content_.unit;
        for (const std::string& note : content_.notes) into_.warn(note);
        if (std::ranges::any_of(content_.points, [](const Vec3& p) { return !p.allFinite(); }))
            cursor_.fail("expected finite coordinates");
        deck.points = std::move(content_.points);
        deck.point_tags = numbers({&content_.point_numbers, 1}, deck.points.size(), "nodes");
        std::vector<std::vector<std::int32_t>> given;
        std::size_t count = 0;
        for (const Cells& cells : content_.cells) {
            given.push_back(cells.numbers);
            count += cells.families.size();
        }
        const std::vector<DeckTag> tags = numbers(given, count, "cells");
        std::size_t first = 0;
        for (const Cells& cells : content_.cells)
            first += add_cells(cells, {tags.data() + first, count - first});
        add_sets();
    }

private:
    /// Numbers of nodes or cells: those of the file or, if it gives none or repeats one, numbers in order.
    std::vector<DeckTag> numbers(std::span<const std::vector<std::int32_t>> given, std::size_t count,
                                 const char* what)
    {
        std::vector<DeckTag> all;
        for (const auto& some : given) all.insert(all.end(), some.begin(), some.end());
        std::vector<DeckTag> sorted = all;
        std::ranges::sort(sorted);
        const bool twice = std::ranges::adjacent_find(sorted) != sorted.end();
        if (all.size() == count && !twice && (all.empty() || sorted.front() >= 0)) return all;
        if (!all.empty())
            into_.warn(formatted("{} are numbered in order, because their numbers repeat", what));
        all.resize(count);
        for (std::size_t i = 0; i < count; ++i) all[i] = static_cast<DeckTag>(i) + 1;
        return all;
    }

    std::size_t add_cells(const Cells& cells, std::span<const DeckTag> tags)
    {
        const auto shape = std::ranges::find(kShapes, cells.type, &MedShape::type);
        if (shape == std::end(kShapes)) cursor_.fail("the cell type {} is unknown", cells.type);
        const auto size = static_cast<std::size_t>(shape_info(shape->shape).nodes);
        const std::size_t count = cells.families.size();
        if (cells.nodes.size() != count * size) cursor_.fail("the number of nodes does not match the cells");
        const std::size_t block = into_.block_of(shape->shape, "");
        std::vector<Index> nodes(size);
        for (std::size_t e = 0; e < count; ++e) {
            for (std::size_t k = 0; k < size; ++k) {
                const std::int32_t node = cells.nodes[e * size + shape->places[k]];
                if (node < 1 || index(node) > into_.points().size())
                    cursor_.fail("expected a node of {}, found number {}", into_.points().size(),
                                 found(node));
                nodes[k] = node - 1;
            }
            if (is_inverted(shape->shape, nodes)) // some programs write nodes in the order of VTK
                for (std::size_t k = 0; k < size; ++k) nodes[k] = cells.nodes[e * size + k] - 1;
            const std::int32_t family = cells.families[e];
            const Index region = into_.region_of(
                family == std::numeric_limits<std::int32_t>::min() ? 0 : std::abs(family));
            into_.add_element(block, tags[e], region, nodes);
            cells_of_[family].push_back(tags[e]);
            region_of_[family] = region;
        }
        return count;
    }

    [[nodiscard]] bool is_inverted(DeckShape shape, std::span<const Index> nodes) const
    {
        const auto [dimension, corners, count] = shape_info(shape);
        if (dimension < 3) return false;
        const auto at = [&](int k) -> const Vec3& { return into_.deck().points[index(nodes[index(k)])]; };
        double volume = 0; // six times the volume of the cell: sum over its faces, seen from the first corner
        for (const Quad& face : face_corners(shape)) {
            const auto add = [&](int a, int b, int c) {
                volume += (at(a) - at(0)).dot((at(b) - at(0)).cross(at(c) - at(0)));
            };
            add(face[0], face[1], face[2]);
            if (face[3] >= 0) add(face[0], face[2], face[3]);
        }
        return volume < 0;
    }

    /// Add groups as sets, and name each region after its group with the fewest cells.
    void add_sets()
    {
        std::map<std::string, std::vector<std::int32_t>> of_cells, of_nodes;
        for (const Family& family : content_.families)
            for (const std::string& group : family.groups)
                (family.number < 0 ? of_cells : of_nodes)[group].push_back(family.number);
        std::map<Index, std::size_t> fewest;
        for (const auto& [name, families] : of_cells) {
            DeckSet set{.name = name};
            for (const std::int32_t family : families)
                if (const auto cells = cells_of_.find(family); cells != cells_of_.end())
                    set.members.insert(set.members.end(), cells->second.begin(), cells->second.end());
            if (set.members.empty()) continue;
            tidy(set);
            for (const std::int32_t family : families) {
                const auto region = region_of_.find(family);
                if (region == region_of_.end()) continue;
                const auto [best, fresh] = fewest.try_emplace(region->second, set.members.size());
                if (!fresh && best->second <= set.members.size()) continue;
                best->second = set.members.size();
                into_.deck().regions[index(region->second)].name = name;
            }
            into_.deck().sets.push_back(std::move(set));
        }
        for (const auto& [name, families] : of_nodes) {
            DeckSet set{.kind = DeckSet::Kind::nodes, .name = name};
            const std::set<std::int32_t> wanted(families.begin(), families.end());
            for (std::size_t p = 0; p < content_.point_families.size(); ++p)
                if (wanted.contains(content_.point_families[p]))
                    set.members.push_back(into_.deck().point_tags[p]);
            tidy(set);
            if (!set.members.empty()) into_.deck().sets.push_back(std::move(set));
        }
    }

    Cursor& cursor_;
    DeckBuilder& into_;
    Content content_;
    std::map<std::int32_t, std::vector<DeckTag>> cells_of_; ///< numbers of the cells of each family
    std::map<std::int32_t, Index> region_of_;
};

// --- writing ----------------------------------------------------------------------------------------------

/// The content of a MED file. Each entity of the view becomes a family of cells. Nodes that are in the same
/// sets of nodes become a family of nodes.
Content content_of(const MeshView& view, const std::string& unit)
{
    Content content{.unit = unit};
    view.each_point(0, view.points, [&](std::span<const Vec3> points) {
        content.points.insert(content.points.end(), points.begin(), points.end());
    });
    std::vector<DeckTag> tags;
    view.point_tags.each(0, view.points, [&](std::size_t, DeckTag tag) { tags.push_back(tag); });
    content.point_numbers.assign(tags.begin(), tags.end());
    std::map<DeckShape, Cells> cells;
    for (const MeshView::Block& block : view.blocks) {
        const MedShape* const shape = med_shape(block.shape);
        if (shape == nullptr) refuse_element(block, "MED", "there is no such element");
        Cells& own = cells[block.shape];
        own.type = shape->type;
        const auto size = static_cast<std::size_t>(shape_info(block.shape).nodes);
        each_cell(block, 0, block.count, [&](std::size_t, DeckTag tag, std::span<const Index> nodes) {
            own.nodes.resize(own.nodes.size() + size);
            for (std::size_t k = 0; k < size; ++k)
                own.nodes[own.nodes.size() - size + shape->places[k]] = nodes[k] + 1;
            if (block.tags.given() || view.is_deck) own.numbers.push_back(static_cast<std::int32_t>(tag));
        });
        mesh::each_run(block.entities, 0, block.count,
                       [&](std::size_t first, std::size_t last, Index entity) {
                           own.families.insert(own.families.end(), last - first, -entity - 1);
                       });
    }
    for (auto& [shape, own] : cells) content.cells.push_back(std::move(own));
    for (std::size_t e = 0; e < view.entities.size(); ++e)
        content.families.push_back({-static_cast<std::int32_t>(e) - 1, view.entities[e].groups});
    // A family of nodes for each list of sets to which nodes belong.
    SetLists lists;
    content.point_families.assign(view.points, 0);
    const TagPlaces places(tags);
    for (std::size_t s = 0; s < view.sets.size(); ++s)
        if (view.sets[s].kind == mesh::SetKind::nodes)
            view.sets[s].members.each(0, view.sets[s].count, [&](std::size_t, DeckTag tag) {
                if (const Index at = places.find(tag); at >= 0)
                    content.point_families[index(at)] = lists.extended(content.point_families[index(at)],
                                                                       static_cast<int>(s));
            });
    for (const std::int32_t list :
         std::set<std::int32_t>(content.point_families.begin(), content.point_families.end())) {
        if (list == 0) continue;
        Family& family = content.families.emplace_back(Family{.number = list});
        for (const int set : lists[list]) add_once(family.groups, view.sets[index(set)].name);
    }
    for (Family& family : content.families)
        for (std::string& group : family.groups)
            if (group.size() > MED_LNAME_SIZE) {
                content.notes.push_back(formatted("{} is called {}", group, group.substr(0, MED_LNAME_SIZE)));
                group.resize(MED_LNAME_SIZE);
            }
    return content;
}

struct Image {
    std::string error{};
    bool no_library = false;
    std::string bytes{};
};

Image image_of(const Content& content)
{
    Image image;
    const Library library;
    image.no_library = !library.is_there();
    if (image.no_library) return image;
    const auto check = [&](med_err result, const char* what) {
        if (result < 0 && image.error.empty()) image.error = what;
    };
    med_memfile memory = MED_MEMFILE_INIT;
    const med_idt file = LACUNA_MED_CALL(library, MEDmemFileOpen)("file.med", &memory, MED_FALSE,
                                                                  MED_ACC_CREAT);
    const auto padded = [](std::string text, std::size_t length) {
        text.resize(length, ' ');
        return text;
    };
    std::string axes, units;
    for (const char* axis : {"x", "y", "z"}) {
        axes += padded(axis, MED_SNAME_SIZE);
        units += padded(content.unit, MED_SNAME_SIZE);
    }
    check(LACUNA_MED_CALL(library, MEDmeshCr)(file, kMesh, 3, 3, MED_UNSTRUCTURED_MESH, "", "", MED_SORT_DTIT,
                                              MED_CARTESIAN, axes.c_str(), units.c_str()),
          "mesh");
    const auto write_numbers = [&](med_entity_type entity, med_geometry_type type,
                                   const std::vector<std::int32_t>& families,
                                   const std::vector<std::int32_t>& numbers) {
        check(LACUNA_MED_CALL(library, MEDmeshEntityFamilyNumberWr)(
                  file, kMesh, MED_NO_DT, MED_NO_IT, entity, type, static_cast<med_int>(families.size()),
                  families.data()),
              "families");
        if (numbers.empty()) return;
        check(LACUNA_MED_CALL(library, MEDmeshEntityNumberWr)(file, kMesh, MED_NO_DT, MED_NO_IT, entity, type,
                                                              static_cast<med_int>(numbers.size()),
                                                              numbers.data()),
              "numbers");
    };
    check(LACUNA_MED_CALL(library, MEDmeshNodeCoordinateWr)(
              file, kMesh, MED_NO_DT, MED_NO_IT, MED_UNDEF_DT, MED_FULL_INTERLACE,
              static_cast<med_int>(content.points.size()), content.points.front().data()),
          "nodes");
    write_numbers(MED_NODE, MED_NONE, content.point_families, content.point_numbers);
    for (const Cells& cells : content.cells) {
        if (cells.families.empty()) continue;
        check(LACUNA_MED_CALL(library, MEDmeshElementConnectivityWr)(
                  file, kMesh, MED_NO_DT, MED_NO_IT, MED_UNDEF_DT, MED_CELL, cells.type, MED_NODAL,
                  MED_FULL_INTERLACE, static_cast<med_int>(cells.families.size()), cells.nodes.data()),
              "cells");
        write_numbers(MED_CELL, cells.type, cells.families, cells.numbers);
    }
    check(LACUNA_MED_CALL(library, MEDfamilyCr)(file, kMesh, "FAMILLE_ZERO", 0, 0, ""), "family");
    for (const Family& family : content.families) {
        std::string groups;
        for (const std::string& group : family.groups) groups += padded(group, MED_LNAME_SIZE);
        const std::string name = formatted("FAM_{}", family.number);
        check(LACUNA_MED_CALL(library, MEDfamilyCr)(file, kMesh, name.c_str(), family.number,
                                                    static_cast<med_int>(family.groups.size()),
                                                    groups.c_str()),
              "family");
    }
    check(LACUNA_MED_CALL(library, MEDfileClose)(file), "file");
    image.bytes.assign(static_cast<const char*>(memory.app_image_ptr), memory.app_image_size);
    return image;
}

[[noreturn]] void tell_no_library()
{
    throw BackendError(
        Message("io.no_med", "the library {} that reads and writes MED is not installed", LACUNA_MED)
            .remedy("install libmedc11, or use .unv or .msh"));
}

} // namespace

void read_med(Cursor& cursor, DeckBuilder& into)
{
    cursor.has_bytes = true;
    const std::string_view bytes = cursor.rest();
    if (!bytes.starts_with("\x89HDF")) cursor.fail("expected a MED file, which begins like HDF5");
    const std::string result = in_other_process(bytes.size(), [&] { return bytes_of(content_of(bytes)); });
    if (result.empty()) cursor.fail("the MED library cannot read it: the file is damaged");
    Content content;
    Reader reader(result);
    reader(content);
    if (content.no_library) tell_no_library();
    if (!content.error.empty()) cursor.fail("{}", content.error);
    MedReader(cursor, into, std::move(content)).read();
}

DeckFile med_file(const View& view, const MeshFileOptions& options, const mesh::ViewParts* /*parts*/)
{
    check_numbers(*view, std::numeric_limits<std::int32_t>::max(), "a MED file",
                  "give first_node and first_cell");
    Content content = content_of(*view, options.unit);
    const std::string result = in_other_process(content.points.size() * sizeof(Vec3),
                                                [&] { return bytes_of(image_of(content)); });
    Image image;
    if (!result.empty()) {
        Reader reader(result);
        reader(image);
    }
    if (image.no_library) tell_no_library();
    if (result.empty() || !image.error.empty())
        throw BackendError(Message("io.med_library", "the MED library cannot write the {}",
                                   image.error.empty() ? "file" : image.error)
                               .remedy("check the installation of libmedC, or write another format"));
    DeckFile file;
    file.notes = std::move(content.notes);
    file.add(std::move(image.bytes));
    return file;
}

} // namespace lacuna::io

#else

namespace lacuna::io {

void read_med(Cursor& cursor, DeckBuilder& into);

namespace {

[[noreturn]] void tell_no_library()
{
    throw BackendError(Message("io.no_med", "this build does not read or write MED")
                           .remedy("configure it with -DLACUNA_MED=ON, or use .unv or .msh"));
}

} // namespace

void read_med(Cursor& /*cursor*/, DeckBuilder& /*into*/) { tell_no_library(); }

DeckFile med_file(const View& /*view*/, const MeshFileOptions& /*options*/, const mesh::ViewParts* /*parts*/)
{
    tell_no_library();
}

} // namespace lacuna::io

#endif
