// SPDX-License-Identifier: MIT
#include <lacuna/core/error.h>
#include <lacuna/core/message.h>

#include <doctest/doctest.h>

#include <clocale>
#include <string>
#include <vector>

using namespace lacuna;

TEST_CASE("a message keeps what its text says as data")
{
    const NamedEntity face{"face", 12, "rim"}, edge{"edge", 3};
    const Message message = Message("sweep.example", "{} has {} sides, but {} are needed beside {}", face,
                                    found(7), needed(8), edge)
                                .remedy("take {} off, or {:.3g} times the size", face, 0.12345);
    CHECK(message.code() == "sweep.example");
    CHECK(message.text() == "face 12 \"rim\" has 7 sides, but 8 are needed beside edge 3; "
                            "take face 12 \"rim\" off, or 0.123 times the size");
    CHECK(message.entities() == std::vector<NamedEntity>{face, edge});
    CHECK(message.found() == std::vector<MessageValue>{7LL});
    CHECK(message.needed() == std::vector<MessageValue>{8LL});

    const NotSweepable error(message);
    CHECK(error.what() == message.text());
    CHECK(error.code() == "sweep.example");
    CHECK(error.message().entities() == message.entities());
}

TEST_CASE("lists in messages name six entities and count the others, which stay as data")
{
    std::vector<NamedEntity> faces;
    for (long long tag = 1; tag <= 40; ++tag) faces.push_back({"face", tag});
    const Message message("topology.example", "{} are free", faces);
    CHECK(message.text() == "face 1, face 2, face 3, face 4, face 5, face 6 and 34 more are free");
    CHECK(message.entities().size() == 40);
}

TEST_CASE("a message about a part names the part and keeps its data")
{
    const Message whole = Message("sweep.example", "{} folds", NamedEntity{"edge", 4})
                              .remedy("try more layers")
                              .attempt(Message("sweep.other", "no"));
    const Message part = whole.about("resin");
    CHECK(part.text() == "resin: edge 4 folds; try more layers");
    CHECK(part.remedy() == whole.remedy());
    CHECK(part.entities() == whole.entities());
    REQUIRE(part.attempts().size() == 1);
    CHECK(part.attempts().front().code() == "sweep.other");
}

TEST_CASE("text that holds braces is no format, and numbers do not follow the host's locale")
{
    CHECK(formatted("{}", "a {} of {:d}") == "a {} of {:d}");
    const std::string before = std::setlocale(LC_ALL, nullptr);
    for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8"})
        if (std::setlocale(LC_ALL, name) != nullptr) CHECK(formatted("{} {:.2f}", 0.5, 1.25) == "0.5 1.25");
    std::setlocale(LC_ALL, before.c_str());
}
