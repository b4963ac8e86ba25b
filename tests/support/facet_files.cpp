// SPDX-License-Identifier: MIT
#include "support/facet_files.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <sstream>
#include <tuple>

namespace lacuna::test {
namespace {

template <class Value>
void put(std::string& to, Value value, bool big = false)
{
    const char* bytes = reinterpret_cast<const char*>(&value);
    std::string text(bytes, sizeof value);
    if (big) std::reverse(text.begin(), text.end());
    to += text;
}

std::string number(double x)
{
    std::ostringstream text;
    text.precision(17);
    text << x;
    return text.str();
}

/// Text of so many characters, blanks before it or behind it.
std::string field(const std::string& text, int width, bool right = true)
{
    const std::string blanks(static_cast<std::size_t>(std::max(0, width - static_cast<int>(text.size()))),
                             ' ');
    return right ? blanks + text : text + blanks;
}
std::string field(int n, int width) { return field(std::to_string(n), width); }

std::string side_name(int side) { return "side " + std::to_string(side); }

/// The two halves of every quad of a side.
std::vector<Triangle> triangles_of(const FacetBox& box, int side)
{
    std::vector<Triangle> all;
    for (std::size_t q = 0; q < box.quads.size(); ++q) {
        const Quad& c = box.quads[q];
        if (box.side[q] != side) continue;
        all.push_back({c[0], c[1], c[2]});
        all.push_back({c[0], c[2], c[3]});
    }
    return all;
}

std::string stl_text(const FacetBox& box)
{
    std::string text;
    for (int side = 1; side <= 6; ++side) {
        text += "solid " + side_name(side) + "\n";
        for (const Triangle& t : triangles_of(box, side)) {
            text += "  facet normal 0 0 1\n    outer loop\n";
            for (const Index p : t) {
                text += "      vertex";
                for (const double x : box.points[index(p)]) text += " " + number(x);
                text += "\n";
            }
            text += "    endloop\n  endfacet\n";
        }
        text += "endsolid " + side_name(side) + "\n";
    }
    return text;
}

std::string stl_binary(const FacetBox& box)
{
    std::string bytes;
    for (int side = 1; side <= 6; ++side) {
        bytes += field(side_name(side), 80, false);
        const std::vector<Triangle> all = triangles_of(box, side);
        put(bytes, static_cast<std::uint32_t>(all.size()));
        for (const Triangle& t : all) {
            for (int k = 0; k < 3; ++k) put(bytes, 0.0F);
            for (const Index p : t)
                for (const double x : box.points[index(p)]) put(bytes, static_cast<float>(x));
            put(bytes, std::uint16_t(0));
        }
    }
    return bytes;
}

std::string obj(const FacetBox& box, bool back)
{
    std::string text = "# a box\nmtllib none.mtl\n";
    for (const Vec3& p : box.points)
        text += "v " + number(p.x()) + " " + number(p.y()) + " " + number(p.z()) + "\n";
    int side = 0;
    for (std::size_t q = 0; q < box.quads.size(); ++q) {
        if (box.side[q] != side) text += "g " + side_name(side = box.side[q]) + "\nusemtl steel\n";
        text += "f";
        for (const Index p : box.quads[q])
            text += " " + std::to_string(back ? p - static_cast<int>(box.points.size()) : p + 1) +
                    (back ? "//1" : "/1/1");
        text += "\n";
    }
    return text;
}

/// Gmsh's own, as text or bytes.
std::string msh(const FacetBox& box, const std::string& version, bool binary)
{
    std::string out = "$MeshFormat\n" + version + (binary ? " 1 8\n" : " 0 8\n");
    const auto whole = [&](int n, const char* after) {
        binary ? put(out, n) : void(out += std::to_string(n) + after);
    };
    const auto size = [&](std::uint64_t n, const char* after) {
        binary ? put(out, n) : void(out += std::to_string(n) + after);
    };
    const auto real = [&](double x, const char* after) {
        binary ? put(out, x) : void(out += number(x) + after);
    };
    const auto point = [&](const Vec3& p) {
        real(p.x(), " ");
        real(p.y(), " ");
        real(p.z(), "\n");
    };
    const std::size_t quads = box.quads.size();
    if (binary) {
        put(out, 1);
        out += "\n";
    }
    out += "$EndMeshFormat\n$Comments\na box\n$EndComments\n$PhysicalNames\n6\n";
    for (int side = 1; side <= 6; ++side)
        out += "2 " + std::to_string(side) + " \"" + side_name(side) + "\"\n";
    out += "$EndPhysicalNames\n";
    if (version == "4.1") {
        out += "$Entities\n";
        for (const std::uint64_t n : {0, 0, 6, 0}) size(n, " ");
        for (int side = 1; side <= 6; ++side) {
            whole(side, " ");
            for (int k = 0; k < 6; ++k) real(k, " ");
            size(1, " ");
            whole(side, " ");
            size(0, "\n");
        }
        out += "\n$EndEntities\n$Nodes\n";
        for (const std::uint64_t n :
             {std::uint64_t(1), box.points.size(), std::uint64_t(1), box.points.size()})
            size(n, " ");
        for (const int n : {2, 1, 0}) whole(n, " ");
        size(box.points.size(), "\n");
        for (std::size_t p = 0; p < box.points.size(); ++p) size(p + 1, "\n");
        for (const Vec3& p : box.points) point(p);
        out += "\n$EndNodes\n$Elements\n";
        for (const std::uint64_t n : {std::uint64_t(6), quads, std::uint64_t(1), quads}) size(n, " ");
        for (int side = 1; side <= 6; ++side) {
            for (const int n : {2, side, 3}) whole(n, " ");
            size(static_cast<std::uint64_t>(std::count(box.side.begin(), box.side.end(), side)), "\n");
            for (std::size_t q = 0; q < quads; ++q) {
                if (box.side[q] != side) continue;
                size(q + 1, " ");
                for (const Index p : box.quads[q]) size(static_cast<std::uint64_t>(p) + 1, " ");
            }
        }
        return out + "\n$EndElements\n";
    }
    out += "$Nodes\n" + std::to_string(box.points.size()) + "\n";
    for (std::size_t p = 0; p < box.points.size(); ++p) {
        whole(static_cast<int>(p) + 1, " ");
        point(box.points[p]);
    }
    out += "\n$EndNodes\n$Elements\n" + std::to_string(quads) + "\n";
    if (binary)
        for (const int n : {3, static_cast<int>(quads), 2}) put(out, n);
    for (std::size_t q = 0; q < quads; ++q) {
        whole(static_cast<int>(q) + 1, " ");
        if (!binary) out += "3 2 ";
        whole(box.side[q], " ");
        whole(box.side[q], " ");
        for (const Index p : box.quads[q]) whole(p + 1, " ");
    }
    return out + "\n$EndElements\n";
}

std::string unv(const FacetBox& box, int nodes, int elements, int groups)
{
    std::string text = "    -1\n   164\n         1  SI: Meter (newton)         2\n    -1\n";
    const auto dataset = [&](int n) { text += "    -1\n" + field(n, 6) + "\n"; };
    const auto real = [](double x) {
        std::string t = number(x);
        return field(t.find('.') == std::string::npos ? t + ".0D+00" : t + "D+00", 25);
    };
    dataset(elements);
    for (std::size_t q = 0; q < box.quads.size(); ++q) {
        for (const int n : {static_cast<int>(q) + 1, 94, 7}) text += field(n, 10);
        if (elements == 780)
            for (const int n : {1, 8}) text += field(n, 10);
        else
            text += field(8, 10);
        for (const int n : elements == 780 ? std::vector{8, 1, 4} : std::vector{1, 4}) text += field(n, 10);
        text += "\n";
        for (const Index p : box.quads[q]) text += field(p + 1, 10);
        text += "\n";
    }
    text += "    -1\n";
    dataset(nodes);
    for (std::size_t p = 0; p < box.points.size(); ++p) {
        for (const int n : {static_cast<int>(p) + 1, 1, 1, 11}) text += field(n, 10);
        if (nodes != 15) text += "\n";
        for (const double x : box.points[p]) text += real(x);
        text += "\n";
    }
    text += "    -1\n";
    dataset(groups);
    const bool leaf = groups >= 2435;
    for (int side = 1; side <= 6; ++side) {
        std::vector<int> members;
        for (std::size_t q = 0; q < box.quads.size(); ++q)
            if (box.side[q] == side) members.push_back(static_cast<int>(q) + 1);
        for (const int n : {side, 0, 0, 0, 0, 0, 0, static_cast<int>(members.size())}) text += field(n, 10);
        text += "\n" + side_name(side) + "\n";
        for (std::size_t k = 0; k < members.size(); ++k) {
            text += field(8, 10) + field(members[k], 10);
            if (leaf) text += field(0, 10) + field(0, 10);
            if (k + 1 == members.size() || (k + 1) % (leaf ? 2 : 4) == 0) text += "\n";
        }
    }
    return text + "    -1\n";
}

/// @param parts  the box is a part that is put in place once, else it stands in the open.
std::string inp(const FacetBox& box, bool parts)
{
    std::string text = "*Heading\n a box\n";
    if (parts) text += "*Part, name=box\n";
    text += parts ? "*Node\n" : "*NODE, NSET=NALL\n";
    for (std::size_t p = 0; p < box.points.size(); ++p) {
        text += field(static_cast<int>(p) + 1, 7);
        for (const double x : box.points[p]) text += ", " + field(number(x), 12);
        text += "\n";
    }
    for (int side = 1; side <= 6; ++side) {
        text += (parts ? "*Element, type=S4R, elset=\"" : "*ELEMENT,\n  TYPE = S4, ELSET = ") +
                side_name(side) + (parts ? "\"\n" : "\n");
        for (std::size_t q = 0; q < box.quads.size(); ++q) {
            if (box.side[q] != side) continue;
            text += std::to_string(q + 1) + ",";
            for (std::size_t k = 0; k < 4; ++k)
                text += std::to_string(box.quads[q][k] + 1) + (k == 3             ? "\n"
                                                               : k == 1 && !parts ? ",\n"
                                                                                  : ", ");
        }
    }
    if (parts)
        return text +
               "*Shell Section, elset=\"side 2\", material=steel\n0.1, 5\n*End Part\n** \n*Assembly, "
               "name=whole\n*Instance, name=first, part=box\n*End Instance\n*Nset, nset=fixed, "
               "instance=first, generate\n1, 4, 1\n*End Assembly\n*Material, name=steel\n*Elastic\n2.1e5, "
               "0.3\n*Step\n*Static\n*End Step\n";
    return text + "*ELSET, ELSET=one\n1\n*NSET, NSET=some\n1, 2,\n3\n*SURFACE, NAME=below, TYPE=NODE\nsome\n";
}

/// @param free  fields are separated by commas, else they stand in columns.
std::string dyna(const FacetBox& box, bool free)
{
    const auto row = [free](const std::vector<std::string>& words, int first, int width) {
        std::string text;
        for (std::size_t k = 0; k < words.size(); ++k)
            text += free ? (k > 0 ? "," : "") + words[k] : field(words[k], k == 0 ? first : width);
        return text + "\n";
    };
    std::string text = "*KEYWORD\n$ a box\n*TITLE\nbox\n";
    for (int side = 1; side <= 6; ++side)
        text += "*PART\n" + side_name(side) + "\n" + row({std::to_string(side), "1", "1"}, 10, 10);
    text += "*NODE\n";
    for (std::size_t p = 0; p < box.points.size(); ++p) {
        std::vector<std::string> words{std::to_string(p + 1)};
        for (const double x : box.points[p]) words.push_back(number(x));
        text += row(words, 8, 16);
    }
    text += "*ELEMENT_SHELL\n";
    for (std::size_t q = 0; q < box.quads.size(); ++q) {
        std::vector<std::string> words{std::to_string(q + 1), std::to_string(box.side[q])};
        for (const Index p : box.quads[q]) words.push_back(std::to_string(p + 1));
        text += row(words, 8, 8);
    }
    text += "*SET_NODE_LIST_TITLE\nsome\n" + row({"1"}, 10, 10) + row({"1", "2", "3"}, 10, 10);
    return text + "*SECTION_SHELL\n" + row({"1", "2"}, 10, 10) + "*END\n";
}

enum class Fields { free, small, large, apart };

std::string bdf(const FacetBox& box, Fields kind)
{
    std::string text = "SOL 101\nCEND\nTITLE = a box\nBEGIN BULK\n$ nodes\n", later;
    const auto card = [&](const std::string& name, std::vector<std::string> fields) {
        // In free fields, but for the second line, which is named and comes behind all cards.
        if (kind == Fields::apart) {
            const std::string mark = "+" + name.substr(0, 2) + fields[0];
            text += name;
            for (std::size_t k = 0; k < std::min<std::size_t>(fields.size(), 8); ++k) text += "," + fields[k];
            if (fields.size() > 8) {
                text += "," + mark;
                later.insert(0, "\n");
                for (std::size_t k = fields.size(); k > 8; --k) later.insert(0, "," + fields[k - 1]);
                later.insert(0, mark);
            }
            text += "\n";
            return;
        }
        text += kind == Fields::free ? name : field(kind == Fields::large ? name + "*" : name, 8, false);
        for (std::size_t k = 0; k < fields.size(); ++k) {
            if (kind == Fields::free && k > 0 && k % 8 == 0) text += ",\n";
            if (kind == Fields::small && k > 0 && k % 8 == 0) text += "\n        ";
            if (kind == Fields::large && k > 0 && k % 4 == 0) text += "\n*       ";
            text += kind == Fields::free ? "," + fields[k]
                                         : field(fields[k], kind == Fields::small ? 8 : 16, false);
        }
        text += "\n";
    };
    const auto real = [](double x) {
        const std::string t = number(x);
        return t.find('.') == std::string::npos ? t + ".+0" : t;
    };
    for (std::size_t p = 0; p < box.points.size(); ++p) {
        const Vec3& at = box.points[p];
        card(kind == Fields::small ? "grid" : "GRID",
             {std::to_string(p + 10), "", real(at.x()), real(at.y()), real(at.z())});
    }
    for (std::size_t q = 0; q < box.quads.size(); ++q) {
        std::vector<std::string> fields{std::to_string(q + 1), std::to_string(box.side[q])};
        for (const Index p : box.quads[q]) fields.push_back(std::to_string(p + 10));
        // Eight-node quads name their corners first.
        if (q % 2 == 1)
            for (const Index p : box.quads[q]) fields.push_back(std::to_string(p + 10));
        card(q % 2 == 1 ? "CQUAD8" : "CQUAD4", fields);
    }
    return text + later + "PSHELL,1,1,0.1\nENDDATA\nwhat follows does not count\n";
}

std::string vtk(const FacetBox& box, const std::string& version, bool binary, bool poly)
{
    std::string out = "# vtk DataFile Version " + version + "\na box\n" + (binary ? "BINARY" : "ASCII") +
                      "\nDATASET " + (poly ? "POLYDATA" : "UNSTRUCTURED_GRID") + "\nPOINTS " +
                      std::to_string(box.points.size()) + " double\n";
    const std::size_t quads = box.quads.size();
    for (const Vec3& p : box.points)
        for (const double x : p) binary ? put(out, x, true) : void(out += number(x) + " ");
    out += "\n";
    const auto whole = [&](std::int64_t n, bool wide) {
        if (!binary)
            out += std::to_string(n) + " ";
        else if (wide)
            put(out, n, true);
        else
            put(out, static_cast<std::int32_t>(n), true);
    };
    const std::string word = poly ? "POLYGONS " : "CELLS ";
    if (version == "5.1") {
        out += "METADATA\nINFORMATION 0\n\n" + word + std::to_string(quads + 1) + " " +
               std::to_string(4 * quads) + "\nOFFSETS vtktypeint64\n";
        for (std::size_t q = 0; q <= quads; ++q) whole(static_cast<std::int64_t>(4 * q), true);
        out += "\nCONNECTIVITY vtktypeint64\n";
        for (const Quad& q : box.quads)
            for (const Index p : q) whole(p, true);
    } else {
        out += word + std::to_string(quads) + " " + std::to_string(5 * quads) + "\n";
        for (const Quad& q : box.quads) {
            whole(4, false);
            for (const Index p : q) whole(p, false);
        }
    }
    out += "\n";
    if (!poly) {
        out += "CELL_TYPES " + std::to_string(quads) + "\n";
        for (std::size_t q = 0; q < quads; ++q) whole(9, false);
        out += "\n";
    }
    return out + "CELL_DATA 1\nSCALARS x int 1\nLOOKUP_TABLE default\n1\n";
}

std::string base64(const std::string& bytes)
{
    const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; ++k)
            bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
        for (std::size_t k = 0; k < 4; ++k)
            text += i + k > bytes.size() ? '=' : digits[bits >> (18 - 6 * k) & 63];
    }
    return text;
}

std::string vtu(const FacetBox& box, const std::string& format, const std::string& encoding, bool big)
{
    std::string appended;
    const auto array = [&](const std::string& type, const std::string& attributes, auto values) {
        std::string text = "<DataArray type=\"" + type + "\" " + attributes + " format=\"" + format + "\"";
        std::string bytes, words;
        for (const auto value : values) {
            put(bytes, value, big);
            words += number(static_cast<double>(value)) + " ";
        }
        std::string head;
        put(head, static_cast<std::uint64_t>(bytes.size()), big);
        if (format == "ascii") return text + ">\n" + words + "\n</DataArray>\n";
        // Head and data together, or each encoded by itself: both are written in the wild.
        if (format == "binary") return text + ">\n  " + base64(head) + base64(bytes) + "\n</DataArray>\n";
        text += " offset=\"" + std::to_string(appended.size()) + "\"/>\n";
        appended += encoding == "raw" ? head + bytes : base64(head + bytes);
        return text;
    };
    std::vector<double> at;
    for (const Vec3& p : box.points) at.insert(at.end(), p.begin(), p.end());
    std::vector<std::int64_t> connectivity;
    std::vector<std::int32_t> ends;
    for (const Quad& q : box.quads) {
        connectivity.insert(connectivity.end(), q.begin(), q.end());
        ends.push_back(static_cast<std::int32_t>(connectivity.size()));
    }
    std::string out =
        "<?xml version=\"1.0\"?>\n<!-- a <box> -->\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
        "byte_order=\"" +
        std::string(big ? "BigEndian" : "LittleEndian") +
        "\" header_type=\"UInt64\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"" +
        std::to_string(box.points.size()) + "\" NumberOfCells=\"" + std::to_string(box.quads.size()) +
        "\">\n<Points>\n" + array("Float64", "Name=\"Points\" NumberOfComponents=\"3\"", at) +
        "</Points>\n<Cells>\n" + array("Int64", "Name=\"connectivity\"", connectivity) +
        array("Int32", "Name=\"offsets\"", ends) +
        array("UInt8", "Name='types'", std::vector<std::uint8_t>(box.quads.size(), 9)) +
        "</Cells>\n</Piece>\n</UnstructuredGrid>\n";
    if (!appended.empty())
        out += "<AppendedData encoding=\"" + encoding + "\">\n  _" + appended + "\n</AppendedData>\n";
    return out + "</VTKFile>\n";
}

std::string medit(const FacetBox& box)
{
    std::string text = "MeshVersionFormatted 2\nDimension 3\n# points\nVertices\n" +
                       std::to_string(box.points.size()) + "\n";
    for (const Vec3& p : box.points)
        text += number(p.x()) + " " + number(p.y()) + " " + number(p.z()) + " 0\n";
    text += "Edges 1\n1 2 5\nQuadrilaterals\n" + std::to_string(box.quads.size()) + "\n";
    for (std::size_t q = 0; q < box.quads.size(); ++q) {
        for (const Index p : box.quads[q]) text += std::to_string(p + 1) + " ";
        text += std::to_string(box.side[q]) + "\n";
    }
    return text + "End\n";
}

} // namespace

FacetBox facet_box()
{
    FacetBox box;
    std::map<std::tuple<int, int, int>, Index> at;
    const auto corner = [&](std::array<int, 3> p) {
        const auto [found, fresh] = at.try_emplace({p[0], p[1], p[2]}, static_cast<Index>(box.points.size()));
        if (fresh) box.points.emplace_back(p[0] * 1.25, p[1] * 0.5, p[2]);
        return found->second;
    };
    constexpr std::array<int, 3> kCells{3, 2, 1};
    for (int side = 1; side <= 6; ++side) {
        const auto axis = static_cast<std::size_t>((side - 1) % 3);
        const std::size_t u = (axis + 1) % 3;
        const std::size_t v = (axis + 2) % 3;
        for (int i = 0; i < kCells[u]; ++i) {
            for (int j = 0; j < kCells[v]; ++j) {
                const auto place = [&](int du, int dv) {
                    std::array<int, 3> p{};
                    p[axis] = side > 3 ? kCells[axis] : 0;
                    p[u] = i + du;
                    p[v] = j + dv;
                    return corner(p);
                };
                Quad q{place(0, 0), place(1, 0), place(1, 1), place(0, 1)};
                if (side <= 3) std::swap(q[1], q[3]);
                box.quads.push_back(q);
                box.side.push_back(side);
            }
        }
    }
    return box;
}

std::vector<FacetSample> facet_samples()
{
    const FacetBox box = facet_box();
    std::vector<FacetSample> all{{"text.stl", stl_text(box), true, false, 6, "side "},
                                 {"binary.Stl", stl_binary(box), false, false, 6, "side "},
                                 {"forward.obj", obj(box, false), true, true, 6, "side "},
                                 {"back.OBJ", obj(box, true), true, true, 6, "side "}};
    for (const char* version : {"2.2", "4.1"})
        for (const bool binary : {false, true})
            all.push_back({std::string("v") + version + (binary ? "b.msh" : "t.msh"),
                           msh(box, version, binary), !binary, true, 6, "side "});
    all.push_back({"new.unv", unv(box, 2411, 2412, 2467), true, true, 6, "side "});
    all.push_back({"old.unv", unv(box, 15, 71, 2429), true, true, 6, "side "});
    all.push_back({"middle.UNV", unv(box, 781, 780, 2435), true, true, 6, "side "});
    all.push_back({"free.bdf", bdf(box, Fields::free), true, true, 6, "pid:"});
    all.push_back({"small.nas", bdf(box, Fields::small), true, true, 6, "pid:"});
    all.push_back({"large.dat", bdf(box, Fields::large), true, true, 6, "pid:"});
    all.push_back({"apart.bdf", bdf(box, Fields::apart), true, true, 6, "pid:"});
    all.push_back({"open.inp", inp(box, false), true, true, 6, "side "});
    all.push_back({"parts.INP", inp(box, true), true, true, 6, "side "});
    all.push_back({"columns.k", dyna(box, false), true, true, 6, "side "});
    all.push_back({"commas.K", dyna(box, true), true, true, 6, "side "});
    for (const char* version : {"2.0", "5.1"})
        for (const bool binary : {false, true})
            for (const bool poly : {false, true})
                all.push_back({std::string("v") + version + (binary ? "b" : "t") + (poly ? "p.vtk" : "u.vtk"),
                               vtk(box, version, binary, poly), !binary, true, 1, ""});
    all.push_back({"text.vtu", vtu(box, "ascii", "", false), true, true, 1, ""});
    all.push_back({"inline.vtu", vtu(box, "binary", "", false), true, true, 1, ""});
    all.push_back({"big.vtu", vtu(box, "binary", "", true), true, true, 1, ""});
    all.push_back({"raw.vtu", vtu(box, "appended", "raw", false), false, true, 1, ""});
    all.push_back({"coded.vtu", vtu(box, "appended", "base64", false), true, true, 1, ""});
    all.push_back({"text.mesh", medit(box), true, true, 6, ""});
    return all;
}

} // namespace lacuna::test
