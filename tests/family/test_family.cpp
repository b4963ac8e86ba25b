// SPDX-License-Identifier: MIT
#include "family/family.h"
#include "support/whole_families.h"

#include <doctest/doctest.h>

#include <functional>
#include <map>

using namespace lacuna;
using test::End;
using test::Ending;
using test::Member;
using topology::VolumeClass;

namespace {

/// A refusal that has a geometric reason.
struct Refusal {
    std::string code, reason;
    std::function<bool(const Member&)> expected;
    bool following_meshes = false; ///< void edges that follow the given walls make it good
};

/// Square holes on a circle, a quarter turn, so that each takes the next one's place.
bool square_holes_change_places(const Member& m) { return m.loops == 5 && m.edges == 4 && m.twist == 90; }

const std::vector<Refusal>& refusals()
{
    static const std::vector<Refusal> list{
        {"topology.wall_apart",
         "one circle of one edge has a vertex without a wall only if its wall hangs on neither end",
         [](const Member& m) { return m.value == VolumeClass::II && m.loops == 1 && m.edges == 1; }},
        {"quality.inverted",
         "without walls the square outer loop fits unturned as well as turned, its holes only turned",
         [](const Member& m) {
             return m.value == VolumeClass::I && square_holes_change_places(m) && m.target == End::bowed;
         }},
        {"quality.inverted", "straight void walls of holes that go round, in given walls that wind",
         [](const Member& m) {
             return m.value == VolumeClass::II && square_holes_change_places(m) && m.target == End::bowed;
         },
         true},
        {"quality.not_certified", "straight void walls of holes that go round, in given walls that wind",
         [](const Member& m) {
             return m.value == VolumeClass::II && square_holes_change_places(m) && m.target != End::bowed;
         },
         true},
    };
    return list;
}

const Refusal* reason_of(const Member& member, const std::string& code)
{
    for (const Refusal& refusal : refusals()) {
        if (refusal.code == code && refusal.expected(member)) return &refusal;
    }
    return nullptr;
}

std::string in_lines(const std::vector<std::string>& faults)
{
    std::string text;
    for (const std::string& fault : faults) text += fault + "\n";
    return text;
}

/// Every member of a class is meshed without fault, or refused for a reason that is listed.
void try_class(VolumeClass value)
{
    std::map<std::string, int> count;
    for (const Member& member : test::members_to_run(test::members(value), 11)) {
        const std::string name = member.name();
        CAPTURE(name);
        const Ending ending = test::run(member);
        ++count[ending.code];
        CHECK_MESSAGE(ending.faults.empty(), in_lines(ending.faults));
        if (ending.code == "meshed") continue;
        const Refusal* reason = reason_of(member, ending.code);
        CHECK_MESSAGE(reason != nullptr, ending.code << ": " << ending.message);
        if (reason == nullptr || !reason->following_meshes) continue;
        const Ending followed = test::run(member, closure::EdgeShape::follow);
        CHECK_MESSAGE(followed.code == "meshed", followed.message);
        CHECK_MESSAGE(followed.faults.empty(), in_lines(followed.faults));
    }
    std::string line = "class " + std::string(to_string(value)) + ":";
    for (const auto& [code, times] : count) line += " " + std::to_string(times) + " " + code;
    MESSAGE(line);
}

} // namespace

TEST_CASE("class I of any loops, ends, edges and twist is meshed, or refused for a reason")
{
    try_class(VolumeClass::I);
}
TEST_CASE("class II of any loops, ends, edges and twist is meshed, or refused for a reason")
{
    try_class(VolumeClass::II);
}
TEST_CASE("class III of any loops, ends, edges and twist is meshed, or refused for a reason")
{
    try_class(VolumeClass::III);
}
TEST_CASE("class IV of any loops, ends, edges and twist is meshed, or refused for a reason")
{
    try_class(VolumeClass::IV);
}
TEST_CASE("class V of any loops, ends, edges and twist is meshed, or refused for a reason")
{
    try_class(VolumeClass::V);
}
