// SPDX-License-Identifier: MIT
#include "support/edit_model.h"
#include "support/folder.h"
#include "support/value_at.h"
#include "support/volumes.h"

#include <lacuna/closure/close.h>
#include <lacuna/io/facets.h>
#include <lacuna/matching/match.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <set>
#include <sstream>

using namespace lacuna;

namespace {

/// Open prisms of every class, closed, by name.
std::vector<std::pair<std::string, topology::OpenVolume>> sealed_volumes()
{
    struct Case {
        const char* name;
        test::PrismOptions options;
    };
    std::vector<Case> cases{
        {"II", {.sides = 5, .drop = test::without(false, false, false, {0, 1})}},
        {"III", {.sides = 0, .holes = 1, .drop = test::without(false, false, false, {0})}},
        {"IV", {.sides = 6, .holes = 2, .twist = 20, .drop = test::without(false, true, false)}},
        {"V", {.sides = 0, .holes = 1, .hole_sides = 0, .drop = test::without(true, true, false)}},
        {"I", {.sides = 4, .taper = 0.7, .drop = test::without(false, false, true)}}};
    std::vector<std::pair<std::string, topology::OpenVolume>> sealed;
    for (const Case& c : cases) {
        topology::OpenVolume volume = test::prism(c.options).open();
        const bool ends = !volume.faces(topology::Role::source).empty() &&
                          !volume.faces(topology::Role::target).empty();
        volume = closure::close(volume, ends ? matching::match(volume) : matching::Match{}).volume;
        sealed.emplace_back(c.name, std::move(volume));
    }
    return sealed;
}

/// Facets as three places each.
template <class Number>
using Places = std::vector<std::array<std::array<Number, 3>, 3>>;

/// Every side of a facet is met once, run the other way, and what is enclosed is positive. @return that
/// volume.
template <class Number>
double check_watertight(const Places<Number>& facets)
{
    std::map<std::pair<std::array<Number, 3>, std::array<Number, 3>>, int> sides;
    double volume = 0;
    for (const auto& f : facets) {
        for (std::size_t i = 0; i < 3; ++i) ++sides[{f[i], f[(i + 1) % 3]}];
        const auto at = [&](std::size_t i) {
            return Vec3(double(f[i][0]), double(f[i][1]), double(f[i][2]));
        };
        volume += at(0).dot(at(1).cross(at(2))) / 6;
    }
    std::size_t lone = 0;
    for (const auto& [side, uses] : sides)
        lone += uses != 1 || !sides.contains({side.second, side.first}) ? 1 : 0;
    CHECK(lone == 0);
    CHECK(volume > 0);
    return volume;
}

std::size_t facet_count(const topology::OpenVolume& volume)
{
    std::size_t count = 0;
    for (const auto& face : volume.model.faces) count += face.triangles.size();
    return count;
}

/// A text MSH file, as far as these tests need it.
struct TextMsh {
    std::map<std::pair<int, int>, std::string> names;
    std::map<int, std::vector<int>> physical; ///< of each surface
    std::map<std::size_t, std::array<double, 3>> nodes;
    std::map<int, std::vector<std::array<std::size_t, 3>>> facets; ///< of each surface

    explicit TextMsh(const std::string& text)
    {
        std::istringstream in(text);
        std::string word;
        while (in >> word) {
            if (word == "$PhysicalNames") read_names(in);
            if (word == "$Entities") read_entities(in);
            if (word == "$Nodes") read_nodes(in);
            if (word == "$Elements") read_elements(in);
        }
    }

private:
    void read_names(std::istream& in)
    {
        std::size_t count = 0;
        for (in >> count; count > 0; --count) {
            int dimension = 0, tag = 0;
            std::string name;
            in >> dimension >> tag >> std::ws;
            std::getline(in, name);
            names[{dimension, tag}] = name.substr(1, name.size() - 2);
        }
    }
    void read_entities(std::istream& in)
    {
        std::size_t points = 0, curves = 0, surfaces = 0, volumes = 0, count = 0;
        in >> points >> curves >> surfaces >> volumes;
        CHECK(points + curves + volumes == 0);
        for (; surfaces > 0; --surfaces) {
            int tag = 0;
            double box = 0;
            in >> tag;
            for (int i = 0; i < 6; ++i) in >> box;
            for (in >> count; count > 0; --count) in >> physical[tag].emplace_back();
            in >> count;
            CHECK(count == 0);
        }
    }
    void read_nodes(std::istream& in)
    {
        std::size_t blocks = 0, all = 0, first = 0, last = 0;
        in >> blocks >> all >> first >> last;
        for (; blocks > 0; --blocks) {
            int dimension = 0, tag = 0, parametric = 0;
            std::size_t count = 0;
            in >> dimension >> tag >> parametric >> count;
            CHECK(physical.contains(tag));
            std::vector<std::size_t> numbers(count);
            for (std::size_t& n : numbers) in >> n;
            for (const std::size_t n : numbers) {
                std::array<double, 3> p{};
                in >> p[0] >> p[1] >> p[2];
                CHECK(nodes.emplace(n, p).second);
            }
        }
        CHECK(nodes.size() == all);
        CHECK(first == 1);
        CHECK(last == all);
    }
    void read_elements(std::istream& in)
    {
        std::size_t blocks = 0, all = 0, first = 0, last = 0;
        in >> blocks >> all >> first >> last;
        std::size_t expected = 1;
        for (; blocks > 0; --blocks) {
            int dimension = 0, tag = 0, type = 0;
            std::size_t count = 0;
            in >> dimension >> tag >> type >> count;
            CHECK(dimension == 2);
            CHECK(type == 2);
            for (; count > 0; --count) {
                std::size_t number = 0;
                std::array<std::size_t, 3> f{};
                in >> number >> f[0] >> f[1] >> f[2];
                CHECK(number == expected++);
                facets[tag].push_back(f);
            }
        }
        CHECK(expected == all + 1);
    }
};

} // namespace

TEST_CASE("a binary STL is one watertight solid of the sealed volume, outward")
{
    const test::Folder folder;
    for (auto& [name, volume] : sealed_volumes()) {
        CAPTURE(name);
        io::write_facets(volume, folder.file("a.stl"));
        const std::string bytes = test::bytes_of(folder.file("a.stl"));
        const auto count = at<std::uint32_t>(bytes, 80);
        CHECK(bytes.substr(0, 5) != "solid");
        CHECK(count == facet_count(volume));
        REQUIRE(bytes.size() == 84 + 50 * std::size_t(count));
        Places<float> facets;
        for (std::uint32_t i = 0; i < count; ++i) {
            const std::size_t place = 84 + 50 * std::size_t(i);
            const auto record = at<std::array<std::array<float, 3>, 4>>(bytes, place);
            facets.push_back({record[1], record[2], record[3]});
            const auto vec = [&](std::size_t k) { return Vec3(record[k][0], record[k][1], record[k][2]); };
            const Vec3 area = (vec(2) - vec(1)).cross(vec(3) - vec(1));
            if (area.norm() > 1e-6) CHECK(vec(0).dot(area.normalized()) == doctest::Approx(1).epsilon(1e-3));
        }
        CHECK(check_watertight(facets) == doctest::Approx(closure::enclosed_volume(volume)).epsilon(1e-5));
    }
}

TEST_CASE("a text STL holds every coordinate to the bit")
{
    const test::Folder folder;
    for (auto& [name, volume] : sealed_volumes()) {
        CAPTURE(name);
        io::write_facets(volume, folder.file("a.STL"), {.binary = false});
        std::istringstream in(test::bytes_of(folder.file("a.STL")));
        Places<double> facets;
        std::string word;
        std::size_t corners = 0, solids = 0;
        while (in >> word) {
            if (word == "solid") ++solids;
            if (word == "facet") facets.emplace_back();
            if (word != "vertex") continue;
            auto& p = facets.back()[corners++ % 3];
            in >> p[0] >> p[1] >> p[2];
        }
        CHECK(solids == 1);
        CHECK(word == "volume"); // after endsolid
        REQUIRE(facets.size() == facet_count(volume));
        std::size_t i = 0;
        for (const auto& face : volume.model.faces) {
            for (const Triangle& t : face.triangles) {
                for (std::size_t k = 0; k < 3; ++k) {
                    const Vec3& p = volume.model.at(t[k]);
                    CHECK(facets[i][k] == std::array{p.x(), p.y(), p.z()});
                }
                ++i;
            }
        }
        CHECK(check_watertight(facets) == doctest::Approx(closure::enclosed_volume(volume)).epsilon(1e-12));
    }
}

TEST_CASE("an OBJ has every point once and a group of its own for every face")
{
    const test::Folder folder;
    for (auto& [name, volume] : sealed_volumes()) {
        CAPTURE(name);
        io::write_facets(volume, folder.file("a.obj"));
        std::istringstream in(test::bytes_of(folder.file("a.obj")));
        std::vector<std::array<double, 3>> points;
        Places<double> facets;
        std::set<std::string> groups;
        for (std::string line; std::getline(in, line);) {
            std::istringstream rest(line);
            std::string word;
            rest >> word;
            if (word == "g") {
                rest >> word;
                CHECK(groups.insert(word).second);
            } else if (word == "v") {
                auto& p = points.emplace_back();
                rest >> p[0] >> p[1] >> p[2];
            } else {
                CHECK(word == "f");
                std::array<std::size_t, 3> f{};
                rest >> f[0] >> f[1] >> f[2];
                facets.push_back({points.at(f[0] - 1), points.at(f[1] - 1), points.at(f[2] - 1)});
            }
        }
        CHECK(groups.size() == volume.model.faces.size());
        CHECK(std::set(points.begin(), points.end()).size() == points.size());
        CHECK(facets.size() == facet_count(volume));
        CHECK(check_watertight(facets) == doctest::Approx(closure::enclosed_volume(volume)).epsilon(1e-12));
    }
}

TEST_CASE("an MSH has a surface and physical groups for every face, named as in a mesh")
{
    const test::Folder folder;
    for (auto& [name, volume] : sealed_volumes()) {
        CAPTURE(name);
        test::edit(volume.model,
                   [](topology::ModelBuilder& model) { model.faces.front().name = "a \"given\" name"; });
        io::write_facets(volume, folder.file("a.msh"), {.binary = false, .all_groups = true});
        const TextMsh msh(test::bytes_of(folder.file("a.msh")));
        REQUIRE(msh.facets.size() == volume.model.faces.size());
        Places<double> facets;
        for (const auto& [tag, list] : msh.facets) {
            for (const auto& f : list)
                facets.push_back({msh.nodes.at(f[0]), msh.nodes.at(f[1]), msh.nodes.at(f[2])});
        }
        CHECK(check_watertight(facets) == doctest::Approx(closure::enclosed_volume(volume)).epsilon(1e-12));

        std::size_t voids = 0;
        for (const auto& [tag, groups] : msh.physical) {
            REQUIRE(!groups.empty());
            std::set<std::string> names;
            for (const int group : groups) names.insert(msh.names.at({2, group}));
            const auto given = std::find_if(
                volume.model.faces.begin(), volume.model.faces.end(),
                [tag = tag](const auto& f) { return f.origin == topology::Origin::given && f.tag == tag; });
            const bool is_void = given == volume.model.faces.end();
            const auto role = is_void ? topology::Role::wall
                                      : volume.role[std::size_t(given - volume.model.faces.begin())];
            if (is_void)
                CHECK(names.contains("void:" + std::to_string(++voids)));
            else if (role == topology::Role::source)
                CHECK(names.contains("source"));
            else if (role == topology::Role::target)
                CHECK(names.contains("target"));
            else
                CHECK(names.contains("wall:" + std::to_string(tag)));
            if (given == volume.model.faces.begin()) CHECK(names.contains("a 'given' name"));
        }
        CHECK(voids > 0);

        // By default a surface is in one of these, that of its name before that of its role.
        io::write_facets(volume, folder.file("one.msh"), {.binary = false});
        const TextMsh one(test::bytes_of(folder.file("one.msh")));
        CHECK(one.physical.size() == msh.physical.size());
        for (const auto& [tag, groups] : one.physical) {
            REQUIRE(groups.size() == 1);
            const std::string& own = one.names.at({2, groups[0]});
            const auto is_it = [&](int group) { return msh.names.at({2, group}) == own; };
            CHECK(std::ranges::any_of(msh.physical.at(tag), is_it));
            if (tag == volume.model.faces.front().tag) CHECK(own == "a 'given' name");
        }
    }
}

TEST_CASE("a binary MSH holds what the text one holds, and two writings are alike to the byte")
{
    const test::Folder folder;
    for (auto& [name, volume] : sealed_volumes()) {
        CAPTURE(name);
        io::write_facets(volume, folder.file("text.msh"), {.binary = false});
        io::write_facets(volume, folder.file("bytes.msh"));
        RunContext one;
        one.threads = 1;
        io::write_facets(volume, folder.file("again.msh"), {}, one);
        const std::string bytes = test::bytes_of(folder.file("bytes.msh"));
        CHECK(bytes == test::bytes_of(folder.file("again.msh")));
        const TextMsh msh(test::bytes_of(folder.file("text.msh")));
        std::size_t place = bytes.find("$Elements\n") + 10;
        CHECK(at<std::uint64_t>(bytes, place) == msh.facets.size());
        place += 32;
        for (std::size_t block = 0; block < msh.facets.size(); ++block) {
            const int tag = at<int>(bytes, place + 4);
            REQUIRE(msh.facets.contains(tag));
            const auto& facets = msh.facets.at(tag);
            REQUIRE(at<std::uint64_t>(bytes, place + 12) == facets.size());
            place += 20;
            for (const auto& f : facets) {
                CHECK(at<std::array<std::uint64_t, 3>>(bytes, place + 8) ==
                      std::array<std::uint64_t, 3>{f[0], f[1], f[2]});
                place += 32;
            }
        }
        CHECK(bytes.substr(place) == "\n$EndElements\n");
        place = bytes.find("$Nodes\n") + 7 + 32;
        const auto count = std::size_t(at<std::uint64_t>(bytes, place + 12));
        CHECK(count == msh.nodes.size());
        place += 20 + 8 * count;
        for (std::size_t n = 1; n <= count; ++n, place += 24)
            CHECK(at<std::array<double, 3>>(bytes, place) == msh.nodes.at(n));
        CHECK(bytes.substr(place, 11) == "\n$EndNodes\n");
    }
}

TEST_CASE("facets that face inward are written outward")
{
    const test::Folder folder;
    auto volume = test::prism({.sides = 4}).open();
    std::vector<FaceId> all;
    for (std::size_t f = 0; f < volume.model.faces.size(); ++f) all.emplace_back(f);
    topology::flip_faces(volume.model, all);
    io::write_facets(volume, folder.file("a.stl"));
    const std::string bytes = test::bytes_of(folder.file("a.stl"));
    Places<float> facets;
    for (std::size_t place = 84; place < bytes.size(); place += 50) {
        const auto record = at<std::array<std::array<float, 3>, 4>>(bytes, place);
        facets.push_back({record[1], record[2], record[3]});
    }
    check_watertight(facets);
}

TEST_CASE("volumes that are not sealed, unknown endings and missing folders are refused and leave nothing")
{
    const test::Folder folder;
    const auto open = test::prism({.sides = 5, .drop = test::without(false, false, false, {2})}).open();
    for (const char* name : {"a.stl", "a.obj", "a.msh"}) {
        CHECK(test::error_code([&] { io::write_facets(open, folder.file(name)); }) == "io.not_sealed");
    }
    try {
        io::write_facets(open, folder.file("a.stl"));
        FAIL("not refused");
    } catch (const InvalidInput& error) {
        CHECK(error.message().found() == std::vector<MessageValue>{4LL});
        CHECK(std::ranges::count(error.message().entities(), std::string("edge"), &NamedEntity::kind) == 4);
        CHECK(error.message().remedy() == "close() it first");
    }
    const auto sealed = test::prism({.sides = 5}).open();
    CHECK(test::error_code([&] { io::write_facets(sealed, folder.file("a.ply")); }) == "io.unknown_ending");
    CHECK(test::error_code([&] { io::write_facets(sealed, folder.file("a")); }) == "io.unknown_ending");
    CHECK(test::error_code([&] { io::write_facets(sealed, folder.file("no/a.stl")); }) == "io.no_folder");
    CHECK(folder.entries() == 0);
}
