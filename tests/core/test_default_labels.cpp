// SPDX-License-Identifier: MIT
#include <lacuna/core/shared/default_labels.h>

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

using namespace lacuna;

namespace {

/// Words in backticks of a line.
std::vector<std::string> words_in(const std::string& line)
{
    std::vector<std::string> words;
    for (std::size_t at = line.find('`'); at != std::string::npos; at = line.find('`', at)) {
        const std::size_t end = line.find('`', at + 1);
        words.push_back(line.substr(at + 1, end - at - 1));
        at = end + 1;
    }
    return words;
}

/// A label as programs write it in capitals of any kind.
std::vector<std::string> spellings(const std::string& word)
{
    std::string upper = word;
    for (char& c : upper) c = static_cast<char>(c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c);
    return {word, upper, upper.substr(0, 1) + word.substr(1), " " + word};
}

} // namespace

TEST_CASE("labels that the reference lists are default ones, with their numbers, in any case of letters")
{
    const auto folder = std::filesystem::path(__FILE__).parent_path();
    std::ifstream file(folder / "../../docs/reference.md");
    std::string line;
    while (std::getline(file, line) && line != "### Names that programs give") continue;
    std::size_t rows = 0;
    while (std::getline(file, line) && !line.starts_with("So ")) {
        const bool begins = line.starts_with("| begins with |"), counted = line.starts_with("| is, with");
        if (!begins && !counted && !line.starts_with("| is |")) continue;
        ++rows;
        for (const std::string& word : words_in(line)) {
            CAPTURE(word);
            for (const std::string& label : spellings(word)) {
                CHECK(is_default_label(label) == !counted);
                CHECK(is_default_label(label + " that a user wrote") == begins);
                for (const char* number : {"1", " 12", "_3", ".7", "001", " (2)", "-4", " 7.6 1.1"})
                    CHECK(is_default_label(label + number));
            }
        }
        if (line.starts_with("| is")) CHECK(words_in(line).size() > 30);
    }
    CHECK(rows == 3);
    for (const char* label :
         {"Open CASCADE STEP translator 7.6 1.1", "NONE", "Solid1", "Face 12", "Boss-Extrude1", "12", "#7",
          "Part 1", "PartBody", "", "Exported from Blender-2.82"})
        CHECK(is_default_label(label));
}

TEST_CASE("names that somebody gave are none of them")
{
    for (const char* name :
         {"inlet", "outlet_1", "housing", "MAINBODY_BACK", "graphite", "Welle", "i02simp", "hot side", "hole",
          "cut", "box", "faceplate", "solid rotor", "part_left", "bodywork", "4th floor", "1a", "pad left"})
        CHECK(!is_default_label(name));
}
