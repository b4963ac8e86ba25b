// SPDX-License-Identifier: MIT
#include <lacuna/core/error.h>
#include <lacuna/core/parallel.h>

#include <doctest/doctest.h>

#include <atomic>
#include <numeric>
#include <vector>

using namespace lacuna;

TEST_CASE("parallel_for visits every index once, for any thread count and grain")
{
    for (const int threads : {1, 2, 5}) {
        for (const std::size_t grain : {1u, 7u, 1000u}) {
            CAPTURE(threads);
            CAPTURE(grain);
            std::vector<int> visits(997, 0);
            RunContext context;
            context.threads = threads;
            parallel_for(context, visits.size(), grain, [&](std::size_t begin, std::size_t end) {
                for (std::size_t i = begin; i < end; ++i) ++visits[i];
            });
            for (const int count : visits) CHECK(count == 1);
        }
    }
}

TEST_CASE("an exception of a body reaches the caller")
{
    RunContext context;
    context.threads = 3;
    CHECK_THROWS_AS(parallel_for(context, 100, 1,
                                 [](std::size_t begin, std::size_t) {
                                     if (begin == 40) throw InvalidInput("test.body", "forty");
                                 }),
                    InvalidInput);
}

TEST_CASE("a cancelled run stops with Cancelled")
{
    const std::atomic<bool> cancel{true};
    RunContext context;
    context.cancel = &cancel;
    CHECK_THROWS_AS(parallel_for(context, 100, 1, [](std::size_t, std::size_t) {}), Cancelled);
}
