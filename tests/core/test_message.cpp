// SPDX-License-Identifier: MIT
#include <lacuna/core/error.h>
#include <lacuna/core/message.h>
#include <lacuna/core/shared/bytes.h>

#include <doctest/doctest.h>

#include <clocale>
#include <cstdint>
#include <random>
#include <string>
#include <utility>
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
    CHECK(part.text() == "resin: edge 4 folds; try more layers (no)");
    CHECK(part.remedy() == whole.remedy());
    CHECK(part.entities() == whole.entities());
    REQUIRE(part.attempts().size() == 1);
    CHECK(part.attempts().front().code() == "sweep.other");
}

TEST_CASE("a message that quotes another has its text, entities and values")
{
    const NamedEntity face{"face", 12}, edge{"edge", 3};
    const Message inner = Message("cad.inner", "{} is {} long", edge, found(2)).remedy("give {}", needed(3));
    const Message outer =
        Message("cad.outer", "{} could not be made: {}", face, inner.parts()).remedy("write facets");
    CHECK(outer.text() == "face 12 could not be made: edge 3 is 2 long; give 3; write facets");
    CHECK(outer.code() == "cad.outer");
    CHECK(outer.entities() == std::vector<NamedEntity>{face, edge});
    CHECK(outer.found() == inner.found());
    CHECK(outer.needed() == inner.needed());
}

TEST_CASE(
    "a remedy or an attempt makes another message, and numbers above those with a sign are printed whole")
{
    Message message("core.large", "{} cells", found(std::uint64_t(1) << 63));
    CHECK(message.text() == "9223372036854775808 cells");
    CHECK(message.found() == std::vector<MessageValue>{"9223372036854775808"});
    message = message.remedy("ask for fewer").attempt(message);
    message = std::move(message).remedy("ask for {}", needed(5U));
    CHECK(message.text() == "9223372036854775808 cells; ask for 5"); // it says already why the attempt failed
    CHECK(message.attempts().size() == 1);
    CHECK(message.needed() == std::vector<MessageValue>{5LL});
}

TEST_CASE("text that holds braces is no format, and numbers do not follow the host's locale")
{
    CHECK(formatted("{}", "a {} of {:d}") == "a {} of {:d}");
    const std::string before = std::setlocale(LC_ALL, nullptr);
    for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8"})
        if (std::setlocale(LC_ALL, name) != nullptr) CHECK(formatted("{} {:.2f}", 0.5, 1.25) == "0.5 1.25");
    std::setlocale(LC_ALL, before.c_str());
}

namespace {

/// Bytes that stand for parts are written again as they came; all others are a ProtocolError.
void check_bytes(const std::string& bytes)
{
    MessageParts parts;
    try {
        Reader reader(bytes);
        reader(parts);
        reader.finish();
    } catch (const ProtocolError&) {
        return;
    }
    Writer writer;
    writer(Message(parts).parts());
    CHECK(std::move(writer).take() == bytes);
}

} // namespace

TEST_CASE("a message that another process rebuilds from its parts has the same text and data")
{
    const NamedEntity face{"face", 12, "{rim}"}, edge{"edge", 3, {}, std::pair(4, 9)};
    const Message sent = Message("cad.example", "{} and {} are {:.2f} apart, not {}", face, edge, found(0.5),
                                 needed("touching"))
                             .remedy("give {} {} sides", edge, needed(8));
    Writer writer;
    writer(sent.parts());
    const std::string bytes = std::move(writer).take();
    MessageParts parts;
    Reader reader(bytes);
    reader(parts);
    reader.finish();
    const Message got(std::move(parts));
    CHECK(got.code() == sent.code());
    CHECK(got.text() == "face 12 \"{rim}\" and edge 3 (vertices 4-9) are 0.50 apart, not touching; "
                        "give edge 3 (vertices 4-9) 8 sides");
    CHECK(got.remedy() == sent.remedy());
    REQUIRE(got.entities() == std::vector<NamedEntity>{face, edge, {"vertex", 4}, {"vertex", 9}});
    CHECK(got.entities()[0].name == "{rim}");
    CHECK(got.entities()[1].ends == edge.ends);
    CHECK(got.found() == sent.found());
    CHECK(got.needed() == sent.needed());
    CHECK(got.about("process 2").text() == "process 2: " + sent.text());

    std::mt19937 dice(7);
    for (int k = 0; k < 2000; ++k) {
        std::string changed = bytes;
        changed[dice() % changed.size()] = static_cast<char>(dice());
        check_bytes(changed);
        changed.resize(dice() % changed.size());
        check_bytes(changed);
    }
}
