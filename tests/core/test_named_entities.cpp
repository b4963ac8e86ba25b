// SPDX-License-Identifier: MIT
#include <lacuna/core/shared/named_entities.h>

#include <doctest/doctest.h>

#include <string>
#include <utility>
#include <vector>

using namespace lacuna;
using Entities = std::vector<NamedEntity>;

TEST_CASE("an entity is found wherever in a message it is named")
{
    for (const std::string kind : {"face", "void face", "edge", "vertex", "source loop", "node", "cell"}) {
        CAPTURE(kind);
        const Entities one{{kind, 12}};
        CHECK(named_entities(kind + " 12") == one);
        CHECK(named_entities("sweep: " + kind + " 12 folds; try a smaller size") == one);
        CHECK(named_entities("between " + kind + " 12 \"rim\" and the other, which is " + kind + " 12") ==
              one);
        CHECK(named_entities("(" + kind + " 12)") == one);
    }
}

TEST_CASE("lists name each entity, in order")
{
    const Entities three{{"face", 3}, {"face", 1}, {"face", 20}};
    CHECK(named_entities("faces 3, 1 and 20 fit") == three);
    CHECK(named_entities("faces 3 \"a\", 1 \"b, 4\" and 20") == three);
    CHECK(named_entities("faces 3, 1, and 20 of 25 faces") == three);
    CHECK(named_entities("edge 5 (vertices 1-2)") == Entities{{"edge", 5}, {"vertex", 1}, {"vertex", 2}});
}

TEST_CASE("counts, measures, names and words are no entities")
{
    for (const std::string text :
         {"4 faces are free", "a face 2.5 wide", "the surface 3", "faces", "face -3", "face \"face 7\"", "",
          "edges 3mm apart", "a \"quote without an end, face", "face 99999999999999999999999"}) {
        CAPTURE(text);
        CHECK(named_entities(text).empty());
    }
    CHECK(named_entities("of the source, face 3") == Entities{{"face", 3}});
}
