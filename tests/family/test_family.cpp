// SPDX-License-Identifier: MIT
#include "family/family.h"

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
};

const std::vector<Refusal>& refusals()
{
    static const std::vector<Refusal> list{
        {"topology.wall_apart",
         "one circle of one edge has no vertex without a wall, unless its wall hangs on neither end",
         [](const Member& m) { return m.value == VolumeClass::II && m.loops == 1 && m.edges == 1; }},
        {"quality.inverted",
         "round holes whose walls do not say that they turn, and that change places with each other",
         [](const Member& m) {
             return m.value != VolumeClass::I && m.loops == 5 && m.edges == 1 && !m.halved && m.twist == 90;
         }},
        {"quality.inverted", "as above, the outer wall given and those of the holes void",
         [](const Member& m) {
             return m.value == VolumeClass::II && m.loops == 5 && m.edges == 1 && m.twist == 30;
         }},
        {"quality.inverted", "straight void walls between holes that change places, over a bowed target",
         [](const Member& m) {
             return m.value <= VolumeClass::II && m.loops == 5 && m.edges == 4 && m.target == End::bowed &&
                    m.twist == 90;
         }},
        {"quality.not_certified",
         "straight void walls of holes that change places, within a given wall that winds",
         [](const Member& m) {
             return m.value == VolumeClass::II && m.loops == 5 && m.edges == 4 && m.target != End::bowed &&
                    m.twist == 90;
         }},
    };
    return list;
}

bool refused_for_a_reason(const Member& member, const std::string& code)
{
    for (const Refusal& refusal : refusals()) {
        if (refusal.code == code && refusal.expected(member)) return true;
    }
    return false;
}

/// Every member of a class is meshed without fault, or refused for a reason that is listed.
void try_class(VolumeClass value)
{
    std::map<std::string, int> count;
    for (const Member& member : test::members(value)) {
        const std::string name = member.name();
        CAPTURE(name);
        const Ending ending = test::run(member);
        ++count[ending.code];
        std::string faults;
        for (const std::string& fault : ending.faults) faults += fault + "\n";
        CHECK_MESSAGE(faults.empty(), faults);
        const bool good = ending.code == "meshed" || refused_for_a_reason(member, ending.code);
        CHECK_MESSAGE(good, ending.code << ": " << ending.message);
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
