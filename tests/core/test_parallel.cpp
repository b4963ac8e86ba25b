// SPDX-License-Identifier: MIT
#include <lacuna/core/error.h>
#include <lacuna/core/shared/parallel.h>

#include <doctest/doctest.h>

#include <atomic>
#include <limits>
#include <numeric>
#include <vector>

#ifdef __linux__
#include <fstream>
#include <sys/resource.h>
#include <unistd.h>
#endif

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

namespace {

void check_all_visited(int threads)
{
    std::vector<std::atomic<int>> visits(5000);
    RunContext context;
    context.threads = threads;
    parallel_for(context, visits.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) ++visits[i];
    });
    for (const std::atomic<int>& count : visits) CHECK(count == 1);
}

} // namespace

TEST_CASE("an absurd number of threads is cut down to a useful one")
{
    RunContext context;
    for (const int threads : {-1, 0, 100'000, std::numeric_limits<int>::max()}) {
        CAPTURE(threads);
        context.threads = threads;
        CHECK(thread_count(context) >= 1);
        CHECK(thread_count(context) <= 4096);
        check_all_visited(threads);
    }
}

#ifdef __linux__
TEST_CASE("where the system gives no more threads, those there are do all the work")
{
    // A thread's stack of 8 MB finds no room any more.
    std::ifstream statm("/proc/self/statm");
    rlim_t pages = 0;
    statm >> pages;
    rlimit before{};
    REQUIRE(getrlimit(RLIMIT_AS, &before) == 0);
    rlimit tight = before;
    tight.rlim_cur = pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + (rlim_t{4} << 20);
    REQUIRE(setrlimit(RLIMIT_AS, &tight) == 0);
    check_all_visited(64);
    setrlimit(RLIMIT_AS, &before);
}
#endif
