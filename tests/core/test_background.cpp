// SPDX-License-Identifier: MIT
#include <lacuna/core/error.h>
#include <lacuna/core/shared/background.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <string>
#include <thread>
#include <vector>

using namespace lacuna;

TEST_CASE("work beside other work gives its result, with one thread and with several")
{
    for (const int threads : {1, 2, 5}) {
        CAPTURE(threads);
        std::vector<std::string> notes;
        const std::thread::id here = std::this_thread::get_id();
        bool told_here = true;
        RunContext context;
        context.threads = threads;
        context.log = [&](std::string_view line) {
            told_here = told_here && std::this_thread::get_id() == here;
            notes.emplace_back(line);
        };
        Background<int> work(context, [](const RunContext& own) {
            log_line(own, "a note");
            return 10 * thread_count(own);
        });
        CHECK(work.take() == 10 * std::max(1, threads - 1));
        CHECK(notes == std::vector<std::string>{"a note"});
        CHECK(told_here);
    }
}

TEST_CASE("what work beside other work throws is thrown where it is taken, and nowhere if it is not")
{
    std::atomic<bool> cancel = true;
    for (const int threads : {1, 2}) {
        CAPTURE(threads);
        RunContext context;
        context.threads = threads;
        context.cancel = &cancel;
        const auto poll = [](const RunContext& own) {
            check_cancelled(own);
            return 0;
        };
        Background<int> taken(context, poll);
        CHECK_THROWS_AS(taken.take(), Cancelled);
        const Background<int> left(context, poll);
    }
}
