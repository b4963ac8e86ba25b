// SPDX-License-Identifier: MIT
//
// Files as other programs write them beside what manuals show: each says the same as a plain one.
#include "support/folder.h"
#include "support/refusal.h"

#include <lacuna/io/deck.h>
#include <lacuna/io/load_facets.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <random>
#include <sstream>

using namespace lacuna;

namespace {

using test::has;

std::string dialect_failure(const std::string& name, const std::string& bytes)
{
    try {
        io::read_facets(name, bytes);
    } catch (const InvalidInput& error) {
        return error.code() + ": " + error.what();
    }
    return "";
}

/// A block of nx × ny × nz hexahedra with spacings of halves and whole numbers.
struct Block {
    int nx, ny, nz;
    std::array<double, 3> step;

    [[nodiscard]] int tag(int i, int j, int k) const { return 1 + i + (nx + 1) * (j + (ny + 1) * k); }
    [[nodiscard]] int nodes() const { return (nx + 1) * (ny + 1) * (nz + 1); }
    [[nodiscard]] int cells() const { return nx * ny * nz; }
    [[nodiscard]] std::array<double, 3> at(int node) const
    {
        const int n = node - 1;
        return {n % (nx + 1) * step[0], n / (nx + 1) % (ny + 1) * step[1], n / (nx + 1) / (ny + 1) * step[2]};
    }
    [[nodiscard]] std::array<int, 8> cell(int number) const
    {
        const int i = number % nx, j = number / nx % ny, k = number / nx / ny;
        return {tag(i, j, k),     tag(i + 1, j, k),     tag(i + 1, j + 1, k),     tag(i, j + 1, k),
                tag(i, j, k + 1), tag(i + 1, j, k + 1), tag(i + 1, j + 1, k + 1), tag(i, j + 1, k + 1)};
    }
};

/// Twenty-five of them, the same every time.
std::vector<Block> blocks()
{
    std::mt19937 random(32);
    std::vector<Block> all;
    for (int b = 0; b < 25; ++b) {
        const auto upto = [&](unsigned most) { return 1 + static_cast<int>(random() % most); };
        all.push_back({upto(4), upto(3), upto(3), {upto(4) / 2.0, upto(4) / 2.0, upto(4) / 2.0}});
    }
    return all;
}

std::string real(double value)
{
    std::ostringstream text;
    text << value;
    return has(text.str(), ".") ? text.str() : text.str() + ".";
}

/// What a deck is, whatever its order: places of nodes, and nodes of elements, by their numbers.
struct Content {
    std::map<io::DeckTag, std::array<double, 3>> points;
    std::map<io::DeckTag, std::vector<io::DeckTag>> elements;
    friend bool operator==(const Content&, const Content&) = default;
};

Content content_of(const io::Deck& deck)
{
    Content content;
    for (std::size_t p = 0; p < deck.points.size(); ++p)
        content.points[deck.point_tags[p]] = {deck.points[p].x(), deck.points[p].y(), deck.points[p].z()};
    for (const io::DeckBlock& block : deck.blocks)
        for (std::size_t e = 0; e < block.count(); ++e)
            for (const Index node : block.element(e))
                content.elements[block.tags[e]].push_back(deck.point_tags[index(node)]);
    return content;
}

Content content_of(const Block& block)
{
    Content content;
    for (int n = 1; n <= block.nodes(); ++n) content.points[n] = block.at(n);
    for (int c = 0; c < block.cells(); ++c) {
        const auto nodes = block.cell(c);
        content.elements[c + 1].assign(nodes.begin(), nodes.end());
    }
    return content;
}

std::string grid_line(const Block& block, int node)
{
    const auto at = block.at(node);
    return "GRID," + std::to_string(node) + ",," + real(at[0]) + "," + real(at[1]) + "," + real(at[2]) + "\n";
}

std::string hex_card(const Block& block, int cell, int property = 1)
{
    const auto n = block.cell(cell);
    std::string text = "CHEXA," + std::to_string(cell + 1) + "," + std::to_string(property);
    for (std::size_t k = 0; k < 8; ++k) text += (k == 6 ? ",+\n+," : ",") + std::to_string(n[k]);
    return text + "\n";
}

std::string nastran(const Block& block)
{
    std::string text = "BEGIN BULK\n";
    for (int n = 1; n <= block.nodes(); ++n) text += grid_line(block, n);
    for (int c = 0; c < block.cells(); ++c) text += hex_card(block, c);
    return text + "PSOLID,1,1\nENDDATA\n";
}

/// In columns of eight.
std::string columns(const std::vector<std::string>& fields)
{
    std::string text;
    for (const std::string& field : fields) text += field + std::string(8 - field.size(), ' ');
    return text + "\n";
}

} // namespace

TEST_CASE("replicated cards of Nastran are what they would be written out")
{
    int style = 0;
    for (const Block& block : blocks()) {
        CAPTURE(style);
        const bool bare = style % 2 == 1, fixed = style % 3 == 1, counted = style % 4 < 2,
                   all = style % 5 < 2;
        ++style;
        const auto more = [&](const std::string& n) { return bare ? "*" + n : "*(" + n + ")"; };
        const auto line = [&](const std::vector<std::string>& fields) {
            if (fixed) return columns(fields);
            std::string text;
            for (const std::string& field : fields) text += (text.empty() ? "" : ",") + field;
            return text + "\n";
        };
        std::string text = "BEGIN BULK\n";
        for (int row = 1; row <= block.nodes(); row += block.nx + 1) {
            text += grid_line(block, row);
            std::vector<std::string> next{"=", more("1"), "=", more(real(block.step[0]))};
            if (all)
                next.emplace_back("==");
            else
                next.insert(next.end(), {"=", "="});
            text += line(next);
            if (block.nx < 2) continue;
            if (counted)
                text += (bare ? "=" : "=(") + std::to_string(block.nx - 1) + (bare ? "\n" : ")\n");
            else
                for (int i = 1; i < block.nx; ++i) text += line(next);
        }
        // Elements that go on in a second line; the property is repeated by a named card.
        for (int row = 0; row < block.cells(); row += block.nx) {
            text += hex_card(block, row);
            for (int i = 1; i < block.nx; ++i) {
                std::vector<std::string> first{i % 2 == 0 ? "=" : "CHEXA", more("1"), "="};
                first.resize(9, more("1"));
                first.emplace_back("+");
                text += line(first) + line({"+", more("1"), more("1")});
            }
        }
        text += "PSOLID,1,1\nENDDATA\n";
        CAPTURE(text);
        CHECK(content_of(io::read_deck("x.bdf", text)) == content_of(block));
    }
    const std::string flat = "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,0.,1.,0.\n";
    const std::string face = "CTRIA3,7,1,1,2,3\n";
    for (const auto& [deck, words] : std::vector<std::pair<std::string, std::string>>{
             {"=,*(1),=,*(1.),==\n" + flat + face, "line 1: expected a complete card right above ="},
             {flat + "=(2)\n" + face, "line 4: expected =n"},
             {flat + "=,*(1),*(2),==\n" + face, "line 4: cannot add '2' to ''"},
             {flat + "=,*(1.5),==\n" + face, "line 4: cannot add '1.5' to '3'"},
             {flat + "=,*(1),=,*(1.),==\n=(0)\n" + face, "line 5: expected =n"},
             {flat + "=,*(1),=,*(1.),==\n=999999\n" + face, "line 5: =999999 generates too many cards"},
             {flat + "CTRIA3,7,1,1,2,3,,,,+A\n=,*(1),==\n+A\n",
              "line 5: expected a complete card right above ="}}) {
        CAPTURE(deck);
        CHECK_MESSAGE(has(dialect_failure("x.bdf", deck), words), dialect_failure("x.bdf", deck));
    }
}

TEST_CASE("equations and labels of Nastran cards are text, commas or not, and are kept as they stand")
{
    const std::vector<std::string> texts{
        "DEQATN  7       F(A,B) = A + 2.*B\n        + SQRT(A)\n",
        "DEQATN  8       F(A,B,C,D,E,G,H,I,J,K,L)=A+B+C+D+E+G+H+I+J+K+L\n",
        "DEQATN,9,F(A,B)=MAX(A,B)\n",
        "DEQATN  10      F(X)=X\n+       ;MAX(X,1.),2.\n+A      -X\n",
        "deqatn* 11              F(X,Y)=X*Y\n*       +1., 2.\n",
        "MONPNT1 WING    left wing, inner, outer and tip, of all\n        123456  WING\n",
        "UDNAME  100\n        parts, old/plate.dll\n"};
    int number = 0;
    for (const Block& block : blocks()) {
        const std::string& text = texts[static_cast<std::size_t>(number++) % texts.size()];
        CAPTURE(text);
        std::string deck = nastran(block);
        const std::size_t at = deck.find(number % 2 == 0 ? "CHEXA,1," : "PSOLID");
        deck.insert(at, text);
        const io::Deck read = io::read_deck("x.bdf", deck);
        CHECK(content_of(read) == content_of(block));
        REQUIRE(read.texts.size() == 3);
        CHECK(has(read.texts[1].text, text));
    }
    // A card of fields stays one.
    CHECK(has(dialect_failure("x.bdf", "GRID    1       0.,0.,0.\n"), "io."));
}

TEST_CASE("decks that end with END BULK, lines without a name and continuations nobody named are read")
{
    int number = 0;
    for (const Block& block : blocks()) {
        CAPTURE(number);
        std::string deck = nastran(block);
        if (number % 2 == 0) deck.replace(deck.find("ENDDATA"), 7, "END BULK");
        // Field 10 of each card is blank, its continuation has a name.
        std::string named;
        if (number % 3 == 0) {
            for (std::size_t at = 0, count = 0; at < deck.size(); ++at) {
                if (deck.compare(at, 4, ",+\n+") != 0) {
                    named += deck[at];
                    continue;
                }
                named += "\n+C" + std::to_string(++count);
                at += 3;
            }
            // Other cards name theirs.
            named.insert(named.find("PSOLID"), "MAT9,5,1.,2.,3.,4.,5.,6.,7.,+M\n+M,8.,9.,10.,11.\n");
            deck = named;
        }
        if (number % 4 == 0)
            deck.insert(deck.find("PSOLID"),
                        "1                                   0.0\n*           0.0\n*       $\n");
        ++number;
        CAPTURE(deck);
        const io::Deck read = io::read_deck("x.bdf", deck);
        CHECK(content_of(read) == content_of(block));
        CHECK(read.texts.back().text == "ENDDATA\n");
    }
    const std::string flat = "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,0.,1.,0.\n";
    CHECK(has(dialect_failure("x.bdf", flat + "CTRIA3,7,1,1,2,3,,,,+W\n+X,1,2\n"),
              "the continuation '+X,1,2' belongs to no card"));
    CHECK(has(dialect_failure("x.bdf", flat + "2.5,7,1,1,2,3\n"), "expected the name of a bulk data card"));
}

TEST_CASE("superelements are one deck where their numbers do not clash, which is a warning")
{
    const std::string head = "SOL 101\nCEND\n";
    for (const Block& block : blocks()) {
        // The main bulk data have one half of the cells, a superelement the other; nodes of both are in both.
        std::string main = "BEGIN BULK\nMAT1,7,2.1+5,,.3\nPSOLID,1,7\n",
                    part = "BEGIN SUPER=3\nMAT1,7,2.1+5,,.3\n";
        part += "PSOLID,1,7\n";
        for (int n = 1; n <= block.nodes(); ++n) {
            main += grid_line(block, n);
            if (n > block.nodes() / 3) part += grid_line(block, n);
        }
        for (int c = 0; c < block.cells(); ++c) (c % 2 == 0 ? main : part) += hex_card(block, c);
        const io::Deck read = io::read_deck("x.bdf", head + main + part + "ENDDATA\n");
        CHECK(content_of(read) == content_of(block));
        REQUIRE(read.warnings.size() == 1);
        CHECK(read.warnings[0] == "x.bdf: read as one deck with its superelements (1)");
        REQUIRE(read.texts.size() == 3);
        CHECK(read.texts[0].text == head + "BEGIN BULK\n");
        CHECK(read.texts[1].text == "MAT1,7,2.1+5,,.3\nPSOLID,1,7\n");
        const std::string all = head + main + part;
        for (const auto& [more, words] : std::vector<std::pair<std::string, std::string>>{
                 {hex_card(block, 0), "element 1 occurs twice"},
                 {"GRID,1,,5.,5.,5.\n", "another GRID with this number"},
                 {"PSOLID,1,8\n", "another one has a different PSOLID 1"},
                 {"MAT1,7,1.+5,,.3\n", "another one has a different MAT1 7"},
                 {"SELOC,3,1,2,3,4,5,6\n", "moved, repeated or mirrored"},
                 {"SEBULK,4,MIRROR,3\n", "moved, repeated or mirrored"}}) {
            if (block.cells() < 2 && has(words, "element")) continue;
            CAPTURE(more);
            const std::string own = has(more, "SE") ? more : "BEGIN SUPER=4\n" + more;
            CHECK_MESSAGE(has(dialect_failure("x.bdf", all + own), words),
                          dialect_failure("x.bdf", all + own));
        }
    }
}

TEST_CASE("MSH files of version 1.0, and physical names of version 2.0, which have no dimension")
{
    for (const Block& block : blocks()) {
        std::string nodes, first, second;
        for (int n = 1; n <= block.nodes(); ++n) {
            const auto at = block.at(n);
            nodes += std::to_string(n) + " " + real(at[0]) + " " + real(at[1]) + " " + real(at[2]) + "\n";
        }
        for (int c = 0; c < block.cells(); ++c) {
            const std::string number = std::to_string(c + 1);
            std::string corners;
            for (const int node : block.cell(c)) corners += " " + std::to_string(node);
            first += number + " 5 7 3 8" + corners + "\n";
            second += number + " 5 3 7 3 0" + corners + "\n";
        }
        const auto n = block.cell(0);
        const std::string lid = std::to_string(n[0]) + " " + std::to_string(n[1]) + " " +
                                std::to_string(n[2]) + " " + std::to_string(n[3]) + "\n";
        const std::string count = std::to_string(block.nodes()) + "\n";
        const std::string cells = std::to_string(block.cells() + 1) + "\n";
        const std::string last = std::to_string(block.cells() + 1);
        const std::string old = "$NOD\n" + count + nodes + "$ENDNOD\n$ELM\n" + cells + first + last +
                                " 3 9 4 4 " + lid + "$ENDELM\n";
        const std::string named = "$MeshFormat\n2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n7 \"My block\"\n"
                                  "9\"lid\"\n$EndPhysicalNames\n$Nodes\n" +
                                  count + nodes + "$EndNodes\n$Elements\n" + cells + second + last +
                                  " 3 3 9 4 0 " + lid + "$EndElements\n";
        const io::Deck one = io::read_deck("x.msh", old), two = io::read_deck("x.msh", named);
        CHECK(content_of(one) == content_of(two));
        CHECK(one.element_count(3) == std::size_t(block.cells()));
        REQUIRE(two.sets.size() == 2);
        CHECK(two.sets[0].name == "lid");
        CHECK(two.sets[1].name == "My block");
        REQUIRE(one.sets.size() == 2);
        CHECK(one.sets[1].members == two.sets[1].members);

        std::string wrong = old;
        wrong.replace(wrong.find(" 5 7 3 8 "), 9, " 5 7 3 9 ");
        CHECK(has(dialect_failure("x.msh", wrong), "has 8 nodes, not 9"));
        wrong = old;
        wrong.replace(wrong.find("$ELM\n"), 5 + cells.size(), "$ELM\n999999999\n");
        CHECK(has(dialect_failure("x.msh", wrong), "too short"));
        wrong = named;
        wrong.replace(wrong.find("2 0 8"), 5, "2.2 0 8");
        CHECK(has(dialect_failure("x.msh", wrong), "expected a small whole number, found"));
        for (std::size_t length = 5; length < old.size(); length += 37)
            CHECK(has(dialect_failure("x.msh", old.substr(0, length)), "io."));
    }
}

TEST_CASE("an STL solid may end in two words, and its loops and facets too")
{
    std::mt19937 random(7);
    for (int trial = 0; trial < 24; ++trial) {
        const auto end = [&](const std::string& what) {
            const char* words[] = {"end", "end ", "END ", "End\t"};
            return words[random() % 4] + what + "\n";
        };
        std::string text;
        const int solids = 1 + trial % 3, facets = 1 + trial % 5;
        for (int s = 0; s < solids; ++s) {
            text += "solid part\n";
            for (int f = 0; f < facets; ++f)
                text += " facet normal 0 0 0\n  outer loop\n   vertex 0 0 " + std::to_string(f) +
                        "\n   vertex 1 0 0\n   vertex 0 1 0\n  " + end("loop") + " " + end("facet");
            text += "end solid" + std::string(trial % 2 == 0 ? " part\n" : "\n");
        }
        CAPTURE(text);
        CHECK(io::read_facets("x.stl", text).soup.triangles.size() == std::size_t(solids * facets));
        std::string wrong = text;
        wrong.replace(wrong.rfind("end solid"), 9, "end facet");
        CHECK(has(dialect_failure("x.stl", wrong), "expected solid, found 'facet'"));
        wrong.replace(wrong.rfind("end facet"), 9, "ends");
        CHECK(has(dialect_failure("x.stl", wrong), "expected endsolid, found 'ends'"));
    }
}

TEST_CASE("lines between the datasets of a universal file are passed over, also numbers, but no dataset")
{
    const std::vector<std::string> lines{"Workpiece",
                                         "File written 19 May 2019 09:58:46",
                                         "19 May 2019",
                                         "-1 is a mark",
                                         "*** end of block ***",
                                         "2019 5 19",
                                         "  17",
                                         "0.5 1e3",
                                         "2411"};
    int number = 0;
    for (const Block& block : blocks()) {
        std::vector<std::string> sets(2);
        sets[0] = "    -1\n  2411\n";
        for (int n = 1; n <= block.nodes(); ++n) {
            const auto at = block.at(n);
            sets[0] += std::to_string(n) + " 1 1 11\n " + real(at[0]) + " " + real(at[1]) + " " +
                       real(at[2]) + "\n";
        }
        sets[1] = "    -1\n  2412\n";
        for (int c = 0; c < block.cells(); ++c) {
            sets[1] += std::to_string(c + 1) + " 115 1 1 7 8\n";
            for (const int node : block.cell(c)) sets[1] += " " + std::to_string(node);
            sets[1] += "\n";
        }
        for (std::string& set : sets) set += "    -1\n";
        const std::string& text = lines[static_cast<std::size_t>(number) % lines.size()];
        std::string file;
        for (int k = 0; k < 3; ++k) {
            for (int l = 0; l < (number + k) % 3; ++l) file += text + "\n";
            if (k < 2) file += sets[static_cast<std::size_t>(k)];
        }
        ++number;
        CAPTURE(file);
        const io::Deck read = io::read_deck("x.unv", file);
        CHECK(content_of(read) == content_of(block));
        CHECK(has(dialect_failure("x.unv", sets[0] + sets[1].substr(sets[1].find("2412"))),
                  "expected -1, which begins a dataset"));
        CHECK(has(dialect_failure("x.unv", text + "\n"), "io."));
    }
}

TEST_CASE("nodes that an element lists too many are left out with a warning, one kind for a keyword")
{
    int number = 0;
    for (const Block& block : blocks()) {
        const int further = 1 + number % 5;
        std::string text = "*NODE\n";
        for (int n = 1; n <= block.nodes(); ++n) {
            const auto at = block.at(n);
            text += std::to_string(n) + ", " + real(at[0]) + ", " + real(at[1]) + ", " + real(at[2]) + "\n";
        }
        text += "*ELEMENT, TYPE=C3D8  , ELSET=B1\n";
        std::string wrong = text;
        for (int c = 0; c < block.cells(); ++c) {
            std::string line = std::to_string(c + 1);
            for (const int node : block.cell(c)) line += ", " + std::to_string(node);
            for (int k = 0; k < further + c % 2; ++k) {
                if (k < further) text += k == 0 ? line + ", 1" : ", " + std::to_string(k + 1);
                wrong += k == 0 ? line + ", 1" : ", " + std::to_string(k + 1);
            }
            text += number % 2 == 0 ? ",\n" : "\n";
            wrong += ",\n";
        }
        ++number;
        CAPTURE(text);
        const io::Deck read = io::read_deck("x.inp", text);
        CHECK(content_of(read) == content_of(block));
        REQUIRE(read.warnings.size() == 1);
        CHECK(has(read.warnings[0], "elements C3D8 list too many nodes"));
        CHECK(has(read.warnings[0], "up to " + std::to_string(further) + " nodes per element"));
        if (block.cells() > 1) CHECK(has(dialect_failure("x.inp", wrong), "found another number"));
    }
    // Twenty nodes in two lines are no eight and a second element.
    std::string text = "*NODE\n";
    for (int n = 1; n <= 20; ++n) text += std::to_string(n) + ", " + std::to_string(n * n) + ", 1, 2\n";
    text +=
        "*ELEMENT, TYPE=C3D8\n1, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15,\n16, 17, 18, 19, 20\n";
    CHECK(has(dialect_failure("x.inp", text), "found another number"));
}

TEST_CASE("AVS and HEC-MW files are refused by their names, whatever their ending")
{
    int number = 0;
    const std::vector<std::string> endings{".inp", ".msh", ".dat", ".unv", ".obj"};
    for (const Block& block : blocks()) {
        std::string avs = number % 2 == 0 ? "# made by a program, 2019\n" : "";
        avs += std::to_string(block.nodes()) + " " + std::to_string(block.cells()) + " 0 1 0\n";
        std::string hec = number % 3 == 0 ? "!! a comment\n" : number % 3 == 1 ? "# a comment\n" : "";
        hec += number % 2 == 0 ? "!HEADER, VERSION=1\n title\n!NODE\n" : "!NODE\n";
        for (int n = 1; n <= block.nodes(); ++n) {
            const auto at = block.at(n);
            avs += std::to_string(n) + "  " + real(at[0]) + " " + real(at[1]) + " " + real(at[2]) + "\n";
            hec += std::to_string(n) + ", " + real(at[0]) + ", " + real(at[1]) + ", " + real(at[2]) + "\n";
        }
        const std::string ending = endings[static_cast<std::size_t>(number++) % endings.size()];
        CAPTURE(ending);
        CHECK(has(dialect_failure("x" + ending, avs), "an AVS UCD file, a format that is not supported"));
        CHECK(has(dialect_failure("x" + ending, hec), "a HEC-MW mesh, a format that is not supported"));
    }
    // Counts alone are no such file.
    CHECK(has(dialect_failure("x.inp", "1 2 3 4 5\n*NODE\n"), "io.no_faces"));
}

TEST_CASE("binary AVS files are refused by that name, in either byte order")
{
    int number = 0;
    const std::vector<std::string> endings{".inp", ".msh", ".dat", ".unv", ".obj"};
    for (const Block& block : blocks()) {
        for (const bool big : {false, true}) {
            std::string bytes = "\x07";
            const auto add = [&](auto value) {
                std::array<char, sizeof value> own;
                std::memcpy(own.data(), &value, sizeof value);
                if (big) std::reverse(own.begin(), own.end());
                bytes.append(own.data(), own.size());
            };
            for (const int count : {block.nodes(), block.cells(), 0, 1, 0, 8 * block.cells()}) add(count);
            for (int c = 0; c < block.cells(); ++c)
                for (const int what : {c + 1, 1, 8, 7}) add(what);
            for (int c = 0; c < block.cells(); ++c)
                for (const int node : block.cell(c)) add(node);
            for (std::size_t axis = 0; axis < 3; ++axis)
                for (int n = 1; n <= block.nodes(); ++n) add(static_cast<float>(block.at(n)[axis]));
            const std::string ending = endings[static_cast<std::size_t>(number++) % endings.size()];
            CAPTURE(ending);
            CHECK(has(dialect_failure("x" + ending, bytes),
                      "a binary AVS UCD file, a format that is not supported"));
            // One that ends before its counts do is no such file.
            CHECK(!has(dialect_failure("x" + ending, bytes.substr(0, bytes.size() - 1)), "AVS"));
        }
    }
}

TEST_CASE("OBJ lines go on behind a backslash, comments do not")
{
    std::mt19937 random(3);
    for (const Block& block : blocks()) {
        std::string plain, broken;
        for (int n = 1; n <= block.nodes(); ++n) {
            const auto at = block.at(n);
            plain += "v " + real(at[0]) + " " + real(at[1]) + " " + real(at[2]) + "\n";
        }
        for (int c = 0; c < block.cells(); ++c) {
            const auto n = block.cell(c);
            plain += "f " + std::to_string(n[0]) + " " + std::to_string(n[1]) + " " + std::to_string(n[2]) +
                     " " + std::to_string(n[3]) + "\n";
        }
        for (const char c : plain) {
            const bool breaks = c == ' ' && random() % 3 == 0;
            broken += breaks ? std::string(" \\") + (random() % 2 == 0 ? "\r\n" : "\n") : std::string(1, c);
            if (c == '\n' && random() % 4 == 0) broken += "# C:\\models\\\n";
        }
        CAPTURE(broken);
        const io::FacetFile a = io::read_facets("x.obj", plain), b = io::read_facets("x.obj", broken);
        CHECK(a.soup.points == b.soup.points);
        CHECK(a.soup.quads == b.soup.quads);
        CHECK(has(dialect_failure("x.obj", plain + "f 1 2 \\\n"), "three corners"));
    }
}
