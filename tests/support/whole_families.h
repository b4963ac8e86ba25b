// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdlib>
#include <vector>

namespace lacuna::test {

/// Whether all members of families are run, not the few that a build can wait for.
inline bool whole_families() { return std::getenv("LACUNA_WHOLE_FAMILIES") != nullptr; }

/// Which members of a family are run: all where LACUNA_WHOLE_FAMILIES is set, else every `step`-th from the
/// first on. A step that has no factor in common with the numbers of values of a family's parameters leaves
/// no value out, if enough members are left.
class MembersToRun {
public:
    explicit MembersToRun(std::size_t step) : step_(whole_families() ? 1 : step) {}

    /// Whether the next member is one of them.
    bool next() { return at_++ % step_ == 0; }

private:
    std::size_t step_, at_ = 0;
};

/// Those members of a family.
template <class Member>
std::vector<Member> members_to_run(const std::vector<Member>& family, std::size_t step)
{
    MembersToRun run(step);
    std::vector<Member> some;
    for (const Member& member : family)
        if (run.next()) some.push_back(member);
    return some;
}

} // namespace lacuna::test
