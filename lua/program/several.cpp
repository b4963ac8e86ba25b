// SPDX-License-Identifier: MIT
#include "program/several.h"

#include <lacuna/core/run_context.h>
#include <lacuna/mpi/ranks.h>

#include <algorithm>
#include <atomic>
#include <cstdio>

namespace lacuna::program {

bool is_first() { return mpi::place_of_process().rank == 0; }

bool is_one_of_several() { return mpi::place_of_process().size > 1; }

Exit run_as_several(const CommandLine& line, const std::function<Exit(const CommandLine&, const Crew*)>& run)
{
    if (line.action == Action::batch)
        throw BadUsage("-j cannot be used with mpirun: it starts its own processes");
    mpi::Ranks ranks;
    CommandLine own = line;
    if (own.threads == 0) own.threads = std::max(1, thread_count({}) / ranks.on_this_machine());
    if (ranks.place().rank > 0) {
        std::atomic<bool> cancel{false};
        watch_interrupts(cancel);
        RunContext context;
        context.threads = own.threads;
        context.cancel = &cancel;
        ranks.help(context);
        return Exit::done;
    }
    const Exit result = run(own, &ranks.crew());
    const int size = ranks.place().size;
    if (line.action == Action::run && result == Exit::done && !ranks.were_called())
        std::fprintf(
            stderr,
            "lacuna: note: the first of the %d processes did all the work; they only share the layers "
            "of volume:sweep_to and assembly:sweep_to\n",
            size);
    if (line.verbose) {
        const mpi::Traffic sent = ranks.traffic();
        std::fprintf(stderr, "lacuna: the first of %d processes sent %zu messages, %llu bytes\n", size,
                     sent.messages, static_cast<unsigned long long>(sent.bytes));
    }
    return result;
}

} // namespace lacuna::program
