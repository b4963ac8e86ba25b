// SPDX-License-Identifier: MIT
#include <lacuna/core/shared/nearest_word.h>

#include <doctest/doctest.h>

#include <string>
#include <vector>

using namespace lacuna;

namespace {

/// Words over a small alphabet: every one up to three letters.
std::vector<std::string> small_words()
{
    std::vector<std::string> words{""};
    for (std::size_t begin = 0, length = 0; length < 3; ++length) {
        const std::size_t end = words.size();
        for (std::size_t i = begin; i < end; ++i)
            for (const char c : {'a', 'b', 'c'}) words.push_back(words[i] + c);
        begin = end;
    }
    return words;
}

} // namespace

TEST_CASE("edit distance is a metric: zero to itself alone, the same both ways, no detour shorter")
{
    const std::vector<std::string> words = small_words();
    REQUIRE(words.size() == 1 + 3 + 9 + 27);
    for (const std::string& a : words)
        for (const std::string& b : words) {
            const std::size_t direct = edit_distance(a.c_str(), b.c_str());
            CHECK((direct == 0) == (a == b));
            CHECK(direct == edit_distance(b.c_str(), a.c_str()));
            for (const std::string& c : words)
                CHECK_FALSE(edit_distance(a.c_str(), c.c_str()) + edit_distance(c.c_str(), b.c_str()) <
                            direct);
        }
}

TEST_CASE("one letter added, dropped or changed is a distance of one, at every place and length")
{
    for (std::size_t length = 1; length < 90; length += 11) {
        const std::string word(length, 'x');
        for (std::size_t place = 0; place < length && place < 63; ++place) {
            std::string added = word, changed = word;
            added.insert(place, 1, 'o');
            changed[place] = 'o';
            CAPTURE(length);
            CAPTURE(place);
            if (length < 63) CHECK(edit_distance(word.c_str(), added.c_str()) == 1);
            CHECK(edit_distance(word.c_str(), changed.c_str()) == 1);
            CHECK(edit_distance(word.c_str(), word.substr(1).c_str()) == 1);
        }
    }
}

TEST_CASE("every key with one letter wrong is nearest to itself")
{
    const char* const keys[] = {
        "layers",  "size",    "quads",     "order", "serendipity",  "min_scaled_jacobian",
        "improve", "threads", "curvature", "gap",   "max_deviation"};
    for (std::size_t k = 0; k < std::size(keys); ++k)
        for (std::size_t place = 0; place < std::string(keys[k]).size(); ++place) {
            std::string typo = keys[k];
            typo[place] = '#';
            CHECK(nearest_word(typo.c_str(), keys) == k);
        }
}
